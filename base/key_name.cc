// SPDX-License-Identifier: Apache-2.0
#include "base/key_name.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/words.h"

namespace floorproof {
namespace {

constexpr std::pair<std::string_view, std::string_view> kUnits[] = {
    {"_mps2", "m/s²"}, {"_mps", "m/s"}, {"_radps", "rad/s"}, {"_degps", "°/s"}, {"_deg", "°"},
    {"_rad", "rad"},   {"_hz", "Hz"},   {"_kg", "kg"},       {"_m", "m"},       {"_s", "s"}};

bool IsNumber(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

KeyName NameOfKey(std::string_view path) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= path.size();) {
    const std::size_t end = std::min(path.find('.', at), path.size());
    parts.emplace_back(path.substr(at, end - at));
    at = end + 1;
  }
  KeyName key;
  std::string last = parts.back();
  for (const auto& [suffix, unit] : kUnits)
    if (last.size() > suffix.size() && last.ends_with(suffix)) {
      last.resize(last.size() - suffix.size());
      key.unit = unit;
      break;
    }
  key.name = Words(last);
  if (parts.size() < 2) return key;
  const std::string& before = parts[parts.size() - 2];
  std::string of = Words(before);
  if (IsNumber(before) && parts.size() > 2) {  // of a list: "fault 0"
    std::string list = Words(parts[parts.size() - 3]);
    if (list.ends_with('s')) list.pop_back();
    of = list + " " + before;
  }
  key.name = of + " " + key.name;
  return key;
}

KeyScale ScaleOf(const KeyName& key, double most) {
  if (key.unit == "m" && std::abs(most) < 1) return {1000, "mm"};
  return {1, key.unit};
}

}  // namespace floorproof

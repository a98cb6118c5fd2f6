// SPDX-License-Identifier: Apache-2.0
#include "base/key_name.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
  // The part behind the last dot, which the path then lacks.
  const auto take = [&path] {
    const std::size_t dot = path.rfind('.');
    const std::string_view part = path.substr(dot + 1);  // all of it, where there is none
    path = path.substr(0, dot == path.npos ? 0 : dot);
    return part;
  };
  const bool alone = path.find('.') == path.npos;
  std::string_view last = take();
  KeyName key;
  for (const auto& [suffix, unit] : kUnits)
    if (last.size() > suffix.size() && last.ends_with(suffix)) {
      last.remove_suffix(suffix.size());
      key.unit = unit;
      break;
    }
  key.name = Words(last);
  if (alone) return key;
  const std::string_view before = take();
  std::string of = Words(before);
  if (IsNumber(before) && !path.empty()) {  // of a list: "fault 0"
    std::string list = Words(take());
    if (list.ends_with('s')) list.pop_back();
    of = list + " " + of;
  }
  key.name = of + " " + key.name;
  return key;
}

KeyScale ScaleOf(const KeyName& key, double most) {
  if (key.unit == "m" && std::abs(most) < 1) return {1000, "mm"};
  return {1, key.unit};
}

}  // namespace floorproof

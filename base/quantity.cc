// SPDX-License-Identifier: Apache-2.0
#include "base/quantity.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace floorproof {
namespace {

constexpr int kMostDecimals = 12;

std::string Group(std::string digits) {
  const std::size_t first = digits.front() == '-' ? 1 : 0;
  for (std::size_t at = std::min(digits.find('.'), digits.size()); at > first + 3;)
    digits.insert(at -= 3, ",");
  return digits;
}

// Without grouping, and without the sign of a zero.
std::string Fixed(double value, int decimals) {
  std::array<char, 400> text{};  // the largest double has 309 digits
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value,
                                          std::chars_format::fixed, decimals);
  std::string out(text.data(), end);
  if (out.front() == '-' && out.find_first_not_of("-0.") == std::string::npos) out.erase(0, 1);
  return out;
}

}  // namespace

std::string NumberText(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return "0";
  // The place of the first digit, once rounded to so many.
  int first = static_cast<int>(std::floor(std::log10(std::abs(value))));
  const double rounded_up = (std::pow(10, digits) - 0.5) * std::pow(10, first - digits + 1);
  if (std::abs(value) >= rounded_up) ++first;
  const int decimals = digits - 1 - first;
  if (decimals < 0) {
    const double unit = std::pow(10, -decimals);
    return Group(Fixed(std::round(value / unit) * unit, 0));
  }
  std::string text = Fixed(value, std::min(decimals, kMostDecimals));
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return Group(text);
}

std::string FixedText(double value, int decimals) {
  return std::isfinite(value) ? Group(Fixed(value, decimals)) : "–";
}

std::string PercentText(double share, int digits) {
  return std::isfinite(share) ? NumberText(100 * share, digits) + " %" : "–";
}

std::string EnergyText(double energy_j) {
  if (std::abs(energy_j) < 999.5) return NumberText(energy_j) + " J";
  return NumberText(energy_j / 1000) + " kJ";
}

std::string LengthText(double length_m) {
  if (std::abs(length_m) >= 0.9995) return NumberText(length_m) + " m";
  return NumberText(1000 * length_m) + " mm";
}

std::string TimeText(double time_s) {
  if (std::abs(time_s) < 7200) return NumberText(time_s) + " s";
  return NumberText(time_s / 3600) + " h";
}

Compared ComparedText(double value, double limit, int decimals, std::string_view unit) {
  constexpr int kMost = 6;
  Compared out;
  for (int k = decimals; k <= std::max(decimals, kMost); ++k) {
    out = {FixedText(value, k), FixedText(limit, k)};
    if (value == limit || out.value != out.limit) break;
  }
  if (unit.empty()) return out;
  for (std::string* text : {&out.value, &out.limit}) text->append(" ").append(unit);
  return out;
}

}  // namespace floorproof

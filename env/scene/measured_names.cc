// SPDX-License-Identifier: Apache-2.0
#include "env/scene/measured_names.h"

#include "base/file_output.h"
#include "base/params.h"
#include "env/geometry/geometry.h"

namespace floorproof {
namespace {

constexpr MeasuredUnit kMm = {"mm", 1e-3, 2000};
constexpr MeasuredUnit kDeg = {"deg", kPi / 180, 90};
constexpr MeasuredUnit kPct = {"pct", 1e-2, 100};

}  // namespace

std::span<const MeasuredKind> MeasuredKinds() {
  static constexpr MeasuredKind kKinds[] = {
      {"step", kMm},
      {"drop", kMm},
      {"groove", kMm},
      {"cable_cover", kDeg},
      {"cable_cover_height", kMm},
      {"rough", kMm},
      {"threshold", kMm},
      {"ramp", kDeg},
      {"ramp_down", kDeg},
      {"carpet", kMm},
      {"lift_sill", kMm},
      {"wet", kPct},
  };
  return kKinds;
}

std::span<const std::string_view> MeasuredDirections() {
  static constexpr std::string_view kDirections[] = {"forward", "sideways", "diagonal", "oblique"};
  return kDirections;
}

std::string FiguresText(std::span<const double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + FormatDouble(value);
  return text;
}

std::string FiguresHash(const std::map<std::string, std::string>& said) {
  std::string all;
  for (const auto& [name, text] : said)
    if (name != kMeasuredFigures) all.append(name).append("=").append(text).append("\n");
  return Sha256(all);
}

}  // namespace floorproof

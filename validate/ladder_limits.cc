// SPDX-License-Identifier: Apache-2.0
#include "validate/ladder_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "base/params.h"
#include "env/scene/measured_block.h"

namespace floorproof {
namespace {

std::vector<double> Values(std::span<const LadderRow> rows,
                           const std::function<double(const LadderCell&)>& of) {
  std::vector<double> values;
  for (const LadderRow& row : rows) values.push_back(of(row.cell));
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::string Joined(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + FormatDouble(value);
  return text;
}

std::string Numeric(std::string_view name, const std::vector<double>& values) {
  return fmt::format("<numeric name=\"{}\" data=\"{}\"/>\n", name, Joined(values));
}

std::string_view UnitName(std::string_view unit) { return unit == "%" ? "pct" : unit; }

}  // namespace

std::string MeasuredElements(std::span<const LadderRow> rows, const std::string& by,
                             const std::string& model) {
  const auto friction_of = [](const LadderCell& cell) { return cell.friction; };
  const auto speed_of = [](const LadderCell& cell) { return cell.speed_mps; };
  const std::vector<double> frictions = Values(rows, friction_of), speeds = Values(rows, speed_of);
  std::string text = fmt::format(
      "<text name=\"{}\" data=\"{}\"/>\n<text name=\"{}\" data=\"{}\"/>\n"
      "<text name=\"{}how\" data=\"{} deg off square to either side; diagonal, oblique: edges at "
      "45 deg to body "
      "or way\"/>\n",
      kMeasuredBy, by, kMeasuredModel, model, kMeasuredPrefix,
      FormatDouble(rows.front().cell.oblique_deg));
  text += Numeric(kMeasuredFrictions, frictions) + Numeric(kMeasuredSpeeds, speeds);
  text +=
      "<!-- By friction, for each by speed. Below 0: all that was tried was crossed, up to that. "
      "-->\n";
  for (const LadderHazard& hazard : LadderHazards())
    for (const Direction direction :
         {Direction::kForward, Direction::kSideways, Direction::kDiagonal, Direction::kOblique}) {
      std::vector<double> limits(frictions.size() * speeds.size());
      bool any = false;
      for (const LadderRow& row : rows) {
        if (row.cell.hazard != hazard.name || row.cell.direction != direction) continue;
        const auto f = std::ranges::find(frictions, row.cell.friction) - frictions.begin();
        const auto s = std::ranges::find(speeds, row.cell.speed_mps) - speeds.begin();
        limits[static_cast<std::size_t>(f) * speeds.size() + static_cast<std::size_t>(s)] =
            row.above_all ? -row.limit : row.limit;
        any = true;
      }
      if (any)
        text += Numeric(fmt::format("{}{}_{}_{}", kMeasuredPrefix, hazard.name, Name(direction),
                                    UnitName(hazard.unit)),
                        limits);
    }
  return text;
}

}  // namespace floorproof

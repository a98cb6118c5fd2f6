// SPDX-License-Identifier: Apache-2.0
#include "validate/ladder_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <vector>

#include "base/params.h"
#include "env/scene/measured_names.h"

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

// Elements, one a line, and what they say.
class Elements {
 public:
  void Text(const std::string& name, const std::string& text) { Add("text", name, text); }
  void Numeric(const std::string& name, const std::vector<double>& values) {
    Add("numeric", name, FiguresText(values));
  }
  void Comment(std::string_view text) { lines_ += fmt::format("<!-- {} -->\n", text); }
  std::string Hash() const { return FiguresHash(said_); }
  const std::string& lines() const { return lines_; }

 private:
  void Add(std::string_view element, const std::string& name, const std::string& data) {
    lines_ += fmt::format("<{} name=\"{}\" data=\"{}\"/>\n", element, name, data);
    said_[name] = data;
  }

  std::string lines_;
  std::map<std::string, std::string> said_;
};

std::string_view UnitName(std::string_view unit) { return unit == "%" ? "pct" : unit; }

}  // namespace

std::string MeasuredElements(std::span<const LadderRow> rows, const std::string& by,
                             const std::string& model) {
  const auto friction_of = [](const LadderCell& cell) { return cell.friction; };
  const auto speed_of = [](const LadderCell& cell) { return cell.speed_mps; };
  const std::vector<double> frictions = Values(rows, friction_of), speeds = Values(rows, speed_of);
  Elements out;
  out.Text(kMeasuredBy, by);
  out.Text(kMeasuredModel, model);
  out.Text(kMeasuredHow, FormatDouble(rows.front().cell.oblique_deg) +
                             " deg off square to either side; diagonal, oblique: edges at 45 deg "
                             "to body or way");
  out.Numeric(kMeasuredFrictions, frictions);
  out.Numeric(kMeasuredSpeeds, speeds);
  out.Comment(
      "By friction, for each by speed. Below 0: all that was tried was crossed, up to that.");
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
        out.Numeric(fmt::format("{}{}_{}_{}", kMeasuredPrefix, hazard.name, Name(direction),
                                UnitName(hazard.unit)),
                    limits);
    }
  out.Text(kMeasuredFigures, out.Hash());
  return out.lines();
}

}  // namespace floorproof

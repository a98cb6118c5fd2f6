// SPDX-License-Identifier: Apache-2.0
#include "report/capability_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "render/chart.h"

namespace floorproof {
namespace {

using Stroke = ChartStyle::Stroke;

constexpr Rgb kInk = {60, 66, 74};

// Apart for those who see red and green alike too (Okabe & Ito's palette).
Rgb ColourOf(Direction direction) {
  switch (direction) {
    case Direction::kForward:
      return {0, 114, 178};
    case Direction::kSideways:
      return {213, 94, 0};
    case Direction::kDiagonal:
      return {0, 158, 115};
    case Direction::kOblique:
      return {204, 121, 167};
  }
  return kInk;
}

int AsideOf(Direction direction) {
  constexpr int kAside_px = 6;
  return kAside_px * (static_cast<int>(direction) - static_cast<int>(Direction::kSideways));
}

Rgb Paler(const Rgb& colour, double share) {
  Rgb paler;
  for (std::size_t k = 0; k < 3; ++k)
    paler[k] = static_cast<std::uint8_t>(colour[k] + share * (255 - colour[k]));
  return paler;
}

// The style of the level-th of at most three values, the last the strongest.
ChartStyle StyleOf(const Rgb& colour, std::size_t level) {
  constexpr Stroke kStrokes[] = {Stroke::kDotted, Stroke::kDashed, Stroke::kSolid};
  constexpr double kPale[] = {0.50, 0.28, 0.0};
  level = std::min<std::size_t>(level, 2);
  return {Paler(colour, kPale[level]), kStrokes[level], false};
}

std::string Spoken(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 32);
  return text;
}

// What a chart is drawn over (x) and what its strokes tell apart (level).
struct AxisReading {
  std::string x_label;
  std::function<double(const LadderCell&)> x, level;
  std::function<std::string(double)> level_name;
};

std::vector<double> Values(std::span<const LadderRow> rows,
                           const std::function<double(const LadderCell&)>& of) {
  std::vector<double> values;
  for (const LadderRow& row : rows) values.push_back(of(row.cell));
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::vector<Direction> DirectionsIn(std::span<const LadderRow> rows) {
  std::vector<Direction> directions;
  for (const Direction d :
       {Direction::kForward, Direction::kSideways, Direction::kDiagonal, Direction::kOblique})
    if (std::any_of(rows.begin(), rows.end(),
                    [&](const LadderRow& row) { return row.cell.direction == d; }))
      directions.push_back(d);
  return directions;
}

ChartPanel PanelOf(const LadderHazard& hazard, std::span<const LadderRow> rows,
                   const AxisReading& reading) {
  ChartPanel panel;
  panel.title = Spoken(hazard.name);
  panel.subtitle = fmt::format("{} [{}]", hazard.size, hazard.unit);
  panel.x_label = reading.x_label;
  panel.x_ticks = Values(rows, reading.x);
  const std::vector<double> levels = Values(rows, reading.level);
  for (const char* wheels : {"ideal", "rollers"})
    for (const Direction direction : DirectionsIn(rows))
      for (std::size_t i = 0; i < levels.size(); ++i) {
        ChartSeries series{StyleOf(ColourOf(direction), i), AsideOf(direction), {}};
        series.style.hollow = std::string_view(wheels) == "rollers";
        if (series.style.hollow) series.style.stroke = Stroke::kNone;
        for (const LadderRow& row : rows)
          if (row.cell.hazard == hazard.name && row.cell.wheels == wheels &&
              row.cell.direction == direction && reading.level(row.cell) == levels[i])
            series.points.push_back({reading.x(row.cell), row.limit, row.above_all});
        if (!series.points.empty()) panel.series.push_back(std::move(series));
      }
  return panel;
}

Chart ChartOf(std::span<const LadderRow> rows, const AxisReading& reading) {
  Chart chart;
  for (const LadderHazard& hazard : LadderHazards())
    chart.panels.push_back(PanelOf(hazard, rows, reading));
  std::vector<ChartKey> directions, levels;
  for (const Direction direction : DirectionsIn(rows))
    directions.push_back({Spoken(Name(direction)), StyleOf(ColourOf(direction), 2)});
  const std::vector<double> values = Values(rows, reading.level);
  for (std::size_t i = values.size(); i-- > 0;)
    levels.push_back({reading.level_name(values[i]), StyleOf(kInk, i)});
  if (std::any_of(rows.begin(), rows.end(),
                  [](const LadderRow& row) { return row.cell.wheels == "rollers"; }))
    levels.push_back({"wheels with rollers (lines: ideal wheels)", {kInk, Stroke::kNone, true}});
  chart.legend = {directions, levels};
  return chart;
}

std::vector<LadderRow> RowsOf(std::span<const LadderRow> rows, const std::string& robot) {
  std::vector<LadderRow> own;
  for (const LadderRow& row : rows)
    if (row.cell.robot == robot) own.push_back(row);
  return own;
}

// What the figures mean, below the title.
std::vector<std::string> Notes(std::span<const LadderRow> rows, const std::string& setting) {
  const std::vector<Direction> directions = DirectionsIn(rows);
  const bool aside =
      std::find(directions.begin(), directions.end(), Direction::kSideways) != directions.end();
  const bool oblique =
      std::find(directions.begin(), directions.end(), Direction::kOblique) != directions.end();
  std::vector<std::string> notes = {
      fmt::format("Up to the limit every size tried is crossed, driven straight, {:g} deg off "
                  "square, by the robot's own tracker and judged by the failure detectors; 0: none "
                  "is.",
                  rows.front().cell.oblique_deg),
      setting + (aside ? " Diagonal: the way at 45 deg to the body, the hazard square to the "
                         "way. Series of equal values stand side by side."
                       : " Diagonal: the edge met at 45 deg. Series of equal values stand side "
                         "by side.")};
  if (rows.front().cell.planned)
    notes.push_back(
        "The plan knows each hazard and leads over it." +
        std::string(oblique ? " Oblique: forward, the edge at 45 deg to the way." : ""));
  return notes;
}

}  // namespace

void WriteCapabilityChart(std::span<const LadderRow> rows, const std::string& robot,
                          const std::filesystem::path& png) {
  const std::vector<LadderRow> own = RowsOf(rows, robot);
  if (own.empty()) return;
  const RobotSpec spec = ReadRobot(FindRobotFile(robot, {})).spec;
  Chart chart =
      ChartOf(own, {"speed [m/s]", [](const LadderCell& cell) { return cell.speed_mps; },
                    [](const LadderCell& cell) { return cell.friction; },
                    [](double friction) { return fmt::format("friction {}", friction); }});
  chart.title = fmt::format("{}: capability chart", RobotName(own.front().cell));
  chart.notes = Notes(own, fmt::format("Belly clearance {:g} mm, mass {:g} kg.",
                                       1000 * spec.clearance_m, spec.mass_kg));
  WriteChart(chart, png);
}

void WriteSweepChart(std::span<const LadderRow> rows, const std::string& robot,
                     const std::filesystem::path& folder) {
  const std::vector<LadderRow> own = RowsOf(rows, robot);
  if (own.empty()) return;
  const LadderCell& cell = own.front().cell;
  Chart chart =
      ChartOf(own, {"belly clearance [mm]",
                    [](const LadderCell& c) { return 1000 * c.changes.clearance_m.value(); },
                    [](const LadderCell& c) { return c.changes.mass_kg.value(); },
                    [](double mass_kg) { return fmt::format("{:g} kg", mass_kg); }});
  chart.title = fmt::format("{}: limits over belly clearance and mass", robot);
  chart.notes = Notes(own, fmt::format("{} wheels, {:g} m/s, friction {:g}.", Spoken(cell.wheels),
                                       cell.speed_mps, cell.friction));
  WriteChart(chart, folder / fmt::format("sweep_{}.png", robot));
}

}  // namespace floorproof

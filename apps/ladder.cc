// SPDX-License-Identifier: Apache-2.0
#include "apps/ladder.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "base/file_output.h"
#include "base/interrupt.h"
#include "base/progress_line.h"
#include "base/quantity.h"
#include "base/words.h"
#include "report/ladder_files.h"
#include "validate/ladder_findings.h"

namespace floorproof {

namespace fs = std::filesystem;

std::vector<LadderRow> ClimbWithProgress(std::span<const LadderCell> cells, int jobs,
                                         const Globals& globals) {
  ProgressLine progress(globals);
  return ClimbLadder(cells, jobs, [&](const LadderProgress& now) {
    if (progress.IsDue())
      progress.Show(fmt::format("  {} of {} rows, about {:.0f} s to go", now.done, cells.size(),
                                progress.wall_s() * now.to_go));
  });
}

void SayLeastLimits(std::span<const LadderRow> rows, const Globals& globals) {
  std::vector<const LadderRow*> least;  // in the order of the rows
  const auto of = [](const LadderCell& cell) {
    return std::tuple(cell.robot, cell.wheels, cell.hazard);
  };
  for (const LadderRow& row : rows) {
    const auto same = std::ranges::find_if(
        least, [&](const LadderRow* other) { return of(other->cell) == of(row.cell); });
    if (same == least.end())
      least.push_back(&row);
    else if (std::pair(row.above_all, row.limit) < std::pair((*same)->above_all, (*same)->limit))
      *same = &row;
  }
  const auto differ = [&](std::string LadderCell::*member) {
    return std::ranges::any_of(
        rows, [&](const LadderRow& row) { return row.cell.*member != rows.front().cell.*member; });
  };
  const bool robots = differ(&LadderCell::robot), wheels = differ(&LadderCell::wheels);
  std::vector<TextColumn> columns;
  if (robots) columns.push_back({.heading = "Robot"});
  if (wheels) columns.push_back({.heading = "Wheels"});
  columns.insert(columns.end(), {{.heading = "Hazard"},
                                 {.heading = "Least limit", .right = true},
                                 {.heading = "Way"},
                                 {.heading = "m/s", .right = true},
                                 {.heading = "Friction", .right = true},
                                 {.heading = "Held by", .wraps = true}});
  TextTable table(std::move(columns));
  for (const LadderRow* row : least) {
    const LadderCell& cell = row->cell;
    std::vector<TextCell> line;
    if (robots) line.emplace_back(RobotName(cell));
    if (wheels) line.emplace_back(cell.wheels);
    line.emplace_back(Words(cell.hazard));
    line.emplace_back(fmt::format("{} {}", LimitText(*row), FindLadderHazard(cell.hazard).unit));
    line.emplace_back(std::string(Name(cell.direction)));
    line.emplace_back(NumberText(cell.speed_mps));
    line.emplace_back(FixedText(cell.friction, 1));
    line.emplace_back(Words(row->held_by));
    table.Add(std::move(line));
  }
  globals.Say(table);
}

nlohmann::ordered_json RunLadder(const fs::path& folder, int jobs, const Globals& globals) {
  const std::vector<LadderCell> cells = LadderCells({}), oblique_cells = ObliqueCells(),
                                sweep_cells = SweepCells();
  globals.Say(fmt::format(
      "the ladder: {} limits at {} degrees off square, {} more at other angles, {} over "
      "clearance and mass",
      cells.size(), kChartOblique_deg, oblique_cells.size(), sweep_cells.size()));
  const std::vector<LadderRow> rows = ClimbWithProgress(cells, jobs, globals);
  WriteFileWhole(folder / "ladder.csv", LadderCsv(rows));
  const std::vector<LadderRow> oblique = ClimbWithProgress(oblique_cells, jobs, globals);
  WriteFileWhole(folder / "ladder_oblique.csv", ObliqueCsv(oblique));
  const std::vector<LadderRow> sweep = ClimbWithProgress(sweep_cells, jobs, globals);
  WriteFileWhole(folder / "ladder_sweep.csv", SweepCsv(sweep));
  SayWhenInterrupted(
      fmt::format("{} of {} rows of the ladder, {} of {} at other angles and {} of {} of its sweep "
                  "are in {}",
                  rows.size(), cells.size(), oblique.size(), oblique_cells.size(), sweep.size(),
                  sweep_cells.size(), folder.string()));
  if (Interrupted()) return {};
  WriteLadderCharts(rows, sweep, folder);
  SayLeastLimits(rows, globals);
  for (const std::string& finding : Findings(rows)) globals.Say(finding);
  for (const std::string& finding : ObliqueFindings(oblique)) globals.Say(finding);
  return {
      {"rows", LadderJson(rows)}, {"oblique", LadderJson(oblique)}, {"sweep", LadderJson(sweep)}};
}

}  // namespace floorproof

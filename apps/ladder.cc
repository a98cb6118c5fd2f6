// SPDX-License-Identifier: Apache-2.0
#include "apps/ladder.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/file_output.h"
#include "base/interrupt.h"
#include "base/progress_line.h"
#include "base/quantity.h"
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

void SayRows(std::span<const LadderRow> rows, const Globals& globals) {
  TextTable table({{.heading = "Robot"},
                   {.heading = "Wheels"},
                   {.heading = "Hazard"},
                   {.heading = "Way"},
                   {.heading = "Speed", .right = true},
                   {.heading = "Friction", .right = true},
                   {.heading = "Limit", .right = true},
                   {.heading = "Held by"}});
  for (const LadderRow& row : rows) {
    const LadderCell& cell = row.cell;
    table.Add(
        {RobotName(cell), cell.wheels, std::string(cell.hazard), std::string(Name(cell.direction)),
         NumberText(cell.speed_mps) + " m/s", FixedText(cell.friction, 1),
         fmt::format("{} {}", LimitText(row), FindLadderHazard(cell.hazard).unit), row.held_by});
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
  SayRows(rows, globals);
  for (const std::string& finding : Findings(rows)) globals.Say(finding);
  for (const std::string& finding : ObliqueFindings(oblique)) globals.Say(finding);
  return {
      {"rows", LadderJson(rows)}, {"oblique", LadderJson(oblique)}, {"sweep", LadderJson(sweep)}};
}

}  // namespace floorproof

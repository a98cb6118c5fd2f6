// SPDX-License-Identifier: Apache-2.0
#include "apps/ladder.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/file_output.h"
#include "base/interrupt.h"
#include "base/progress_line.h"
#include "report/capability_chart.h"
#include "validate/ladder_findings.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr double kDisagreement = 0.2;  // of two wheel models' limits that is worth a line
constexpr double kShownFriction = 0.8;
constexpr double kTrustedShare = 0.8;  // of a limit that a robot should be trusted with

// Roller wheels take about so many times longer.
double CostOf(const LadderCell& cell) { return cell.wheels == "rollers" ? 12 : 1; }

std::vector<LadderRow> Climb(std::span<const LadderCell> cells, int jobs, const Globals& globals) {
  double cost = 0, spent = 0;
  for (const LadderCell& cell : cells) cost += CostOf(cell);
  ProgressLine progress(globals);
  return ClimbLadder(cells, jobs, [&](const LadderRow& row, std::size_t done) {
    spent += CostOf(row.cell);
    if (progress.IsDue())
      progress.Show(fmt::format("  {} of {} rows, about {:.0f} s to go", done, cells.size(),
                                progress.wall_s() * (cost - spent) / spent));
  });
}

std::string Text(const LadderRow& row) {
  return fmt::format("{}{}", row.limit, row.above_all ? " or more" : "");
}

void SayRows(std::span<const LadderRow> rows, const Globals& globals) {
  for (const LadderRow& row : rows) {
    const LadderCell& cell = row.cell;
    globals.Say(
        fmt::format("  {:<7} {:<7} {:<18} {:<8} {:.1f} m/s  friction {:.1f} {:>12} {:<3} {}",
                    cell.robot, cell.wheels, cell.hazard, Name(cell.direction), cell.speed_mps,
                    cell.friction, Text(row), FindLadderHazard(cell.hazard).unit, row.held_by));
  }
}

void SayTrustedStep(std::span<const LadderRow> rows, const std::string& name,
                    const Globals& globals) {
  const auto step_m = TrustedStep(rows, name);
  if (!step_m) return;
  const double model_m = ReadRobot(FindRobotFile(name, {})).spec.step_m;
  globals.Say(fmt::format(
      "{}: level changes up to {:.1f} mm are crossed every way at every speed on friction 0.8; its "
      "step_m is {:.1f} mm, {:.0f} % of the limit {:.1f} mm",
      name, 1000 * *step_m, 1000 * model_m, 100 * kTrustedShare, 1000 * kTrustedShare * *step_m));
}

void SayFindings(std::span<const LadderRow> rows, const Globals& globals) {
  for (const CoverGap& gap : CoverGaps(rows))
    if (gap.cell.friction == kShownFriction) globals.Say(Sentence(gap));
  for (const auto& [ideal, rollers] : WheelDisagreements(rows, kDisagreement)) {
    const LadderCell& cell = ideal.cell;
    globals.Say(fmt::format(
        "ideal wheels and rollers part by more than {:.0f} %: {} {} {} {} m/s, friction {}: {} and "
        "{} {}",
        100 * kDisagreement, cell.robot, cell.hazard, Name(cell.direction), cell.speed_mps,
        cell.friction, Text(ideal), Text(rollers), FindLadderHazard(cell.hazard).unit));
  }
  for (const RobotEntry& robot : Robots()) SayTrustedStep(rows, std::string(robot.name), globals);
}

nlohmann::ordered_json Json(std::span<const LadderRow> rows) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const LadderRow& row : rows) {
    const LadderCell& cell = row.cell;
    nlohmann::ordered_json object = {
        {"robot", cell.robot},         {"wheels", cell.wheels},
        {"hazard", cell.hazard},       {"direction", Name(cell.direction)},
        {"speed_mps", cell.speed_mps}, {"friction", cell.friction},
        {"limit", row.limit},          {"unit", FindLadderHazard(cell.hazard).unit},
        {"at_least", row.above_all},   {"held_by", row.held_by}};
    if (cell.changes.clearance_m) object["clearance_m"] = *cell.changes.clearance_m;
    if (cell.changes.mass_kg) object["mass_kg"] = *cell.changes.mass_kg;
    json.push_back(std::move(object));
  }
  return json;
}

}  // namespace

void ClearLadder(const fs::path& folder) {
  WriteFileWhole(folder / "ladder.csv", LadderCsv({}));
  WriteFileWhole(folder / "ladder_sweep.csv", SweepCsv({}));
  std::error_code ignored;
  for (const RobotEntry& robot : Robots())
    for (const char* name : {"capability", "sweep"})
      fs::remove(folder / fmt::format("{}_{}.png", name, robot.name), ignored);
}

nlohmann::ordered_json RunLadder(const fs::path& folder, int jobs, const Globals& globals) {
  const std::vector<LadderCell> cells = LadderCells({}), sweep_cells = SweepCells();
  globals.Say(fmt::format("the ladder: {} limits, {} more over clearance and mass", cells.size(),
                          sweep_cells.size()));
  const std::vector<LadderRow> rows = Climb(cells, jobs, globals);
  WriteFileWhole(folder / "ladder.csv", LadderCsv(rows));
  const std::vector<LadderRow> sweep = Climb(sweep_cells, jobs, globals);
  WriteFileWhole(folder / "ladder_sweep.csv", SweepCsv(sweep));
  SayWhenInterrupted(fmt::format("{} of {} rows of the ladder and {} of {} of its sweep are in {}",
                                 rows.size(), cells.size(), sweep.size(), sweep_cells.size(),
                                 folder.string()));
  if (Interrupted()) return {};
  for (const RobotEntry& robot : Robots()) {
    WriteCapabilityChart(rows, std::string(robot.name), folder);
    WriteSweepChart(sweep, std::string(robot.name), folder);
  }
  SayRows(rows, globals);
  SayFindings(rows, globals);
  return {{"rows", Json(rows)}, {"sweep", Json(sweep)}};
}

}  // namespace floorproof

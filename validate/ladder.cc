// SPDX-License-Identifier: Apache-2.0
#include "validate/ladder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>

#include "base/interrupt.h"
#include "base/params.h"
#include "base/printable.h"
#include "controllers/drive.h"
#include "env/hazards/hazard_type.h"
#include "env/scene/robot_limits.h"
#include "env/scene/roller_wheels.h"
#include "validate/parallel.h"

namespace floorproof {
namespace {

constexpr double kSpeeds_mps[] = {0.1, 0.2, 0.3};
constexpr double kFrictions[] = {0.4, 0.6, 0.8};
constexpr double kRollerFrictions[] = {0.4, 0.8};
constexpr double kClearances_m[] = {0.015, 0.018, 0.020, 0.022, 0.025, 0.030};
constexpr double kMassFactors[] = {0.7, 1.0, 1.5};
constexpr double kObliques_deg[] = {0, 0.5, 1, 3, 5, 10};
constexpr double kFarRunUp_m = 0.3, kOtherRunUp_m = 0.1;
constexpr double kClear_m = 0.02;  // between what lies behind and the circle around the robot

std::vector<Direction> DirectionsOf(const RobotSpec& robot) {
  if (IsHolonomic(robot)) return {Direction::kForward, Direction::kSideways, Direction::kDiagonal};
  return {Direction::kForward, Direction::kDiagonal};
}

void AddCells(const std::string& name, const RobotSpec& robot, const std::string& wheels,
              std::span<const double> frictions, std::vector<LadderCell>& cells) {
  for (const LadderHazard& hazard : LadderHazards())
    for (const Direction direction : DirectionsOf(robot))
      for (const double speed_mps : kSpeeds_mps)
        for (const double friction : frictions)
          cells.push_back({name, wheels, hazard.name, direction, speed_mps, friction, {}});
}

// Roller wheels take about so many times longer.
double CostOf(const LadderCell& cell) { return cell.wheels == "rollers" ? 4 : 1; }

std::string CsvRow(const LadderRow& row) {
  const LadderCell& cell = row.cell;
  return fmt::format("{},{},{},{},{},{},{},{}", CsvField(RobotName(cell)), cell.wheels, cell.hazard,
                     Name(cell.direction), FormatDouble(cell.speed_mps),
                     FormatDouble(cell.friction), FormatDouble(row.limit),
                     FindLadderHazard(cell.hazard).unit);
}

constexpr std::string_view kColumns = "robot,wheels,hazard,direction,speed_mps,friction,limit,unit";

}  // namespace

std::string_view Name(Direction direction) {
  switch (direction) {
    case Direction::kForward:
      return "forward";
    case Direction::kSideways:
      return "sideways";
    case Direction::kDiagonal:
      return "diagonal";
    case Direction::kOblique:
      return "oblique";
  }
  return "?";
}

std::vector<LadderCell> LadderCells(const LadderOptions& options) {
  std::vector<LadderCell> cells;
  for (const RobotEntry& entry : Robots()) {
    const std::string name(entry.name);
    const RobotSpec robot = ReadRobot(FindRobotFile(name, {})).spec;
    AddCells(name, robot, "ideal", kFrictions, cells);
    if (options.rollers && HasMecanumWheels(robot))
      AddCells(name, robot, "rollers", kRollerFrictions, cells);
  }
  return cells;
}

std::vector<LadderCell> SweepCells() {
  std::vector<LadderCell> cells;
  for (const RobotEntry& entry : Robots()) {
    const std::string name(entry.name);
    const RobotSpec robot = ReadRobot(FindRobotFile(name, {})).spec;
    for (const LadderHazard& hazard : LadderHazards())
      for (const Direction direction : DirectionsOf(robot))
        for (const double factor : kMassFactors)
          for (const double clearance_m : kClearances_m) {
            LadderCell cell{name, "ideal", hazard.name, direction, 0.2, 0.8, {}};
            cell.changes.mass_kg = std::round(1000 * factor * robot.mass_kg) / 1000;
            cell.changes.clearance_m = clearance_m;
            cells.push_back(cell);
          }
  }
  return cells;
}

std::vector<LadderCell> ObliqueCells() {
  std::vector<LadderCell> cells;
  for (const RobotEntry& entry : Robots()) {
    const std::string name(entry.name);
    const RobotSpec robot = ReadRobot(FindRobotFile(name, {})).spec;
    for (const LadderHazard& hazard : LadderHazards())
      for (const Direction direction : DirectionsOf(robot)) {
        LadderCell cell{name, "ideal", hazard.name, direction, 0.2, 0.8, {}};
        for (const double oblique_deg : kObliques_deg) {
          cell.oblique_deg = oblique_deg;
          cells.push_back(cell);
        }
        cell.oblique_deg = kChartOblique_deg;
        cell.run_up_m = kFarRunUp_m;
        cells.push_back(cell);
      }
  }
  return cells;
}

std::vector<LadderCell> RobotCells(const std::string& robot) {
  const RobotSpec spec = ReadRobot(FindRobotFile(robot, {})).spec;
  double radius_m = 0;
  for (const WheelSpec& wheel : spec.wheels) radius_m = std::max(radius_m, wheel.radius_m);
  std::vector<Direction> directions = DirectionsOf(spec);
  if (IsHolonomic(spec)) directions.push_back(Direction::kOblique);
  std::vector<LadderCell> cells;
  for (const LadderHazard& hazard : LadderHazards())
    for (const Direction direction : directions)
      for (const double share : {0.5, 1.0})
        for (const double friction : kFrictions) {
          LadderCell cell{robot,    "ideal", hazard.name, direction, share * spec.cruise_mps,
                          friction, {}};
          cell.planned = true;
          cell.scale = RungScale(radius_m);
          cells.push_back(cell);
        }
  return cells;
}

double RungScale(double wheel_radius_m) {
  constexpr double kLargest_m = 0.07;  // that the rungs are made for
  return std::exp2(std::ceil(std::log2(wheel_radius_m / kLargest_m)));
}

Rungs ScaledRungs(const LadderHazard& hazard, double scale) {
  Rungs rungs = hazard.rungs;
  if (hazard.most <= 0) return rungs;
  const auto times = [](double factor, int n) { return static_cast<int>(std::lround(factor * n)); };
  if (scale < 1) {
    rungs.per_unit = times(1 / scale, rungs.per_unit);
    rungs.last = times(1 / scale, rungs.last);
    constexpr double kLeast_mm = 1000 * kLeastSize_m;
    rungs.first = std::max(rungs.first, static_cast<int>(std::ceil(kLeast_mm * rungs.per_unit)));
  } else {
    rungs.spacing = times(scale, rungs.spacing);
    rungs.last = std::min(times(scale, rungs.last),
                          static_cast<int>(std::floor(hazard.most * rungs.per_unit)));
  }
  return rungs;
}

CrossingPlan PlanOf(const LadderCell& cell, const RobotSpec& robot, double size) {
  CrossingPlan plan;
  plan.speed_mps = cell.speed_mps;
  plan.friction = cell.friction;
  const double angle_rad = cell.direction == Direction::kForward    ? 0
                           : cell.direction == Direction::kSideways ? kPi / 2
                                                                    : kPi / 4;
  if (IsHolonomic(robot) && cell.direction != Direction::kOblique)
    plan.yaw_rad = -angle_rad;  // the way is the world's x, but for the obliqueness
  else
    plan.travel_rad = plan.yaw_rad = angle_rad;
  plan.travel_rad += cell.oblique_deg * kPi / 180;
  plan.yaw_rad += cell.oblique_deg * kPi / 180;
  if (cell.mirrored) plan.travel_rad *= -1, plan.yaw_rad *= -1;
  plan.run_up_m = cell.run_up_m;
  const double end_m = FindLadderHazard(cell.hazard).length_m(size);
  plan.beyond_m = (end_m + robot.circumscribed_radius_m + kClear_m) / std::cos(plan.travel_rad);
  return plan;
}

std::vector<LadderCell> Tries(const LadderCell& cell) {
  if (!cell.planned) return {cell};
  LadderCell other = cell;
  other.oblique_deg = -cell.oblique_deg;
  other.run_up_m = kOtherRunUp_m;
  other.mirrored = cell.direction == Direction::kDiagonal || cell.direction == Direction::kOblique;
  return {cell, other};
}

std::optional<LadderRow> FindRow(const LadderCell& cell) {
  const LadderHazard& hazard = FindLadderHazard(cell.hazard);
  RobotModel robot = ReadRobot(FindRobotFile(cell.robot, {}), cell.changes);
  if (cell.wheels == "rollers") robot = WithRollerWheels(robot);
  robot.spec.measured = {};  // earlier figures do not change those found now
  const std::vector<LadderCell> tries = Tries(cell);
  LadderRow row{cell, 0, false, ""};
  const auto limit = FindLimit(ScaledRungs(hazard, cell.scale), [&](double size) {
    return std::ranges::all_of(tries, [&](const LadderCell& one) {
      const CrossingPlan plan = PlanOf(one, robot.spec, size);
      Hazard met = hazard.make(size, plan.travel_rad);
      met.known = met.known || cell.planned;
      if (cell.planned) met.crossable = true;  // the plan leads over it
      const CrossingResult result = Cross(robot, std::move(met), plan);
      // The last that held lies just above the limit.
      if (!result.crossed) row.held_by = result.held_by;
      return result.crossed;
    });
  });
  if (!limit) return {};
  row.limit = limit->size;
  row.above_all = limit->above_all;
  return row;
}

std::vector<LadderRow> ClimbLadder(std::span<const LadderCell> cells, int jobs,
                                   const std::function<void(const LadderProgress&)>& on_row) {
  double cost = 0, spent = 0;
  for (const LadderCell& cell : cells) cost += CostOf(cell);
  std::vector<std::optional<LadderRow>> found(cells.size());
  std::mutex one_at_a_time;
  std::size_t done = 0;
  RunParallel(static_cast<int>(cells.size()), jobs, [&](int i) {
    auto& row = found[static_cast<std::size_t>(i)];
    row = FindRow(cells[static_cast<std::size_t>(i)]);
    if (!row) return;
    const std::lock_guard lock(one_at_a_time);
    ++done;
    spent += CostOf(row->cell);
    if (on_row) on_row({done, (cost - spent) / spent});
  });
  std::vector<LadderRow> rows;
  for (auto& row : found)
    if (row) rows.push_back(std::move(*row));
  return rows;
}

std::string RobotName(const LadderCell& cell) {
  return std::filesystem::path(cell.robot).stem().string();
}

std::string LimitText(const LadderRow& row) {
  return fmt::format("{}{}", row.limit, row.above_all ? " or more" : "");
}

std::string LadderCsv(std::span<const LadderRow> rows) {
  std::string out = fmt::format("{}\n", kColumns);
  for (const LadderRow& row : rows) out += CsvRow(row) + "\n";
  return out;
}

std::string ObliqueCsv(std::span<const LadderRow> rows) {
  std::string out = fmt::format("{},oblique_deg,run_up_m\n", kColumns);
  for (const LadderRow& row : rows)
    out += fmt::format("{},{},{}\n", CsvRow(row), FormatDouble(row.cell.oblique_deg),
                       FormatDouble(row.cell.run_up_m));
  return out;
}

std::string SweepCsv(std::span<const LadderRow> rows) {
  std::string out = fmt::format("{},clearance_m,mass_kg\n", kColumns);
  for (const LadderRow& row : rows) {
    const RobotChanges& changes = row.cell.changes;
    out += fmt::format("{},{},{}\n", CsvRow(row), FormatDouble(changes.clearance_m.value()),
                       FormatDouble(changes.mass_kg.value()));
  }
  return out;
}

}  // namespace floorproof

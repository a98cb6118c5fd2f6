// SPDX-License-Identifier: Apache-2.0
// Floors for tests of the planners that go from cell to cell.
#pragma once

#include "tests/planners/risk_floors.h"

namespace floorproof::testing {

// A floor, a robot and what the planners make of them.
struct Site {
  Site(HazardMap m, RobotSpec r, const RiskParams& params = {})
      : map(std::move(m)),
        robot(std::move(r)),
        risk(ComputeRisk(map, robot, PaperTables(), params)) {}
  // In cells of 0.5 m, and a square robot as wide.
  explicit Site(const std::string& rows) : Site(DrawHazards(rows, 0.5), SquareRobot(0.5)) {}

  Vec2 At(Cell cell) const { return risk.grid.frame.Center(cell); }
  PlanResult Plan(const std::string& planner, const Vec2& start, std::optional<Vec2> goal = {},
                  const std::string& yaml = "{}") const {
    return MakePlanner(planner, yaml)
        ->Plan({map, robot, {start.x(), start.y(), 0}, goal, 1, &risk});
  }
  PlanResult Plan(const std::string& planner, Cell start, std::optional<Cell> goal = {},
                  const std::string& yaml = "{}") const {
    return Plan(planner, At(start), goal ? std::optional<Vec2>(At(*goal)) : std::nullopt, yaml);
  }
  RiskOfPath Measure(const PlanResult& plan) const { return MeasureRisk(risk, plan.path); }

  HazardMap map;
  RobotSpec robot;
  RiskMap risk;
};

inline double Figure(const PlanResult& plan, const std::string& name) {
  for (const auto& [key, value] : plan.figures)
    if (key == name) return value;
  ADD_FAILURE() << "no figure " << name;
  return 0;
}

}  // namespace floorproof::testing

// SPDX-License-Identifier: Apache-2.0
// Floors drawn in characters, robots that are discs, and what must hold of any plan on them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "env/core/coverage.h"
#include "planners/planner.h"

namespace floorproof::testing {

// The top row first; '#' is wall, '?' unknown, anything else free.
inline HazardMap Draw(const std::string& text, double cell_m, const Pose2& X_WG = {}) {
  std::istringstream in(text);
  std::vector<std::string> rows;
  for (std::string row; in >> row;) rows.push_back(row);
  HazardMap map;
  const int w = static_cast<int>(rows.front().size()), h = static_cast<int>(rows.size());
  map.frame = {w, h, cell_m, X_WG};
  map.occupancy = Grid<CellState>(w, h, CellState::kFree);
  for (int iy = 0; iy < h; ++iy)
    for (int ix = 0; ix < w; ++ix) {
      const char c = rows[static_cast<std::size_t>(h - 1 - iy)][static_cast<std::size_t>(ix)];
      if (c == '#') map.occupancy(ix, iy) = CellState::kOccupied;
      if (c == '?') map.occupancy(ix, iy) = CellState::kUnknown;
    }
  return map;
}

inline HazardMap EmptyFloor(int w, int h, double cell_m) {
  HazardMap map;
  map.frame = {w, h, cell_m, {}};
  map.occupancy = Grid<CellState>(w, h, CellState::kFree);
  return map;
}

// The same, but wall except where is_free(p_R) of the place in a room's frame R.
template <typename IsFree>
HazardMap RoomOnFloor(int w, int h, double cell_m, const Pose2& X_WR, IsFree is_free) {
  HazardMap map = EmptyFloor(w, h, cell_m);
  for (int iy = 0; iy < h; ++iy)
    for (int ix = 0; ix < w; ++ix)
      if (!is_free(Vec2(X_WR.Inverse() * map.frame.Center(ix, iy))))
        map.occupancy(ix, iy) = CellState::kOccupied;
  return map;
}

// Left and right exchanged.
inline HazardMap Mirrored(const HazardMap& map) {
  HazardMap out = map;
  for (int iy = 0; iy < map.occupancy.height; ++iy)
    for (int ix = 0; ix < map.occupancy.width; ++ix)
      out.occupancy(ix, iy) = map.occupancy(map.occupancy.width - 1 - ix, iy);
  return out;
}

inline RobotSpec DiscRobot(double radius_m, double tool_width_m) {
  RobotSpec robot;
  robot.name = "disc";
  robot.clear.radius_m = robot.inscribed_radius_m = robot.circumscribed_radius_m = radius_m;
  robot.tool.radius_m = tool_width_m / 2;
  robot.tool_width_m = tool_width_m;
  robot.step_m = 0.01;
  return robot;
}

// A planner of that name with parameters written as YAML.
inline std::unique_ptr<Planner> MakePlanner(const std::string& name,
                                            const std::string& yaml = "{}") {
  auto planner = MakePlugin(Planners(), name, "planner");
  ReadParams(ParseYaml(yaml, "test"), "plan.", *planner);
  return planner;
}

// The least distance from the path's segments to a wall, m: an independent ruler, by sampling the
// segments every 5 mm against the walls' squares.
inline double LeastClearance(const HazardMap& map, const Path& path, double reach_m) {
  const double cell = map.frame.cell_m;
  const int reach = static_cast<int>(std::ceil(reach_m / cell)) + 1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec2 a = path[i == 0 ? 0 : i - 1].p_W, b = path[i].p_W;
    const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / 0.005)));
    for (int s = 0; s <= steps; ++s) {
      const Vec2 p = map.frame.X_WG.Inverse() * Vec2(a + (b - a) * s / steps) / cell;
      const int cx = static_cast<int>(std::floor(p.x())), cy = static_cast<int>(std::floor(p.y()));
      for (int iy = cy - reach; iy <= cy + reach; ++iy)
        for (int ix = cx - reach; ix <= cx + reach; ++ix)
          if (map.IsWall(ix, iy)) {
            const double dx = std::max({0.0, ix - p.x(), p.x() - ix - 1});
            const double dy = std::max({0.0, iy - p.y(), p.y() - iy - 1});
            least = std::min(least, std::hypot(dx, dy) * cell);
          }
    }
  }
  return least;
}

inline double Coverage(const HazardMap& map, const RobotSpec& robot, const Pose2& start,
                       const PlanResult& plan) {
  const SweepArea area = ComputeSweepArea(map, plan.clear, plan.tool, robot.step_m, start.p());
  return MeasureCoverage(area, plan.tool, plan.path).coverage;
}

// What every successful plan must satisfy: it starts at the start, and stays clear of walls as
// built, to half a fine cell (the resolution at which a floor is looked at).
inline void ExpectSound(const HazardMap& map, const Pose2& start, const PlanResult& plan) {
  ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
  ASSERT_FALSE(plan.path.empty());
  EXPECT_LT((plan.path.front().p_W - start.p()).norm(), 1e-6);
  EXPECT_GE(LeastClearance(map, plan.path, plan.clear.radius_m + 0.1),
            plan.clear.radius_m - map.inset_m - FineFrame(map.frame).cell_m / 2 - 1e-9);
}

}  // namespace floorproof::testing

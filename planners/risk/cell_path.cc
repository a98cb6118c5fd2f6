// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/cell_path.h"

#include <cmath>
#include <optional>

namespace floorproof {
namespace {

constexpr double kSame_m = 1e-6;

}  // namespace

Path ToPath(const CellTour& tour, const CellMotion& motion, const GridFrame& frame,
            const Pose2& start, const Vec2& end_W) {
  Path path;
  const auto add = [&](const Vec2& p, std::size_t i) {
    const std::optional<double> yaw =
        motion.yaw_rad.empty() ? std::nullopt : std::optional<double>(motion.yaw_rad[i]);
    const double speed_mps = motion.speed_mps.empty() ? 0 : motion.speed_mps[i];
    if (!path.empty() && (path.back().p_W - p).norm() < kSame_m) return;
    const std::size_t n = path.size();
    if (n >= 2 && path[n - 1].yaw_rad == yaw && path[n - 1].speed_mps == speed_mps) {
      const Vec2 before = path[n - 1].p_W - path[n - 2].p_W, now = p - path[n - 1].p_W;
      if (std::abs(Cross(before, now)) < kSame_m * before.norm() && before.dot(now) > 0)
        path.pop_back();
    }
    Waypoint waypoint;
    waypoint.p_W = p;
    waypoint.yaw_rad = yaw;
    waypoint.speed_mps = speed_mps;
    path.push_back(waypoint);
  };
  add(start.p(), 0);
  for (std::size_t i = 0; i < tour.cells.size(); ++i) add(frame.Center(tour.cells[i]), i);
  add(end_W, tour.cells.size() - 1);
  return path;
}

std::vector<double> SpeedsOverTerrain(const RiskGrid& grid, const std::vector<Cell>& tour,
                                      const RobotSpec& robot) {
  std::vector<double> speed_mps(tour.size(), 0);
  for (std::size_t i = 1; i < tour.size(); ++i)
    if (grid.contents(tour[i]).terrain() || grid.contents(tour[i - 1]).terrain())
      speed_mps[i] = robot.cover_speed_mps;
  return speed_mps;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "validate/suite/lap_room.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/params.h"

namespace floorproof {
namespace {

constexpr double kClear_m = 0.3;  // between the robot on its lap and what stands beside
constexpr double kLong_m = 2.5, kShort_m = 1.5;  // the lap's sides at least
constexpr double kFurniture_m = 1;               // its height: above every scan

std::vector<Vec2> Box(const Vec2& low, const Vec2& high) {
  return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

}  // namespace

LapRoom MakeLapRoom(const RobotSpec& robot, double speed_mps) {
  const double reach_m = robot.circumscribed_radius_m;
  const double margin_m = reach_m + kClear_m;
  const double long_m = std::max(kLong_m, 4 * reach_m), short_m = std::max(kShort_m, 4 * reach_m);
  const double niche_m = 0.5;
  BenchFloor floor(long_m + 2 * margin_m + niche_m, short_m + 2 * margin_m + niche_m);
  const double width_m = floor.width_m(), length_m = floor.length_m();
  const std::string keys = fmt::format("type: blind_object, height_m: {}", kFurniture_m);
  const Vec2 low(margin_m, margin_m), high(low.x() + long_m, low.y() + short_m);
  // Something in the middle of the lap, a cupboard in one corner, a shelf on the far wall.
  const Vec2 inside(margin_m, margin_m);
  floor.Polygon(keys + ", id: table", Box(low + inside, low + inside + Vec2(0.4, 0.2)));
  floor.Polygon(keys + ", id: cupboard",
                Box({length_m - niche_m / 2, width_m - 0.8}, {length_m, width_m}));
  floor.Polygon(keys + ", id: shelf", Box({0.6, width_m - niche_m / 3}, {1.4, width_m}));
  Path lap;
  for (const Vec2& corner : {low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y()), low}) {
    lap.emplace_back().p_W = corner;
    lap.back().speed_mps = speed_mps;
  }
  return {std::move(floor), {low.x(), low.y(), 0}, std::move(lap)};
}

std::string EstimatorKeys(const RobotModel& robot, const Vec2& error_W, double error_rad) {
  return fmt::format(
      "estimator: {{name: {}, start_error_x_m: {}, start_error_y_m: {}, start_error_yaw_deg: "
      "{}}}\n",
      HasLidar(robot) ? "mcl" : "odometry", FormatDouble(error_W.x()), FormatDouble(error_W.y()),
      FormatDouble(error_rad * 180 / kPi));
}

}  // namespace floorproof

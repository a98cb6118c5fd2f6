// SPDX-License-Identifier: Apache-2.0
#include "validate/suite/bench_floor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/params.h"

namespace floorproof {
namespace {

constexpr double kCell_m = 0.5;

}  // namespace

BenchFloor::BenchFloor(double length_m, double width_m)
    : length_m_(kCell_m * std::ceil(length_m / kCell_m)),
      width_m_(kCell_m * std::ceil(width_m / kCell_m)) {}

void BenchFloor::Place(const std::string& keys, const char* key, const std::vector<Vec2>& points) {
  hazards_ += fmt::format("    - {{{}, {}: {}}}\n", keys, key, PointsText(points));
}

void BenchFloor::Polygon(const std::string& keys, const std::vector<Vec2>& corners) {
  Place(keys, "polygon_m", corners);
}

void BenchFloor::Line(const std::string& keys, const std::vector<Vec2>& points) {
  Place(keys, "line_m", points);
}

std::string BenchFloor::Keys(const MethodRun& run, const Pose2& start) const {
  const auto cells = [](double m) { return static_cast<std::size_t>(std::lround(m / kCell_m)); };
  std::string rows;
  for (std::size_t row = 0; row < cells(width_m_); ++row)
    rows += "      " + std::string(cells(length_m_), '.') + "\n";
  return fmt::format(
      "site:\n  site: 1\n  name: {}\n  grid:\n    cell_m: {}\n    rows: |\n{}  floor: {{friction: "
      "{}}}\n{}"
      "start: {{x_m: {}, y_m: {}, yaw_deg: {}}}\n",
      run.method, FormatDouble(kCell_m), rows, FormatDouble(run.draw.friction),
      hazards_.empty() ? "" : "  hazards:\n" + hazards_, FormatDouble(start.x_m),
      FormatDouble(start.y_m), FormatDouble(start.yaw_rad * 180 / kPi));
}

std::string PointsText(const std::vector<Vec2>& points) {
  std::string text;
  for (const Vec2& p : points)
    text += fmt::format("{}[{}, {}]", text.empty() ? "" : ", ", FormatDouble(p.x()),
                        FormatDouble(p.y()));
  return "[" + text + "]";
}

double RunUp(const RobotSpec& robot, double speed_mps) {
  return speed_mps * speed_mps / (2 * robot.max_accel_mps2);
}

double WidthOf(const RobotModel& robot) {
  double left_m = 0, right_m = 0;
  for (const auto& part : robot.spec.outline_B)
    for (const Vec2& corner : part) {
      left_m = std::max(left_m, corner.y());
      right_m = std::min(right_m, corner.y());
    }
  return left_m - right_m;
}

bool HasLidar(const RobotModel& robot) {
  return mjs_findElement(robot.mjcf.get(), mjOBJ_SITE, "lidar") != nullptr;
}

double TimeTo(const RobotSpec& robot, double way_m, double speed_mps) {
  return way_m / speed_mps + speed_mps / robot.max_accel_mps2;
}

SizeLadder SpeedLadder(const RobotSpec& robot) {
  constexpr int kPerUnit = 100, kStep = 4;
  const int most = static_cast<int>(std::floor(kPerUnit * robot.max_speed_mps + 1e-9));
  return {"speed", "m/s", {.per_unit = kPerUnit, .first = kStep, .spacing = kStep, .last = most}};
}

Path StraightPlan(const Vec2& from_W, const Vec2& to_W, double speed_mps) {
  Path plan(2);
  plan[0].p_W = from_W;
  plan[1].p_W = to_W;
  for (Waypoint& waypoint : plan) waypoint.speed_mps = speed_mps;
  return plan;
}

}  // namespace floorproof

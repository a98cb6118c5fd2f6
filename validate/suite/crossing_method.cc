// SPDX-License-Identifier: Apache-2.0
#include "validate/suite/crossing_method.h"

#include <cmath>

namespace floorproof {
namespace {

constexpr double kAtSpeed_m = 0.2;  // at speed, before the edge
constexpr double kRunOut_m = 0.5;   // the whole robot is beyond; it does not slow down before
constexpr double kBehind_m = 0.2;   // from walls

}  // namespace

MethodDrive CrossingMethod::LayOut(const MethodRun& run) const {
  const RobotSpec& robot = run.robot.spec;
  const double reach_m = robot.circumscribed_radius_m;
  const double turn_rad = (90 - angle_deg()) * kPi / 180 + run.draw.angle_rad;
  const double speed_mps = run.draw.speed_share * robot.cruise_mps;
  const double length_m = Length(run.size);
  // An edge that is met at an angle comes nearer to the circle around the robot.
  const double start_m = reach_m + kBehind_m;
  const double edge_m =
      start_m + reach_m / std::cos(turn_rad) + RunUp(robot, speed_mps) + kAtSpeed_m;
  const double end_m = edge_m + (length_m + beyond_m() + reach_m) / std::cos(turn_rad) + kRunOut_m;
  BenchFloor floor(end_m + reach_m + kBehind_m, 4 * reach_m + 1);
  const double middle_m = floor.width_m() / 2;
  // Where the line so far behind the edge crosses this y.
  const auto x = [&](double behind_m, double y_m) {
    return edge_m + behind_m / std::cos(turn_rad) - (y_m - middle_m) * std::tan(turn_rad);
  };
  const std::string keys = HazardKeys(run.size, turn_rad * 180 / kPi);
  const double width_m = floor.width_m();
  if (length_m > 0)
    floor.Line(keys, {{x(length_m / 2, 0), 0}, {x(length_m / 2, width_m), width_m}});
  else
    floor.Polygon(keys, {{x(0, 0), 0},
                         {floor.length_m(), 0},
                         {floor.length_m(), width_m},
                         {x(0, width_m), width_m}});
  return {floor.Keys(run, {start_m, middle_m, 0}),
          StraightPlan({start_m, middle_m}, {end_m, middle_m}, speed_mps)};
}

}  // namespace floorproof

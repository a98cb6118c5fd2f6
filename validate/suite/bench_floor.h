// SPDX-License-Identifier: Apache-2.0
// The floors that methods are laid out on: a rectangle of free floor with walls around it, its
// lower left corner at the world's origin.
#pragma once

#include <string>
#include <vector>

#include "env/core/robot_spec.h"
#include "validate/suite/method.h"

namespace floorproof {

class BenchFloor {
 public:
  // At least so large, m; whole cells of half a metre.
  BenchFloor(double length_m, double width_m);

  double length_m() const { return length_m_; }
  double width_m() const { return width_m_; }
  // A hazard in a place: `keys` as YAML, "type: step, height_m: 0.01".
  void Polygon(const std::string& keys, const std::vector<Vec2>& corners);
  void Line(const std::string& keys, const std::vector<Vec2>& points);
  // The key `site` with this floor, named as the method, of the run's friction; and `start`.
  std::string Keys(const MethodRun& run, const Pose2& start) const;

 private:
  void Place(const std::string& keys, const char* key, const std::vector<Vec2>& points);

  double length_m_, width_m_;
  std::string hazards_;
};

// "[[0, 1], [2, 3]]"
std::string PointsText(const std::vector<Vec2>& points);

// The way from rest up to this speed, m.
double RunUp(const RobotSpec& robot, double speed_mps);
// Across all that collides, as it drives along its own x, m.
double WidthOf(const RobotModel& robot);
// Whether the model has a lidar: its site of that name.
bool HasLidar(const RobotModel& robot);
// What a method says that needs one.
inline constexpr const char* kNoLidar = "the model has no lidar";
// Speeds up to the robot's highest, rungs 0.04 m/s apart; the first is below what bounce_back calls
// an impact.
SizeLadder SpeedLadder(const RobotSpec& robot);
// When it has come so far from rest, at most, s.
double TimeTo(const RobotSpec& robot, double way_m, double speed_mps);
// A straight plan at one speed.
Path StraightPlan(const Vec2& from_W, const Vec2& to_W, double speed_mps);

}  // namespace floorproof

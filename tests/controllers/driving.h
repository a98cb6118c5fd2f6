// SPDX-License-Identifier: Apache-2.0
// Trackers judged on an IdealRobot.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "controllers/ideal_robot.h"
#include "controllers/tracker.h"

namespace floorproof {

// Round, 0.18 m radius, wheels 0.24 m apart, 0.25 m/s cruise.
RobotSpec RoundRobot();
// The same on four Mecanum wheels.
RobotSpec HolonomicRobot();
// These two, and every registered robot.
std::vector<std::string> TestRobotNames();
const RobotSpec& TestRobot(const std::string& name);  // one of them, read once
std::vector<RobotSpec> TestRobots();
// Without reading it.
std::string DriveOf(const std::string& name);

struct DriveOptions {
  std::optional<Pose2> start;  // none: on the first waypoint, facing along the path
  double control_s = 0.02;
  double wheel_lag_s = IdealRobot::kWheelLag_s;
  double time_limit_s = 3600;
  // Moves the robot behind its back; called at every control period.
  std::function<void(double t_s, Pose2& X_WB)> push;
};

struct Driven {
  struct Step {
    double t_s = 0;
    Pose2 X_WB;
    BodyTwist twist;  // commanded
    std::size_t segment = 0;
    bool dwelling = false, turning = false;
    double cross_track_m = 0;
    std::vector<int> tasks;  // ids of those that it says are done now
  };
  std::vector<Step> steps;
  bool done = false;
  MissedStops missed;
  double time_s = 0;
  double max_cross_track_m = 0;

  double CrossTrackAfter(double t_s) const;  // largest from t_s on
  bool SegmentsNeverDecrease() const;
};

Driven DriveAlong(Tracker& dut, const Path& path, const DriveOptions& options = {},
                  const ClearanceField* clearance = nullptr, const RobotSpec& robot = RoundRobot());

Path MakePath(const std::vector<Vec2>& points);

// What a perfect robot needs: trapezoids of speed between stops, turns on the spot at corners above
// 50 deg, bends at full speed.
double IdealTime(const Path& path, const RobotSpec& robot = RoundRobot());

}  // namespace floorproof

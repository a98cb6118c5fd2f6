// SPDX-License-Identifier: Apache-2.0
// A robot that rolls without slip and whose wheels reach their speed a little late: enough of a
// robot to judge a tracker by, and to say how a plan will be driven where nothing goes wrong.
#pragma once

#include <memory>
#include <vector>

#include "controllers/drive.h"

namespace floorproof {

class IdealRobot {
 public:
  static constexpr double kWheelLag_s = 0.1;  // as the simulated robots' wheels

  // At rest, in its model's own shape. `robot` outlives it. Throws InputError as Drive::Configure.
  IdealRobot(const RobotSpec& robot, const Pose2& X_WB, double wheel_lag_s = kWheelLag_s);

  const Estimate& state() const { return state_; }
  // Follows the command for dt_s, in so many equal steps. Allocates nothing.
  void Drive(const Command& command, double dt_s, int steps = 1);
  // Moved behind its back.
  void MoveTo(const Pose2& X_WB) { state_.X_WB = X_WB; }

 private:
  std::unique_ptr<class Drive> drive_;
  double wheel_lag_s_;
  std::vector<double> wheels_radps_, wanted_radps_;
  Estimate state_;
};

}  // namespace floorproof

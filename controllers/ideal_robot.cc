// SPDX-License-Identifier: Apache-2.0
#include "controllers/ideal_robot.h"

#include <cmath>

#include "env/core/blocks.h"

namespace floorproof {

IdealRobot::IdealRobot(const RobotSpec& robot, const Pose2& X_WB, double wheel_lag_s)
    : drive_(MakePlugin(Drives(), robot.drive, "drive")),
      wheel_lag_s_(wheel_lag_s),
      wheels_radps_(robot.wheels.size()),
      wanted_radps_(robot.wheels.size()) {
  drive_->Configure(robot);
  state_.X_WB = X_WB;
  state_.hinges = StartState(robot);
  state_.hinges.steered = robot.steering.has_value();
}

void IdealRobot::Drive(const Command& command, double dt_s, int steps) {
  const double h_s = dt_s / steps, keep = std::exp(-h_s / wheel_lag_s_);
  HingeState& hinges = state_.hinges;
  HingeState turning = command.hinges;
  turning.n = hinges.n;
  turning.rad = hinges.rad;
  turning.TakeSteering(hinges);
  drive_->ToWheels(command.twist, turning, wanted_radps_);
  for (int i = 0; i < steps; ++i) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(hinges.n); ++k)
      hinges.rad[k] += turning.radps[k] * h_s;
    hinges.radps = turning.radps;
    hinges.steer_radps = turning.steer_radps;
    hinges.steer_rad += turning.steer_radps * h_s;
    for (std::size_t w = 0; w < wheels_radps_.size(); ++w)
      wheels_radps_[w] = wanted_radps_[w] + (wheels_radps_[w] - wanted_radps_[w]) * keep;
    const BodyTwist v = drive_->ToTwist(wheels_radps_, hinges);
    Pose2& X_WB = state_.X_WB;
    const Pose2 middle{0, 0, X_WB.yaw_rad + 0.5 * v.wz_radps * h_s};
    const Vec2 step_W = middle.Rotate({v.vx_mps * h_s, v.vy_mps * h_s});
    X_WB = {X_WB.x_m + step_W.x(), X_WB.y_m + step_W.y(),
            WrapAngle(X_WB.yaw_rad + v.wz_radps * h_s)};
    state_.V_WB_B = v;
  }
}

}  // namespace floorproof

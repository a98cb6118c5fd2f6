// SPDX-License-Identifier: Apache-2.0
// What a pursuit commands: speed and turn, moved towards what is wanted as fast as the robot's
// accelerations allow.
#pragma once

#include <algorithm>
#include <cmath>

#include "controllers/creep.h"
#include "controllers/follower_params.h"
#include "env/core/motion.h"
#include "env/core/robot_spec.h"

namespace floorproof {

class PursuitTwist {
 public:
  // At rest, at its whole speed.
  void Start(const RobotSpec& robot) {
    accel_mps2_ = robot.max_accel_mps2;
    yaw_rate_radps_ = robot.max_yaw_rate_radps;
    yaw_accel_radps2_ = robot.max_yaw_accel_radps2;
    twist_ = {};
    share_ = 1;
    creep_.Reset();
  }
  // From now on speeds and turns on the spot are at most this share of what is wanted.
  void Slow(double share) { share_ = share; }

  // Drives an arc of this curvature (1/m, positive to the left).
  void Follow(double vx_mps, double curvature_1pm, double dt_s) {
    BeginTurn();
    Drive(vx_mps, dt_s);
    Turn(std::clamp(curvature_1pm * twist_.vx_mps, -yaw_rate_radps_, yaw_rate_radps_), dt_s);
  }
  // The next turn on the spot is another.
  void BeginTurn() { creep_.Reset(); }
  // Comes to rest, and turns there by the rest of its turn, to the left if `side` is 1, to the
  // right if it is -1.
  void TurnOnTheSpot(double left_rad, int side, double t_s, double dt_s) {
    if (share_ > 0) creep_.Update(std::abs(left_rad), t_s);
    Drive(0, dt_s);
    Turn(share_ * side * TurningRate(left_rad, yaw_rate_radps_, yaw_accel_radps2_, creep_.speed()),
         dt_s);
  }
  void Rest(double dt_s) {
    BeginTurn();
    Drive(0, dt_s);
    Turn(0, dt_s);
  }

  const BodyTwist& twist() const { return twist_; }  // last commanded

 private:
  void Drive(double vx_mps, double dt_s) {
    const double dv = accel_mps2_ * dt_s;
    twist_.vx_mps = std::clamp(share_ * vx_mps, twist_.vx_mps - dv, twist_.vx_mps + dv);
  }
  void Turn(double wz_radps, double dt_s) {
    const double dw = yaw_accel_radps2_ * dt_s;
    twist_.wz_radps = std::clamp(wz_radps, twist_.wz_radps - dw, twist_.wz_radps + dw);
  }

  double accel_mps2_ = 0, yaw_rate_radps_ = 0, yaw_accel_radps2_ = 0;
  BodyTwist twist_;
  double share_ = 1;
  Creep creep_{Creep::kTurn};
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Where a robot thinks it is, and how it moves.
#pragma once

#include <array>

#include "env/geometry/geometry.h"

namespace floorproof {

// Velocity of the body, in its own frame: x forward, y left.
struct BodyTwist {
  double vx_mps = 0, vy_mps = 0, wz_radps = 0;
};

// Angles and rates of what motors turn about upright axes: the hinges between a reconfigurable
// robot's blocks, in the order of RobotSpec::hinges (n = 0: the robot is one rigid body), and the
// fork that steers its wheel (RobotSpec::steering).
struct HingeState {
  static constexpr int kMax = 8;
  int n = 0;
  std::array<double, kMax> rad{}, radps{};
  bool steered = false;  // there is a fork
  double steer_rad = 0, steer_radps = 0;

  // The fork is where it is, whatever is asked of the hinges.
  void TakeSteering(const HingeState& now) {
    steered = now.steered;
    steer_rad = now.steer_rad;
  }
};

struct Estimate {
  Pose2 X_WB;
  BodyTwist V_WB_B;
  HingeState hinges = {};     // as their encoders say
  double position_std_m = 0;  // standard deviation of its place, by its own account
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Slower the smaller the gap to known obstacles, as regulated pure pursuit does.
#pragma once

#include <algorithm>

#include "env/core/coverage.h"
#include "env/core/params.h"
#include "env/core/robot_spec.h"

namespace floorproof {

class ObstacleGap {
 public:
  void Visit(ParamVisitor& v) {
    v("obstacle_gap_m", gap_m_, NonNegative(),
      "gap between clear shape and known obstacles below which it slows down");
    v("obstacle_speed_share", share_, Between(0.1, 1), "share of the speed at no gap");
  }
  // `clearance` may be nullptr: no obstacle is known.
  void Start(const RobotSpec& robot, const ClearanceField* clearance) {
    clearance_ = clearance;
    radius_m_ = robot.inscribed_radius_m > 0 ? robot.inscribed_radius_m : robot.clear.radius_m;
  }
  // The speed allowed where the robot is and where it is heading.
  double Limit(double speed_mps, const Vec2& p_W, const Vec2& target_W) const {
    if (clearance_ == nullptr || gap_m_ <= 0) return speed_mps;
    const double gap_m = std::min(clearance_->At(p_W), clearance_->At(target_W)) - radius_m_;
    return speed_mps * (share_ + (1 - share_) * std::clamp(gap_m / gap_m_, 0.0, 1.0));
  }

 private:
  double gap_m_ = 0.10, share_ = 0.6;
  const ClearanceField* clearance_ = nullptr;
  double radius_m_ = 0;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// How wheels that roll alike share what there is to drive: each one's current in its own direction,
// the mean over a while, by the median of all that turn.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "controllers/monitors/lean_angle.h"

namespace floorproof {

struct WheelShareParams {
  double agree = 0.45, least_a = 0.02, mean_s = 1, most_lean_deg = 1;
  void Visit(ParamVisitor& v) {
    v("agree", agree, Between(0.01, 0.99),
      "wheels draw alike from this share of the median to its inverse");
    v("least_a", least_a, NonNegative(), "a median below this says nothing (A)");
    v("mean_s", mean_s, Positive(), "time constant of the mean (s)");
    v("most_lean_deg", most_lean_deg, Between(0, 90),
      "of a robot that leans more by its IMU, as on an edge, wheels do not carry alike (deg)");
  }
};

// Of the median.
using WheelShare = std::optional<double>;

class WheelShares {
 public:
  // May allocate; Update may not.
  void Start(const WheelShareParams& params, const RobotSpec& robot);
  // One period. By driven wheel; none of one that has not turned this way for long. Empty while
  // nothing can be said: fewer than four wheels turn, all of them roll freely, the robot leans or
  // has leaned just now, or its blocks fold and do not carry alike. Nor in a bend of a robot whose
  // wheels are plain: those on the inside brake, and slide.
  std::span<const WheelShare> Update(const MonitorReadings& now);
  bool Agrees(double share) const { return share > params_.agree && share < 1 / params_.agree; }
  // How many do not, of those that Update() told of.
  int Odd(std::span<const WheelShare> shares) const;

 private:
  struct Wheel {
    double least_radps;  // slower it does not turn
    bool forward = true;
    double turns_s = 0;  // this way
    LowPass draws_a;
  };
  WheelShareParams params_;
  std::vector<Wheel> wheels_;
  bool scrub_ = false;  // plain wheels
  std::vector<WheelShare> shares_;
  std::vector<double> turning_a_;
  LeanAngle lean_;
  double level_s_ = 0;  // since it last leaned
};

}  // namespace floorproof

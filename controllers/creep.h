// SPDX-License-Identifier: Apache-2.0
// The minimum speed near a stop, for motors that fall short of low speeds.
//
// A follower commands lower and lower speeds as it approaches a stop. A motor with a proportional
// speed loop falls short of the commanded speed by its load over its gain. On a slope, or if tyres
// scrub, this can be more than the commanded speed, and the robot stops before the place. If the
// robot gets no closer for 1 s, the minimum commanded speed is ramped up; while it gets closer, the
// minimum decays. So it stays near the speed that just moves the robot, as an integrator would.
// Used for the remaining way along a leg, and for the remaining angle of a turn on the spot.
#pragma once

#include <algorithm>
#include <limits>

namespace floorproof {

class Creep {
 public:
  struct Limits {
    double progress;    // the remaining way must shrink by this to count as closer (m, or rad)
    double ramp_per_s;  // of the minimum speed while the robot stands (m/s^2, or rad/s^2)
    double max_speed;   // largest minimum speed (m/s, or rad/s)
    double new_way;     // a remaining way that grows by more belongs to another stop (m, or rad)
  };
  static constexpr Limits kAlong{0.001, 0.05, 0.1, 0.05}, kTurn{0.005, 0.25, 0.5, 0.25};

  explicit Creep(const Limits& limits) : limits_(limits) {}
  void Reset() { *this = Creep(limits_); }
  // The remaining way (m) or angle (rad), >= 0, at this time. Call it in every control period in
  // which the robot is commanded to approach; a pause starts it afresh. Does not allocate.
  void Update(double left, double t_s) {
    constexpr double kPatience_s = 1, kPatienceAgain_s = 0.1, kPause_s = 0.5;
    constexpr double kDecay = 0.9, kNothing = 0.02;  // per `progress`; share of max_speed
    if (t_s - last_s_ > kPause_s || left > least_ + limits_.new_way) Reset();
    const double dt_s = t_s - std::max(last_s_, 0.0);
    last_s_ = t_s;
    if (left < least_ - limits_.progress) {
      least_ = left;
      since_s_ = t_s;
      speed_ *= kDecay;
      if (speed_ < kNothing * limits_.max_speed) speed_ = 0;
    } else if (t_s - since_s_ > (speed_ > 0 ? kPatienceAgain_s : kPatience_s)) {
      speed_ = std::min(limits_.max_speed, speed_ + limits_.ramp_per_s * dt_s);
    }
  }
  // The minimum speed to command: 0 unless the robot stood still near here.
  double speed() const { return speed_; }

 private:
  static constexpr double kInf = std::numeric_limits<double>::infinity();
  Limits limits_;
  double least_ = kInf, since_s_ = 0, last_s_ = -kInf;
  double speed_ = 0;
};

}  // namespace floorproof

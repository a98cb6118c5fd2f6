// SPDX-License-Identifier: Apache-2.0
// How a robot gets through the last of its way to a stop, or of a turn, where its motors are weak.
//
// Near a stop a follower asks for less and less speed. A motor whose speed loop is proportional
// falls short of what it is asked for by its load over its gain: on a slope, with a heavy robot or
// with tyres that scrub, by more than is asked for there, and the robot stands still before the
// place. A robot that comes no nearer for a while is asked for more and more speed, as an
// integrating controller would, until it moves.
#pragma once

#include <algorithm>
#include <limits>

namespace floorproof {

class Creep {
 public:
  struct Limits {
    double nearer;      // by so much less is left: it moves (m, or rad)
    double more_per_s;  // more speed each second that it stands (m/s2, or rad/s2)
    double max_speed;   // of the least speed (m/s, or rad/s)
    double freed;       // so far from where it stood, nothing holds it any more (m, or rad)
  };
  static constexpr Limits kWay{0.001, 0.05, 0.1, 0.05}, kTurn{0.005, 0.25, 0.5, 0.25};

  explicit Creep(const Limits& limits) : limits_(limits) {}
  // Another way, or turn, begins.
  void Reset() { *this = Creep(limits_); }
  // So much is left at this time. Does not allocate.
  void Update(double left, double t_s) {
    constexpr double kPatience_s = 1;
    if (left < stalled_ - limits_.freed) speed_ = 0;
    if (left < least_ - limits_.nearer) {
      least_ = left;
      since_s_ = t_s;
    }
    const double wanted = limits_.more_per_s * (t_s - since_s_ - kPatience_s);
    if (wanted <= speed_) return;
    speed_ = std::min(wanted, limits_.max_speed);
    stalled_ = least_;
  }
  // The least speed to ask for: 0 unless the robot stood still near here.
  double speed() const { return speed_; }

 private:
  static constexpr double kNowhere = std::numeric_limits<double>::infinity();
  Limits limits_;
  double least_ = kNowhere, since_s_ = 0;
  double stalled_ = kNowhere, speed_ = 0;
};

}  // namespace floorproof

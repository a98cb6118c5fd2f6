// SPDX-License-Identifier: Apache-2.0
// Giving way to an edge that holds a holonomic robot.
//
// A robot that meets an edge aslant is caught by one wheel. What a caught Mecanum wheel rubs acts
// along its roller, upward and aside at once, and nothing opposes it: the other wheels spin, all
// their friction is used forward, and until the robot slides aside as fast as they spin they hold
// it neither sideways nor in yaw. It slides along the edge. Once the whole row stands at the edge,
// the sideways pulls of left and right wheels cancel, and the row climbs as it does square on.
//
// So a robot that is commanded on and does not get on squares up: it turns against its slide, about
// the wheel that is caught. It does not turn back to its path's yaw, which takes it off the square,
// nor drive back sideways as fast as it drives on, which lets half of the wheels stand still. It
// bears that until it has come its own length farther: the rows behind meet the same edge.
//
// Judges by the estimated place alone. A robot that does not notice that it slips, as one on
// odometry, does not give way.
#pragma once

#include <optional>

#include "env/core/robot_spec.h"

namespace floorproof {

class Compliance {
 public:
  // `bearable_rad`: the error of yaw that is borne. A robot without a circumscribed radius does not
  // give way.
  void Start(const RobotSpec& robot, double bearable_rad);
  // One control period of driving along a leg: where the robot is, the leg's direction (unit), and
  // the speed along it that was commanded until now.
  void Update(const Vec2& p_W, const Vec2& direction_W, double commanded_mps, double dt_s);
  // It does not drive along a leg.
  void Drop();

  bool held() const { return held_; }             // at this moment
  bool active() const { return to_bear_m_ > 0; }  // from then on until it has come its length

  // What is to be corrected of an error of yaw.
  double YawError(double error_rad) const;
  // The turn that squares it up, while it is held; else 0.
  double SquaringRate() const;
  // The most of its speed that may go back to the path.
  double BackSpeed(double speed_mps, double otherwise_mps) const;

 private:
  double length_m_ = 0, bearable_rad_ = 0;
  std::optional<Vec2> last_W_;
  double expected_mps_ = 0;             // of wheels that follow the command with their lag
  double expected_m_ = 0, made_m_ = 0;  // along the leg, of late
  double aside_mps_ = 0;                // to the left of it
  double to_bear_m_ = 0;
  bool held_ = false;
};

}  // namespace floorproof

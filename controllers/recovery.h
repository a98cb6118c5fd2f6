// SPDX-License-Identifier: Apache-2.0
// What a driving robot does when its shell is pressed or there is no floor ahead: it brakes, goes
// back the way it came (a robot that cannot turn on the spot by the width of its tightest turn at
// least), and then wants the rest of its plan joined anew (planners/lines/rejoin.h).
// Where it meets something behind it too, it goes to the middle between both.
#pragma once

#include <string>
#include <vector>

#include "base/params.h"
#include "env/core/motion.h"
#include "env/core/observation.h"
#include "env/core/robot_spec.h"

namespace floorproof {

struct RecoveryParams {
  bool bumper = true, cliff = true;  // what it reacts to
  double back_off_m = 0.15, back_off_mps = 0.1;
  std::string then = "replan";
  int most = 50;  // reactions an episode: a robot that is caught does not struggle for ever
  void Visit(ParamVisitor& v);
  // What it goes by.
  std::vector<Reading> Needs() const;
};

class Recovery {
 public:
  void Start(const RecoveryParams& params, const RobotSpec& robot);

  // One control period. Takes `command`, what the tracker asked for last, and replaces its twist
  // while it reacts; true: it does, the tracker is not to be asked.
  bool Update(const Observation& sensed, const Estimate& estimate, double dt_s, Command& command);
  // What it was about is over: the robot was set down elsewhere.
  void Drop() {
    state_ = State::kIdle;
    ended_ = false;
  }
  // It has gone back: the tracker needs a new path. True once a reaction.
  bool ended() const { return ended_; }
  int count() const { return count_; }
  // What it reacted to last was a drop, not a touch.
  bool met_drop() const { return met_drop_; }

 private:
  enum class State { kIdle, kBrake, kBack };
  bool Alarm(const Observation& sensed) const;
  void Begin(const Observation& sensed, const BodyTwist& commanded);
  void GoBack(double m);
  void Approach(const BodyTwist& wanted, double dt_s);

  RecoveryParams params_;
  const RobotSpec* robot_ = nullptr;
  bool holonomic_ = false;
  State state_ = State::kIdle;
  BodyTwist twist_;            // commanded now
  Vec2 way_B_ = Vec2::Zero();  // unit, away from what was met
  double turn_ = 0;            // or the sense to turn back in
  Pose2 from_;                 // the estimate where going back began
  double back_m_ = 0;          // to be gone
  bool between_ = false;       // it met something behind, too, and goes to the middle
  double left_s_ = 0;
  bool ended_ = false, met_drop_ = false;
  int count_ = 0;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A path tracker whose twists somebody else says: a program that holds this one as a library
// (python/). How far along the path the robot is, its stops and its dwells are kept here, as they
// are for every other tracker; so are the robot's limits.
#pragma once

#include "controllers/path_progress.h"
#include "controllers/tracker.h"

namespace floorproof {

// Where a plan first changes the robot's shape, which twists cannot; nullptr: nowhere.
const Waypoint* FirstFold(const Path& path, const RobotSpec& robot);

class TwistTracker : public Tracker {
 public:
  // What the twist of a period may be made from: at stops nobody is asked.
  struct Situation {
    const Estimate& estimate;
    double t_s = 0, dt_s = 0;
    std::size_t segment = 0;       // of the path: from this waypoint to the next
    Vec2 target_W = Vec2::Zero();  // a point ahead on the path, where one drives
    double speed_mps = 0;          // that the way ahead allows
  };

  // `free`: the path is nobody's way; twists are asked for whatever it is, and it has no end.
  explicit TwistTracker(bool free = false) : free_(free) {}

  bool Commands(const Drive&) const override { return true; }
  // Throws InputError where the plan changes the robot's shape. The plan's yaws are not held.
  void Start(const Path& path, const RobotSpec& robot, const ClearanceField* clearance) override;
  void Extend(const Path& path) override;
  void Slow(double share) override {
    share_ = share;
    progress_.Slow(share);
  }
  double Duration() const override { return duration_s_; }
  MissedStops Missed() const override { return progress_.missed(); }
  bool WouldBeDone(const Estimate& estimate, double t_s) const override {
    return !free_ && progress_.WouldBeDone(estimate.X_WB, t_s);
  }
  // The twist that is asked for, within the robot's speeds and accelerations; at dwells and at the
  // end none.
  Command Update(const Estimate& estimate, double t_s, double dt_s) override;

 protected:
  // The path is another from now on.
  virtual void OnPath(const Path&, const RobotSpec&) {}
  virtual BodyTwist Twist(const Situation& now) = 0;

 private:
  void MoveTowards(const BodyTwist& wanted, double dt_s);

  bool free_;
  PathProgress progress_;
  RobotSpec robot_;
  BodyTwist twist_;  // last commanded
  double share_ = 1, duration_s_ = 0;
};

}  // namespace floorproof

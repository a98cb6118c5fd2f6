// SPDX-License-Identifier: Apache-2.0
// Whether a robot truly arrived, by its true positions, regardless of its own estimate.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "env/core/motion.h"
#include "env/core/path.h"

namespace floorproof {

// Which parts of a plan a robot has truly come to. A place of the plan is passed once the robot's
// centre has been within `near_m` of it, at any time: rows of a plan that are nearer to each other
// than that are not told apart, which coverage does. A task is done once the robot has stopped for
// it within `near_m` of its waypoint.
class PlanPassed {
 public:
  // Time and memory grow with the plan's length, up to a million looks at it.
  PlanPassed(const Path& plan, double near_m);

  // Once a control period. Allocates nothing.
  void Add(const Vec2& p_W, bool dwelling);

  // Length of the plan that was not passed, m.
  double left_m() const;
  int tasks_missed() const;
  // Where the first of them was due, if there is one.
  std::optional<Vec2> first_missed_W() const;

 private:
  struct Look {
    std::int64_t key = 0;  // of the square of `near_m` that holds it
    Vec2 p_W;
    double share_m = 0;  // of the plan's length
    bool passed = false;
  };
  struct Task {
    Vec2 p_W;
    bool done = false;
  };
  std::int64_t Key(double x, double y) const;

  double near_m_;
  std::vector<Look> looks_;  // by key
  std::vector<Task> tasks_;
  Vec2 last_W_ = Vec2::Constant(1e18);
};

// Where a robot stood when its drive was over.
struct Arrival {
  bool believed = false;        // that it had driven all that led it
  std::optional<double> off_m;  // from its true place to where it should be; none: no such place
  double most_off_m = 0;        // that is allowed
  Vec2 end_W = Vec2::Zero();    // where it should be
  bool at_rest = true;
  double speed_mps = 0, turn_radps = 0;
  std::optional<double> left_m;  // of the plan, not passed; none: there was no plan beforehand
  double plan_m = 0;             // the plan's length
  int tasks_missed = 0;
  std::optional<Vec2> first_missed_W;
};

// Tells whether a robot has stood still for long enough.
class RestWatch {
 public:
  static constexpr double kRest_s = 1, kRest_mps = 0.02, kRest_radps = 0.05;
  static constexpr double kPatience_s = 10;  // for which a robot may take to come to rest

  // It has begun to stand.
  void Begin(double t_s) { began_s_ = moved_s_ = t_s; }
  bool begun() const { return began_s_.has_value(); }
  // In each step since.
  void Add(const Truth& truth);
  bool HasRested(double t_s) const { return begun() && t_s - moved_s_ >= kRest_s - 1e-9; }
  bool IsOver(double t_s) const { return HasRested(t_s) || t_s - *began_s_ >= kPatience_s; }
  void Drop() { began_s_.reset(); }

 private:
  std::optional<double> began_s_;
  double moved_s_ = 0;  // last
};

}  // namespace floorproof

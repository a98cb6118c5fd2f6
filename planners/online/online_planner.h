// SPDX-License-Identifier: Apache-2.0
// The contract of planners of unknown floors. They plan while the robot drives: told what it has
// seen so far, they say where it is to go next. A new one is one file in this folder and one line
// in list.inc. None sees the floor as it is, the true pose or the physics; nothing that it may
// include knows of them (docs/architecture.md).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/params.h"
#include "base/registry.h"
#include "env/known/estimate.h"
#include "env/known/known_map.h"
#include "planners/online/extent.h"

namespace floorproof {

// What it is told before the drive.
struct OnlineTask {
  GridFrame ground;   // of the known map; its borders say how far floor may reach, no more
  Pose2 start;        // X_WB, as the robot believes it
  Extent clear = {};  // is to stay free around the robot's centre: its body, and a margin
  Extent tool = {};   // is swept around it
  double tool_width_m = 0;
  std::uint64_t seed = 0;
  Extent body = {};  // of the robot around its centre (m), without a margin
};

// What it is told on the way.
struct OnlineInput {
  const KnownMap& known;
  std::span<const Cell> changed;  // the cells of `known` of another state than at the last call
  // Where it is. So that a robot need not stop at each target it is asked shortly before, with the
  // target that it is about to reach as its place.
  const Estimate& estimate;
  bool bumped = false, dropped = false;  // since the last call: it was touched, or met an edge
  bool missed = false;                   // it never reached the place of the last call
  bool stopped = false;  // something lies across its way to the target, or it came off that way
  // It is not on its way to the target any more.
  bool left_its_way() const { return bumped || dropped || stopped; }
};

struct OnlineStep {
  enum class Kind {
    kTarget,   // drive there, straight
    kDone,     // all is covered that it knows of and can reach
    kNowhere,  // there is no free floor to go to
  };
  Kind kind = Kind::kTarget;
  Vec2 target_W = Vec2::Zero();
  std::string_view why = {};  // of the last two, in words
};

// Keys that all of them have.
struct OnlineParams {
  double radius_m = 1.5;            // r
  std::optional<double> step_m;     // epsilon
  std::optional<double> speed_mps;  // none: the robot's cruise
  void Visit(ParamVisitor& v);
};

class OnlinePlanner : public Configurable {
 public:
  // No step is longer than radius_m: for who starts it.
  virtual const OnlineParams& params() const = 0;
  // Whether it draws from the task's seed: else the same floor has the same drive.
  virtual bool uses_seed() const { return false; }
  // Whether it covers all that can be reached, and says so then.
  virtual bool covers_all() const { return true; }

  // Forgets the drive before.
  virtual void Start(const OnlineTask& task) = 0;
  // Where to go from here: asked at the start, whenever the target is reached, and when the robot
  // could not get there or had to stop on its way.
  virtual OnlineStep Next(const OnlineInput& input) = 0;
  // Its own figures of the drive, for plan.json and the columns plan.*, in order.
  virtual std::vector<std::pair<std::string, double>> figures() const { return {}; }
};

std::span<const PluginEntry<OnlinePlanner>> OnlinePlanners();

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What a robot's commands act on and its sensors look at: the physics, or an ideal robot without.
// The episode's loop knows no more of either.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "env/core/motion.h"
#include "env/core/observation.h"

namespace floorproof {

// What the robot's side wants for one control period.
struct Actuation {
  BodyTwist twist;                      // of the body
  std::span<const double> wheel_radps;  // the same by driven wheel, RobotSpec's order
  HingeState hinges;                    // the rates that their motors hold
  std::span<const char> cut = {};       // wheels whose motors are cut off their power; empty: none
};

class Plant {
 public:
  virtual ~Plant() = default;
  // At rest at the pose, its start; time 0, everything that it carries new. Sizes `sensed`.
  virtual void Reset(const Pose2& X_WB, Observation& sensed) = 0;
  // The same in the middle of an episode: lifted and set down, at rest. Time goes on, and no sensor
  // notices.
  virtual void SetDown(const Pose2& X_WB) = 0;
  // Holds from now on. Allocates nothing; nor do the next two, but where a fault comes or goes.
  virtual void Apply(const Actuation& actuation) = 0;
  // What the robot's sensors tell at the start of a control period.
  virtual void Sense(Observation& sensed) = 0;
  // One step; false when the plant broke: the episode is an `error`. Throws InternalError when the
  // engine itself fails.
  virtual bool Step() = 0;
  // After a Step that returned false: what broke, and when.
  virtual std::string WhyBroken() const = 0;
  // As at the last step.
  virtual const Truth& truth() const = 0;
  // Share of the battery's capacity that is left; none: the robot states no capacity.
  virtual std::optional<double> battery_left() const = 0;
};

}  // namespace floorproof

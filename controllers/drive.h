// SPDX-License-Identifier: Apache-2.0
// Drives: body twist <-> wheel speeds, both ways.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "base/registry.h"
#include "env/core/motion.h"
#include "env/core/robot_spec.h"

namespace floorproof {

class Drive {
 public:
  virtual ~Drive() = default;

  // What every robot on this drive can do; known before Configure.
  virtual bool holonomic() const = 0;          // moves every way, whatever its heading
  virtual bool turns_on_the_spot() const = 0;  // turns without driving on

  // Reads radii and places of the wheels; throws InputError when the robot lacks what the drive
  // needs.
  virtual void Configure(const RobotSpec& robot) = 0;
  // From now on these wheels, a flag each, are out of use: what they turn says nothing of the
  // twist, and their motors' speeds bound nothing. They are still told to turn along, so that they
  // drag less. False, and nothing changes, where the others cannot move the robot every way that it
  // could. Not before Configure.
  virtual bool Exclude(std::span<const char> wheels) = 0;
  // Wheel speeds (rad/s, in RobotSpec's order) for a twist. Components that the drive cannot follow
  // are dropped. `hinges` says how the blocks that carry the wheels stand and are to move. Of a
  // robot that steers it says where its wheels point, and gets the rates that turn them to where
  // they are to point; none steered: they point there already. When a
  // wheel would exceed its motor's no-load speed, all wheel speeds and the hinges' rates are scaled
  // down together, so that the curvature stays.
  virtual void ToWheels(const BodyTwist& twist, HingeState& hinges,
                        std::span<double> wheel_radps) const = 0;
  void ToWheels(const BodyTwist& twist, std::span<double> wheel_radps) const {
    HingeState none;
    ToWheels(twist, none, wheel_radps);
  }
  // The twist that results when the wheels roll at these speeds while the hinges turn so, in the
  // least-squares sense. Where `hinges` does not say so, wheels that are steered point ahead.
  virtual BodyTwist ToTwist(std::span<const double> wheel_radps,
                            const HingeState& hinges = {}) const = 0;
};

std::span<const PluginEntry<Drive>> Drives();
// The first of them that can be configured for the robot's wheels; none: `why` says what each
// lacks.
const PluginEntry<Drive>* DriveFor(const RobotSpec& robot, std::string& why);
// Whether the robot's drive is. Throws InputError when there is no such drive.
bool IsHolonomic(const RobotSpec& robot);

}  // namespace floorproof

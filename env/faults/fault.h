// SPDX-License-Identifier: Apache-2.0
// Faults: what may break on a robot, each told as plain Alterations. A new one is one file in this
// folder and one line in list.inc. When it is broken is said by its schedule (schedule.h). Faults
// know no MuJoCo: simulation and sensors apply what they say.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/params.h"
#include "base/registry.h"
#include "env/core/alterations.h"
#include "env/core/robot_spec.h"

namespace floorproof {

// On which robot. The references hold during the call only.
struct FaultContext {
  const RobotSpec& robot;
  std::span<const std::string> sensors;  // names of those that it carries
};

class Fault : public Configurable {
 public:
  static constexpr const char* kAll = "all";  // the word for all wheels, all sensors

  // Before an episode. Throws InputError, without a mark, naming the key of Visit that asks for
  // what the robot does not have.
  virtual void Start(const FaultContext& context) = 0;
  // Adds what is broken now to what is broken already: factors multiply. The lists by wheel hold a
  // value for each driven wheel; that of rollers is empty on a robot without.
  virtual void Break(Alterations& alterations) const = 0;
};

std::span<const PluginEntry<Fault>> Faults();

// Indices into RobotSpec::wheels of the wheel of that name, or of all. Throws InputError.
std::vector<std::size_t> FindWheels(const RobotSpec& robot, const std::string& name);

}  // namespace floorproof

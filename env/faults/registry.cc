// SPDX-License-Identifier: Apache-2.0
// The table of faults, made from its list.
#include <numeric>

#include "env/faults/fault.h"

namespace floorproof {

#define FP_FAULT(Class, name, help) std::unique_ptr<Fault> Make##Class();
#include "env/faults/list.inc"
#undef FP_FAULT

std::span<const PluginEntry<Fault>> Faults() {
  static constexpr PluginEntry<Fault> kTable[] = {
#define FP_FAULT(Class, name, help) {name, help, &Make##Class},
#include "env/faults/list.inc"
#undef FP_FAULT
  };
  return kTable;
}

std::vector<std::size_t> FindWheels(const RobotSpec& robot, const std::string& name) {
  if (name == Fault::kAll) {
    std::vector<std::size_t> all(robot.wheels.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
  }
  std::string known;
  for (std::size_t i = 0; i < robot.wheels.size(); ++i) {
    if (robot.wheels[i].name == name) return {i};
    known += " " + robot.wheels[i].name;
  }
  throw InputError({}, "wheel", name,
                   "is no driven wheel of the robot (all, or one of:" + known + ")");
}

}  // namespace floorproof

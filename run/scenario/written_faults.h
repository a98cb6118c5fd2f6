// SPDX-License-Identifier: Apache-2.0
// A scenario's faults as they are written: a list under the key `faults`.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/config.h"
#include "env/faults/schedule.h"

namespace floorproof {

// Throws InputError, also where the robot has nothing that could break so, and where a fault comes
// or goes faster than the physics steps. `node`: the list.
std::vector<ScheduledFault> ReadFaults(const ConfigNode& node, const FaultContext& context,
                                       double step_s);
ConfigNode FaultsSchema();

// The list again, with every default stated.
ConfigNode WriteFaults(std::span<const ScheduledFault> faults);

}  // namespace floorproof

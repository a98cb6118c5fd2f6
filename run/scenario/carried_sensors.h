// SPDX-License-Identifier: Apache-2.0
// Which sensors a robot carries, and with which keys.
#pragma once

#include <span>
#include <vector>

#include "base/config.h"
#include "env/sensors/sensor.h"

namespace floorproof {

// Those that are written (a map: name, its keys); and for each reading that is needed and that none
// of them fills, the first of the table that does, as it is by default. In the table's order.
// Throws InputError where two of those written fill the same reading.
std::vector<NamedSensor> CarriedSensors(std::span<const PluginEntry<Sensor>> table,
                                        const ConfigNode& written, std::span<const Reading> needed);

}  // namespace floorproof

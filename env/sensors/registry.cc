// SPDX-License-Identifier: Apache-2.0
// The table of sensors, made from its list.
#include "env/sensors/sensor.h"

namespace floorproof {

#define FP_SENSOR(Class, name, help) std::unique_ptr<Sensor> Make##Class();
#include "env/sensors/list.inc"
#undef FP_SENSOR

std::span<const PluginEntry<Sensor>> Sensors() {
  static constexpr PluginEntry<Sensor> kTable[] = {
#define FP_SENSOR(Class, name, help) {name, help, &Make##Class},
#include "env/sensors/list.inc"
#undef FP_SENSOR
  };
  return kTable;
}

std::vector<std::string> SensorNames(std::span<const NamedSensor> sensors) {
  std::vector<std::string> names;
  for (const NamedSensor& sensor : sensors) names.push_back(sensor.name);
  return names;
}

}  // namespace floorproof

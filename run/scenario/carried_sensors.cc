// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/carried_sensors.h"

#include <algorithm>
#include <map>
#include <string>

namespace floorproof {

std::vector<NamedSensor> CarriedSensors(std::span<const PluginEntry<Sensor>> table,
                                        const ConfigNode& written,
                                        std::span<const Reading> needed) {
  std::vector<NamedSensor> sensors;
  for (const auto& entry : table) sensors.push_back({std::string(entry.name), entry.make()});

  std::map<Reading, std::string> filled_by;
  for (const auto& [name, sensor, implied] : sensors) {
    const ConfigNode* params = written.Find(name);
    if (params == nullptr) continue;
    const auto [first, is_first] = filled_by.try_emplace(sensor->Fills(), name);
    if (!is_first)
      throw InputError(params->mark, "sensors." + name, "",
                       "tells the " + std::string(Name(sensor->Fills())) + ", as " + first->second +
                           " does: a robot carries one of them");
  }
  for (const auto& [name, sensor, implied] : sensors)
    if (std::ranges::find(needed, sensor->Fills()) != needed.end())
      filled_by.try_emplace(sensor->Fills(), name);

  std::erase_if(sensors, [&](const NamedSensor& s) {
    const auto by = filled_by.find(s.sensor->Fills());
    return by == filled_by.end() || by->second != s.name;
  });
  for (auto& [name, sensor, implied] : sensors) {
    const ConfigNode* params = written.Find(name);
    implied = params == nullptr && DocumentParams(*sensor).empty();
    if (params != nullptr && !params->IsNull())
      ReadParams(*params, "sensors." + name + ".", *sensor);
  }
  return sensors;
}

}  // namespace floorproof

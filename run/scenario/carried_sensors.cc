// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/carried_sensors.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace floorproof {

std::vector<NamedSensor> CarriedSensors(std::span<const PluginEntry<Sensor>> table,
                                        const ConfigNode& written,
                                        std::span<const Reading> needed) {
  std::map<Reading, std::string_view> filled_by;
  for (const auto& entry : table) {
    const ConfigNode* params = written.Find(entry.name);
    if (params == nullptr) continue;
    const Reading reading = entry.make()->Fills();
    const auto [first, is_first] = filled_by.try_emplace(reading, entry.name);
    if (!is_first)
      throw InputError(params->mark, "sensors." + std::string(entry.name), "",
                       "tells the " + std::string(Name(reading)) + ", as " +
                           std::string(first->second) + " does: a robot carries one of them");
  }
  for (const auto& entry : table)
    if (const Reading reading = entry.make()->Fills();
        std::ranges::find(needed, reading) != needed.end())
      filled_by.try_emplace(reading, entry.name);

  std::vector<NamedSensor> carried;
  for (const auto& entry : table) {
    auto sensor = entry.make();
    const auto by = filled_by.find(sensor->Fills());
    if (by == filled_by.end() || by->second != entry.name) continue;
    const std::string name(entry.name);
    const ConfigNode* params = written.Find(name);
    const bool implied = params == nullptr && DocumentParams(*sensor).empty();
    if (params != nullptr && !params->IsNull())
      ReadParams(*params, "sensors." + name + ".", *sensor);
    carried.push_back({name, std::move(sensor), implied});
  }
  return carried;
}

}  // namespace floorproof

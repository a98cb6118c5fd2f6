// SPDX-License-Identifier: Apache-2.0
// The table of detectors, made from its list.
#include "env/core/levels.h"
#include "env/failures/detector.h"

namespace floorproof {

#define FP_DETECTOR(Class, name, help) std::unique_ptr<Detector> Make##Class();
#include "env/failures/list.inc"
#undef FP_DETECTOR

std::span<const PluginEntry<Detector>> Detectors() {
  static constexpr PluginEntry<Detector> kTable[] = {
#define FP_DETECTOR(Class, name, help) {name, help, &Make##Class},
#include "env/failures/list.inc"
#undef FP_DETECTOR
  };
  return kTable;
}

std::string HazardId(const HazardMap& map, int index, bool contact) {
  if (index >= 0 && index < static_cast<int>(map.hazards.size()))
    return map.hazards[static_cast<std::size_t>(index)].id;
  if (index == ObstacleContact::kFloor) return BaseFloorId(map);
  return contact ? "wall" : "";
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "env/hazards/hazard_type.h"

namespace floorproof {

#define FP_HAZARD(Class, name, help) std::unique_ptr<HazardType> Make##Class();
#include "env/hazards/list.inc"
#undef FP_HAZARD

std::span<const PluginEntry<HazardType>> HazardTypes() {
  static constexpr auto kTable = std::to_array<PluginEntry<HazardType>>({
#define FP_HAZARD(Class, name, help) {name, help, Make##Class},
#include "env/hazards/list.inc"
#undef FP_HAZARD
  });
  return kTable;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "planners/online/online_planner.h"

namespace floorproof {

#define FP_ONLINE_PLANNER(Class, name, help) std::unique_ptr<OnlinePlanner> Make##Class();
#include "planners/online/list.inc"
#undef FP_ONLINE_PLANNER

std::span<const PluginEntry<OnlinePlanner>> OnlinePlanners() {
  static constexpr PluginEntry<OnlinePlanner> kTable[] = {
#define FP_ONLINE_PLANNER(Class, name, help) {name, help, &Make##Class},
#include "planners/online/list.inc"
#undef FP_ONLINE_PLANNER
  };
  return kTable;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "planners/online/online_planner.h"

namespace floorproof {

void OnlineParams::Visit(ParamVisitor& v) {
  v("radius_m", radius_m, Positive(), "r: how far the robot sees around it, at least a step (m)");
  v("step_m", step_m, Positive(),
    "epsilon: side of its cells (m); none: the tool's width, or the site's cell (drive: cells)");
  v("speed_mps", speed_mps, Positive(), "how fast the robot drives (m/s); none: its cruise");
}

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

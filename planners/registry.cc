// SPDX-License-Identifier: Apache-2.0
#include "planners/planner.h"

namespace floorproof {

#define FP_PLANNER(Class, name, help) std::unique_ptr<Planner> Make##Class();
#include "planners/list.inc"
#undef FP_PLANNER

std::span<const PluginEntry<Planner>> Planners() {
  static constexpr PluginEntry<Planner> kTable[] = {
#define FP_PLANNER(Class, name, help) {name, help, &Make##Class},
#include "planners/list.inc"
#undef FP_PLANNER
  };
  return kTable;
}

std::string_view Name(PlanStatus status) {
  switch (status) {
    case PlanStatus::kSuccess:
      return "success";
    case PlanStatus::kStartBlocked:
      return "start_blocked";
    case PlanStatus::kNoFloor:
      return "no_floor";
    case PlanStatus::kGoalUnreachable:
      return "goal_unreachable";
    case PlanStatus::kFloorDivided:
      return "floor_divided";
    case PlanStatus::kTooFewSamples:
      return "too_few_samples";
    case PlanStatus::kOnline:
      return "online";
    case PlanStatus::kFailed:
      return "failed";
  }
  return "?";
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "run/episode/go_to_navigator.h"

namespace floorproof {

GoToNavigator::GoToNavigator(const PlanResult& plan)
    : plan_(plan), path_(plan.path.begin(), plan.path.begin() + 2) {}

PathChange GoToNavigator::Update(const NavigatorInput& input) {
  const bool anew = input.line != nullptr && input.line->number != line_;
  if (!anew && !input.recovered) return PathChange::kNone;
  if (anew) {
    line_ = input.line->number;
    path_[1].p_W = input.line->to_W;
    path_[1].speed_mps = input.line->speed_mps.value_or(0);
  }
  path_[0].p_W = input.estimate.X_WB.p();
  return PathChange::kAnew;
}

}  // namespace floorproof

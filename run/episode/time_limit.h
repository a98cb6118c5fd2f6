// SPDX-License-Identifier: Apache-2.0
// How long an episode may last, in simulated seconds: what the scenario states, else by what
// drives.
#pragma once

#include "run/scenario/scenario_params.h"

namespace floorproof {

// Of a planner of unknown floors.
inline double OnlineLimit_s(const EpisodeParams& params) {
  return params.time_limit_s.value_or(3 * 3600);
}
// Of a plan that takes so long at its own speeds.
inline double PlanLimit_s(const EpisodeParams& params, double plan_s) {
  return params.time_limit_s.value_or(60 + 3 * plan_s);
}

}  // namespace floorproof

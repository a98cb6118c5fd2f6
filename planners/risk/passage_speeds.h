// SPDX-License-Identifier: Apache-2.0
// How fast a path meets each hazard on its way.
#pragma once

#include "planners/risk/path_rates.h"

namespace floorproof {

// The same way, at the speed of the least expected rate over and past each hazard, with a run-up in
// which the robot comes to that speed. Hazards that are met together share a speed. Nothing changes
// where that saves next to nothing.
Path AtBestSpeeds(const Path& path, const PlanRequest& request, const PathRates& rates);

}  // namespace floorproof

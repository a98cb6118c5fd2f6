// SPDX-License-Identifier: Apache-2.0
// What plans that were driven say of what rates come to in whole plans.
#pragma once

#include <span>

#include "measure/calibration.h"
#include "planners/risk/carry_over.h"

namespace floorproof {

// By plan, what its rates come to and how many of its drives failed. The drives of a plan take the
// same way, and mostly end alike: a plan counts as one case, however often it was driven. Without
// plans nothing is changed, and with few of them little: the logistic regression is penalised as if
// intercept and slope were known to be 0 +- 0.5 and
// 1 +- 0.5.
CarryOver FitCarryOver(std::span<const Forecast> plans);

}  // namespace floorproof

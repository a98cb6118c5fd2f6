// SPDX-License-Identifier: Apache-2.0
// The risk model of a robot, from its measured meetings with hazards.
#pragma once

#include <vector>

#include "env/core/encounter.h"
#include "planners/risk/rate_model.h"

namespace floorproof {

struct RateFitOptions {
  // The robot is its own mirror image: a meeting counts for its mirror image too.
  bool mirrored = false;
  // The robot can go sideways; else the side that leads is no covariate.
  bool holonomic = true;
  // Fewer meetings of a kind than this say too little for rates that depend on anything.
  int least_encounters = 50;
};

// Rates are those of the first meeting of a drive with a hazard; what came of later ones says how
// alike they end (measure/shared_frailty.h). One set of rates for each hazard type, passed over and
// passed beside, there by manner where enough is known, and for each exposure, in the order of
// their names. All encounters are of `robot`. The covariates of a kind are the keys that all its
// hazards state, and the columns of Approach; what is passed and seldom failed is fitted with like
// kinds (measure/like_kinds.h). Those that never vary are kept as axes without functions. Meetings
// that were censored count half. Exposures that were censored count with the way that was driven.
// Modes are split off in the order of how often they happened; those that never did share what is
// left in equal parts. A kind like no other that never failed is predicted at the mean rate that
// such kinds have (Good's estimate, from the kinds that failed once; Biometrika 40 (1953) 237), and
// its upper bound is 3 / exposure. All numbers are rounded to 6 significant digits. The same
// encounters give the same bytes.
RiskModel FitRates(const std::vector<Encounter>& encounters, MeasuredRobot robot,
                   const RateFitOptions& options);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// How probable it is that a plan is driven without a failure, from the rates of all its meetings.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "planners/risk/rate_evaluator.h"

namespace floorproof {

// A meeting of a plan, in the order in which it is driven.
struct PlannedMeeting {
  const RateEvaluator* rates = nullptr;  // of its kind
  std::vector<std::pair<std::string, double>> size;
  double way_m = 1;  // of an exposure
};

// With its 95 % interval.
struct Probability {
  double value = 0, lower = 0, upper = 0;
};

struct Survival {
  Probability no_failure;
  std::array<Probability, kNumFailureModes> first;  // by mode: that it is what ends the drive
  std::vector<double> by_meeting;                   // that this meeting is what ends it
  double beyond = 0;  // the farthest that a meeting lies beyond what was measured
};

// `conditions`: by drawn condition, how each meeting is met. What one episode draws holds for all
// of its meetings, so that they may all fail together:
//   P(no failure) = mean over conditions of exp(-sum over meetings of Lambda).
// Expects at least one condition, and one Approach a meeting in each. The intervals hold what the
// model does not know (its members) and that conditions are a sample. `mirrored` is the model's.
// Throws InputError as Covariates does.
Survival PredictSurvival(std::span<const PlannedMeeting> meetings,
                         std::span<const std::vector<Approach>> conditions, bool mirrored);

}  // namespace floorproof

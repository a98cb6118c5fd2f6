// SPDX-License-Identifier: Apache-2.0
// How probable it is that a plan is driven without a failure, from the rates of all its meetings.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "planners/risk/rate_evaluator.h"

namespace floorproof {

// A meeting of a plan as it is in one condition.
struct PlannedMeeting {
  const RateEvaluator* rates = nullptr;              // of its kind
  std::vector<std::pair<std::string, double>> size;  // the hazard's keys
  Approach at;
  double way_m = 1;        // of an exposure
  std::size_t number = 0;  // which of the plan's meetings it is, whatever the condition
  // The number of the plan's first meeting with this hazard that is of this kind; its own: the
  // only one.
  std::size_t first = 0;
};

// With its 95 % interval.
struct Probability {
  double value = 0, lower = 0, upper = 0;
};

struct Survival {
  Probability no_failure;
  std::array<Probability, kNumFailureModes> first;  // by mode: that it is what ends the drive
  std::vector<double> by_meeting;                   // by number: that it is what ends the drive
  // By number: how far the meeting lies beyond what was measured where it does so most, and the
  // condition in which it does.
  struct Beyond {
    double share = 0;
    std::size_t condition = 0;
  };
  std::vector<Beyond> beyond;
  double farthest_beyond() const;  // its largest share
};

// `conditions`: by drawn condition, the meetings in the order in which they are driven; `numbers`:
// how many there are. What one episode draws holds for all of its meetings, so that they may all
// fail together, and so does what no covariate says of a hazard (KindRates::theta):
//   P(no failure) = mean over conditions of exp(-sum over hazards of (sum of
//   Lambda^theta)^(1/theta)).
// Expects at least one condition. The intervals hold what the model does not know (its members) and
// that conditions are a sample. `model` is that of the meetings' rates. Throws InputError as
// Covariates does.
Survival PredictSurvival(std::span<const std::vector<PlannedMeeting>> conditions,
                         std::size_t numbers, const RiskModel& model);

}  // namespace floorproof

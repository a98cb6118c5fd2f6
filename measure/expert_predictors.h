// SPDX-License-Identifier: Apache-2.0
// Predictors of a plan's failure that know no measured rates, fitted to the same training data:
// what a risk model has to be better than.
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "env/core/encounter.h"
#include "planners/risk/fmea_tables.h"
#include "planners/risk/rate_model.h"

namespace floorproof {

// A plan's exposures to one or more kinds of danger (meetings, or a risk that was summed), and how
// many of its drives failed.
struct TrainingPlan {
  std::vector<double> exposures;
  int k = 0, n = 0;
};

// The share of all drives that failed; NaN without a drive.
double FitConstant(std::span<const TrainingPlan> plans);

// Rates r >= 0, one for each exposure x, of
//   P(failure) = 1 - exp(-sum of r x),
// by maximum likelihood. With the one exposure CRF, 1 - exp(-a CRF). All plans have as many
// exposures, each at least 0; a rate that no plan is exposed to is 0.
std::vector<double> FitRatesOfExposures(std::span<const TrainingPlan> plans);
double FailureOfExposures(std::span<const double> rates, std::span<const double> exposures);

using ClassNumbers = std::array<double, kNumHazardClasses>;

// How many meetings with hazards of each class, those that a robot passes within reach too.
ClassNumbers MeetingsOfClasses(std::span<const Encounter> encounters,
                               const std::map<std::string, HazardClass>& class_of_type);

// Of the encounters with an outcome, by class, the share that failed: what Table 3 lacks to give a
// probability. 0 where a class was not met.
ClassNumbers OccurrenceOfClasses(std::span<const Encounter> encounters,
                                 const std::map<std::string, HazardClass>& class_of_type);

// By mode, the probability that it ends a plan with so many meetings, each of which fails with its
// class's occurrence, in the mode that Table 3 gives then; meetings are independent, and those of
// all classes are spread alike over the plan.
ModeNumbers ExpertFailures(const FmeaTables& tables, const ClassNumbers& occurrence,
                           const ClassNumbers& meetings);

}  // namespace floorproof

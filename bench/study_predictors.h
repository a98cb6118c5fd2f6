// SPDX-License-Identifier: Apache-2.0
// What predictors say of a plan before it is driven: a robot's measured rates, and those that know
// none.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "measure/expert_predictors.h"

namespace floorproof {

class ScenarioFile;

// Fitted to training data, the model apart.
struct FittedPredictors {
  double constant = 0;
  std::vector<double> of_crf, of_classes;  // rates
  ClassNumbers occurrence = {};
};

// "step over"; an exposure's type alone.
std::string KindOf(const Encounter& encounter);

// Adds to `plan`: crf, meetings (by class), complete, lower, upper, modes and kinds (by name, the
// probability that it ends a drive, as measured rates say), predicted (by predictor, the
// probability of failure). `fitted` none: of measured rates alone. Throws InputError where there is
// no plan.
void DescribePlan(const ScenarioFile& file, const std::map<std::string, HazardClass>& class_of_type,
                  const FittedPredictors* fitted, nlohmann::ordered_json& plan);

}  // namespace floorproof

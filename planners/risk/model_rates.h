// SPDX-License-Identifier: Apache-2.0
// The rates of all kinds of meeting of a risk model, made ready to be asked many times.
#pragma once

#include <deque>
#include <string_view>

#include "planners/risk/rate_evaluator.h"

namespace floorproof {

class ModelRates {
 public:
  explicit ModelRates(const RiskModel& model);  // outlives it
  const RiskModel& model() const { return model_; }

  // Of such a meeting; valid as long as this is. None: nothing was measured of it.
  const RateEvaluator* Find(std::string_view type, Passage passage, const Approach& at) const;

 private:
  const RiskModel& model_;
  std::deque<RateEvaluator> evaluators_;  // by kind of the model
};

}  // namespace floorproof

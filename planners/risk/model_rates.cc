// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/model_rates.h"

#include <algorithm>

namespace floorproof {

ModelRates::ModelRates(const RiskModel& model) : model_(model) {
  for (const KindRates& kind : model.kinds) evaluators_.emplace_back(kind);
}

const RateEvaluator* ModelRates::Find(std::string_view type, Passage passage,
                                      const Approach& at) const {
  const auto found = std::ranges::find_if(evaluators_, [&](const RateEvaluator& rates) {
    return IsAbout(rates.kind(), type, passage, at);
  });
  return found == evaluators_.end() ? nullptr : &*found;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// One eta of the rates of a kind of meeting, fitted: penalised maximum likelihood, how smooth
// chosen by the evidence of the data.
#pragma once

#include <string_view>
#include <vector>

#include "measure/rate_likelihood.h"
#include "planners/risk/rate_model.h"

namespace floorproof {

// Fewer events, or fewer rows without one, say too little for an eta that depends on anything.
inline constexpr int kLeastEvents = 5;

// From rows of which at least one has an event and one has none. Functions that it is made of may
// be added to the axes. `name` is of the random stream that the posterior's members are drawn from.
LinearPredictor FitPredictor(const std::vector<RateRow>& rows, bool per_metre,
                             std::string_view name, std::vector<RateAxis>& axes);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The rates of one kind of meeting, fitted: penalised maximum likelihood, how smooth chosen by the
// evidence of the data.
#pragma once

#include <string_view>
#include <vector>

#include "measure/rate_likelihood.h"
#include "planners/risk/rate_model.h"

namespace floorproof {

// Sets kind.modes from rows that are all of this kind; kind.axes and kind.per_metre are set. Modes
// that happened fewer than kLeastEvents times get one rate everywhere; of one that never did the
// coefficients are left empty (fit_rates.h says what becomes of it). `name` is of the random stream
// that the posterior's members are drawn from.
inline constexpr int kLeastEvents = 10;
void FitKindRates(const std::vector<RateRow>& rows, std::string_view name, KindRates& kind);

}  // namespace floorproof

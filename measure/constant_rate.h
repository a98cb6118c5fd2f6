// SPDX-License-Identifier: Apache-2.0
// One rate whatever a meeting is like: of a mode that hardly ever happened.
#pragma once

#include <string_view>

#include "planners/risk/rate_model.h"

namespace floorproof {

// Of a mode that happened `mode.events` times in so much exposure; `rate` is what is to be
// predicted, above 0. Members: quantiles of Gamma(events + 1, exposure), whose upper 95 % bound is
// 3 / exposure where nothing happened; `name` is of the stream that shuffles them.
void SetConstantRate(double exposure, double rate, std::string_view name, ModeRates& mode);

}  // namespace floorproof

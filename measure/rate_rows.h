// SPDX-License-Identifier: Apache-2.0
// Meetings as the fit of rates sees them: what their rates may depend on, a row of numbers each.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "env/core/encounter.h"
#include "measure/fit_rates.h"
#include "measure/rate_likelihood.h"

namespace floorproof {

using Meetings = std::vector<const Encounter*>;
using ByKind = std::map<std::pair<std::string, Passage>, Meetings>;  // by type of hazard

int FailuresOf(const Meetings& met);

// Of at least one meeting: the hazard's keys that all of them state.
std::vector<std::string> StatedByAll(const Meetings& met);
// Of meetings that are all exposures, or none of them, at least one: these sizes, and the columns
// of an approach that matter there.
std::vector<RateAxis> AxesOf(const Meetings& met, const std::vector<std::string>& sizes,
                             Manner manner, const RateFitOptions& options);
// In their order.
std::vector<RateRow> RowsOf(const Meetings& met, const std::vector<RateAxis>& axes, bool mirrored);

}  // namespace floorproof

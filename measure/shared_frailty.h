// SPDX-License-Identifier: Apache-2.0
// How alike several meetings with one hazard in one drive end, of one manner, beyond what
// covariates say of them.
#pragma once

#include <vector>

#include "env/core/encounter.h"
#include "planners/risk/rate_model.h"

namespace floorproof {

// The meetings with one hazard in one drive that are of one kind, in the order in which they came;
// exposures, and encounters of no drive (Encounter::drive), are by themselves. In the order in
// which they began.
std::vector<std::vector<const Encounter*>> MeetingsOfDrives(
    const std::vector<Encounter>& encounters);
// The first of each: who failed at a hazard does not meet it again, so later ones are of those who
// got over it.
std::vector<Encounter> FirstMeetings(const std::vector<Encounter>& encounters);

// Sets KindRates::theta, one number for all kinds of a manner, given the model's rates: the
// greatest likelihood / theta, as twice as large is half as likely beforehand. 1 where too few
// hazards were met again, or where 1 says it nearly as well (likelihood ratio, 95 %): many
// crossings would count as one otherwise, from next to no failures. A robot that failed at a hazard
// does not meet it again, so what counts is how often who got over it once gets over it again: of
// meetings 1 to k that were cleared the likelihood is exp(-(sum of Lambda^theta)^(1/theta)), of one
// that failed behind them what that falls by.
void SetSharedFrailty(const std::vector<Encounter>& encounters, RiskModel& model);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// An interval as it is told: rounded, it still holds all that it held.
#pragma once

#include "stats/interval.h"

namespace floorproof {

// To three digits, the lower end never upwards, the upper never downwards: a bound that is told too
// low would seem to pass a gate. (Within 1e-9 of the last digit an end counts as being there.)
Interval RoundedOutward(const Interval& exact);

}  // namespace floorproof

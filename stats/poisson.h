// SPDX-License-Identifier: Apache-2.0
// Exact bounds on a rate per kilometre or per hour.
#pragma once

#include "stats/interval.h"

namespace floorproof {

// Garwood's two-sided interval of the rate per unit of exposure, from k events in `exposure` (km,
// hours). k = 0 has the lower end 0; exposure 0 says nothing: [0, infinity).
// Throws InputError unless k >= 0, exposure is finite and >= 0, 0 < confidence < 1.
Interval GarwoodInterval(int k, double exposure, double confidence);

}  // namespace floorproof

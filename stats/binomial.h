// SPDX-License-Identifier: Apache-2.0
// Exact bounds on a probability from k events in n independent episodes.
#pragma once

#include "stats/interval.h"

namespace floorproof {

// One-sided Clopper-Pearson bounds: the probability is below (above) the bound with at least
// `confidence`, whatever it is. k = n has the upper bound 1, k = 0 the lower bound 0 (so has n =
// 0). Throws InputError unless 0 <= k <= n and 0 < confidence < 1.
double ClopperPearsonUpper(int k, int n, double confidence);
double ClopperPearsonLower(int k, int n, double confidence);

// Two-sided: each end is the one-sided bound at (1 + confidence) / 2. n = 0 gives [0, 1].
Interval ClopperPearson(int k, int n, double confidence);

}  // namespace floorproof

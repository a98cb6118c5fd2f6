// SPDX-License-Identifier: Apache-2.0
// Evidence on p < p0 or p > p0 that may be looked at after every episode.
#pragma once

#include "stats/interval.h"

namespace floorproof {

// Logarithms of the mixture e-values after k events in n episodes. Their running products over
// episodes depend on k and n alone. If p >= p0, E_pass ever reaches 1 / alpha with chance at most
// alpha, however often one looks (Ville's inequality); if p <= p0, so for E_fail. At most one of
// the two exceeds 1 at a time. Finite for every k <= n. Throws InputError unless 0 <= k <= n, 0 <
// p0 < 1.
double LogEPass(int k, int n, double p0);
double LogEFail(int k, int n, double p0);

enum class SequentialOutcome { kPass, kFail, kGoOn };

// Pass when E_pass >= 1 / (1 - confidence), fail when E_fail is. With confidence > 0 both cannot
// be.
SequentialOutcome JudgeSequentially(int k, int n, double p0, double confidence);

// Ends of the rates that the same tests, run at every p0, leave open: valid at any stopping time,
// the upper and the lower end each with `confidence`. The gate passes when upper <= p0, fails when
// lower >= p0. n = 0 gives [0, 1].
Interval AnytimeBounds(int k, int n, double confidence);

}  // namespace floorproof

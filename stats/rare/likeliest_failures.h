// SPDX-License-Identifier: Apache-2.0
// The likeliest failure of a region: the one of greatest density, which is the one nearest to the
// origin, found from the nearest that was met by a pattern search.
#pragma once

#include <vector>

#include "base/streams.h"
#include "stats/rare/rare_problem.h"

namespace floorproof {

// Trials that Likeliest makes at most, for each failure it begins from.
inline constexpr int kPolishRounds = 14, kPolishTrials = 14;

// Each failure moved nearer to the origin for as long as it fails, its noise as it was. All are
// searched at the same time, so that the trials of a round can run side by side.
std::vector<Trial> Likeliest(const RareProblem& problem, std::vector<Trial> failures,
                             Stream& stream);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A lower bound on the mean of numbers that are never negative, whatever their distribution.
#pragma once

#include <span>

namespace floorproof {

// Whoever bets on independent numbers x_i >= 0 of mean m by the factors 1 + c (x_i / m - 1), with c
// in [0, 1], expects to keep his stake at most: that he ever has 1 / (1 - confidence) times as much
// is as unlikely as 1 - confidence (Ville 1939). The bound is the least m that a mixture of such
// bettors does not refute (Waudby-Smith and Ramdas 2024). No upper bound on the numbers is needed,
// so importance weights may be used as they are. 0 where the numbers say nothing. Throws InputError
// unless all numbers are finite and >= 0 and 0 < confidence < 1.
double BettingLowerBound(std::span<const double> numbers, double confidence);

}  // namespace floorproof

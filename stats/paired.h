// SPDX-License-Identifier: Apache-2.0
// Two variants compared episode by episode: the same id has the same draws in both, so that what
// chance did to one it did to the other.
#pragma once

#include <span>

#include "stats/interval.h"

namespace floorproof {

// A table of pairs of yes or no: a's answer first.
struct PairedCounts {
  int both = 0, only_a = 0, only_b = 0, neither = 0;
  int n() const { return both + only_a + only_b + neither; }
};

// Exact two-sided McNemar p-value from the discordant counts: under equal rates each discordant
// pair falls to either side with chance 1/2. (12, 3) gives 0.035; no discordant pair gives 1.
double McNemarExact(int only_a, int only_b);

// Tango's score interval of rate(a) - rate(b). n = 0 gives [-1, 1].
Interval PairedRateDifference(const PairedCounts& counts, double confidence);

// Location of the differences a - b of a metric.
struct PairedDifference {
  int n = 0;
  double estimate = 0;  // NaN at n = 0
  Interval interval;    // infinite ends where n is too small to say
};

// Mean with Student's t-interval; needs n >= 2.
PairedDifference MeanDifference(std::span<const double> differences, double confidence);

// Median with the interval between two order statistics whose coverage is exactly computable
// whatever the distribution (sign test); at 95 % it needs n >= 6.
PairedDifference MedianDifference(std::span<const double> differences, double confidence);

}  // namespace floorproof

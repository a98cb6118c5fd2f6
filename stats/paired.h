// SPDX-License-Identifier: Apache-2.0
// Two variants compared episode by episode: the same id has the same draws in both, so that what
// chance did to one it did to the other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "stats/interval.h"

namespace floorproof {

// What one variant gave in one episode: a metric, or 1 for "failed" and 0 for "did not".
struct EpisodeValue {
  std::int64_t episode = 0;
  double value = 0;
};

// A table of pairs of yes or no: a's answer first.
struct PairedCounts {
  int both = 0, only_a = 0, only_b = 0, neither = 0;
  int n() const { return both + only_a + only_b + neither; }
};

// Joins by episode id; ids that only one side has are left out. Each side must be in ascending
// order of id, without repeats, its values finite. Throws InputError otherwise.
// Differences are a - b in order of id; a value other than 0 counts as yes.
std::vector<double> PairedDifferences(std::span<const EpisodeValue> a,
                                      std::span<const EpisodeValue> b);
PairedCounts CountPairs(std::span<const EpisodeValue> a, std::span<const EpisodeValue> b);

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

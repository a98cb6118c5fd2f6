// SPDX-License-Identifier: Apache-2.0
// How clean a region is, from the scores of samples in it: the space audit ("audit-sampling",
// section 3.1).
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace floorproof {

// Places that were chosen alike, as all near walls, or a few of the rest: how much of the region is
// like them, in any unit, and the scores of those that were sampled.
struct Stratum {
  double weight = 0;
  std::vector<double> scores;
};

struct SpaceScore {
  int samples = 0;
  double represented = 0;      // share of the region, by weight, whose strata have samples
  std::optional<double> mean;  // of that share; none: there is no such share
  // Of the mean; none: a stratum has one sample only.
  std::optional<double> standard_error;
  double degrees_of_freedom = 0;  // of the standard error: mean -+ t * standard_error
};

// The mean of the strata's means by their weights. The paper combines "the result of all the sample
// audits" and does not say how; the plain mean of samples that were chosen near walls would be the
// walls'. Cochran, "Sampling Techniques" (1977), equations (5.6) and (5.16), without a correction
// for the share of a stratum that was sampled: a tape is a thousandth of what it speaks for. One
// stratum gives Student's mean and interval. Both take the places of a stratum for drawn by chance
// from it: those of a lattice that all lie at one distance from a wall speak for that distance.
// Throws InputError on a weight that is negative or not finite.
SpaceScore ScoreOfSpace(std::span<const Stratum> strata);

}  // namespace floorproof

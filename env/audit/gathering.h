// SPDX-License-Identifier: Apache-2.0
// What many samples say together: of a choice of places, how well it finds dirt; of a region, how
// clean it is.
#pragma once

#include <optional>
#include <span>

namespace floorproof {

// A sample is dirty when its count is above this (audit paper, section 6.1).
inline constexpr int kDirtyAbove = 10;

// The audit paper, equation (4): the dirt gathering efficiency N_d / (N_d + N_c).
struct Gathering {
  int dirty = 0, clean = 0;                  // N_d, N_c
  std::optional<double> Efficiency() const;  // none: no sample was taken
};
Gathering Gather(std::span<const int> dirt_counts, int dirty_above = kDirtyAbove);

// The space audit (section 3.1): the samples' scores taken together. Their interval is the caller's
// to make: mean -+ t * standard_error, Student's t of samples - 1 degrees of freedom (stats has the
// distributions). That takes the samples for independent and spread over the whole region; those
// chosen near walls speak for the walls.
struct SpaceScore {
  int samples = 0;
  std::optional<double> mean;            // none: no sample
  std::optional<double> standard_error;  // of the mean; none: fewer than two samples
};
SpaceScore ScoreOfSpace(std::span<const double> sample_scores);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// How well a choice of places finds dirt.
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

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The tables of the hTetro FMEA paper (htetro-fmea-coverage): what may go wrong with a robot near a
// hazard, and how badly.
#pragma once

#include <array>

#include "env/core/event.h"
#include "env/core/hazard_map.h"

namespace floorproof {

inline constexpr std::size_t kNumHazardClasses = 4;  // C1 to C4
inline constexpr std::size_t kNumEffects = 5;        // E1 to E5

struct FmeaTables {
  // Table 1: how hard a class is to detect, 1 (any sensor sees it) to 4.
  std::array<double, kNumHazardClasses> detectability = {};
  // Table 3, upper half: P(C_i, F_j), of a failure mode by a class; each row sums to 1.
  std::array<std::array<double, kNumFailureModes>, kNumHazardClasses> mode_of_class = {};
  // Table 3, lower half: P(F_j, E_k), of an effect by a mode; each mode's sum to 1.
  std::array<std::array<double, kNumEffects>, kNumFailureModes> effect_of_mode = {};
  // Table 2: severities S_k.
  std::array<double, kNumEffects> severity = {};

  // What Eqs. 2 to 4 make of a hazard of this class, but for its distance, which is the rest of
  // Eq. 1: D_C * sum over k, j of S_k P(F_j, E_k) P(C, F_j).
  double Weight(HazardClass hazard_class) const;
};

}  // namespace floorproof

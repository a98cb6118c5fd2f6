// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/fmea_tables.h"

namespace floorproof {

double FmeaTables::Weight(HazardClass hazard_class) const {
  const auto c = static_cast<std::size_t>(hazard_class);
  const auto& modes = mode_of_class[c];
  double risk = 0;
  for (std::size_t k = 0; k < kNumEffects; ++k) {
    double effect = 0;  // Eq. 3, of Eq. 2's I_F = P(C, F)
    for (std::size_t j = 0; j < modes.size(); ++j) effect += effect_of_mode[j][k] * modes[j];
    risk += severity[k] * effect;  // Eq. 4
  }
  return detectability[c] * risk;
}

}  // namespace floorproof

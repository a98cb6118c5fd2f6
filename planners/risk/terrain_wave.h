// SPDX-License-Identifier: Apache-2.0
// The FMEA paper's wave front over a floor that terrain cuts apart.
#pragma once

#include "planners/risk/risk_map.h"
#include "planners/walk/wave_front.h"

namespace floorproof {

// Where the wave from `end` stops before it has reached every free cell, terrain lies across the
// floor. The paper opens the terrain cell of the least RF and begins anew. Literally that may be
// any terrain cell; meant is one where the terrain can be crossed ("will be allowed for crossover",
// Figure 3b). Opened here are the closed terrain cells of the least sum of RF that join what the
// wave has reached to what it has not. Across a strip one cell wide that is one cell.
//
// `open`: the free cells to be covered, and terrain opened before. Terrain that is opened is added.
// Returns the scores of WaveFront; what no terrain leads to stays out of reach.
Grid<double> WaveOverTerrain(const RiskMap& risk, Cell end, Grid<std::uint8_t>& open);

}  // namespace floorproof

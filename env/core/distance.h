// SPDX-License-Identifier: Apache-2.0
// Exact distance transforms of a grid of set cells.
#pragma once

#include <cstdint>

#include "env/core/grid.h"

namespace floorproof {

// Distance, in cells, from each cell's centre to the nearest set cell's centre (DistanceToSet in
// coverage.h measures to its area); infinite where nothing is set.
Grid<float> DistanceToCentres(const Grid<std::uint8_t>& set);

}  // namespace floorproof

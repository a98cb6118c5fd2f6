// SPDX-License-Identifier: Apache-2.0
// Cuts a floor into regions, each swept in one direction.
#pragma once

#include <optional>

#include "planners/lines/floor.h"

namespace floorproof {

struct Regions {
  Grid<std::int32_t> label;           // per cell of the floor; -1: no pose
  std::vector<double> direction_rad;  // per region, of its rows in the floor's frame, [0, pi)
};

// `link`: what a row costs beside its length, in cells: the step to the next one, and its turns.
// `fixed_rad`: one direction for the whole floor.
Regions FindRegions(const Floor& floor, double link, std::optional<double> fixed_rad);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A polygon with a sloping edge all round.
#pragma once

#include <string_view>
#include <vector>

#include "env/core/hazard_map.h"

namespace floorproof {

// The prisms of a slab of this height on the polygon (counter-clockwise), whose edge slopes in by
// `rim_m` at the top; 0: upright. Convex parts of the top, and a wedge for each edge, mitred at
// corners. Throws InputError (without mark) that names `key`, with `value`, where the slopes leave
// no top or cross each other.
std::vector<Solid> SlabWithRim(const Polygon& polygon, double height_m, double rim_m,
                               std::string_view key, double value);

}  // namespace floorproof

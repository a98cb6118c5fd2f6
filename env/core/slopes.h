// SPDX-License-Identifier: Apache-2.0
// The slanted floors of a hazard.
#pragma once

#include <vector>

#include "env/core/hazard_map.h"

namespace floorproof {

// Whether it has any.
bool IsRamp(const Hazard& hazard);
// The one at this place; nullptr: none.
const Solid* SlopeAt(const Hazard& hazard, const Vec2& p_W);
// Whether a corner of one leads onto a floor of this height: it lies no more than step_m higher or
// lower, within 2 cm of the floor's ground plan (nullptr: the floor is everywhere).
bool LeadsOnto(const Hazard& ramp, double height_m, const std::vector<Polygon>* floor,
               double step_m);

}  // namespace floorproof

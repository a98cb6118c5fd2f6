// SPDX-License-Identifier: Apache-2.0
// Which of a site's hazards holds where they overlap.
#pragma once

#include <string>
#include <vector>

#include "env/core/hazard_map.h"

namespace floorproof {

// A hazard that would have to bend over a higher edge than it does.
struct UnbentHazard {
  std::string id;
  double edge_m = 0;  // between the highest and the lowest floor beneath it
};

// Sorts hazards that shape the floor (C3, C4) and may overlap: first floors (steps, ramps), then
// covers of floors (carpets, thresholds, lifts), then terrain (cable covers, grooves, rough
// ground), each in the order in which they are written; all others keep their places. Where floors
// overlap, the later one wins, exactly: a level change or a groove cuts the solids of earlier ones
// back to the parts beside it. Hazards of the upper two layers are lifted or lowered with the floor
// beneath, each part on its own floor where they cross edges, and `warnings` names these; a groove
// is cut into the floor that it is in. Terrain bridges a groove before it. A floor is where it is
// built: the bases of its solids, which on a drawing are smaller than its cells. Terrain on terrain
// stays: the higher is felt. Pieces narrower than 0.1 mm are left out: they would be no solid;
// along curves of many corners a cut may be off by half of that. A hazard on a ramp is built level,
// from the floor below the ramp; `warnings` names it. Footprints stay whole, so that a map without
// its unknown hazards does not show where they lie. The solids must be as their types make them:
// those that taper with a corner of `top` for each of `base`.
// Returns the hazards that cannot be laid, since they do not bend so far (Hazard::bend_m). Throws
// InputError, without a file, if so much of them overlaps that the cuts would take too long.
std::vector<UnbentHazard> LayFloors(std::vector<Hazard>& hazards,
                                    std::vector<std::string>& warnings);

}  // namespace floorproof

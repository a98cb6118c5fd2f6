// SPDX-License-Identifier: Apache-2.0
// Where and when a state of the physics stopped being one.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

namespace floorproof {

// Whether MuJoCo warned of what no later state can be believed after: a coordinate, speed or
// acceleration that is not finite or beyond 1e10 (mjMAXVAL), a singular inertia, contacts that do
// not fit.
bool HasDiverged(const mjData* data);

// "body 'arm' (joint 'elbow') at 1.234 s": by the index that MuJoCo gave with the warning, and the
// physics' own clock. Without a warning: the body `base`.
std::string DescribeDivergence(const mjModel* model, const mjData* data, int base);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Whether physics can be computed with the numbers of a compiled model.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

namespace floorproof {

// Throws InputError naming file, line, element and attribute of a number that is not finite, or
// outside the range that MuJoCo documents (XML reference; solver parameters): masses, sizes,
// stiffnesses, damping and friction of at least 0, solref of one sign, solimp in [0, 1] with a
// power of at least 1, and nothing beyond 1e10 (mjMAXVAL), where MuJoCo gives a state up. `spec`:
// what `model` was compiled from.
void RefuseWrongNumbers(const mjModel* model, mjSpec* spec, const std::string& file);

}  // namespace floorproof

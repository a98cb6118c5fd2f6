// SPDX-License-Identifier: Apache-2.0
// Where a body's axes point in the world, as the engine holds it.
#pragma once

#include <mujoco/mujoco.h>

#include "env/geometry/geometry.h"

namespace floorproof {

using Rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

// R_WK of that body K; a view into `data`, not a copy.
inline Rotation RotationOf(const mjData* data, int body) { return Rotation(data->xmat + 9 * body); }

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What a robot that cannot turn on the spot has left undone of its path.
#pragma once

#include "env/geometry/geometry.h"

namespace floorproof {

// Dwells and the path's end that it passed beside: it came no nearer, and could not without a loop.
struct MissedStops {
  int count = 0;
  bool end = false;             // the last of them is the path's end
  Vec2 first_W = Vec2::Zero();  // where there is one
};

}  // namespace floorproof

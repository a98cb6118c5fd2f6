// SPDX-License-Identifier: Apache-2.0
// Where an episode was when its time ran out.
#pragma once

#include <string>

#include "env/geometry/geometry.h"

namespace floorproof {

// Where a robot was when its time ran out. That is an outcome and no failure: nothing says that the
// robot would not have got there.
struct Timeout {
  double t_s = 0;
  Pose2 X_WB;
  std::string hazard;  // what held it or was near it, as Event::hazard
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// How far along its path a robot is.
#pragma once

#include <cstddef>

#include "env/core/path.h"

namespace floorproof {

// The way gone along the path that is followed, m: the place on the tracked segment that is nearest
// to the robot, as metres along the path, less the distance to it. So it grows where the robot gets
// on, or comes back to its path, and falls where it goes back or aside. It is a place, not a way
// driven: swaying adds nothing to it. A path that replaces another (after a reaction, after help)
// is counted from what was reached on the one before.
class PlanProgress {
 public:
  // `paths`: how many paths there have been; another number says that `path` is a new one.
  // `segment`: the one that is tracked. Returns meters().
  double Update(const Path& path, int paths, std::size_t segment, const Vec2& p_W);

  double meters() const { return progress_m_; }

 private:
  double progress_m_ = 0;
  double before_m_ = 0;  // what paths before this one, and its beginning, account for
  double start_m_ = 0;   // way along the path to its waypoint segment_
  std::size_t segment_ = 0;
  int paths_ = 0;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "run/episode/plan_progress.h"

#include <algorithm>

namespace floorproof {

double PlanProgress::Update(const Path& path, int paths, std::size_t segment, const Vec2& p_W) {
  const bool anew = paths != paths_;
  segment = path.size() < 2 ? 0 : std::min(segment, path.size() - 2);
  if (anew || segment < segment_) segment_ = 0, start_m_ = 0;
  for (; segment_ < segment; ++segment_)
    start_m_ += (path[segment_ + 1].p_W - path[segment_].p_W).norm();

  const Vec2 &from = path[segment].p_W, &to = path[std::min(segment + 1, path.size() - 1)].p_W;
  const double fraction = NearestFraction(from, to, p_W);
  const Vec2 nearest = from + fraction * (to - from);
  const double here_m = start_m_ + fraction * (to - from).norm() - (nearest - p_W).norm();
  if (anew) before_m_ = progress_m_ - here_m;
  paths_ = paths;
  return progress_m_ = before_m_ + here_m;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "run/episode/go_to_navigator.h"

#include <algorithm>

namespace floorproof {

double GoToDuration(const Path& places, const RobotSpec& robot) {
  constexpr double kStop_s = 3;  // of each way and turn, to gather speed and to lose it
  const double turn_s = kPi / robot.max_yaw_rate_radps + kStop_s;
  double duration_s = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double speed_mps = places[i].speed_mps > 0 ? places[i].speed_mps : robot.cruise_mps;
    duration_s +=
        (places[i].p_W - places[i - 1].p_W).norm() / std::min(speed_mps, robot.max_speed_mps) +
        kStop_s + 2 * turn_s;
  }
  return duration_s + turn_s;
}

GoToNavigator::GoToNavigator(const PlanResult& plan)
    : plan_(plan), path_{plan.path.front(), plan.path.back()} {}

PathChange GoToNavigator::Update(const NavigatorInput& input) {
  const bool anew = input.line != nullptr && input.line->number != line_;
  if (!anew && !input.recovered) return PathChange::kNone;
  if (anew) {
    line_ = input.line->number;
    path_[1].p_W = input.line->to_W;
    path_[1].speed_mps = input.line->speed_mps.value_or(0);
  }
  path_[0].p_W = input.estimate.X_WB.p();
  return PathChange::kAnew;
}

}  // namespace floorproof

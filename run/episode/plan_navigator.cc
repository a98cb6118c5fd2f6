// SPDX-License-Identifier: Apache-2.0
#include "run/episode/plan_navigator.h"

#include <utility>

#include "planners/lines/rejoin.h"
#include "planners/lines/turned_plan.h"

namespace floorproof {
namespace {

// Nearer to a wall of the map, what was seen is that wall, drawn where the robot thought it was.
constexpr double kSeenAway_m = 0.12;

}  // namespace

PlanNavigator::PlanNavigator(const PlanResult& plan, const HazardMap& known, const RobotSpec& robot,
                             const RecoveryParams* recovery)
    : plan_(plan),
      known_(known),
      robot_(robot),
      around_(recovery != nullptr && recovery->then == "replan"),
      path_(plan.path) {}

// Where it went is not asked again: the rest of the path, joined from where the robot thinks it is.
PathChange PlanNavigator::Update(const NavigatorInput& input) {
  if (!input.recovered || input.known == nullptr) return PathChange::kNone;
  const HazardMap known = WithSeen(known_, *input.known, robot_.step_m, kSeenAway_m);
  path_ = Rejoin({known, input.known->marks, robot_, plan_.clear, path_, input.segment,
                  input.estimate.X_WB, around_});
  if (robot_.turn_radius_m > 0) {
    const HazardMap marked = WithMarks(known, input.known->marks);
    Path turned = FitTurns(path_, marked, robot_, plan_.clear, input.estimate.X_WB);
    if (!turned.empty() && turned.back().p_W == path_.back().p_W) path_ = std::move(turned);
  }
  return PathChange::kAnew;
}

void PlanNavigator::GoOnFrom(std::size_t waypoint) {
  path_.erase(path_.begin(), path_.begin() + static_cast<std::ptrdiff_t>(waypoint));
}

}  // namespace floorproof

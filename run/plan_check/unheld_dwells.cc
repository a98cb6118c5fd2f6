// SPDX-License-Identifier: Apache-2.0
#include "run/plan_check/unheld_dwells.h"

#include <algorithm>
#include <cmath>

#include "env/core/standing.h"
#include "run/scenario/floors.h"
#include "run/scenario/world.h"

namespace floorproof {

std::optional<UnheldDwell> FindUnheldDwell(const World& world, const PlanResult& plan) {
  constexpr double kGravity_mps2 = 9.81, kLevel_rad = 0.005;
  const RobotSpec& robot = world.robot.spec;
  const bool dwells = std::ranges::any_of(plan.path, [](const auto& w) { return w.dwell_s > 0; });
  if (!dwells || robot.standstill == Standstill::kBrake) return std::nullopt;
  double holds_n = 0;
  if (robot.standstill == Standstill::kHold)
    for (const WheelSpec& wheel : robot.wheels) holds_n += wheel.max_torque_nm / wheel.radius_m;
  const HazardMap floor = TrueFloor(world);
  std::optional<UnheldDwell> steepest;
  for (const Waypoint& w : plan.path) {
    if (!(w.dwell_s > 0)) continue;
    const double slope_rad = std::atan(GroundAt(floor, w.p_W).gradient.norm());
    const double pulls_n = robot.mass_kg * kGravity_mps2 * std::sin(slope_rad);
    if (slope_rad > kLevel_rad && pulls_n > holds_n &&
        (!steepest || slope_rad > steepest->slope_rad))
      steepest = UnheldDwell{w.p_W, slope_rad, holds_n, pulls_n};
  }
  return steepest;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "tests/real_robots/measured_figures.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "validate/ladder.h"
#include "validate/limit_search.h"
#include "validate/rig.h"

namespace floorproof {
namespace {

// Millimetres to a tenth for small wheels, to one for large ones; degrees to a half.
Rungs RungsOf(const LadderHazard& hazard, double radius_m) {
  if (hazard.unit == "deg") return {.per_unit = 2, .first = 6, .spacing = 6, .last = 120};
  const int per_unit = radius_m < 0.1 ? 10 : 2;
  const double unit_m = 1e-3 / per_unit;
  const int spacing = std::max(1, static_cast<int>(std::lround(radius_m / 25 / unit_m)));
  constexpr double kThreshold_m = 0.1;  // the hazard's own bound
  const double most_m =
      hazard.name == "threshold" ? std::min(kThreshold_m, 2 * radius_m) : 2 * radius_m;
  return {.per_unit = per_unit,
          .first = spacing,
          .spacing = spacing,
          .last = static_cast<int>(most_m / unit_m)};
}

}  // namespace

FoundLimit LimitOf(const std::filesystem::path& mjcf, std::string_view name,
                   const Approach& approach) {
  const LadderHazard& hazard = FindLadderHazard(name);
  const RobotModel robot = ReadRobot(mjcf);
  LadderCell cell;
  cell.hazard = hazard.name;
  cell.speed_mps = approach.speed_mps;
  cell.friction = approach.friction;
  cell.oblique_deg = approach.oblique_deg;
  std::string held_by;
  const auto limit =
      FindLimit(RungsOf(hazard, robot.spec.wheels.front().radius_m), [&](double size) {
        const CrossingPlan plan = PlanOf(cell, robot.spec, size);
        const CrossingResult result = Cross(robot, hazard.make(size, plan.travel_rad), plan);
        if (!result.crossed) held_by = result.held_by;
        return result.crossed;
      });
  if (!limit) throw InternalError("interrupted");
  return {limit->size, limit->above_all, held_by};
}

double DrivingPower(const std::filesystem::path& mjcf, const BodyTwist& twist) {
  Rig rig(mjcf.string());
  rig.Run(twist, 3);
  double sum_w = 0;
  int n = 0;
  for (const double end_s = rig.truth().t_s + 2; rig.truth().t_s < end_s; ++n) {
    rig.Step();
    sum_w += rig.truth().power_w;
  }
  return sum_w / n;
}

}  // namespace floorproof

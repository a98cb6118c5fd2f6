// SPDX-License-Identifier: Apache-2.0
#include "env/failures/footing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "env/core/standing.h"

namespace floorproof {

WheelCentres::WheelCentres(const RobotSpec& robot, const Sample& sample)
    : swung_(sample.hinges.n > 0) {
  if (!swung_) return;
  start_ = MoveBlocks(robot.blocks, robot.hinges, StartState(robot));
  now_ = MoveBlocks(robot.blocks, robot.hinges, sample.hinges);
}

Vec3 WheelCentres::Of(const WheelSpec& wheel) const {
  if (!swung_) return wheel.p_BW;
  const auto block = static_cast<std::size_t>(wheel.block);
  const Vec2 p_K = start_.block[block].X_BK.Inverse() * Vec2(wheel.p_BW.head<2>());
  const Vec2 p_B = now_.block[block].X_BK * p_K;
  return {p_B.x(), p_B.y(), wheel.p_BW.z()};
}

double FloorUnder(const HazardMap& map, const RobotSpec& robot, const Sample& sample) {
  if (robot.wheels.empty()) return LevelAt(map, sample.X_WB().p());
  double floor_m = -std::numeric_limits<double>::infinity();
  const WheelCentres centres(robot, sample);
  for (const WheelSpec& wheel : robot.wheels) {
    const Vec2 p_B = centres.Of(wheel).head<2>();
    floor_m = std::max(floor_m, LevelAt(map, sample.X_WB() * p_B));
  }
  return floor_m;
}

bool IsGap(const Hazard& hazard, double floor_m) {
  if (hazard.hazard_class != HazardClass::kLevelChange) return hazard.height_m < 0;
  const double own_m = std::min(hazard.height_m, floor_m) - kSameLevel_m;
  return hazard.height_m < floor_m - kSameLevel_m ||
         std::ranges::any_of(hazard.solids, [&](const Solid& solid) {
           return solid.kind == Solid::Kind::kCut && solid.z_low_m < own_m;  // a lift's gap
         });
}

bool IsFloor(const Hazard& hazard, double floor_m) {
  return hazard.hazard_class == HazardClass::kLevelChange &&
         std::abs(hazard.height_m - floor_m) <= kSameLevel_m;
}

}  // namespace floorproof

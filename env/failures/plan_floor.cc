// SPDX-License-Identifier: Apache-2.0
#include "env/failures/plan_floor.h"

#include <cmath>
#include <limits>

#include "env/core/slopes.h"
#include "env/failures/footing.h"

namespace floorproof {

bool PlanFloor::Level::IsRamp() const {
  return hazard != nullptr && hazard->hazard_class != HazardClass::kLevelChange;
}

bool PlanFloor::Level::Holds(const Vec2& p_W) const {
  return hazard == nullptr || std::ranges::any_of(hazard->footprint, [&](const Polygon& part) {
           return Contains(part, p_W);
         });
}

double PlanFloor::Level::HeightAt(const Vec2& p_W) const {
  if (!IsRamp()) return height_m;
  const Solid* slope = SlopeAt(*hazard, p_W);
  return slope != nullptr ? TopAt(*slope, p_W) : 0;
}

PlanFloor::PlanFloor(const HazardMap& map, const RobotSpec& robot)
    : map_(&map), robot_(&robot), levels_{Level{}} {
  for (const Hazard& hazard : map.hazards)
    if (hazard.hazard_class == HazardClass::kLevelChange || floorproof::IsRamp(hazard))
      levels_.push_back({&hazard, hazard.height_m});
}

void PlanFloor::SetDown(const Sample& sample) {
  set_down_ = true;
  start_m_ = FloorUnder(*map_, *robot_, sample);
  for (Level& level : levels_) level.driven = IsDriven(level);
  ForEachFoot(sample, [&](const Vec2& p_W) {
    std::ranges::find_if(levels_.rbegin(), levels_.rend(), [&](const Level& level) {
      return level.Holds(p_W);
    })->driven = true;
  });
  highest_m_ = start_m_;
  for (const Level& level : levels_)
    if (level.driven) highest_m_ = std::max(highest_m_, level.height_m);
}

bool PlanFloor::IsDriven(const Level& level) const {
  if (level.hazard != nullptr && !level.hazard->known) return false;
  return level.IsRamp() || std::abs(level.height_m - start_m_) <= robot_->step_m ||
         std::ranges::any_of(levels_, [&](const Level& ramp) {
           return ramp.IsRamp() && ramp.hazard->known &&
                  LeadsOnto(*ramp.hazard, level.height_m,
                            level.hazard != nullptr ? &level.hazard->footprint : nullptr,
                            robot_->step_m);
         });
}

double PlanFloor::At(const Vec2& p_W) const {
  double floor_m = start_m_;
  for (const Level& level : levels_)  // later ones win
    if (level.driven && level.Holds(p_W)) floor_m = level.HeightAt(p_W);
  return floor_m;
}

// The robot's centre, and those of its wheels.
template <class Look>
void PlanFloor::ForEachFoot(const Sample& sample, const Look& look) const {
  look(sample.X_WB().p());
  const WheelCentres centres(*robot_, sample);
  for (const WheelSpec& wheel : robot_->wheels)
    look(Vec2(sample.X_WB() * Vec2(centres.Of(wheel).head<2>())));
}

double PlanFloor::Under(const Sample& sample) const {
  double lowest_m = std::numeric_limits<double>::infinity();
  ForEachFoot(sample, [&](const Vec2& p_W) { lowest_m = std::min(lowest_m, At(p_W)); });
  return lowest_m;
}

bool PlanFloor::IsBase(const Vec2& p_W) const {
  return std::ranges::none_of(
      levels_, [&](const Level& level) { return level.hazard != nullptr && level.Holds(p_W); });
}

}  // namespace floorproof

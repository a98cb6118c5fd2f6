// SPDX-License-Identifier: Apache-2.0
#include "env/core/measured_limits.h"

#include <algorithm>

#include "env/core/hazard_map.h"
#include "env/core/robot_spec.h"

namespace floorproof {
namespace {

constexpr double kSame = 1 + 1e-6;  // more than what rounding does to a size

// What only has a friction is as large as what it takes of 1.
std::vector<std::vector<HazardSize>> SizesOf(const Hazard& hazard) {
  const bool is_patch =
      !hazard.solids.empty() && std::ranges::all_of(hazard.solids, [](const Solid& solid) {
        return solid.kind == Solid::Kind::kSurface;
      });
  if (!is_patch || !hazard.material.friction) return hazard.sizes;
  return {{{"wet", std::max(0.0, 1 - *hazard.material.friction)}}};
}

}  // namespace

void DropLimits(MeasuredLimits& measured, std::string_view why) {
  measured.limits.clear();
  if (!measured.by.empty() && measured.why_unused.empty()) measured.why_unused = why;
}

std::optional<double> LimitOn(const MeasuredLimits& measured, std::string_view kind,
                              double friction) {
  const auto limit = std::ranges::find(measured.limits, kind, &MeasuredLimit::kind);
  if (limit == measured.limits.end()) return std::nullopt;
  const auto& at = measured.frictions;
  const auto last = static_cast<std::ptrdiff_t>(at.size()) - 1;
  // The first that is no lower, and the one below it, unless it is the same.
  const auto above = std::ranges::lower_bound(at, friction / kSame) - at.begin();
  const bool same = above <= last && at[static_cast<std::size_t>(above)] <= friction * kSame;
  const auto most = [&](std::ptrdiff_t i) {
    return limit->most[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last))];
  };
  return same ? most(above) : std::min(most(above - 1), most(above));
}

std::optional<bool> Crosses(const MeasuredLimits& measured, const Hazard& hazard,
                            double floor_friction) {
  std::optional<bool> crosses;
  for (const std::vector<HazardSize>& all : SizesOf(hazard)) {
    bool known = true, within = true;
    for (const HazardSize& size : all) {
      const bool is_patch = size.kind == "wet";
      const double friction =
          is_patch ? floor_friction
                   : std::min(floor_friction, hazard.material.friction.value_or(floor_friction));
      const auto limit = LimitOn(measured, size.kind, friction);
      known = known && limit;
      within = within && limit && size.size <= *limit * kSame;
    }
    if (known) crosses = crosses.value_or(false) || within;
  }
  return crosses;
}

double TrustedStep(const RobotSpec& robot, double floor_friction) {
  const auto up = LimitOn(robot.measured, "step", floor_friction);
  const auto down = LimitOn(robot.measured, "drop", floor_friction);
  if (!up && !down) return robot.step_m;
  return std::min(up.value_or(*(up ? up : down)), down.value_or(*(down ? down : up)));
}

HazardMap JudgedFor(HazardMap map, const RobotSpec& robot) {
  if (robot.measured.limits.empty()) return map;
  for (Hazard& hazard : map.hazards)
    if (hazard.hazard_class == HazardClass::kLevelChange ||
        hazard.hazard_class == HazardClass::kTerrain)
      hazard.crossable = Crosses(robot.measured, hazard, map.floor_friction);
  return map;
}

}  // namespace floorproof

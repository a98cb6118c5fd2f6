// SPDX-License-Identifier: Apache-2.0
#include "run/episode/make_navigator.h"

#include "controllers/follower_params.h"
#include "planners/lines/held_yaw.h"
#include "run/episode/go_to_navigator.h"
#include "run/episode/make_plan.h"
#include "run/episode/online_navigator.h"
#include "run/episode/plan_navigator.h"
#include "run/scenario/scenario_spec.h"
#include "run/scenario/world.h"

namespace floorproof {
namespace {

// Kept beyond the clear shape, for the tracker's error.
constexpr double kMargin_m = 0.015;

// As wide, seen from the robot's centre, as the shape is where it is widest.
Extent Around(const Shape2& shape) {
  if (shape.kind == Shape2::Kind::kCircle) return {Vec2::Constant(shape.radius_m), true};
  Extent extent{Vec2::Zero(), false};
  for (const Vec2& corner : shape.footprint_B)
    extent.half_m = extent.half_m.cwiseMax(corner.cwiseAbs());
  return extent;
}

}  // namespace

std::unique_ptr<Navigator> MakeNavigator(const ScenarioSpec& spec, const World& world,
                                         OnlinePlanner* online, const PlanResult& plan,
                                         const HazardMap& known) {
  const RobotSpec& robot = world.robot.spec;
  if (LeadsItself(spec)) return std::make_unique<GoToNavigator>(plan);
  if (online == nullptr)
    return std::make_unique<PlanNavigator>(plan, known, robot,
                                           spec.recovery ? &*spec.recovery : nullptr);
  const HeldShapes held = HoldYaw(known, world.start, robot.clear, robot.tool);
  const Extent body = Around(held.clear);
  return std::make_unique<OnlineNavigator>(
      *online,
      OnlineNavigator::Robot{body, body.Wider(kMargin_m), Around(held.tool), robot.tool_width_m,
                             kPlannedShare * robot.max_accel_mps2, held.yaw_rad},
      world.start.p(), PlanSeed(spec));
}

}  // namespace floorproof

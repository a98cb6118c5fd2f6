// SPDX-License-Identifier: Apache-2.0
#include "run/plan_check/plan_budget.h"

#include <algorithm>

#include "controllers/tracker.h"
#include "env/core/driven_floor.h"
#include "env/scene/driving_power.h"
#include "run/scenario/floors.h"
#include "run/scenario/scenario.h"

namespace floorproof {

PlanBudget EstimateBudget(const Scenario& s, const PlanResult& plan) {
  const HazardMap known = KnownFloor(s.world);
  const ClearanceField clearance =
      ClearanceOnTheWay(known, LevelChangesOnTheWay(known, plan.path), s.world.robot.spec.step_m);
  const auto tracker = MakePlugin(Trackers(), s.spec.tracker, "controller");
  tracker->Start(plan.path, s.world.robot.spec, &clearance);
  PlanBudget out;
  out.time_s = tracker->Duration();
  double dwell_s = 0;
  for (const Waypoint& w : plan.path) dwell_s += w.dwell_s;
  const double moving_s = std::max(0.0, out.time_s - dwell_s);

  const SpecPtr spec(mj_copySpec(s.world.robot.mjcf.get()));
  const ModelPtr model(mj_compile(spec.get(), s.world.robot.assets.get()));
  if (!model)
    throw InputError({s.spec.robot_file.string(), 0}, "", mjs_getError(spec.get()),
                     "does not compile");
  const double motors_w = moving_s > 0 ? SteadyMotorsPower(model.get(), s.world.robot.spec,
                                                           Length(plan.path) / moving_s)
                                       : 0;
  const double hotel_w = s.world.robot.spec.hotel_load_w;
  out.energy_j = hotel_w * out.time_s + motors_w * moving_s;
  if (!s.world.robot.spec.battery.capacity_wh || !s.world.robot.spec.battery.voltage_v) return out;
  // Drawn from the cells, which heat as well.
  const double volt = *s.world.robot.spec.battery.voltage_v;
  const auto cells_j = [&](double load_w, double time_s) {
    return volt * Feed(volt, s.world.robot.spec.battery.resistance_ohm, load_w).current_a * time_s;
  };
  out.battery_share = (cells_j(hotel_w, dwell_s) + cells_j(hotel_w + motors_w, moving_s)) /
                      (*s.world.robot.spec.battery.capacity_wh * 3600);
  return out;
}

}  // namespace floorproof

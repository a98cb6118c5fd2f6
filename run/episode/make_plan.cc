// SPDX-License-Identifier: Apache-2.0
#include "run/episode/make_plan.h"

#include "planners/lines/turned_plan.h"
#include "run/episode/episode_stream.h"
#include "run/scenario/floors.h"

namespace floorproof {

std::uint64_t PlanSeed(const Scenario& s) { return EpisodeStream(s, "plan").Next(); }

PlanResult MakePlan(const Scenario& s) {
  const RobotSpec& robot = s.robot.spec;
  const HazardMap known = KnownFloor(s);
  auto risk = std::make_shared<const RiskMap>(ComputeRisk(known, robot, s.fmea, s.risk));
  PlanResult plan;
  if (s.planner) {
    const PlanRequest request{known, robot, s.start, s.goal, PlanSeed(s), risk.get(), s.places};
    plan = s.planner->Plan(request);
    FitTurns(request, plan);
  } else if (s.online) {
    plan.status = PlanStatus::kOnline;
    plan.message = s.planner_name + " plans while it drives, as the floor becomes known";
    plan.clear = robot.clear;
    plan.tool = robot.tool;
    plan.tool_width_m = robot.tool_width_m;
  } else {
    plan.path = s.user_plan;
    // A user's plan need not begin where the robot stands: it drives there first, and is judged on
    // the way as on any other.
    if ((plan.path.front().p_W - s.start.p()).norm() > 1e-6) {
      Waypoint start;
      start.p_W = s.start.p();
      plan.path.insert(plan.path.begin(), start);
    }
    plan.status = PlanStatus::kSuccess;
    plan.clear = robot.clear;
    plan.tool = robot.tool;
    plan.tool_width_m = robot.tool_width_m;
  }
  plan.risk = std::move(risk);
  return plan;
}

}  // namespace floorproof

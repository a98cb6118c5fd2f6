// SPDX-License-Identifier: Apache-2.0
#include "run/episode/make_plan.h"

#include <fmt/format.h>

#include <utility>

#include "base/quantity.h"
#include "env/core/coverage.h"
#include "planners/lines/turned_plan.h"
#include "run/episode/ask_program.h"
#include "run/episode/episode_stream.h"
#include "run/episode/plain_draws.h"
#include "run/scenario/floors.h"
#include "run/scenario/scenario.h"

namespace floorproof {

std::uint64_t PlanSeed(const ScenarioSpec& spec) { return EpisodeStream(spec, "plan").Next(); }

namespace {

PlanResult NotOurs(const Scenario& s, const PlanRequest& request) {
  PlanResult plan;
  Path path = s.spec.user_plan;
  if (const PlanCommand* program = ProgramToAsk(s.spec)) {
    ProgramAnswer answer = AskProgram(s, *program, request);
    path = std::move(answer.path);
    plan.message = std::move(answer.failure);
  }
  if (path.empty()) return plan;
  plan.lead_in_m = (path.front().p_W - s.world.start.p()).norm();
  plan.path = FromStart(std::move(path), s.world.start.p());
  plan.status = PlanStatus::kSuccess;
  return plan;
}

// If the robot's clear circle does not fit at the start, the plan is made from the first place
// straight ahead where it does.
PlanResult Planned(const Planner& planner, const PlanRequest& request) {
  PlanResult plan = planner.Plan(request);
  if (plan.status != PlanStatus::kStartBlocked) {
    FitTurns(request, plan);
    return plan;
  }
  const FloorRoom room(request.map, request.robot.step_m);
  const auto place_W = room.WidePlaceAhead(request.robot, plan.clear, request.start);
  if (!place_W || *place_W == request.start.p()) return plan;
  PlanRequest ahead = request;
  ahead.start.x_m = place_W->x(), ahead.start.y_m = place_W->y();
  plan = planner.Plan(ahead);
  FitTurns(ahead, plan);
  if (plan.status != PlanStatus::kSuccess) return plan;
  Waypoint start;
  start.p_W = request.start.p();
  plan.path.insert(plan.path.begin(), start);
  constexpr double kOff_m = 0.001;  // a first leg that goes straight on is one with this one
  if (plan.path.size() > 2 &&
      DistanceToSegment(plan.path[0].p_W, plan.path[2].p_W, plan.path[1].p_W) < kOff_m)
    plan.path.erase(plan.path.begin() + 1);
  plan.message = fmt::format(
      "the start is too narrow to turn there: the plan first leads {} straight ahead{}",
      LengthText((*place_W - start.p_W).norm()), plan.message.empty() ? "" : "; " + plan.message);
  return plan;
}

}  // namespace

PlanResult MakePlan(const Scenario& s) {
  const RobotSpec& robot = s.world.robot.spec;
  const HazardMap known = KnownFloor(s.world);
  auto risk = std::make_shared<const RiskMap>(ComputeRisk(known, robot, s.spec.fmea, s.spec.risk));
  const std::vector<DriveConditions> conditions =
      s.spec.promises.needs_model ? ConditionsOf(s) : std::vector<DriveConditions>();
  const PlanRequest request{
      known,      robot,         s.world.start,           s.world.goal, PlanSeed(s.spec),
      risk.get(), s.spec.places, s.spec.risk_model.get(), conditions};
  PlanResult plan;
  if (s.spec.plan_by == PlanBy::kPlanner) {
    plan = Planned(*MakePlugin(Planners(), PlannerOf(s.spec), "plan.planner"), request);
  } else {
    if (s.spec.plan_by == PlanBy::kOnline) {
      plan.status = PlanStatus::kOnline;
      plan.message = s.spec.planner_name + " plans while it drives, as the floor becomes known";
    } else {
      plan = NotOurs(s, request);
    }
    plan.clear = robot.clear;
    plan.tool = robot.tool;
    plan.tool_width_m = robot.tool_width_m;
  }
  plan.risk = std::move(risk);
  return plan;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "run/episode/make_plan.h"

#include <utility>

#include "planners/lines/turned_plan.h"
#include "run/episode/ask_program.h"
#include "run/episode/episode_stream.h"
#include "run/episode/plain_draws.h"
#include "run/scenario/floors.h"

namespace floorproof {

std::uint64_t PlanSeed(const Scenario& s) { return EpisodeStream(s, "plan").Next(); }

namespace {

PlanResult NotOurs(const Scenario& s, const PlanRequest& request) {
  PlanResult plan;
  Path path = s.user_plan;
  if (const PlanCommand* program = ProgramToAsk(s)) {
    ProgramAnswer answer = AskProgram(s, *program, request);
    path = std::move(answer.path);
    plan.message = std::move(answer.failure);
  }
  if (path.empty()) return plan;
  plan.lead_in_m = (path.front().p_W - s.start.p()).norm();
  plan.path = FromStart(std::move(path), s.start.p());
  plan.status = PlanStatus::kSuccess;
  return plan;
}

}  // namespace

PlanResult MakePlan(const Scenario& s) {
  const RobotSpec& robot = s.robot.spec;
  const HazardMap known = KnownFloor(s);
  auto risk = std::make_shared<const RiskMap>(ComputeRisk(known, robot, s.fmea, s.risk));
  const std::vector<DriveConditions> conditions = s.planner && s.planner->promises().needs_model
                                                      ? ConditionsOf(s)
                                                      : std::vector<DriveConditions>();
  const PlanRequest request{known,       robot,      s.start,  s.goal,
                            PlanSeed(s), risk.get(), s.places, s.risk_model.get(),
                            conditions};
  PlanResult plan;
  if (s.planner) {
    plan = s.planner->Plan(request);
    FitTurns(request, plan);
  } else {
    if (s.online) {
      plan.status = PlanStatus::kOnline;
      plan.message = s.planner_name + " plans while it drives, as the floor becomes known";
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

// SPDX-License-Identifier: Apache-2.0
#include "run/episode/make_plan.h"

#include "base/streams.h"

namespace floorproof {

double PlanDuration(const Path& path, double cruise_mps) {
  constexpr double kFold_s = 30;  // for each change of shape: three hinges, half a turn each
  double t_s = path.empty() ? 0 : path.front().dwell_s;
  for (std::size_t i = 1; i < path.size(); ++i)
    t_s += (path[i].p_W - path[i - 1].p_W).norm() /
               (path[i].speed_mps > 0 ? path[i].speed_mps : cruise_mps) +
           path[i].dwell_s + (path[i].shape != path[i - 1].shape ? kFold_s : 0);
  return t_s;
}

PlanResult MakePlan(const Scenario& s) {
  const RobotSpec& robot = s.robot.spec;
  const HazardMap known = KnownPart(s.site.map);
  auto risk = std::make_shared<const RiskMap>(ComputeRisk(known, robot, s.fmea, s.risk));
  PlanResult plan;
  if (s.planner) {
    Stream stream(static_cast<std::uint64_t>(s.episode.seed), s.episode_id, "plan");
    plan = s.planner->Plan({known, robot, s.start, s.goal, stream.Next(), risk.get()});
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

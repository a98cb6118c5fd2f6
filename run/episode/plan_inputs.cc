// SPDX-License-Identifier: Apache-2.0
#include "run/episode/plan_inputs.h"

#include <nlohmann/json.hpp>

#include "run/episode/ask_program.h"
#include "run/episode/descriptions.h"
#include "run/episode/plain_draws.h"
#include "run/scenario/plan_file.h"

namespace floorproof {
namespace {

// What a program is told beside the floor and its risk. Its robot's speeds hang on more than the
// robot's keys: the battery's voltage.
std::string ProgramInputs(const Scenario& s, const PlanCommand& program) {
  std::string text = DescribeRobot(s.robot.spec).dump() + std::to_string(ProgramSeed(s, program));
  for (const std::string& word : program.words) text += "\n" + word;
  return text;
}

}  // namespace

std::string PlanInputs(const Scenario& s) {
  const bool has_limits = !s.robot.spec.measured.limits.empty();
  ConfigNode site = s.site_node;
  if (!has_limits) site.Remove("floor");
  ConfigNode others = ConfigNode::Map();
  others.Add("site", std::move(site));
  others.Add("robot", ConfigNode::Scalar(s.robot_file.string(), true));
  RobotChanges changes = s.robot_changes;
  WriteParams([&](ParamVisitor& v) { changes.Visit(v); }, others);
  std::string text = WriteYaml(others) + (has_limits ? "by its limits\n" : "") + s.planner_name;
  for (const double value : {s.start.x_m, s.start.y_m, s.start.yaw_rad})
    text += " " + FormatDouble(value);
  if (s.goal) text += " to " + FormatDouble(s.goal->x()) + " " + FormatDouble(s.goal->y());
  ConfigNode params = ConfigNode::Map();
  if (Configurable* planner = PlannerOf(s))
    WriteParams(*planner, params);
  else if (const PlanCommand* program = ProgramToAsk(s))
    text += "\n" + ProgramInputs(s, *program);
  else
    text += "\n" + PlanCsv(s.user_plan);
  for (const Vec2& p : s.places) text += "\n" + FormatDouble(p.x()) + " " + FormatDouble(p.y());
  RiskParams risk = s.risk;
  WriteParams([&](ParamVisitor& v) { risk.Visit(v); }, params);
  params.Add("tables", ConfigNode::Scalar(s.fmea_file.string(), true));
  params.Add("model", ConfigNode::Scalar(s.risk_model_file.string(), true));
  text += "\n" + WriteYaml(params);
  if (s.planner && s.planner->promises().needs_model)
    for (const DriveConditions& c : ConditionsOf(s))
      for (const double value : {c.friction, c.mass_kg, c.clearance_m})
        text += " " + FormatDouble(value);
  if (s.planner && s.planner->promises().uses_seed) text += std::to_string(s.episode_id);
  return text;
}

}  // namespace floorproof

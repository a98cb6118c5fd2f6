// SPDX-License-Identifier: Apache-2.0
#include "run/episode/plan_inputs.h"

#include <nlohmann/json.hpp>

#include "run/episode/ask_program.h"
#include "run/episode/descriptions.h"
#include "run/episode/plain_draws.h"
#include "run/scenario/plan_file.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

// What a program is told beside the floor and its risk. Its robot's speeds hang on more than the
// robot's keys: the battery's voltage.
std::string ProgramInputs(const Scenario& s, const PlanCommand& program) {
  std::string text =
      DescribeRobot(s.world.robot.spec).dump() + std::to_string(ProgramSeed(s.spec, program));
  for (const std::string& word : program.words) text += "\n" + word;
  return text;
}

}  // namespace

std::string PlanInputs(const Scenario& s) {
  const bool has_limits = !s.world.robot.spec.measured.limits.empty();
  ConfigNode site = s.text.site;
  if (!has_limits) site.Remove("floor");
  ConfigNode others = ConfigNode::Map();
  others.Add("site", std::move(site));
  others.Add("robot", ConfigNode::Scalar(s.spec.robot_file.string(), true));
  RobotChanges changes = s.spec.robot_changes;
  WriteParams([&](ParamVisitor& v) { changes.Visit(v); }, others);
  std::string text =
      WriteYaml(others) + (has_limits ? "by its limits\n" : "") + s.spec.planner_name;
  for (const double value : {s.world.start.x_m, s.world.start.y_m, s.world.start.yaw_rad})
    text += " " + FormatDouble(value);
  if (s.world.goal)
    text += " to " + FormatDouble(s.world.goal->x()) + " " + FormatDouble(s.world.goal->y());
  ConfigNode params = ConfigNode::Map();
  if (IsPlanned(s.spec))
    WriteValues(s.spec.planner_params, params);
  else if (const PlanCommand* program = ProgramToAsk(s.spec))
    text += "\n" + ProgramInputs(s, *program);
  else
    text += "\n" + PlanCsv(s.spec.user_plan);
  for (const Vec2& p : s.spec.places)
    text += "\n" + FormatDouble(p.x()) + " " + FormatDouble(p.y());
  RiskParams risk = s.spec.risk;
  WriteParams([&](ParamVisitor& v) { risk.Visit(v); }, params);
  params.Add("tables", ConfigNode::Scalar(s.spec.fmea_file.string(), true));
  params.Add("model", ConfigNode::Scalar(s.spec.risk_model_file.string(), true));
  text += "\n" + WriteYaml(params);
  if (s.spec.promises.needs_model)
    for (const DriveConditions& c : ConditionsOf(s))
      for (const double value : {c.friction, c.mass_kg, c.clearance_m})
        text += " " + FormatDouble(value);
  if (s.spec.promises.uses_seed) text += std::to_string(s.spec.episode_id);
  return text;
}

}  // namespace floorproof

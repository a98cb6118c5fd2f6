// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/scenario_spec.h"

namespace floorproof {

const PlanCommand* ProgramToAsk(const ScenarioSpec& spec) {
  return spec.plan_command && spec.plan_file.empty() ? &*spec.plan_command : nullptr;
}

std::vector<std::string> SensorNames(const ScenarioSpec& spec) {
  std::vector<std::string> names;
  for (const SensorSpec& sensor : spec.sensors) names.push_back(sensor.plugin.name);
  return names;
}

bool LeadsItself(const ScenarioSpec& spec) { return spec.plan_by == PlanBy::kNobody; }

bool AsksForRisk(const ScenarioSpec& spec) {
  return spec.written.contains("risk") || spec.promises.needs_risk;
}

}  // namespace floorproof

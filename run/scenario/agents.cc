// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/agents.h"

#include "run/scenario/scenario_spec.h"

namespace floorproof {

std::vector<NamedSensor> MakeSensors(const ScenarioSpec& spec) {
  std::vector<NamedSensor> sensors;
  for (const SensorSpec& sensor : spec.sensors)
    sensors.push_back(
        {sensor.plugin.name, MakePlugin(Sensors(), sensor.plugin, "sensors"), sensor.implied});
  return sensors;
}

std::vector<NamedDetector> MakeDetectors(const ScenarioSpec& spec) {
  return MakePlugins<NamedDetector>(Detectors(), spec.detectors, "failures");
}

Agents MakeAgents(const ScenarioSpec& spec) {
  Agents agents;
  if (spec.plan_by == PlanBy::kOnline)
    agents.online = MakePlugin(OnlinePlanners(), PlannerOf(spec), "plan.planner");
  agents.tracker = MakePlugin(Trackers(), spec.tracker, "controller");
  agents.estimator = MakePlugin(Estimators(), spec.estimator, "estimator");
  agents.sensors = MakeSensors(spec);
  if (spec.mapper) SetValues(*spec.mapper, agents.mapper.emplace());
  agents.detectors = MakeDetectors(spec);
  return agents;
}

}  // namespace floorproof

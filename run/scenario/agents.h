// SPDX-License-Identifier: Apache-2.0
// The plug-ins of one episode: planner of an unknown floor, tracker, estimator, sensors, mapper,
// failure detectors. They keep state, so each episode makes its own: nothing leaks into the next.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "controllers/estimator.h"
#include "controllers/mapper.h"
#include "controllers/tracker.h"
#include "env/failures/detector.h"
#include "env/sensors/sensor.h"
#include "planners/online/online_planner.h"

namespace floorproof {

struct ScenarioSpec;

struct Agents {
  std::unique_ptr<OnlinePlanner> online;  // none: the plan is made before the drive
  std::unique_ptr<Tracker> tracker;
  std::unique_ptr<Estimator> estimator;
  std::vector<NamedSensor> sensors;
  std::optional<Mapper> mapper;  // none: no map is drawn
  std::vector<NamedDetector> detectors;
};

// Makes them from names and parameters. Throws InputError for a plug-in that does not exist.
Agents MakeAgents(const ScenarioSpec& spec);
std::vector<NamedSensor> MakeSensors(const ScenarioSpec& spec);
std::vector<NamedDetector> MakeDetectors(const ScenarioSpec& spec);

}  // namespace floorproof

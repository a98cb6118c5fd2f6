// SPDX-License-Identifier: Apache-2.0
// Sensors: from the physics to what the robot is told. A new one is one file in this folder and one
// line in list.inc.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/params.h"
#include "base/registry.h"
#include "base/streams.h"
#include "env/core/hazard_map.h"
#include "env/core/motion.h"
#include "env/core/observation.h"
#include "env/core/robot_spec.h"
#include "env/scene/scene.h"

namespace floorproof {

// Where a sensor is: the references outlive the episode.
struct SensorContext {
  const Scene& scene;
  const HazardMap& map;  // the true one
  const RobotSpec& robot;
  double control_s = 0.02;
  // Torque of each actuator at the last step, N m, as it changes from step to step.
  std::span<const double> motor_nm = {};
};

class Sensor : public Configurable {
 public:
  // The part of the Observation that it fills, and it alone: a robot carries one sensor of each.
  virtual Reading Fills() const = 0;
  // Whether what it tells hangs on its stream, as its parameters are; false: another episode's
  // stream changes nothing.
  virtual bool draws() const { return true; }
  // Before the first step, the robot standing at its start; `noise` is this episode's stream of
  // this sensor. Sizes what Sense() fills. Throws InputError where the robot cannot carry it, its
  // line beginning with the key: it is heard when a scenario is read (run/scenario/start_check.h).
  virtual void Start(const SensorContext& context, const mjData* data, const Truth& truth,
                     const Stream& noise, Observation& out) = 0;
  // After every physics step; for what must not be missed between two control periods.
  virtual void OnStep(const Truth&) {}
  // Once a control period. Allocates nothing.
  virtual void Sense(mjData* data, const Truth& truth, Observation& out) = 0;
  // In place of what it just told: what is heard of it while it is silent. It senses on, so that
  // its noise is the same once it is heard again.
  virtual void Silence(Observation& out) const = 0;
};

// One that a robot carries. `implied`: a part of the scenario brought it, and it has no parameters,
// so that there is nothing to state or to refuse about it.
struct NamedSensor {
  std::string name;
  std::unique_ptr<Sensor> sensor;
  bool implied = false;
};

std::span<const PluginEntry<Sensor>> Sensors();

std::vector<std::string> SensorNames(std::span<const NamedSensor> sensors);

}  // namespace floorproof

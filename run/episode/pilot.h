// SPDX-License-Identifier: Apache-2.0
// The robot's own side of an episode: what it senses, where it thinks it is, what it knows of the
// floor, and what it commands.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "controllers/drive.h"
#include "controllers/mapper.h"
#include "controllers/recovery.h"
#include "env/core/observation.h"
#include "env/sim/simulation.h"
#include "run/scenario/scenario.h"

namespace floorproof {

class Pilot {
 public:
  // All outlive it. `plan` was made on `known`.
  Pilot(Scenario& scenario, const Scene& scene, const HazardMap& known, const PlanResult& plan);

  // Before the first step, the robot at its start.
  void Start(Simulation& sim);
  // One control period: sense, estimate, map, track, react; writes the sample's command and sets
  // the wheels. Allocates only where a reaction changes the path.
  void Control(Simulation& sim);
  // The same of a robot that waits for help: it senses on, its motors hold still.
  void Stand(Simulation& sim);
  // The robot was set down at this waypoint of its path: what it drives begins there now, and
  // whatever it was about is over. Neither sensors nor estimator are told. Allocates.
  void GoOnFrom(std::size_t waypoint, Simulation& sim);
  // After every physics step.
  void OnStep(const Sample& truth);

  // Driven now: the plan, until a reaction changes it or the robot is set down.
  const Path& path() const { return path_; }
  const Observation& sensed() const { return sensed_; }
  const Estimate& estimate() const { return estimate_; }
  const KnownMap* known() const { return mapper_ ? &mapper_->map() : nullptr; }
  int reactions() const { return recovery_ ? recovery_->count() : 0; }

 private:
  Stream StreamOf(const std::string& name) const;
  void TakeNewPath();
  void Sense(Simulation& sim);
  void Actuate(Simulation& sim);

  Scenario& s_;
  const Scene& scene_;
  const HazardMap& known_;
  const PlanResult& plan_;
  const RobotSpec& robot_;
  double control_s_;
  ClearanceField clearance_;
  std::unique_ptr<Drive> drive_;
  std::optional<Mapper> mapper_;
  std::optional<Recovery> recovery_;
  Path path_;
  Observation sensed_;
  Estimate estimate_;
  Command command_;
  std::vector<double> wheel_radps_;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The plant that MuJoCo steps, and the sensors that the robot carries in it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/streams.h"
#include "env/core/alterations.h"
#include "env/faults/schedule.h"
#include "env/sensors/sensor.h"
#include "env/sim/plant.h"
#include "env/sim/simulation.h"

namespace floorproof {

class PhysicsPlant final : public Plant {
 public:
  // The stream of this episode that has this name.
  using StreamOf = std::function<Stream(const std::string& name)>;

  // All but `stream_of` outlive it. `map`: the true one. `faults`: what breaks, and when.
  PhysicsPlant(const Scene& scene, const HazardMap& map, const RobotSpec& robot,
               const std::vector<NamedSensor>& sensors, std::span<const ScheduledFault> faults,
               double control_s, StreamOf stream_of);

  void Reset(const Pose2& X_WB, Observation& sensed) override;
  void SetDown(const Pose2& X_WB) override { simulation_.SetDown(X_WB); }
  void Apply(const Actuation& actuation) override;
  void Sense(Observation& sensed) override;
  bool Step() override;
  std::string WhyBroken() const override {
    return "the physics diverged: " + simulation_.divergence();
  }
  const Truth& truth() const override { return simulation_.truth(); }
  std::optional<double> battery_left() const override { return simulation_.battery().left(); }

  // From now on, in place of what was altered before, until a fault comes or goes. Throws
  // InternalError where the robot does not have what is altered. Allocates.
  void Alter(const Alterations& alterations);

  Simulation& simulation() { return simulation_; }

 private:
  void UpdateFaults(double t_s);
  void Carry(const Pose2& X_BC);

  const Scene& scene_;
  const HazardMap& map_;
  const RobotSpec& robot_;
  const std::vector<NamedSensor>& sensors_;
  const std::vector<std::string> sensor_names_;
  FaultSchedule faults_;
  double control_s_;
  StreamOf stream_of_;
  Simulation simulation_;
  std::vector<char> silent_;  // by sensor
  std::optional<double> bump_stuck_rad_;
  bool begun_ = false;               // the episode: it stands on the floor
  std::optional<Pose2> from_start_;  // where it is carried then
};

}  // namespace floorproof

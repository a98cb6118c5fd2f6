// SPDX-License-Identifier: Apache-2.0
#include "env/sim/physics_plant.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "env/core/standing.h"

namespace floorproof {

PhysicsPlant::PhysicsPlant(const Scene& scene, const HazardMap& map, const RobotSpec& robot,
                           const std::vector<NamedSensor>& sensors,
                           std::span<const ScheduledFault> faults, double control_s,
                           StreamOf stream_of)
    : scene_(scene),
      map_(map),
      robot_(robot),
      sensors_(sensors),
      sensor_names_(SensorNames(sensors)),
      faults_(faults),
      control_s_(control_s),
      stream_of_(std::move(stream_of)),
      simulation_(scene, map, robot),
      silent_(sensors.size(), 0) {}

void PhysicsPlant::Reset(const Pose2& X_WB, Observation& sensed) {
  faults_.Start({robot_, sensor_names_});
  begun_ = false;
  UpdateFaults(0);
  simulation_.Reset(X_WB);
  begun_ = true;
  if (const auto carried = std::exchange(from_start_, {})) Carry(*carried);  // nobody tells it
  for (const auto& [name, sensor, implied] : sensors_)
    sensor->Start({scene_, map_, robot_, control_s_, simulation_.motor_nm()}, simulation_.data(),
                  truth(), stream_of_("sensors." + name), sensed);
}

void PhysicsPlant::Apply(const Actuation& actuation) {
  simulation_.SetWheelSpeeds(actuation.wheel_radps);
  simulation_.CutMotors(actuation.cut);
  simulation_.SetHingeSpeeds(actuation.hinges);
}

void PhysicsPlant::Sense(Observation& sensed) {
  UpdateFaults(truth().t_s);
  sensed.t_s = truth().t_s;
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    sensors_[i].sensor->Sense(simulation_.data(), truth(), sensed);
    if (silent_[i]) sensors_[i].sensor->Silence(sensed);
  }
  if (bump_stuck_rad_) sensed.bump = {true, *bump_stuck_rad_};
}

bool PhysicsPlant::Step() {
  UpdateFaults(truth().t_s);
  const bool good = simulation_.Step();
  if (good)
    for (const NamedSensor& sensor : sensors_) sensor.sensor->OnStep(truth());
  return good;
}

void PhysicsPlant::UpdateFaults(double t_s) {
  if (const Alterations* alterations = faults_.Update(t_s)) Alter(*alterations);
}

void PhysicsPlant::Alter(const Alterations& alterations) {
  for (const std::string& name : alterations.silent_sensors)
    if (std::ranges::find(sensors_, name, &NamedSensor::name) == sensors_.end())
      throw InternalError("the robot carries no sensor " + name + " to silence");
  for (std::size_t i = 0; i < sensors_.size(); ++i)
    silent_[i] = std::ranges::find(alterations.silent_sensors, sensors_[i].name) !=
                 alterations.silent_sensors.end();
  bump_stuck_rad_ = alterations.bump_stuck_rad;
  simulation_.Alter(alterations);
  if (!alterations.carried) return;
  if (begun_)
    Carry(*alterations.carried);
  else
    from_start_ = alterations.carried;
}

// As far as it can stand there: whoever takes it up does not set it down in a wall.
void PhysicsPlant::Carry(const Pose2& X_BC) {
  constexpr int kShares = 20;
  constexpr double kNowhere = 1e-6;  // m and rad
  if (X_BC.p().norm() < kNowhere && std::abs(X_BC.yaw_rad) < kNowhere) return;
  const Pose2 from = truth().X_WB();
  for (int share = kShares; share > 0; --share) {
    const double part = static_cast<double>(share) / kShares;
    const Pose2 to = from * Pose2{part * X_BC.x_m, part * X_BC.y_m, part * X_BC.yaw_rad};
    if (!StandAt(map_, robot_, to).obstruction.empty()) continue;
    simulation_.CarryTo(to);
    return;
  }
}

}  // namespace floorproof

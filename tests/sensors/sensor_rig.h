// SPDX-License-Identifier: Apache-2.0
// One sensor on a robot that stands or drives in a scene.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>

#include "controllers/drive.h"
#include "env/hazards/hazard_type.h"
#include "env/sensors/sensor.h"
#include "env/sim/simulation.h"

namespace floorproof {

// A room of that many metres within walls of one cell, its inner corner at (1, 1).
inline HazardMap Room(double width_m, double height_m, double cell_m = 0.5) {
  HazardMap map;
  const int border = static_cast<int>(std::lround(1 / cell_m));
  const int nx = static_cast<int>(std::lround(width_m / cell_m)) + 2 * border;
  const int ny = static_cast<int>(std::lround(height_m / cell_m)) + 2 * border;
  map.frame = {nx, ny, cell_m, {}};
  map.occupancy = Grid<CellState>(nx, ny, CellState::kOccupied);
  for (int iy = border; iy < ny - border; ++iy)
    for (int ix = border; ix < nx - border; ++ix) map.occupancy(ix, iy) = CellState::kFree;
  return map;
}

// A box-shaped hazard.
inline Hazard Block(HazardClass hazard_class, const Vec2& low_W, const Vec2& high_W,
                    double height_m) {
  Hazard hazard;
  hazard.id = "block";
  hazard.hazard_class = hazard_class;
  hazard.height_m = height_m;
  const Polygon outline = {low_W, {high_W.x(), low_W.y()}, high_W, {low_W.x(), high_W.y()}};
  hazard.footprint = {outline};
  hazard.solids = {{Solid::Kind::kPrism, outline, {}, 0, height_m}};
  return hazard;
}

inline std::unique_ptr<Sensor> MakeSensor(std::string_view name, const std::string& params = "{}") {
  auto sensor = MakePlugin(Sensors(), name, "sensor");
  ReadParams(ParseYaml(params, "params"), "", *sensor);
  return sensor;
}

class SensorRig {
 public:
  static constexpr double kControl_s = 0.02;

  SensorRig(const HazardMap& map, const std::string& robot, const Pose2& start,
            const RobotChanges& changes = {})
      : map_(map),
        robot_(ReadRobot(FindRobotFile(robot, {}), changes)),
        scene_(BuildScene(map_, robot_, {}, start)),
        sim_(scene_, map_, robot_.spec),
        drive_(MakePlugin(Drives(), robot_.spec.drive, "drive")),
        wheels_(robot_.spec.wheels.size()) {
    drive_->Configure(robot_.spec);
    sim_.Reset(start);
  }

  void Carry(std::unique_ptr<Sensor> sensor, std::uint64_t seed = 1) {
    sensor_ = std::move(sensor);
    Start(seed);
  }
  // The sensor that it carries, in another episode.
  void Start(std::uint64_t seed = 1) {
    sensor_->Start({scene_, map_, robot_.spec, kControl_s, sim_.motor_nm()}, sim_.data(),
                   sim_.truth(), Stream(seed, 0, "noise"), sensed_);
  }
  const Observation& Sense() {
    sensed_.t_s = sim_.truth().t_s;
    sensor_->Sense(sim_.data(), sim_.truth(), sensed_);
    return sensed_;
  }
  // One control period at this twist.
  const Observation& Drive(const BodyTwist& twist) {
    HingeState forks;
    forks.TakeSteering(sim_.truth().hinges);
    drive_->ToWheels(twist, forks, wheels_);
    sim_.SetWheelSpeeds(wheels_);
    sim_.SetHingeSpeeds(forks);
    for (int i = 0; i < 5; ++i) StepOn();
    return Sense();
  }
  // One physics step more, after which it does not sense.
  void StepOn() {
    EXPECT_TRUE(sim_.Step());
    sensor_->OnStep(sim_.truth());
  }
  void Put(const Pose2& X_WB) { sim_.Reset(X_WB); }

  const Truth& truth() { return sim_.truth(); }
  const Scene& scene() const { return scene_; }
  const RobotSpec& robot() const { return robot_.spec; }
  Simulation& sim() { return sim_; }

 private:
  HazardMap map_;
  RobotModel robot_;
  Scene scene_;
  Simulation sim_;
  std::unique_ptr<floorproof::Drive> drive_;
  std::unique_ptr<Sensor> sensor_;
  std::vector<double> wheels_;
  Observation sensed_;
};

}  // namespace floorproof

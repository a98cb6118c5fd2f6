// SPDX-License-Identifier: Apache-2.0
#include "env/validate/rig.h"

#include "env/core/registry.h"

namespace floorproof {
namespace {

constexpr int kCells = 40;
constexpr double kCell_m = 0.5;

// The changes that make the model wrong, on top of those that are meant.
RobotChanges Wrong(RobotChanges changes, const RobotSpec& robot, const WrongModel& wrong) {
  if (wrong.wheel_radius_add_m != 0)
    changes.wheel_radius_m = robot.wheels.front().radius_m + wrong.wheel_radius_add_m;
  return changes;
}

}  // namespace

Rig::Rig(const std::string& robot_name, RigOptions options) {
  const auto file = FindRobotFile(robot_name, {});
  true_robot_ = ReadRobot(file, options.changes, options.blocks).robot;
  model_ = ReadRobot(file, Wrong(options.changes, true_robot_, options.wrong), options.blocks);
  map_.frame = {kCells, kCells, kCell_m, {-kCells * kCell_m / 2, -kCells * kCell_m / 2, 0}};
  map_.cells = Grid<CellState>(kCells, kCells);
  map_.hazards = std::move(options.hazards);
  map_.floor_friction = options.friction * options.wrong.friction_factor;
  scene_ = BuildScene(map_, model_, options.physics, {});
  drive_ = MakePlugin(Drives(), true_robot_.drive, "drive");
  drive_->Configure(true_robot_);
  wheel_radps_.resize(true_robot_.wheels.size());
  sim_ = std::make_unique<Simulation>(scene_, map_, model_.robot);
  sim_->Reset({});
}

void Rig::Command(const BodyTwist& twist, const HingeState& hinges) {
  drive_->ToWheels(twist, hinges, wheel_radps_);
  sim_->SetWheelSpeeds(wheel_radps_);
  sim_->SetHingeSpeeds(hinges);
}

void Rig::Step() {
  if (!sim_->Step()) throw InternalError("the physics diverged on the rig");
}

BodyTwist Rig::Run(const BodyTwist& twist, double t_s) {
  Command(twist);
  const double start_s = sample().t_s;
  BodyTwist mean;
  int n = 0;
  while (sample().t_s < start_s + t_s) {
    Step();
    if (sample().t_s < start_s + t_s / 2) continue;
    const BodyTwist& v = sample().V_WB_B;
    mean.vx_mps += v.vx_mps;
    mean.vy_mps += v.vy_mps;
    mean.wz_radps += v.wz_radps;
    ++n;
  }
  return {mean.vx_mps / n, mean.vy_mps / n, mean.wz_radps / n};
}

Hazard Prism(const std::string& id, const Polygon& base, const Polygon& top, double height_m) {
  Hazard hazard;
  hazard.id = id;
  hazard.solids = {{Solid::Kind::kPrism, base, top, 0, height_m}};
  return hazard;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A robot on a wide floor, driven by twists.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "controllers/drive.h"
#include "env/core/registry.h"
#include "env/scene/roller_wheels.h"
#include "env/scene/scene.h"
#include "env/sim/simulation.h"

namespace floorproof {

struct Bench {
  HazardMap map;
  RobotModel robot;
  Scene scene;
  std::unique_ptr<Simulation> sim;

  explicit Bench(const std::string& robot_name, PhysicsParams physics = {},
                 const std::vector<Hazard>& hazards = {}, const RobotChanges& changes = {},
                 bool roller_wheels = false)
      : robot(ReadRobot(FindRobotFile(robot_name, {}), changes)) {
    if (roller_wheels) robot = WithRollerWheels(robot);
    map.hazards = hazards;
    map.frame = {40, 40, 0.5, {-10, -10, 0}};
    map.cells = Grid<CellState>(40, 40);
    scene = BuildScene(map, robot, physics, {});
    sim = std::make_unique<Simulation>(scene, map, robot.robot);
    sim->Reset({});
  }
  // Wheel speeds for this twist from now on.
  void Command(const BodyTwist& twist) {
    const auto drive = MakePlugin(Drives(), robot.robot.drive, "drive");
    drive->Configure(robot.robot);
    std::vector<double> wheels(robot.robot.wheels.size());
    drive->ToWheels(twist, wheels);
    sim->SetWheelSpeeds(wheels);
  }
  // Drives a twist for a time; returns the body's mean velocity over the second half.
  BodyTwist Drive(const BodyTwist& twist, double t_s) {
    Command(twist);
    const double start_s = sim->sample().t_s;
    BodyTwist mean;
    int n = 0;
    while (sim->sample().t_s < start_s + t_s) {
      EXPECT_TRUE(sim->Step());
      if (sim->sample().t_s < start_s + t_s / 2) continue;
      const BodyTwist& v = sim->sample().V_WB_B;
      mean.vx_mps += v.vx_mps;
      mean.vy_mps += v.vy_mps;
      mean.wz_radps += v.wz_radps;
      ++n;
    }
    return {mean.vx_mps / n, mean.vy_mps / n, mean.wz_radps / n};
  }
};

}  // namespace floorproof

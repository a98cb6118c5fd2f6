// SPDX-License-Identifier: Apache-2.0
#include "env/scene/exposed_wheels.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "env/scene/roller_wheels.h"
#include "env/scene/scene.h"
#include "env/scene/wheel_collider.h"
#include "tests/robot_file.h"

namespace floorproof {
namespace {

constexpr double kWall_m = 2;

// Bare floor, a wall across it.
HazardMap Hall() {
  HazardMap map;
  map.frame = {12, 8, 0.25, {}};
  map.occupancy = Grid<CellState>(12, 8);
  for (int row = 0; row < 8; ++row) map.occupancy(8, row) = CellState::kOccupied;
  return map;
}

int NumWheelsThatMeetWalls(const Scene& scene) {
  constexpr int kWallBit = 2;  // as docs/adding-a-robot.md has it
  int num = 0;
  for (int g = 0; g < scene.model->ngeom; ++g)
    num += scene.roles[static_cast<std::size_t>(g)].kind == GeomRole::Kind::kWheel &&
           (scene.model->geom_conaffinity[g] & kWallBit) != 0;
  return num;
}

// Of the bundled robot's file, with a body that is smaller than its wheels' rectangle.
RobotModel Narrow(const std::string& name, const std::string& body, const std::string& narrow) {
  std::ifstream in(FindRobotFile(name, {}));
  std::string xml((std::istreambuf_iterator<char>(in)), {});
  const std::size_t at = xml.find(body);
  EXPECT_NE(at, std::string::npos) << body;
  return ReadRobot(RobotFile(xml.replace(at, body.size(), narrow)).path());
}

struct Reach {
  double wheels_m, body_m;  // the farthest along x
};

// Where wheels and body are after driving at the wall for a while.
Reach DriveAtTheWall(const Scene& scene) {
  const mjModel* m = scene.model.get();
  const DataPtr d = MakeData(m);
  for (int a = 0; a < m->nu; ++a)
    d->ctrl[a] = m->actuator_trntype[a] == mjTRN_JOINT &&
                         std::abs(m->jnt_axis[3 * m->actuator_trnid[2 * a] + 2]) < 0.5
                     ? 6
                     : 0;  // hinges between blocks stay
  while (d->time < 6) StepEngine(m, d.get());
  Reach reach{-1, -1};
  for (int g = 0; g < m->ngeom; ++g) {
    const GeomRole::Kind kind = scene.roles[static_cast<std::size_t>(g)].kind;
    const bool wheel = kind == GeomRole::Kind::kWheel && m->geom_type[g] != mjGEOM_ELLIPSOID;
    if (!wheel && kind != GeomRole::Kind::kBody) continue;
    // Both turn about y: their extent along x is that of their size.
    const double out = m->geom_size[3 * g] + (wheel ? RollersOf(m, g).radius_m : 0);
    double& farthest = wheel ? reach.wheels_m : reach.body_m;
    farthest = std::max(farthest, d->geom_xpos[3 * g] + out);
  }
  return reach;
}

// The body covers them: what their contacts with walls would cost is saved.
TEST(ExposedWheels, ThereAreNoneOnTheBundledRobots) {
  for (const RobotEntry& entry : Robots()) {
    const RobotModel robot = ReadRobot(FindRobotFile(std::string(entry.name), {}));
    EXPECT_EQ(NumWheelsThatMeetWalls(BuildScene(Hall(), robot, {}, {1, 1, 0})), 0) << entry.name;
  }
}

struct Case {
  const char* robot;
  const char* body;
  const char* narrow;
  int num_exposed;
};
void PrintTo(const Case& c, std::ostream* os) { *os << c.robot; }

class ExposedWheelsOf : public ::testing::TestWithParam<Case> {};

TEST_P(ExposedWheelsOf, AreStoppedByAWall) {
  const Case& c = GetParam();
  const RobotModel robot = Narrow(c.robot, c.body, c.narrow);
  const Scene dut = BuildScene(Hall(), robot, {}, {1.3, 1, 0});
  EXPECT_EQ(NumWheelsThatMeetWalls(dut), c.num_exposed);
  const Reach reach = DriveAtTheWall(dut);
  EXPECT_NEAR(reach.wheels_m, kWall_m, 0.004);
  EXPECT_LT(reach.body_m, kWall_m - 0.005) << "the wheels met it first";
}

INSTANTIATE_TEST_SUITE_P(Kinds, ExposedWheelsOf,
                         ::testing::Values(Case{"scrubber", R"(size="0.405 0.35 0.0775")",
                                                R"(size="0.300 0.35 0.0775")", 1},
                                           Case{"rover", R"(size="0.312 0.290 0.015")",
                                                R"(size="0.200 0.290 0.015")", 4},
                                           Case{"htetro", R"(size="0.125 0.125 0.0275")",
                                                R"(size="0.070 0.125 0.0275")", 16}),
                         [](const auto& tested) { return std::string(tested.param.robot); });

// With rollers that are bodies, they meet it instead of the wheel's core.
TEST(ExposedWheels, RollersMeetWallsToo) {
  const RobotModel ideal =
      Narrow("htetro", R"(size="0.125 0.125 0.0275")", R"(size="0.070 0.125 0.0275")");
  const Scene dut = BuildScene(Hall(), WithRollerWheels(ideal), {}, {1.3, 1, 0});
  EXPECT_EQ(NumWheelsThatMeetWalls(dut), 16 * kRollers);
  EXPECT_LT(DriveAtTheWall(dut).body_m, kWall_m - 0.005);
}

// The rover's mudguards as other shapes: corners that a box has and they do not cover nothing.
TEST(ExposedWheels, CountWhereTheBodysOwnShapeDoesNotCoverThem) {
  const std::string guards = R"(class="body" type="box" size="0.312 0.290 0.015" pos="0 0 0.205")";
  const auto exposed = [&](const std::string& shape) {
    return NumWheelsThatMeetWalls(
        BuildScene(Hall(), Narrow("rover", guards, R"(class="body" )" + shape), {}, {1, 1, 0}));
  };
  const auto mesh = [&](double chamfer_m) {
    std::string corners;
    for (const double x : {-1, 1})
      for (const double y : {-1, 1})
        for (const double z : {-1, 1})
          for (const double cut : {0.0, 1.0})
            corners += fmt::format("{} {} {}  ", x * (0.312 - cut * chamfer_m),
                                   y * (0.290 - (1 - cut) * chamfer_m), 0.015 * z);
    std::ifstream in(FindRobotFile("rover", {}));
    std::string xml((std::istreambuf_iterator<char>(in)), {});
    xml.insert(xml.find("</asset>"), "<mesh name='guards' vertex='" + corners + "'/>");
    const std::size_t at = xml.find(guards);
    EXPECT_NE(at, std::string::npos);
    xml.replace(at, guards.size(), R"(class="body" type="mesh" mesh="guards" pos="0 0 0.205")");
    return NumWheelsThatMeetWalls(
        BuildScene(Hall(), ReadRobot(RobotFile(xml).path()), {}, {1, 1, 0}));
  };
  EXPECT_EQ(exposed(R"(type="box" size="0.290 0.312 0.015" pos="0 0 0.205" euler="0 0 1.5707963")"),
            0);
  EXPECT_EQ(exposed(R"(type="ellipsoid" size="0.312 0.290 0.015" pos="0 0 0.205")"), 4);
  EXPECT_EQ(exposed(R"(type="ellipsoid" size="0.600 0.500 0.015" pos="0 0 0.205")"), 0);
  EXPECT_EQ(exposed(R"(type="capsule" size="0.290 0.022" pos="0 0 0.305" euler="0 1.5707963 0")"),
            4);
  EXPECT_EQ(mesh(0.01), 0);
  EXPECT_EQ(mesh(0.08), 4);
}

// What stands over the walls hinders no wheel from passing through them.
TEST(ExposedWheels, WhatLiesAboveTheWallsCoversNothing) {
  const std::string low = R"(size="0.312 0.290 0.015" pos="0 0 0.205")";
  const auto exposed = [&](const std::string& tray) {
    return NumWheelsThatMeetWalls(BuildScene(Hall(), Narrow("rover", low, tray), {}, {1, 1, 0}));
  };
  EXPECT_EQ(exposed(R"(size="0.312 0.290 0.015" pos="0 0 0.455")"), 0) << "it meets their top";
  EXPECT_EQ(exposed(R"(size="0.312 0.290 0.015" pos="0 0 0.475")"), 4);
}

// A caster that stands under the body may swing out from under it.
TEST(ExposedWheels, ACasterCountsWhereverItSwivels) {
  const auto exposed = [](double trail_m) {
    const std::string trail = std::to_string(trail_m);
    std::ifstream in(FindRobotFile("beluga", {}));
    std::string xml((std::istreambuf_iterator<char>(in)), {});
    const std::string ball = R"(<geom name="caster_rear" class="caster"/>)";
    const std::size_t at = xml.find(ball);
    EXPECT_NE(at, std::string::npos);
    const std::string fork =
        R"(<geom class="look" size="0.005" mass="0.02"/><body name="fork"><joint axis="0 0 1"/>
      <geom type="sphere" size="0.005" mass="0.05" class="look"/>
      <body name="roll" pos=")" +
        trail + R"( 0 0"><joint axis="0 1 0"/>
      <geom type="sphere" size="0.02" mass="0.05" contype="0" conaffinity="1"/></body></body>)";
    const RobotFile file(xml.replace(at, ball.size(), fork));
    return NumWheelsThatMeetWalls(BuildScene(Hall(), ReadRobot(file.path()), {}, {1, 1, 0}));
  };
  EXPECT_EQ(exposed(0.015), 0);
  EXPECT_EQ(exposed(0.035), 1) << "ahead of its pivot it stands under the body, behind it does not";
}

}  // namespace
}  // namespace floorproof

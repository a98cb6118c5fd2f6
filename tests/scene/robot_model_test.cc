// SPDX-License-Identifier: Apache-2.0
#include "env/scene/robot_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "env/scene/scene.h"
#include "tests/robot_file.h"
#include "tests/robots.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

RobotModel Beluga(const RobotChanges& changes = {}) {
  return ReadRobot(FindRobotFile("beluga", {}), changes);
}

// The figures stand in the MJCF's head; the program derives them from its geoms.
TEST(RobotModel, DriveDataComeFromTheModel) {
  const RobotSpec robot = Beluga().spec;
  ASSERT_EQ(robot.wheels.size(), 2u);
  EXPECT_NEAR(robot.wheels[0].radius_m, 0.05, 1e-9);
  EXPECT_NEAR(robot.wheels[0].p_BW.y() - robot.wheels[1].p_BW.y(), 0.27, 1e-9);
  EXPECT_NEAR(robot.wheels[0].max_speed_radps, 10, 1e-9);
  EXPECT_NEAR(robot.wheels[0].max_torque_nm, 3, 1e-9) << "the driver's limit, below the stall's 4";
  EXPECT_NEAR(robot.clearance_m, 0.025, 1e-6);
  EXPECT_NEAR(robot.mass_kg, 12, 0.5);
  EXPECT_EQ(robot.clear.kind, Shape2::Kind::kCircle);
  EXPECT_NEAR(robot.clear.radius_m, 0.18, 0.002);
  EXPECT_NEAR(robot.tool.radius_m, 0.15, 1e-9);
}

// The support is the rhomb of wheels and casters: its least angle is that of an edge d from the
// centre of mass, seen from above.
TEST(RobotModel, TheStaticTipAngleIsThatOfTheSupportRhomb) {
  const RobotSpec robot = Beluga().spec;
  const Vec2 wheel(0, 0.143), caster(-0.14, 0);  // outer rim of the wheel; rear caster
  const double side = (wheel - caster).norm();
  const double d = std::abs(Cross(wheel - caster, robot.p_BCom.head<2>() - caster)) / side;
  const Vec2 front(0.14, 0);
  const double ahead =
      std::abs(Cross(wheel - front, robot.p_BCom.head<2>() - front)) / (wheel - front).norm();
  EXPECT_NEAR(robot.static_tip_rad, std::atan2(std::min(d, ahead), robot.p_BCom.z()), 0.03);
}

TEST(RobotModel, ChangesReachMassAndClearance) {
  const RobotSpec robot = Beluga({.mass_kg = 20.0, .clearance_m = 0.015}).spec;
  EXPECT_NEAR(robot.mass_kg, 20, 1e-9);
  EXPECT_NEAR(robot.clearance_m, 0.015, 1e-9);
  EXPECT_NEAR(robot.wheels[0].radius_m, 0.05, 1e-9) << "the wheels stay";
}

TEST(RobotModel, ChangesReachWheelsAndRollers) {
  const std::filesystem::path htetro = FindRobotFile("htetro", {});
  const RobotModel dut = ReadRobot(htetro, {.wheel_radius_m = 0.035, .roller_radius_m = 0.009});
  for (const WheelSpec& wheel : dut.spec.wheels) {
    EXPECT_NEAR(wheel.radius_m, 0.035, 1e-9);
    EXPECT_NEAR(wheel.roller_radius_m, 0.009, 1e-9);
    EXPECT_NEAR(wheel.p_BW.z(), 0.035, 1e-9) << "it stands on the same floor";
  }
  EXPECT_NEAR(dut.spec.clearance_m, 0.025, 1e-9) << "the body stays";
  EXPECT_NEAR(Beluga({.wheel_radius_m = 0.06}).spec.wheels[0].p_BW.z(), 0.06, 1e-9);
  EXPECT_THROW(Beluga({.roller_radius_m = 0.01}), InputError);
  EXPECT_THROW(ReadRobot(htetro, {.roller_radius_m = 0.03}), InputError);
}

// Nothing but the robot's own text asks for names of motors and wheels.
TEST(RobotModel, MotorsAndWheelsNeedNoNames) {
  const std::filesystem::path htetro = FindRobotFile("htetro", {});
  std::stringstream text;
  text << std::ifstream(htetro).rdbuf();
  const std::regex named("(<(?:geom|dcmotor)) name=\"[^\"]*\"([^>]* class=\"wheel)");
  const RobotFile file(std::regex_replace(text.str(), named, "$1$2"));
  const RobotChanges changes = {.wheel_radius_m = 0.035, .battery_v = 11};
  const RobotModel dut = ReadRobot(file.path(), changes), with_names = ReadRobot(htetro, changes);
  ASSERT_EQ(dut.spec.wheels.size(), 16u);
  EXPECT_EQ(dut.spec.wheels[3].name, "actuator 3");
  EXPECT_EQ(dut.spec.wheels[3].radius_m, with_names.spec.wheels[3].radius_m);
  HazardMap map;
  map.frame = {2, 2, 1, {}};
  map.occupancy = Grid<CellState>(2, 2);
  const auto pairs = BuildScene(map, with_names, {}, {}).model->npair;
  EXPECT_EQ(pairs, 16) << "each wheel with the floor";
  EXPECT_EQ(BuildScene(map, dut, {}, {}).model->npair, pairs);
}

// Whatever the scene calls its own parts.
TEST(RobotModel, PartsMayHaveAnyNames) {
  std::ifstream in(FindRobotFile("beluga", {}));
  std::string xml((std::istreambuf_iterator<char>(in)), {});
  std::string looks = "<asset>";
  for (const char* name : {"floor", "sky"})
    looks += std::string("<texture name='") + name +
             "' type='2d' builtin='flat' width='8' height='8' rgb1='1 0 0'/>";
  for (const char* name : {"floor", "floor_", "wall", "pit"})
    looks += std::string("<material name='") + name + "' texture='floor' rgba='1 0 0 1'/>";
  const std::string custom = "<custom>", joint = "<freejoint name=\"root\"/>";
  xml.insert(xml.find(custom), looks + "</asset>");
  std::string geoms;
  for (const char* name : {"floor/0", "wall/1"})
    geoms += std::string("<geom name='") + name +
             "' material='floor' size='0.01' pos='0 0 0.1' contype='0' conaffinity='0'/>";
  xml.insert(xml.find(joint) + joint.size(), geoms);
  HazardMap map;
  map.frame = {4, 4, 1, {}};
  map.occupancy = Grid<CellState>(4, 4);
  map.occupancy(1, 1) = CellState::kOccupied;
  const Scene dut = BuildScene(map, ReadRobot(RobotFile(xml).path()), {}, {});
  const mjModel* m = dut.model.get();
  const int mine = mj_name2id(m, mjOBJ_MATERIAL, "floor");
  ASSERT_GE(mine, 0);
  EXPECT_EQ(m->mat_rgba[4 * mine + 1], 0) << "the robot's own is red";
  EXPECT_EQ(m->geom_matid[mj_name2id(m, mjOBJ_GEOM, "floor/0")], mine);
  int of_floor = -1;
  for (int g = 0; g < m->ngeom; ++g)
    if (m->geom_type[g] == mjGEOM_PLANE) of_floor = m->geom_matid[g];
  ASSERT_GE(of_floor, 0);
  EXPECT_NE(of_floor, mine);
  EXPECT_EQ(m->mat_rgba[4 * of_floor + 1], 1) << "the floor is not";
}

std::string RefusalOf(const std::string& xml) {
  const RobotFile file(xml);
  try {
    ReadRobot(file.path());
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(RobotModel, ABrokenRobotIsRefusedNamingWhatIsMissing) {
  EXPECT_THAT(RefusalOf("<mujoco"), HasSubstr("is not MJCF that MuJoCo reads"));
  EXPECT_THAT(RefusalOf("<mujoco/>"), HasSubstr("a robot needs a body named base"));
  EXPECT_THAT(
      RefusalOf(
          "<mujoco><worldbody><body name='base'><geom size='.1'/></body></worldbody></mujoco>"),
      HasSubstr("free joint"));
  std::string custom = "<custom><text name='drive' data='differential'/>";
  for (const char* number :
       {"tool_width_m", "step_m", "cruise_mps", "max_speed_mps", "max_accel_mps2",
        "max_yaw_rate_radps", "max_yaw_accel_radps2", "hotel_load_w"})
    custom += std::string("<numeric name='") + number + "' data='1'/>";
  const std::string body =
      "<worldbody><body name='base' pos='0 0 1'><freejoint/><geom size='.1'/></body></worldbody>";
  EXPECT_THAT(RefusalOf("<mujoco>" + body + "</mujoco>"), HasSubstr("drive"));
  EXPECT_THAT(RefusalOf("<mujoco>" + custom + "</custom>" + body + "</mujoco>"),
              HasSubstr("a robot needs at least one driven wheel"));
}

std::string BelugaWith(const std::string& before, const std::string& more) {
  std::ifstream in(FindRobotFile("beluga", {}));
  std::string xml((std::istreambuf_iterator<char>(in)), {});
  const std::size_t at = xml.find(before);
  EXPECT_NE(at, std::string::npos) << before;
  return xml.insert(at, more);
}

// Wheels and casters alone would drive through a wall.
TEST(RobotModel, ABodyThatNothingStopsIsRefused) {
  std::string xml = BelugaWith("<mujoco", "");
  const std::string body = "conaffinity=\"3\"";
  xml.replace(xml.find(body), body.size(), "conaffinity=\"0\"");
  EXPECT_THAT(RefusalOf(xml), HasSubstr("nothing but wheels and casters collides"));
}

// Whoever judges the robot rules gravity, solver and light.
TEST(RobotModel, ItsFileDoesNotRuleTheWorld) {
  const RobotFile file(BelugaWith(
      "<custom>",
      "<option gravity='1 0 -1' wind='9 0 0' density='1.2' iterations='1' impratio='7'>"
      "<flag contact='disable'/></option><statistic meaninertia='1e9' meansize='5'/>"
      "<visual><quality numslices='1000' numstacks='1000'/><headlight active='0'/></visual>"
      "<size memory='1M'/>"));
  HazardMap map;
  map.frame = {4, 4, 1, {}};
  map.occupancy = Grid<CellState>(4, 4);
  const Scene dut = BuildScene(map, ReadRobot(file.path()), {}, {});
  const Scene plain = BuildScene(map, Beluga(), {}, {});
  const mjModel &a = *dut.model, &b = *plain.model;
  EXPECT_EQ(std::vector<double>(a.opt.gravity, a.opt.gravity + 3),
            std::vector<double>(b.opt.gravity, b.opt.gravity + 3));
  EXPECT_EQ(a.opt.wind[0], 0);
  EXPECT_EQ(a.opt.density, b.opt.density);
  EXPECT_EQ(a.opt.iterations, b.opt.iterations);
  EXPECT_EQ(a.opt.impratio, b.opt.impratio);
  EXPECT_EQ(a.opt.disableflags, b.opt.disableflags);
  EXPECT_EQ(a.stat.meaninertia, b.stat.meaninertia);
  EXPECT_EQ(a.stat.meansize, b.stat.meansize);
  EXPECT_EQ(a.vis.quality.numslices, b.vis.quality.numslices);
  EXPECT_EQ(a.vis.headlight.active, b.vis.headlight.active);
  EXPECT_EQ(a.narena, b.narena);
}

TEST(RobotModel, TheFileHoldsTheRobotAlone) {
  const std::string rule = "stands beside the robot";
  const auto beside = [&](const std::string& part) {
    return RefusalOf(BelugaWith("<body name=\"base\"", part));
  };
  EXPECT_THAT(beside("<geom name='mine' type='plane' size='9 9 1'/>"),
              HasSubstr("geom mine: " + rule));
  EXPECT_THAT(beside("<body name='crate' pos='1 0 0.1'><geom size='.1'/></body>"),
              HasSubstr("body crate: " + rule));
}

// A drawer that runs out by 20 m, and a hinge far from what turns about it.
TEST(RobotModel, PartsStayNearWhereverTheirJointsTakeThem) {
  const auto carried = [&](const std::string& joint) {
    return RefusalOf(BelugaWith("<freejoint name=\"root\"/>",
                                "<body name='far'>" + joint +
                                    "<geom size='.01' mass='.01' pos='0 0 .1' contype='0' "
                                    "conaffinity='0'/></body>"));
  };
  const std::string rule = "must be within 10 m of the robot's base";
  EXPECT_THAT(carried("<joint type='slide' axis='1 0 0' range='0 20'/>"), HasSubstr(rule));
  EXPECT_THAT(carried("<joint type='hinge' axis='0 0 1' pos='6 0 0'/>"), HasSubstr(rule));
  EXPECT_THAT(carried("<joint type='slide' axis='1 0 0' range='0 0.1'/>"),
              ::testing::Not(HasSubstr(rule)));
}

TEST(RobotModel, ItsMassLiesAboveTheFloor) {
  // A weight that touches nothing.
  const auto with_keel = [](double z_m) {
    return RefusalOf(BelugaWith("<freejoint name=\"root\"/>",
                                "<geom size='.01' mass='20' contype='0' conaffinity='0' "
                                "pos='0 0 " +
                                    std::to_string(z_m) + "'/>"));
  };
  EXPECT_EQ(with_keel(0.01), "accepted");
  EXPECT_THAT(with_keel(-0.5), HasSubstr("base: the centre of mass must lie above the floor"));
}

// MuJoCo copies until no memory is left; whoever asked for it goes on.
TEST(RobotModel, WhatMuJoCoDoesNotSurviveIsRefused) {
  const std::string copies = "<replicate count='&#49;000'>";
  const std::string dut =
      RefusalOf("<mujoco><worldbody><body name='base'>" + copies + copies +
                "<geom size='.001'/></replicate></replicate></body></worldbody></mujoco>");
  EXPECT_THAT(dut, HasSubstr(".xml: MuJoCo "));
  EXPECT_THAT(dut, HasSubstr(" while it compiled this robot"));
  EXPECT_EQ(Beluga().spec.wheels.size(), 2u);
}

// BELUGA with its left wheel's joint written so.
TEST(RobotModel, AWheelTurnsAboutItsOwnAxis) {
  const auto with_joint = [](const std::string& more) {
    std::ifstream in(FindRobotFile("beluga", {}));
    std::string xml((std::istreambuf_iterator<char>(in)), {});
    const std::string joint = "<joint name=\"wheel_left\" class=\"wheel\"";
    const std::size_t at = xml.find(joint);
    EXPECT_NE(at, std::string::npos);
    return RefusalOf(xml.replace(at, joint.size(), joint + more));
  };
  EXPECT_EQ(with_joint(""), "accepted");
  EXPECT_EQ(with_joint(" pos=\"0 0.01 0\""), "accepted");
  EXPECT_EQ(with_joint(" axis=\"0 -1 0\""), "accepted");
  const std::string rule = "wheel_left: the wheel's hinge must be its cylinder's axis";
  EXPECT_THAT(with_joint(" pos=\"0.005 0 0\""), HasSubstr(rule));
  EXPECT_THAT(with_joint(" pos=\"0 0 0.005\""), HasSubstr(rule));
  EXPECT_THAT(with_joint(" axis=\"0 0 1\""), HasSubstr(rule));
  EXPECT_THAT(with_joint(" axis=\"0 1 0.05\""), HasSubstr(rule));
}

// hTetro with its four shells and bellies this half as wide. Of blocks that stand apart all are
// planned for, not one.
TEST(RobotModel, BlocksALittleApartAreOneRobot) {
  const auto with_blocks = [](double half) {
    std::stringstream text;
    text << std::ifstream(FindRobotFile("htetro", {})).rdbuf();
    const std::string half_m = std::to_string(half);
    std::string xml = std::regex_replace(text.str(), std::regex("size=\"0.125 0.125"),
                                         "size=\"" + half_m + " " + half_m);
    xml = std::regex_replace(xml, std::regex("size=\"0.060 0.120"), "size=\"0.060 " + half_m);
    return ReadRobot(RobotFile(xml).path(), {}, Blocks::kHinged).spec;
  };
  for (const double half_m : {0.116, 0.119, 0.126}) {
    const RobotSpec dut = with_blocks(half_m);
    ASSERT_EQ(dut.shapes.size(), 7u);
    const Polygon &square = dut.shapes[0].footprint_B, &corner = dut.shapes[2].footprint_B;
    EXPECT_EQ(square.size(), 4u) << half_m;
    EXPECT_NEAR(SignedArea(square), std::pow(0.25 + 2 * half_m, 2), 1e-4) << half_m;
    EXPECT_EQ(corner.size(), 6u) << half_m;
    EXPECT_NEAR(SignedArea(corner), 2 * half_m * (0.75 + 2 * half_m), 1e-4) << half_m;
  }
  EXPECT_THROW(with_blocks(1e-8), InputError);
}

// Tests of all robots are made by what their files say as text.
TEST(BundledRobots, AreWhatTheirFilesSayAsText) {
  for (const std::string& name : RobotNames()) {
    const RobotSpec dut = ReadRobot(FindRobotFile(name, {})).spec;
    EXPECT_EQ(CustomText(name, "drive"), dut.drive) << name;
    std::vector<std::string> shapes;
    for (const ShapeSpec& shape : dut.shapes) shapes.push_back(shape.name);
    EXPECT_EQ(ShapeNames(name), shapes) << name;
  }
}

TEST(RobotModel, AnUnknownRobotNamesTheNearest) {
  try {
    FindRobotFile("belugo", {"a.yaml", 3});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(),
                HasSubstr("a.yaml:3: robot = belugo: unknown robot; did you mean beluga?"));
  }
}

}  // namespace
}  // namespace floorproof

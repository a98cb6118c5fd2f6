// SPDX-License-Identifier: Apache-2.0
// Alterations, each against the law that it changes, and against what must not notice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "controllers/drive.h"
#include "env/sim/physics_plant.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

constexpr double kControl_s = 0.02;

HazardMap Floor() {
  HazardMap map;
  map.frame = {40, 40, 0.5, {-10, -10, 0}};
  map.occupancy = Grid<CellState>(40, 40);
  return map;
}

// Plates beside the way, so that there are more pairs than are kept live at once.
HazardMap FloorWithPlates() {
  HazardMap map = Floor();
  for (int i = 0; i < 30; ++i) {
    Hazard plate;
    plate.id = "plate-" + std::to_string(i);
    const Vec2 low(-6 + 0.4 * i, 1.5);
    plate.solids = {{Solid::Kind::kPrism, Rectangle(low, low + Vec2(0.3, 0.3)), {}, 0, 0.004}};
    map.hazards.push_back(std::move(plate));
  }
  return map;
}

class AlteredDrive {
 public:
  explicit AlteredDrive(const std::string& robot, HazardMap map = Floor())
      : map_(std::move(map)),
        robot_(ReadRobot(FindRobotFile(robot, {}))),
        scene_(BuildScene(map_, robot_, {}, {})),
        drive_(MakePlugin(Drives(), robot_.spec.drive, "drive")),
        wheels_(robot_.spec.wheels.size()) {
    drive_->Configure(robot_.spec);
  }

  // What it comes to at this twist.
  Truth Run(const Alterations& alterations, const BodyTwist& twist, double t_s,
            double altered_from_s = 0) {
    Simulation sim(scene_, map_, robot_.spec);
    sim.Reset({});
    drive_->ToWheels(twist, wheels_);
    sim.SetWheelSpeeds(wheels_);
    bool altered = false;
    most_torque_nm_ = 0;
    while (sim.truth().t_s < t_s) {
      if (!altered && sim.truth().t_s >= altered_from_s) {
        sim.Alter(alterations);
        altered = true;
      }
      EXPECT_TRUE(sim.Step());
      for (int a = 0; a < static_cast<int>(wheels_.size()); ++a)
        most_torque_nm_ =
            std::max(most_torque_nm_, std::abs(MotorTorque(sim.model(), sim.data(), a)));
    }
    return sim.truth();
  }
  const RobotSpec& spec() const { return robot_.spec; }
  const Scene& scene() const { return scene_; }
  const HazardMap& map() const { return map_; }
  double most_torque_nm() const { return most_torque_nm_; }

 private:
  HazardMap map_;
  RobotModel robot_;
  Scene scene_;
  std::unique_ptr<Drive> drive_;
  std::vector<double> wheels_;
  double most_torque_nm_ = 0;
};

class AlterationsOf : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Robots, AlterationsOf, ::testing::Values("beluga", "htetro"),
                         [](const auto& robot) { return std::string(robot.param); });

TEST_P(AlterationsOf, NoneIsAsBuiltToTheBit) {
  AlteredDrive dut(GetParam());
  const BodyTwist twist{0.1, 0, 0.2};
  const Truth plain = dut.Run({}, twist, 2, 1e9), none = dut.Run({}, twist, 2);
  EXPECT_EQ(plain.p_WB, none.p_WB);
  EXPECT_EQ(plain.power_w, none.power_w);
}

TEST_P(AlterationsOf, AreTakenBack) {
  AlteredDrive dut(GetParam());
  HazardMap map = Floor();
  Simulation sim(dut.scene(), map, dut.spec()), never(dut.scene(), map, dut.spec());
  Alterations all{.wheel_torque = std::vector<double>(dut.spec().wheels.size(), 0.5),
                  .floor_friction = 0.3,
                  .motor_resistance = 2,
                  .battery_voltage = 0.7,
                  .payload_kg = 5,
                  .payload_p_B = {0.1, 0, 0.2}};
  sim.Alter(all);
  sim.Alter({});
  sim.Reset({});
  never.Reset({});
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(sim.Step());
    ASSERT_TRUE(never.Step());
  }
  EXPECT_NEAR((sim.truth().p_WB - never.truth().p_WB).norm(), 0, 1e-9);
}

TEST_P(AlterationsOf, LeaveTheSharedSceneAsItWas) {
  AlteredDrive dut(GetParam());
  const BodyTwist twist{0.1, 0, 0};
  const Truth before = dut.Run({}, twist, 1);
  dut.Run({.floor_friction = 0.1, .payload_kg = 10}, twist, 1);
  EXPECT_EQ(dut.Run({}, twist, 1).p_WB, before.p_WB);
}

TEST_P(AlterationsOf, SlipperyFloorIsLeftSlower) {
  AlteredDrive dut(GetParam());
  const BodyTwist ahead{0.3, 0, 0};
  // While wheels spin, what pushes is mu m g, whatever the mass.
  constexpr double kMu = 0.8 * 0.01, kEarly_s = 0.5;
  const double least_m = dut.Run({.floor_friction = 0.01}, ahead, kEarly_s).p_WB.x();
  EXPECT_GT(dut.Run({}, ahead, kEarly_s).p_WB.x(), 2 * least_m);
  EXPECT_LT(least_m, 1.5 * kMu * 9.81 * kEarly_s * kEarly_s / 2);
}

TEST_P(AlterationsOf, StayWhenTheLivePairsAreChosenAnew) {
  // Many plates: pairs are chosen anew as it drives past them.
  AlteredDrive few(GetParam()), many(GetParam(), FloorWithPlates());
  const Alterations ice{.floor_friction = 0.01};
  const BodyTwist ahead{0.3, 0, 0};
  const double plain_m = few.Run(ice, ahead, 6).p_WB.x();
  EXPECT_NEAR(many.Run(ice, ahead, 6).p_WB.x(), plain_m, 0.02 * plain_m);
  EXPECT_GT(many.Run({}, ahead, 6).p_WB.x(), 1.2 * plain_m);
}

TEST_P(AlterationsOf, AWeakMotorGivesItsShare) {
  AlteredDrive dut(GetParam());
  const BodyTwist ahead{dut.spec().max_speed_mps, 0, 0};
  dut.Run({}, ahead, 0.2);
  const double whole_nm = dut.most_torque_nm();
  dut.Run({.wheel_torque = std::vector<double>(dut.spec().wheels.size(), 0.3)}, ahead, 0.2);
  EXPECT_LT(dut.most_torque_nm(), 0.35 * whole_nm);
  dut.Run({.wheel_torque = std::vector<double>(dut.spec().wheels.size(), 0.0)}, ahead, 0.2);
  EXPECT_LT(dut.most_torque_nm(), 1e-6);
}

// Two driven wheels: the one that is left pushes beside the centre of mass. Of sixteen Mecanum
// wheels the left eight alone determine the motion, so that it stays on its course.
TEST(Alterations, DeadMotorsOnOneSideTurnBelugaNotHtetro) {
  for (const char* robot : {"beluga", "htetro"}) {
    AlteredDrive dut(robot);
    Alterations right_dead;
    for (const WheelSpec& wheel : dut.spec().wheels)
      right_dead.wheel_torque.push_back(wheel.p_BW.y() < 0 ? 0 : 1);
    const BodyTwist ahead{0.1, 0, 0};
    EXPECT_NEAR(dut.Run({}, ahead, 3).yaw_rad, 0, 0.02) << robot;
    const double yaw_rad = dut.Run(right_dead, ahead, 3, 0.5).yaw_rad;
    if (IsHolonomic(dut.spec()))
      EXPECT_NEAR(yaw_rad, 0, 0.02);
    else
      EXPECT_LT(yaw_rad, -0.03) << "towards the dead side";
  }
}

TEST_P(AlterationsOf, APayloadPressesTheFloorAndMovesTheCentreOfMass) {
  AlteredDrive dut(GetParam());
  const HazardMap map = Floor();
  const auto mass_and_centre = [&](const Alterations& alterations) {
    Simulation sim(dut.scene(), map, dut.spec());
    sim.Alter(alterations);
    sim.Reset({});
    const int base = dut.scene().base_body;
    return std::pair(sim.model()->body_subtreemass[base], Vec3(sim.data()->subtree_com + 3 * base));
  };
  constexpr double kLoad_kg = 4;
  const Vec3 at_B(0.1, -0.05, 0.3);
  const auto [mass_kg, p] = mass_and_centre({});
  const auto [loaded_kg, p_loaded] = mass_and_centre({.payload_kg = kLoad_kg, .payload_p_B = at_B});
  EXPECT_NEAR(loaded_kg, mass_kg + kLoad_kg, 1e-9);
  EXPECT_NEAR(p_loaded.x(), (mass_kg * p.x() + kLoad_kg * at_B.x()) / loaded_kg, 2e-3);
  EXPECT_NEAR(p_loaded.y(), (mass_kg * p.y() + kLoad_kg * at_B.y()) / loaded_kg, 2e-3);
}

TEST_P(AlterationsOf, AHungryComputerIsPaidFor) {
  AlteredDrive dut(GetParam());
  const double plain_w = dut.Run({}, {}, 0.5).power_w;
  const double thrice_w = dut.Run({.hotel_load = 3}, {}, 0.5).power_w;
  EXPECT_NEAR(thrice_w - plain_w, 2 * dut.spec().hotel_load_w, 0.05 * plain_w + 1e-3);
}

TEST_P(AlterationsOf, StuckMotorsRunAsIfTheyHadBeenTold) {
  AlteredDrive dut(GetParam());
  const auto drive = MakePlugin(Drives(), dut.spec().drive, "drive");
  drive->Configure(dut.spec());
  std::vector<double> radps(dut.spec().wheels.size());
  const BodyTwist twist{0.15, 0, 0.3};
  drive->ToWheels(twist, radps);
  const Truth told = dut.Run({}, twist, 2);
  const Truth stuck = dut.Run({.wheel_stuck_radps = {radps.begin(), radps.end()}}, {-0.1, 0, 0}, 2);
  EXPECT_NEAR((stuck.p_WB - told.p_WB).norm(), 0, 0.005);
  EXPECT_GT(told.p_WB.head<2>().norm(), 0.2);
}

// Braking from a stand: what the floor gives is friction times weight, and no more.
TEST_P(AlterationsOf, SlipperyWheelsSpeedUpByTheirFriction) {
  AlteredDrive dut(GetParam());
  constexpr double kFriction = 0.03;
  const std::vector<std::optional<double>> slippery(dut.spec().wheels.size(), kFriction);
  const BodyTwist fast{0.4, 0, 0};
  const double t_s = 0.5, most_m = kFriction * 9.81 * t_s * t_s / 2;
  const double slides_m = dut.Run({.wheel_friction = slippery}, fast, t_s).p_WB.x();
  EXPECT_LT(slides_m, 1.05 * most_m);
  EXPECT_GT(slides_m, 0.4 * most_m);
  EXPECT_GT(dut.Run({}, fast, t_s).p_WB.x(), 3 * most_m);
}

TEST(Alterations, OneSlipperyWheelTurnsBelugaAsItSpeedsUp) {
  AlteredDrive dut("beluga");
  const Truth slips = dut.Run({.wheel_friction = {0.02, {}}}, {0.4, 0, 0}, 1);
  EXPECT_GT(slips.yaw_rad, 0.1) << "its left one";
  EXPECT_LT(dut.Run({.wheel_friction = {{}, 0.02}}, {0.4, 0, 0}, 1).yaw_rad, -0.1);
  EXPECT_NEAR(dut.Run({.wheel_friction = {5, 5}}, {0.4, 0, 0}, 1).yaw_rad, 0, 1e-3);
}

// A plate with less friction than the tread has rules.
TEST(Alterations, OnIceATreadThatGripsLittleGripsNoBetter) {
  HazardMap map = Floor();
  Hazard ice;
  ice.id = "ice";
  ice.material.friction = 0.02;
  ice.solids = {{Solid::Kind::kPrism, Rectangle({-5, -5}, {5, 5}), {}, 0, 0.001}};
  map.hazards.push_back(ice);
  AlteredDrive dut("beluga", map);
  const BodyTwist fast{0.4, 0, 0};
  const double on_ice_m = dut.Run({}, fast, 1).p_WB.x();
  EXPECT_LT(on_ice_m, 0.15);
  EXPECT_NEAR(dut.Run({.wheel_friction = {0.7, 0.7}}, fast, 1).p_WB.x(), on_ice_m, 0.1 * on_ice_m);
}

TEST_P(AlterationsOf, MotorsThatAreCutOffGiveNothing) {
  AlteredDrive dut(GetParam());
  const std::size_t n = dut.spec().wheels.size();
  Simulation sim(dut.scene(), dut.map(), dut.spec());
  const auto drive = MakePlugin(Drives(), dut.spec().drive, "drive");
  drive->Configure(dut.spec());
  std::vector<double> wheels(n);
  drive->ToWheels({0.2, 0, 0}, wheels);
  sim.Reset({});
  const auto run = [&](double for_s, std::span<const char> cut) {
    double most_nm = 0;
    for (const double until_s = sim.truth().t_s + for_s; sim.truth().t_s < until_s;) {
      sim.SetWheelSpeeds(wheels);
      sim.CutMotors(cut);
      EXPECT_TRUE(sim.Step());
      for (std::size_t w = 0; w < n; ++w) most_nm = std::max(most_nm, std::abs(sim.motor_nm()[w]));
    }
    return most_nm;
  };
  EXPECT_GT(run(1, {}), 0.01);
  EXPECT_GT(sim.truth().V_WB_B.vx_mps, 0.15);
  EXPECT_LT(run(5, std::vector<char>(n, 1)), 1e-9);
  EXPECT_LT(sim.truth().V_WB_B.vx_mps, 0.02) << "it rolls out";
  run(1, {});
  EXPECT_GT(sim.truth().V_WB_B.vx_mps, 0.15) << "and drives again";
}

TEST(PhysicsPlant, ARobotIsCarriedAsFarAsItCanStand) {
  HazardMap map = Floor();
  for (int iy = 0; iy < 40; ++iy) map.occupancy(23, iy) = CellState::kOccupied;  // x from 1.5 m
  const RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  const Scene scene = BuildScene(map, robot, {}, {});
  std::vector<NamedSensor> sensors;
  PhysicsPlant dut(scene, map, robot.spec, sensors, {}, kControl_s,
                   [](const std::string& name) { return Stream(7, 0, name); });
  Observation sensed;
  dut.Reset({0, 0, 0}, sensed);
  dut.Alter({.carried = Pose2{0, 1, kPi / 2}});
  EXPECT_EQ(dut.truth().carried, 1);
  EXPECT_NEAR(dut.truth().X_WB().y_m, 1, 1e-3);
  EXPECT_NEAR(dut.truth().yaw_rad, kPi / 2, 1e-3);
  dut.Alter({.carried = Pose2{0, -1.6, 0}});  // to the east, into the wall
  EXPECT_GT(dut.truth().X_WB().x_m, 1);
  EXPECT_LT(dut.truth().X_WB().x_m, 1.5 - robot.spec.inscribed_radius_m + 0.01);
  EXPECT_EQ(dut.truth().carried, 2);
  dut.Reset({0, 0, 0}, sensed);
  EXPECT_EQ(dut.truth().carried, 0);
  dut.Alter({.carried = Pose2{}});
  EXPECT_EQ(dut.truth().carried, 0) << "that is nowhere";
}

TEST(Alterations, BlockedRollersKeepAMecanumRobotFromGoingSideways) {
  AlteredDrive dut("htetro");
  const BodyTwist left{0, 0.1, 0};
  const double free_m = dut.Run({}, left, 3).p_WB.y();
  const double blocked_m =
      dut.Run({.roller_drag = std::vector<double>(dut.spec().wheels.size(), 1)}, left, 3).p_WB.y();
  EXPECT_GT(free_m, 0.25);
  EXPECT_LT(std::abs(blocked_m), 0.2 * free_m);
}

TEST(Alterations, OfWhatTheRobotHasNotAreRefused) {
  AlteredDrive dut("beluga");
  const auto why = [&](const Alterations& alterations) -> std::string {
    try {
      dut.Run(alterations, {}, 0.01);
    } catch (const InternalError& e) {
      return e.what();
    }
    return "taken";
  };
  EXPECT_THAT(why({.wheel_torque = {1, 1, 1}}), HasSubstr("wheel_torque"));
  EXPECT_THAT(why({.wheel_friction = {0.1}}), HasSubstr("wheel_friction"));
  EXPECT_THAT(why({.wheel_stuck_radps = {std::nullopt}}), HasSubstr("wheel_stuck_radps"));
  EXPECT_THAT(why({.roller_drag = {1, 1}}), HasSubstr("no rollers"));
}

TEST(PhysicsPlant, ASilentSensorTellsNothingAndItsNoiseGoesOn) {
  const HazardMap map = Floor();
  const RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  const Scene scene = BuildScene(map, robot, {}, {});
  std::vector<NamedSensor> sensors;
  for (const char* name : {"encoders", "imu", "truth"})
    sensors.push_back({name, MakePlugin(Sensors(), name, "sensor")});
  const auto drive = [&](double silent_until_s) {
    PhysicsPlant dut(scene, map, robot.spec, sensors, {}, kControl_s,
                     [](const std::string& name) { return Stream(7, 0, name); });
    Observation sensed;
    dut.Reset({}, sensed);
    const std::vector<double> wheels(robot.spec.wheels.size(), 2.0);
    bool silent = silent_until_s > 0;
    if (silent) dut.Alter({.silent_sensors = {"encoders", "imu", "truth"}});
    for (int k = 0; k < 100; ++k) {
      if (silent && dut.truth().t_s >= silent_until_s) {
        dut.Alter({});
        silent = false;
      }
      dut.Sense(sensed);
      if (silent) {
        EXPECT_EQ(sensed.wheel_rad, std::vector<double>(wheels.size(), 0.0));
        EXPECT_FALSE(sensed.has_imu);
        EXPECT_FALSE(sensed.truth.has_value());
      }
      dut.Apply({.twist = {}, .wheel_radps = wheels, .hinges = {}});
      for (int i = 0; i < 5; ++i) EXPECT_TRUE(dut.Step());
    }
    return sensed;
  };
  const Observation heard = drive(0), late = drive(1.0);
  EXPECT_EQ(heard.gyro_radps, late.gyro_radps);
  EXPECT_EQ(heard.wheel_rad, late.wheel_rad);
  ASSERT_TRUE(late.truth.has_value());
  EXPECT_EQ(heard.truth->X_WB.x_m, late.truth->X_WB.x_m);
}

}  // namespace
}  // namespace floorproof

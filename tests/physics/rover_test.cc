// SPDX-License-Identifier: Apache-2.0
// The skid-steer on flat floor and over edges, with four wheels and with six, loaded in the middle
// and not. How fast it turns is the law `skid`, too.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/run/scenario_text.h"
#include "tests/slurp.h"
#include "validate/ladder.h"
#include "validate/rig.h"

namespace floorproof {
namespace {

TEST(Rover, RestsOnFourWheelsAlike) {
  Rig dut("rover");
  for (int i = 0; i < 500; ++i) dut.Step();
  const Truth& s = dut.truth();
  EXPECT_NEAR(s.p_WB.z(), 0, 0.001);
  EXPECT_LT(s.tilt_rad, 1e-4);
  EXPECT_EQ(s.belly_load_n, 0);
  EXPECT_GT(s.support_margin_m, 0.2);
  const mjModel* m = dut.sim().model();
  for (int j = 0; j < m->njnt; ++j)
    if (m->jnt_type[j] == mjJNT_SLIDE) {
      EXPECT_NEAR(dut.data()->qpos[m->jnt_qposadr[j]], 0, 1e-4);
    }
}

TEST(Rover, RollsAsItsWheelsTurn) {
  for (const double speed_mps : {0.4, -0.3}) {
    Rig dut("rover");
    const BodyTwist v = dut.Run({speed_mps, 0, 0}, 3);
    EXPECT_NEAR(v.vx_mps, speed_mps, 0.01 * std::abs(speed_mps));
    EXPECT_NEAR(v.vy_mps, 0, 1e-4);
    EXPECT_NEAR(v.wz_radps, 0, 1e-4);
  }
}

// From rest to a turn at its full acceleration, and from full speed to a stop at once: the motors
// neither hunt nor turn it the wrong way.
TEST(Rover, GathersATurnSmoothly) {
  Rig dut("rover");
  constexpr double kControl_s = 0.02;
  const double accel = dut.robot().max_yaw_accel_radps2, most = dut.robot().max_yaw_rate_radps;
  double told = 0;
  while (dut.truth().t_s < 1) {
    told = std::min(most, told + accel * kControl_s);
    dut.Command({0, 0, told});
    for (int i = 0; i < 5; ++i) {
      dut.Step();
      EXPECT_GE(dut.truth().V_WB_B.wz_radps, -1e-6);
      EXPECT_NEAR(dut.truth().V_WB_B.wz_radps, told, 0.25) << dut.truth().t_s;
      EXPECT_LT(dut.truth().power_w, 600);
    }
  }
  dut.Run({0.3, 0, 0}, 1);
  dut.Command({});
  const double stop_s = dut.truth().t_s;
  const mjModel* m = dut.sim().model();
  while (dut.truth().t_s < stop_s + 0.5) {
    dut.Step();
    if (dut.truth().t_s < stop_s + 0.2) continue;
    for (int a = 0; a < m->nu; ++a)
      EXPECT_NEAR(dut.data()->qvel[m->jnt_dofadr[m->actuator_trnid[2 * a]]], 0, 0.05);
  }
}

TEST(Rover, MirroredCommandsGiveMirroredMotion) {
  Rig left("rover"), right("rover");
  left.Run({0.2, 0, 0.6}, 3);
  right.Run({0.2, 0, -0.6}, 3);
  const Truth &l = left.truth(), &r = right.truth();
  EXPECT_NEAR(l.p_WB.x(), r.p_WB.x(), 1e-4);
  EXPECT_NEAR(l.p_WB.y(), -r.p_WB.y(), 1e-4);
  EXPECT_NEAR(l.yaw_rad, -r.yaw_rad, 1e-4);
}

TEST(Rover, UpToItsStepItGoesUpAndDown) {
  const RobotModel robot = ReadRobot(FindRobotFile("rover", {}));
  const double size_mm = 1000 * robot.spec.step_m;
  for (const char* hazard : {"step", "drop"})
    for (const Direction direction : {Direction::kForward, Direction::kDiagonal})
      for (const double speed_mps : {0.1, 0.3}) {
        const LadderHazard& it = FindLadderHazard(hazard);
        const LadderCell cell{"rover", "ideal", it.name, direction, speed_mps, 0.8, {}};
        const CrossingPlan plan = PlanOf(cell, robot.spec, size_mm);
        EXPECT_EQ(Cross(robot, it.make(size_mm, plan.travel_rad), plan).held_by, "")
            << hazard << " " << Name(direction) << " " << speed_mps;
      }
}

// What its wheels do while it turns on the spot, a mean over two seconds, against its kinematics.
struct Turned {
  double told_radps = 0, truly_radps = 0;  // yaw rates: as its wheels say, and true
  double told_mps = 0, truly_mps = 0;      // of the body's origin to the left
};
Turned TurnOnTheSpot(Rig& dut, const Drive& drive) {
  std::vector<double> wheels(dut.robot().wheels.size()), mean(wheels.size());
  constexpr int kSteps = 500;
  Turned out;
  drive.ToWheels({0, 0, 0.9}, wheels);
  dut.sim().SetWheelSpeeds(wheels);
  for (int k = 0; k < 2 * kSteps; ++k) {
    dut.Step();
    if (k < kSteps) continue;
    const mjModel* m = dut.sim().model();
    for (std::size_t w = 0; w < mean.size(); ++w)
      mean[w] += dut.data()->qvel[m->jnt_dofadr[m->actuator_trnid[2 * w]]] / kSteps;
    out.truly_radps += dut.truth().V_WB_B.wz_radps / kSteps;
    out.truly_mps += dut.truth().V_WB_B.vy_mps / kSteps;
  }
  const BodyTwist told = drive.ToTwist(mean);
  out.told_radps = told.wz_radps;
  out.told_mps = told.vy_mps;
  return out;
}

// 8 kg on its nose: the front wheels hold, the rear ones slide, and it turns about a point ahead of
// its middle. Of a drive that took the load to be in the middle both would be far off. The front
// tyres hardly slide, and creep for their grip: the point lies 7 % farther ahead than without.
TEST(Rover, ALoadOffTheMiddleMovesWhatItTurnsAbout) {
  Rig dut("rover", {.friction = 0.4});
  const Vec3 load_B(0.2, 0, 0.26);
  constexpr double kLoad_kg = 8;
  dut.sim().Alter({.payload_kg = kLoad_kg, .payload_p_B = load_B});
  RobotSpec loaded = dut.robot();
  loaded.p_BCom =
      (loaded.mass_kg * loaded.p_BCom + kLoad_kg * load_B) / (loaded.mass_kg + kLoad_kg);
  const auto drive = MakePlugin(Drives(), loaded.drive, "drive");
  drive->Configure(dut.robot());
  const Turned unaware = TurnOnTheSpot(dut, *drive);
  EXPECT_GT(unaware.truly_radps, 1.08 * unaware.told_radps);
  EXPECT_LT(unaware.truly_mps, unaware.told_mps - 0.03);
  drive->Configure(loaded);
  const Turned aware = TurnOnTheSpot(dut, *drive);
  EXPECT_NEAR(aware.truly_radps, aware.told_radps, 0.02 * aware.told_radps);
  EXPECT_NEAR(aware.truly_mps, aware.told_mps, 0.10 * std::abs(aware.told_mps));
}

class SixWheels : public ScenarioTest {
 protected:
  // The rover with a third pair of wheels in its middle, which is as heavy again by their weight.
  std::string File() const {
    std::string xml = Slurp(FindRobotFile("rover", {}));
    const auto before = [&xml](const std::string& what, const std::string& put) {
      const std::size_t at = xml.find(what);
      ASSERT_NE(at, std::string::npos);
      xml.insert(at, put);
    };
    std::string bodies, motors;
    for (const std::string side : {"left", "right"}) {
      bodies += "<body name=\"middle_" + side + "\" pos=\"0 " +
                (side == "left" ? "0.25" : "-0.25") + " 0.08\"><joint name=\"spring_middle_" +
                side + "\" class=\"spring\"/><joint name=\"middle_" + side +
                "\" class=\"wheel\"/><geom class=\"wheel\" zaxis=\"0 1 0\"/></body>";
      motors +=
          "<dcmotor name=\"middle_" + side + "\" joint=\"middle_" + side + "\" class=\"wheel\"/>";
    }
    before("<body name=\"front_left\"", bodies);
    before("<dcmotor name=\"front_left\"", motors);
    return Save("six.xml", xml).string();
  }
};

// The middle wheels hardly slide across, and hold the robot's sides: it turns faster for its wheels
// than one without them, by the root of 2 (a^2 - b s) / sqrt(a^2 + s^2) = b.
TEST_F(SixWheels, TurnAsTheirFrictionBalances) {
  for (const double mu : {0.4, 0.8}) {
    Rig dut(File(), {.friction = mu});
    ASSERT_EQ(dut.robot().wheels.size(), 6u);
    double a = 0, b = 0;
    for (const WheelSpec& wheel : dut.robot().wheels) {
      a = std::max(a, wheel.p_BW.x());
      b = std::max(b, wheel.p_BW.y());
    }
    double low = 0, high = a * a / b;
    for (int i = 0; i < 60; ++i) {
      const double s = (low + high) / 2;
      (2 * (a * a - b * s) > b * std::hypot(a, s) ? low : high) = s;
    }
    const auto drive = MakePlugin(Drives(), dut.robot().drive, "drive");
    drive->Configure(dut.robot());
    const Turned turned = TurnOnTheSpot(dut, *drive);
    std::vector<double> wheels(6);
    drive->ToWheels({0, 0, 1}, wheels);
    EXPECT_NEAR(wheels[1] * dut.robot().wheels[1].radius_m, b + low, 1e-6);
    EXPECT_NEAR(turned.truly_radps, turned.told_radps, 0.015 * turned.told_radps) << mu;
    EXPECT_GT(turned.truly_radps, 1.3 * turned.told_radps * (b + low) / (b + a * a / b)) << mu;
  }
}

// One motor gives nothing: its wheel is dragged along, and the two others of its side go on.
TEST_F(SixWheels, DriveOnWithoutOne) {
  Rig dut(File());
  dut.sim().CutMotors(std::vector<char>{1, 0, 0, 0, 0, 0});
  const BodyTwist v = dut.Run({0.3, 0, 0}, 3);
  EXPECT_NEAR(v.vx_mps, 0.3, 0.01 * 0.3);
  EXPECT_NEAR(v.wz_radps, 0, 0.005);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Robots on casters that swivel, slide on springs or do not move at all, from files as users write
// them. How a caster comes to trail behind is the law `caster`, springs are the law `suspension`.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "env/scene/driving_power.h"
#include "tests/run/scenario_text.h"
#include "validate/rig.h"

namespace floorproof {
namespace {

constexpr double kPivot_m = 0.30, kTrail_m = 0.04;  // behind the axle; behind the pivot

// Two driven wheels, and this behind them.
std::string Robot(const std::string& caster) {
  return R"(<mujoco model="trailing">
  <custom>
    <text name="drive" data="differential"/>
    <text name="clear_shape" data="circle"/>
    <text name="tool_shape" data="circle"/>
    <numeric name="tool_width_m" data="0.30"/>
    <numeric name="step_m" data="0.005"/>
    <numeric name="cruise_mps" data="0.2"/>
    <numeric name="max_speed_mps" data="0.35"/>
    <numeric name="max_accel_mps2" data="0.5"/>
    <numeric name="max_yaw_rate_radps" data="1.5"/>
    <numeric name="max_yaw_accel_radps2" data="4.0"/>
    <numeric name="hotel_load_w" data="5"/>
  </custom>
  <compiler angle="radian" autolimits="true"/>
  <default>
    <default class="body"><geom contype="0" conaffinity="3" friction="0.3 0.005 0.0001"/></default>
    <default class="wheel">
      <geom type="cylinder" size="0.06 0.006" zaxis="0 1 0" contype="0" conaffinity="1" mass="0.5"/>
      <joint type="hinge" axis="0 1 0" armature="0.004" damping="0.002" frictionloss="0.02"/>
      <dcmotor nominal="12 4 10" input="vel" controller="0 0 10 0 0 12"/>
    </default>
  </default>
  <worldbody>
    <body name="base">
      <freejoint name="root"/>
      <geom class="body" type="box" size="0.2 0.16 0.05" pos="-0.1 0 0.12" mass="12"/>
      <body name="left" pos="0 0.17 0.06"><joint name="left" class="wheel"/><geom class="wheel"/></body>
      <body name="right" pos="0 -0.17 0.06"><joint name="right" class="wheel"/><geom class="wheel"/></body>
)" + caster +
         R"(    </body>
  </worldbody>
  <actuator>
    <dcmotor name="left" joint="left" class="wheel"/>
    <dcmotor name="right" joint="right" class="wheel"/>
  </actuator>
</mujoco>)";
}

// A fork that swivels freely, its wheel this far ahead of the pivot.
std::string Swivel(double ahead_m) {
  return R"(<body name="fork" pos="-0.30 0 0.03"><joint name="swivel" axis="0 0 1" damping="0.0005"/>
    <geom type="box" size="0.01 0.01 0.01" mass="0.2" contype="0" conaffinity="0"/>
    <body name="caster" pos=")" +
         std::to_string(ahead_m) + R"( 0 0">
      <joint name="caster" axis="0 1 0" frictionloss="0.02" damping="0.004"/>
      <geom type="sphere" size="0.03" mass="0.3" contype="0" conaffinity="1"/>
    </body></body>)";
}
constexpr char kBall[] =
    R"(<body name="ball" pos="-0.30 0 0.02"><geom type="sphere" size="0.02" mass="0.1" contype="0"
      conaffinity="1" priority="2" friction="0.03 0 0"/></body>)";
constexpr char kSprungBall[] =
    R"(<body name="ball" pos="-0.30 0 0.02">
      <joint type="slide" axis="0 0 1" stiffness="3000" springref="-0.006" damping="60"/>
      <geom type="sphere" size="0.02" mass="0.3" contype="0" conaffinity="1" priority="2"
      friction="0.03 0 0"/></body>)";

class Casters : public ScenarioTest {
 protected:
  std::string File(const std::string& caster) const {
    return Save("robot.xml", Robot(caster)).string();
  }
};

// Wherever it points, the robot is clear of it; and it carries where it was left last, at worst
// towards the centre of mass.
TEST_F(Casters, ThatSwivelAreTakenAtTheirWorst) {
  for (const double ahead_m : {-kTrail_m, kTrail_m}) {
    const RobotSpec dut = ReadRobot(File(Swivel(ahead_m))).spec;
    EXPECT_NEAR(dut.clear.radius_m, kPivot_m + kTrail_m + 0.03, 1e-3) << ahead_m;
    // The line through the left wheel's outer end that passes the caster's circle on the inside.
    const Vec2 wheel(0, 0.176), pivot(-kPivot_m, 0), com = dut.p_BCom.head<2>();
    const double far_m = (wheel - pivot).norm();
    const double along_rad = std::atan2((wheel - pivot).y(), (wheel - pivot).x());
    const double normal_rad = along_rad + std::acos(-kTrail_m / far_m);
    const double d = (wheel - com).dot(Vec2(std::cos(normal_rad), std::sin(normal_rad)));
    EXPECT_NEAR(std::tan(dut.static_tip_rad), d / dut.p_BCom.z(), 0.01 * d / dut.p_BCom.z());
  }
  // The same place without a swivel carries more surely.
  EXPECT_GT(ReadRobot(File(kBall)).spec.static_tip_rad,
            1.1 * ReadRobot(File(Swivel(-kTrail_m))).spec.static_tip_rad);
}

TEST_F(Casters, ThatMaySwivelFromUnderTheRobotAreRefused) {
  std::string heavy = Robot(Swivel(-kTrail_m));
  const std::string at = "pos=\"-0.1 0 0.12\"";
  heavy.replace(heavy.find(at), at.size(), "pos=\"-0.29 0 0.12\"");
  try {
    ReadRobot(Save("robot.xml", heavy));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("casters swivelled"), std::string::npos)
        << error.what();
  }
}

// As it turns on the spot, its pivot runs on a circle: where the wheel's axle passes the middle of
// that circle it does not slide: trail / arm is the sine of what it lacks of a quarter turn from
// the arm.
TEST_F(Casters, TrailAlongTheCircleOfATurn) {
  for (const double turn_radps : {0.5, -0.5}) {
    Rig dut(File(Swivel(-kTrail_m)));
    dut.Run({0, 0, turn_radps}, 8);
    const mjModel* m = dut.sim().model();
    const double swivelled = dut.data()->qpos[m->jnt_qposadr[mj_name2id(m, mjOBJ_JOINT, "swivel")]];
    EXPECT_NEAR(std::abs(swivelled), kPi - std::acos(kTrail_m / kPivot_m), 0.01);
    EXPECT_LT(swivelled * turn_radps, 0);
  }
}

// Backing off from where they trailed they come round, and the robot drives as it is told.
TEST_F(Casters, ComeRoundAsTheRobotBacksOff) {
  Rig dut(File(Swivel(-kTrail_m)));
  dut.Run({0.1, 0, 0.4}, 4);  // askew first
  const BodyTwist back = dut.Run({-0.2, 0, 0}, 4);
  EXPECT_NEAR(back.vx_mps, -0.2, 0.01 * 0.2);
  EXPECT_NEAR(back.wz_radps, 0, 0.005);
  const mjModel* m = dut.sim().model();
  const double swivelled = dut.data()->qpos[m->jnt_qposadr[mj_name2id(m, mjOBJ_JOINT, "swivel")]];
  EXPECT_NEAR(std::abs(WrapAngle(swivelled)), kPi, 0.05);
}

// What the motors draw straight ahead is what plans are told: bearings of what rolls, friction of
// what slides, by its spring or by the weight that statics puts on it.
TEST_F(Casters, CostWhatPlansAreTold) {
  constexpr double kSpeed_mps = 0.2;
  double none_w = 0;
  for (const auto& [caster, least] :
       {std::pair<std::string, double>(Swivel(-kTrail_m), 1.1), {kBall, 1.1}, {kSprungBall, 1.1}}) {
    Rig dut(File(caster));
    dut.Run({kSpeed_mps, 0, 0}, 2);
    double drawn_w = 0;
    constexpr int kSteps = 500;
    for (int i = 0; i < kSteps; ++i) {
      dut.Step();
      drawn_w += (dut.truth().power_w - dut.robot().hotel_load_w) / kSteps;
    }
    const RobotModel robot = ReadRobot(File(caster));
    const ModelPtr model(mj_compile(robot.mjcf.get(), nullptr));
    const double told_w = SteadyMotorsPower(model.get(), robot.spec, kSpeed_mps);
    EXPECT_NEAR(drawn_w, told_w, 0.03 * told_w) << caster;
    // The wheels' own bearings: the least that there is to pay.
    const double omega = kSpeed_mps / 0.06, torque_nm = 0.02 + 0.002 * omega;
    const mjtNum* gain = model->actuator_gainprm;
    none_w = 2 * MotorPower(torque_nm, omega, gain[0], gain[1]);
    EXPECT_GT(told_w, least * none_w) << caster;
  }
}

}  // namespace
}  // namespace floorproof

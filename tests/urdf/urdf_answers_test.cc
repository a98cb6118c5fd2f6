// SPDX-License-Identifier: Apache-2.0
// Springs under driven wheels, rollers on them, and motors whose current is limited: what a URDF
// cannot say, answered.
#include <gmock/gmock.h>

#include "tests/urdf/urdf_files.h"
#include "tests/validate/wrongs.h"
#include "validate/steady_drive.h"

namespace floorproof {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

UrdfAnswers Sprung(double share, double travel_m) {
  UrdfAnswers answers;
  answers.sprung_share = share;
  if (share > 0) answers.spring_travel_m = travel_m;
  return answers;
}

std::string BallAt(const std::string& name, const std::string& x_m) {
  return Replaced(Replaced(kBall, "-0.14", x_m), "ball", name);
}
// Casters before and behind the axle, as far: held, the driven wheels carry next to nothing.
std::string OnTwoBalls() {
  return std::string(kBase) + BallAt("ahead", "0.12") + BallAt("behind", "-0.16") + "</robot>\n";
}
std::string Wheel(const std::string& name, double x_m, double y_m) {
  return "<link name=\"" + name +
         "\"><inertial><mass value=\"0.3\"/><inertia ixx=\"3e-4\" iyy=\"5e-4\" izz=\"3e-4\" "
         "ixy=\"0\" "
         "ixz=\"0\" iyz=\"0\"/></inertial><collision><origin rpy=\"1.5707963267948966 0 "
         "0\"/><geometry>"
         "<cylinder radius=\"0.05\" length=\"0.02\"/></geometry></collision></link><joint name=\"" +
         name + "_joint\" type=\"continuous\"><parent link=\"base_link\"/><child link=\"" + name +
         "\"/><origin xyz=\"" + std::to_string(x_m) + " " + std::to_string(y_m) +
         " 0.02\"/><axis xyz=\"0 1 0\"/></joint>\n";
}
// Two more wheels, 0.2 m behind: the centre of mass is not in the middle.
std::string OnFourWheels() {
  return std::string(kBase) + Wheel("left_rear", -0.2, 0.12) + Wheel("right_rear", -0.2, -0.12) +
         "</robot>\n";
}

TEST(WheelSprings, AreAskedForBetweenCastersAlone) {
  using ::testing::Contains;
  const auto asks = Contains(HasSubstr("--set sprung_share"));
  EXPECT_THAT(Converted(OnTwoBalls()).notes, asks);
  EXPECT_THAT(Converted(OnTwoBalls(), Sprung(0.5, 0.006)).notes, ::testing::Not(asks));
  EXPECT_THAT(Converted(WithBall()).notes, ::testing::Not(asks));
}

TEST(WheelSprings, CarryTheShareOfTheWeightThatIsAsked) {
  // The casters' contacts give by some tenths of a millimetre, and so do the springs.
  constexpr double kTravel_m = 0.01, kGives_m = 0.0005;
  for (const double share : {0.4, 0.7}) {
    const RobotCheck dut =
        CheckRobot(ConvertedFile(OnTwoBalls(), Sprung(share, kTravel_m)).string());
    EXPECT_NEAR(dut.drive.driven_share, share, share * kGives_m / kTravel_m);
    EXPECT_THAT(Wrongs(dut), IsEmpty());
  }
}

TEST(WheelSprings, NeedAShare) {
  UrdfAnswers answers;
  answers.spring_preload = 0.5;
  EXPECT_THAT(RefusalOf(OnTwoBalls(), answers),
              HasSubstr("--set spring_preload: 0.5: needs sprung_share"));
}

TEST(UrdfMotors, HaveTheRotorsThatAreAsked) {
  UrdfAnswers answers;
  answers.armature_kgm2 = 0.0123;
  EXPECT_THAT(Converted(WithBall(), answers).text, HasSubstr("armature=\"0.0123\""));
  EXPECT_THAT(Converted(WithBall()).notes, Contains(HasSubstr("--set armature_kgm2")));
}

// At rest they carry as much; where the wheel hangs lowest, their preload.
TEST(WheelSprings, PushWithTheirPreloadWhereTheyHangLowest) {
  constexpr double kTravel_m = 0.01, kShare = 0.5;
  for (const double preload : {0.0, 0.5, 0.9}) {
    UrdfAnswers answers = Sprung(kShare, kTravel_m);
    answers.spring_preload = preload;
    const auto file = ConvertedFile(OnTwoBalls(), answers);
    const ModelPtr m = CompileAlone(ReadRobot(file));
    int springs = 0;
    for (int j = 0; j < m->njnt; ++j) {
      if (m->jnt_type[j] != mjJNT_SLIDE) continue;
      ++springs;
      const auto push_n = [&](double q) {
        return m->jnt_stiffness[j] * (m->qpos_spring[m->jnt_qposadr[j]] - q);
      };
      EXPECT_NEAR(push_n(-kTravel_m) / push_n(0), preload, 1e-6);
    }
    EXPECT_EQ(springs, 2);
    // The softer a spring, the less it feels that the casters give.
    EXPECT_NEAR(CheckRobot(file.string()).drive.driven_share, kShare,
                0.025 * (1 - preload) + 0.001);
  }
}

// It stands level and at its height, though its mass is nearer to the front wheels.
TEST(WheelSprings, CarryARobotWithoutCastersLevel) {
  const RobotCheck dut = CheckRobot(ConvertedFile(OnFourWheels(), Sprung(0.5, 0.006)).string());
  EXPECT_EQ(dut.spec.drive, "skid_steer");
  EXPECT_NEAR(dut.drive.driven_share, 1, 0.01);
  for (const LawRow& row : dut.drive.rows) {
    if (!row.law.starts_with("stand/")) continue;
    EXPECT_LT(std::abs(row.measured), row.tolerance / 5) << row.law;
  }
}

// Nothing said of the motors, the mass in the middle: it turns by sliding.
TEST(UrdfMotors, AreGuessedStrongEnoughToTurnASkidSteer) {
  const std::string text = Replaced(OnFourWheels(), "-0.02 0 0.05", "-0.1 0 0.05");
  for (const double share : {0.0, 1.0})
    EXPECT_THAT(Wrongs(CheckRobot(ConvertedFile(text, Sprung(share, 0.006)).string())), IsEmpty());
}

TEST(UrdfStandstill, IsGuessedByTheMassOrGiven) {
  const auto light = Converted(WithBall(), {});
  EXPECT_THAT(light.text, HasSubstr("<text name=\"standstill\" data=\"hold\"/>  <!-- guess: "));
  EXPECT_THAT(light.notes,
              Contains(HasSubstr("guess: standstill hold, robots of more than 40 kg")));
  const std::string heavy = Replaced(WithBall(), "<mass value=\"5\"/>", "<mass value=\"50\"/>");
  EXPECT_EQ(ReadRobot(ConvertedFile(heavy, {})).spec.standstill, Standstill::kBrake);
  UrdfAnswers answers;
  answers.standstill = "free";
  EXPECT_EQ(ReadRobot(ConvertedFile(heavy, answers)).spec.standstill, Standstill::kFree);
  EXPECT_THAT(Converted(heavy, answers).notes, Not(Contains(HasSubstr("standstill"))));
}

TEST(UrdfTyres, AreGuessedOrGiven) {
  const auto guessed = Converted(WithBall(), {});
  EXPECT_THAT(guessed.text, HasSubstr("<text name=\"tyre\" data=\"hard_rubber\"/>  <!-- guess: "));
  EXPECT_THAT(guessed.notes, Contains(HasSubstr("guess: caster polyurethane, ")));
  UrdfAnswers answers;
  answers.tyre = "soft_rubber";
  const auto stiffness = [](const std::filesystem::path& file) {
    const RobotModel robot = ReadRobot(file);
    return std::ranges::find_if(robot.feet, &Foot::driven)->tyre.stiffness_npm;
  };
  EXPECT_LT(stiffness(ConvertedFile(WithBall(), answers)),
            0.6 * stiffness(ConvertedFile(WithBall(), {})));
}

TEST(UrdfMotors, ACurrentLimitIsTheTorqueThatTheyGive) {
  UrdfAnswers answers;
  answers.stall_nm = 4;
  answers.peak_nm = 1.5;
  answers.friction_nm = 0.11;
  const auto file = ConvertedFile(WithBall(), answers);
  EXPECT_NEAR(ReadRobot(file).spec.wheels[0].max_torque_nm, 1.5, 1e-9);
  EXPECT_THAT(Converted(WithBall(), answers).text, HasSubstr("frictionloss=\"0.11\""));
  // Two wheels of 50 mm.
  EXPECT_NEAR(CheckRobot(file.string()).drive.rolling_n, 2 * 0.11 / 0.05, 0.4);
}

// A kilogram on wheels of 30 g, driven by servos: 9 times its weight at the rims.
std::string OnServos() {
  std::string text = Replaced(WithBall(), "<mass value=\"5\"/>", "<mass value=\"0.94\"/>");
  text = Replaced(text, "<mass value=\"0.3\"/>", "<mass value=\"0.03\"/>");
  text = Replaced(text, "ixx=\"0.03\" iyy=\"0.04\" izz=\"0.06\"",
                  "ixx=\"0.006\" iyy=\"0.008\" izz=\"0.012\"");
  return Replaced(Replaced(text, "3e-4", "1e-5"), "5e-4", "2e-5");
}
UrdfAnswers Servos() {
  UrdfAnswers answers;
  answers.no_load_radps = 6.4;
  answers.stall_nm = 2.3;
  answers.max_speed_mps = 0.25;
  answers.cruise_mps = 0.15;
  return answers;
}

// Of its motors, when it is asked for a speed at once; as a share of what holding that speed takes.
double PowerShare(const std::filesystem::path& file) {
  constexpr double kSpeed_mps = 0.1;
  Rig rig(file.string());
  rig.Run({kSpeed_mps, 0, 0}, 2);
  double sum_w = 0;
  int n = 0;
  for (; rig.truth().t_s < 3; ++n) {
    rig.Step();
    sum_w += MotorsPower(rig);
  }
  return sum_w / n / DriveSteadily(rig, kSpeed_mps, 0).power_w;
}

// The error of the wheels' speeds in the air, as a share of the commanded speed.
double SpeedError(const std::filesystem::path& file) {
  constexpr double kSpeed_mps = 0.1;
  Rig rig(file.string());
  rig.SetGravity({0, 0, 0.1});
  rig.Run({kSpeed_mps, 0, 0}, 2);
  double sum = 0;
  int n = 0;
  for (; rig.truth().t_s < 3; ++n) {
    rig.Step();
    sum += std::abs(rig.truth().rim_mps / kSpeed_mps - 1);
  }
  return sum / n;
}

// With rotors that weigh next to nothing the drivers hunt from stop to stop in the air.
TEST(UrdfMotors, StrongOnesDoNotHunt) {
  EXPECT_NEAR(PowerShare(ConvertedFile(OnServos(), Servos())), 1, 0.2);
  std::string text = Converted(OnServos(), Servos()).text;
  const std::size_t at = text.find("armature=\"") + 10;
  text.replace(at, text.find('"', at) - at, "0.0001");
  const auto file = OwnFolder() / "hunts.xml";
  std::ofstream(file) << text;
  EXPECT_LT(SpeedError(ConvertedFile(OnServos(), Servos())), 0.1);
  EXPECT_GT(SpeedError(file), 1);
}

TEST(UrdfRollers, MakeMecanumWheelsOfPlainOnes) {
  UrdfAnswers answers;
  answers.roller_radius_m = 0.01;
  answers.sprung_share = 1;
  answers.top_speed_mps = 0.3;  // slow enough that it bounds the yaw rate that is guessed
  const RobotCheck dut = CheckRobot(ConvertedFile(OnFourWheels(), answers).string());
  EXPECT_EQ(dut.spec.drive, "mecanum");
  for (const WheelSpec& wheel : dut.spec.wheels) {
    EXPECT_NEAR(wheel.radius_m, 0.05, 1e-7);
    EXPECT_NEAR(wheel.roller_radius_m, 0.01, 1e-7);
    EXPECT_GT(wheel.roller_angle_rad * wheel.p_BW.x() * wheel.p_BW.y(), 0) << wheel.name;
  }
  EXPECT_THAT(Wrongs(dut), IsEmpty());
}

// A URDF's cylinders do not say; a robot of two wheels has none.
TEST(UrdfRollers, AreAskedFor) {
  using ::testing::Contains;
  EXPECT_THAT(Converted(OnFourWheels()).notes, Contains(HasSubstr("--set roller_radius_m")));
  UrdfAnswers answers;
  answers.roller_radius_m = 0.01;
  for (const UrdfMjcf& said : {Converted(OnFourWheels(), answers), Converted(WithBall())})
    EXPECT_THAT(said.notes, ::testing::Not(Contains(HasSubstr("--set roller_radius_m"))));
}

TEST(UrdfRollers, AreSmallerThanTheirWheel) {
  UrdfAnswers answers;
  answers.roller_radius_m = 0.05;
  EXPECT_THAT(RefusalOf(OnFourWheels(), answers),
              HasSubstr("--set roller_radius_m: 0.05: must be less than the radius of wheel"));
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What the check says of robots whose URDF is right, and which drive in a way of their own.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/urdf/urdf_files.h"
#include "validate/robot_check.h"

namespace floorproof {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> LinesOf(const RobotCheck& check) {
  std::vector<std::string> lines;
  for (const Finding& finding : check.findings) lines.push_back(finding.Line());
  return lines;
}

// 18 kg on four wheels of 98 mm, wheelbase 260 mm, track 380 mm; the centre of mass this far ahead
// of their middle.
std::string SkidSteer(double ahead_m) {
  std::string wheels;
  for (const double x : {0.13, -0.13})
    for (const double y : {0.19, -0.19}) {
      const std::string name = std::string(x > 0 ? "front" : "rear") + (y > 0 ? "_left" : "_right");
      wheels += fmt::format(
          R"(<link name="{0}"><inertial><mass value="0.5"/><inertia ixx="0.0013" iyy="0.0024" izz="0.0013" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><origin rpy="1.5708 0 0"/><geometry><cylinder radius="0.098" length="0.04"/></geometry></collision></link>
<joint name="{0}_joint" type="continuous"><parent link="base"/><child link="{0}"/><origin xyz="{1} {2} 0.098"/><axis xyz="0 1 0"/></joint>)",
          name, x, y);
    }
  return fmt::format(
             R"(<robot name="skid"><link name="base"><inertial><origin xyz="{} 0 0.13"/><mass value="16"/><inertia ixx="0.3" iyy="0.4" izz="0.4" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><origin xyz="0 0 0.155"/><geometry><box size="0.42 0.3 0.185"/></geometry></collision></link>)",
             ahead_m * 18 / 16) +
         wheels + "</robot>";
}

// Wheels that slide give way where they carry less: it turns about a point on its load's side. That
// is what such a robot does, and not wrong.
TEST(CheckedUrdf, ASkidSteerTurnsOnTheSideOfItsLoad) {
  for (const double ahead_m : {0.0, 0.02, -0.02}) {
    const RobotCheck dut = CheckRobot(ConvertedFile(SkidSteer(ahead_m)).string());
    EXPECT_TRUE(dut.ok()) << ahead_m;
    EXPECT_EQ(dut.drive.turns_about_m.has_value(), ahead_m != 0) << ahead_m;
    if (ahead_m == 0) continue;
    EXPECT_GT(*dut.drive.turns_about_m * ahead_m, 0);
    EXPECT_THAT(LinesOf(dut), Contains(AllOf(HasSubstr("note: it turns about a point"),
                                             HasSubstr(ahead_m > 0 ? "ahead of" : "behind"))));
  }
}

// At the foot of 1:12 the caster ahead, at a = 0.14 m, is a / 12 higher than the one as far behind:
// the axle between hangs by half of that.
TEST(CheckedUrdf, ARigidAxleBetweenCastersIsNoted) {
  const std::string front =
      Replaced(Replaced(kBall, "ball", "front"), "xyz=\"-0.14 0", "xyz=\"0.14 0");
  const auto lines = [&](const std::string& text, const UrdfAnswers& answers = {}) {
    return LinesOf(CheckRobot(ConvertedFile(text, answers).string()));
  };
  EXPECT_THAT(lines(WithBall(front)),
              Contains(AllOf(HasSubstr("note: its driven axle is between casters"),
                             HasSubstr("the driven wheels are 5.83 mm"))));
  const auto none = Not(Contains(HasSubstr("between casters")));
  EXPECT_THAT(lines(WithBall()), none);
  UrdfAnswers sprung;
  sprung.sprung_share = 0.6;
  EXPECT_THAT(lines(WithBall(front), sprung), none);
}

}  // namespace
}  // namespace floorproof

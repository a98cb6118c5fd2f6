// SPDX-License-Identifier: Apache-2.0
// From a URDF to a robot that is read, checked and driven as any other.
#include "env/urdf/urdf_mjcf.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/places.h"
#include "tests/urdf/urdf_files.h"
#include "tests/validate/wrongs.h"

namespace floorproof {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// The figures that the URDF states come back from the MJCF.
TEST(UrdfMjcf, TheRobotIsTheUrdfs) {
  const RobotSpec dut = ReadRobot(ConvertedFile(WithBall())).spec;
  ASSERT_EQ(dut.wheels.size(), 2u);
  EXPECT_NEAR(dut.wheels[0].radius_m, 0.05, 1e-7);
  EXPECT_NEAR(dut.wheels[0].p_BW.y() - dut.wheels[1].p_BW.y(), 0.24, 1e-7);
  EXPECT_NEAR(dut.mass_kg, 5.6, 1e-6);
  EXPECT_NEAR(dut.p_BCom.x(), -0.02 * 5 / 5.6, 1e-6);
  EXPECT_NEAR(dut.p_BCom.z(), (5 * 0.08 + 0.6 * 0.05) / 5.6, 1e-6);
  EXPECT_NEAR(dut.clearance_m, 0.03, 1e-6);
  EXPECT_NEAR(dut.height_m, 0.13, 1e-6);
  EXPECT_EQ(dut.clear.kind, Shape2::Kind::kCircle);
}

TEST(UrdfMjcf, ItDrivesAsItsKinematicsSays) {
  EXPECT_THAT(Wrongs(CheckRobot(ConvertedFile(WithBall()))), IsEmpty());
}

TEST(UrdfMjcf, ItDrivesOnACasterThatSwivels) {
  const RobotCheck dut = CheckRobot(ConvertedFile(WithSwivel()));
  EXPECT_THAT(Wrongs(dut), IsEmpty());
  EXPECT_EQ(dut.stance.carriers.size(), 3u);
}

TEST(UrdfMjcf, EveryGuessIsMarkedAndNoneIsWhereTheUserAnswers) {
  UrdfAnswers answers;
  answers.no_load_radps = 14;
  answers.stall_nm = 0.9;
  answers.cruise_mps = 0.3;
  answers.max_speed_mps = 0.5;
  answers.tool_width_m = 0.22;
  const std::string text = Converted(WithBall(), answers).text;
  EXPECT_THAT(text, HasSubstr("data=\"0.22\"/>  <!-- given -->"));
  EXPECT_THAT(text, HasSubstr("<!-- stall torque: given -->"));
  EXPECT_THAT(text, HasSubstr("<dcmotor nominal=\"12 0.9 14\""));
  EXPECT_THAT(Converted(WithBall()).text, HasSubstr("<!-- stall torque: guess: "));
  const RobotSpec dut = ReadRobot(ConvertedFile(WithBall(), answers)).spec;
  EXPECT_NEAR(dut.cruise_mps, 0.3, 1e-12);
  EXPECT_NEAR(dut.wheels[0].max_torque_nm, 0.9, 1e-9);
  EXPECT_NEAR(dut.wheels[0].max_speed_radps, 14, 1e-9);
}

// Each guess that a key answers is a line; what was answered is not asked again.
TEST(UrdfMjcf, AsksForWhatTheUrdfCannotSay) {
  EXPECT_THAT(Converted(WithBall()).notes, Contains(HasSubstr("(--set stall_nm=...)")));
  UrdfAnswers answers;
  answers.stall_nm = 0.9;
  const auto notes = Converted(WithBall(), answers).notes;
  EXPECT_THAT(notes, Not(Contains(HasSubstr("(--set stall_nm=...)"))));
  EXPECT_THAT(notes, Contains(HasSubstr("(--set tool_width_m=...)")));
}

TEST(UrdfMjcf, LimitsOfTheUrdfAreTakenWhereTheyCanBe) {
  const auto with = [](const std::string& limit) {
    return ReadRobot(ConvertedFile(Replaced(WithBall(), "<axis xyz=\"0 0 1\"/>",
                                            "<axis xyz=\"0 0 1\"/>" + limit)))
        .spec.wheels[0];
  };
  const WheelSpec stated = with("<limit effort=\"0.7\" velocity=\"11\"/>");
  EXPECT_NEAR(stated.max_speed_radps, 11, 1e-9);
  EXPECT_NEAR(stated.max_torque_nm, 0.7, 1e-9);
  const WheelSpec placeholder = with("<limit effort=\"1000\" velocity=\"1000\"/>");
  EXPECT_LT(placeholder.max_speed_radps, 100);
  EXPECT_LT(placeholder.max_torque_nm, 10);
}

// A geared servo pushes with many times the weight; what a robot so light cannot carry is said.
TEST(UrdfMjcf, AServosEffortIsTakenAndAPlaceholdersIsSaid) {
  const auto with = [](const std::string& limit) {
    return Converted(Replaced(WithBall(), "<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 1\"/>" + limit))
        .notes;
  };
  const auto servo = with("<limit effort=\"20\" velocity=\"5\"/>");  // 15 times the weight
  EXPECT_THAT(servo, Contains(HasSubstr("guess: stall_nm 20 N m, the effort limit")));
  const auto placeholder = with("<limit effort=\"1000\" velocity=\"1000\"/>");
  EXPECT_THAT(placeholder, Contains(HasSubstr("the URDF's effort limit, 1000 N m, is no floor")));
  EXPECT_THAT(placeholder,
              Contains(HasSubstr("the URDF's velocity limit, 1000 rad/s, is no floor")));
  const auto huge = with("<limit effort=\"1e308\" velocity=\"inf\"/>");
  EXPECT_THAT(huge, Contains(HasSubstr("effort limit, 1e+308 N m, is no floor")));
  EXPECT_THAT(huge, Contains(HasSubstr("velocity limit, which is infinite, is no floor")));
  const auto none = with("");
  EXPECT_THAT(none, Not(Contains(HasSubstr("the URDF's"))));
}

// Of 20.6 kg on wheels of 50 mm, 80 N m are 8 times the weight: no servo is as strong.
TEST(UrdfMjcf, AHeavyRobotHasNoServos) {
  const auto notes = [](const std::string& effort_nm) {
    std::string text = Replaced(WithBall(), "<mass value=\"5\"/>", "<mass value=\"20\"/>");
    text = Replaced(text, "<axis xyz=\"0 0 1\"/>",
                    "<axis xyz=\"0 0 1\"/><limit effort=\"" + effort_nm + "\"/>");
    return Converted(text).notes;
  };
  EXPECT_THAT(notes("37"), Contains(HasSubstr("guess: stall_nm 37 N m, the effort limit")));
  EXPECT_THAT(notes("40"), Contains(HasSubstr("effort limit, 40 N m, is no floor robot's")));
}

TEST(UrdfMjcf, NamesMayBeInAnyScript) {
  std::string text = WithBall();
  text = Replaced(text, "left_joint", "\u5de6\u8f6e");
  text = Replaced(text, "base_link", "\u0449\u0430\u0441\u0438 &amp; --&lt;&gt;");
  const RobotCheck dut = CheckRobot(ConvertedFile(text));
  EXPECT_EQ(dut.spec.wheels[0].name, "\u5de6\u8f6e");
  EXPECT_THAT(Wrongs(dut), IsEmpty());
}

// docs/robot.md is what users ask which keys there are.
TEST(UrdfMjcf, ItsKeysAreOnThePage) {
  std::ifstream in(SourceFile("docs/robot.md"));
  const std::string page((std::istreambuf_iterator<char>(in)), {});
  struct Keys : Configurable {
    void Visit(ParamVisitor& v) override { answers.Visit(v); }
    UrdfAnswers answers;
  } keys;
  for (const ParamDoc& key : DocumentParams(keys))
    EXPECT_THAT(page, HasSubstr("`" + key.name + "`")) << key.name;
}

// A wheel called as the body that every robot has.
TEST(UrdfMjcf, NamesMayBeOurOwn) {
  const RobotSpec dut = ReadRobot(ConvertedFile(Replaced(WithBall(), "left_joint", "base"))).spec;
  EXPECT_EQ(dut.wheels.size(), 2u);
}

TEST(UrdfMjcf, TheSameUrdfGivesTheSameBytes) {
  EXPECT_EQ(Converted(WithSwivel()).text, Converted(WithSwivel()).text);
}

// What the fork says of its own is refused where the model is read: a support that holds no mass.
TEST(UrdfMjcf, ASupportThatDoesNotHoldItIsRefusedWhenItIsRead) {
  const auto file =
      ConvertedFile(Replaced(WithBall(), "xyz=\"-0.14 0 -0.015\"", "xyz=\"0.14 0 -0.015\""));
  try {
    ReadRobot(file);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("the centre of mass lies outside the wheels' support"));
  }
}

}  // namespace
}  // namespace floorproof

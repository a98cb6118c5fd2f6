// SPDX-License-Identifier: Apache-2.0
// What of a URDF becomes wheel, caster and base, and the masses that they get.
#include "env/urdf/urdf_robot.h"

#include <gmock/gmock.h>

#include "env/urdf/link_mass.h"
#include "tests/urdf/urdf_files.h"

namespace floorproof {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

UrdfRobot Found(const std::string& text, const UrdfAnswers& answers = {}) {
  const auto file = WrittenUrdf(text);
  return FindRobotParts(file, ReadUrdfModel(file, {}), answers, AnyDrive);
}

TEST(UrdfRobot, FindsWheelsBaseAndFrame) {
  const UrdfRobot dut = Found(WithBall());
  EXPECT_EQ(dut.drive, "differential");
  ASSERT_EQ(dut.wheels.size(), 2u);
  EXPECT_EQ(dut.wheels[0].name, "left_joint");
  EXPECT_NEAR(dut.wheels[0].radius_m, 0.05, 1e-12);
  EXPECT_TRUE(dut.wheels[0].p_B.isApprox(Vec3(0, 0.12, 0.05), 1e-9));
  EXPECT_TRUE(dut.wheels[0].axle_B.isApprox(Vec3::UnitY(), 1e-9));
  EXPECT_NEAR(dut.mass_kg(), 5.6, 1e-9);
  EXPECT_TRUE(dut.base.com_M.isApprox(Vec3(-0.02, 0, 0.08), 1e-9));
  ASSERT_TRUE(dut.lidar_B);
  EXPECT_NEAR(dut.lidar_B->z(), 0.18, 1e-9);
  ASSERT_EQ(dut.casters.size(), 1u);
  EXPECT_EQ(dut.casters[0].kind, UrdfCaster::Kind::kBall);
  EXPECT_TRUE(dut.casters[0].wheel.p_B.isApprox(Vec3(-0.14, 0, 0.015), 1e-9));
}

// Wherever the file's own frame lies, and however it is turned.
TEST(UrdfRobot, TheFrameIsTheWheelsOwn) {
  const UrdfRobot straight = Found(WithBall());
  const UrdfRobot dut = Found(Replaced(WithBall(), "<origin xyz=\"0 0 0.03\"/>",
                                       "<origin xyz=\"1 2 3\" rpy=\"0 0 0.7\"/>"));
  EXPECT_TRUE(dut.base.com_M.isApprox(straight.base.com_M, 1e-6));
  EXPECT_TRUE(dut.base.inertia_M.isApprox(straight.base.inertia_M, 1e-6));
  EXPECT_TRUE(dut.wheels[1].p_B.isApprox(straight.wheels[1].p_B, 1e-6));
  EXPECT_THAT(dut.notes, Contains(HasSubstr("forward is square to the axle")));
}

TEST(UrdfRobot, ACasterThatSwivelsIsForkAndWheel) {
  const UrdfRobot dut = Found(WithSwivel());
  EXPECT_EQ(dut.wheels.size(), 2u) << "its wheel is not driven";
  ASSERT_EQ(dut.casters.size(), 1u);
  const UrdfCaster& caster = dut.casters[0];
  EXPECT_EQ(caster.kind, UrdfCaster::Kind::kSwivel);
  EXPECT_NEAR(caster.pivot_B.x(), -0.12, 1e-9);
  EXPECT_NEAR(caster.wheel.p_B.x(), -0.14, 1e-9);
  EXPECT_NEAR(caster.wheel.radius_m, 0.025, 1e-9);
  EXPECT_NEAR(caster.fork.mass_kg, 0.1, 1e-12);
}

// A principal axis is turned in the file by the origin's rpy: the moment about z comes to lie
// about x.
TEST(UrdfRobot, AnInertiasOwnFrameCounts) {
  const UrdfRobot dut = Found(Replaced(WithBall(), "<origin xyz=\"-0.02 0 0.05\"/><mass",
                                       "<origin xyz=\"-0.02 0 0.05\" rpy=\"0 1.5707963267948966 "
                                       "0\"/><mass"));
  EXPECT_NEAR(dut.base.inertia_M(0, 0), 0.06, 1e-9);
  EXPECT_NEAR(dut.base.inertia_M(2, 2), 0.03, 1e-9);
  const UrdfRobot products = Found(Replaced(WithBall(), "izz=\"0.06\" ixy=\"0\" ixz=\"0\"",
                                            "izz=\"0.06\" ixy=\"0\" ixz=\"0.004\""));
  EXPECT_NEAR(products.base.inertia_M(0, 2), 0.004, 1e-9);
}

// Two points of mass m at +-d about their middle.
TEST(MassOf, SumsAsOneRigidBody) {
  MassOf dut{2, {0.3, 0, 0}, Mat3::Zero()};
  dut += {2, {-0.1, 0, 0}, Mat3::Zero()};
  EXPECT_NEAR(dut.mass_kg, 4, 1e-12);
  EXPECT_NEAR(dut.com_M.x(), 0.1, 1e-12);
  EXPECT_NEAR(dut.inertia_M(1, 1), 2 * 2 * 0.2 * 0.2, 1e-12);
  EXPECT_NEAR(dut.inertia_M(0, 0), 0, 1e-12);
}

TEST(UrdfRobot, AnInertiaThatNoBodyHasIsMended) {
  const auto notes = [](const char* izz) {
    return Found(Replaced(WithBall(), "izz=\"0.06\"", "izz=\"" + std::string(izz) + "\"")).notes;
  };
  EXPECT_THAT(notes("0.07"), Not(Contains(HasSubstr("inertia"))));
  EXPECT_THAT(notes("0.08"), Contains(AllOf(HasSubstr("the inertia of link base_link"),
                                            HasSubstr("more than the two others together"))));
  EXPECT_THAT(notes("-0.02"), Contains(HasSubstr("is not positive")));
  const UrdfRobot dut = Found(Replaced(WithBall(), "izz=\"0.06\"", "izz=\"0.5\""));
  EXPECT_NEAR(dut.base.inertia_M(2, 2), 5.0 / 12 * (0.3 * 0.3 + 0.2 * 0.2), 1e-9)
      << "of the box that it is";
}

TEST(UrdfRobot, MassesOfNothingAreSaid) {
  const UrdfRobot dut = Found(Replaced(WithBall(), "<mass value=\"0.3\"/>", "<mass value=\"0\"/>"));
  EXPECT_THAT(dut.notes, Contains(AllOf(HasSubstr("guess: wheel left_joint weighs"),
                                        HasSubstr("the file gives it no mass"))));
  EXPECT_GT(dut.wheels[0].mass.mass_kg, 0.01);
  EXPECT_THAT(RefusalOf(Replaced(WithBall(), "<mass value=\"5\"/>", "<mass value=\"0\"/>")),
              HasSubstr("no link but its wheels has a mass"));
  EXPECT_THAT(RefusalOf(Replaced(WithBall(), "<mass value=\"5\"/>", "<mass value=\"-5\"/>")),
              HasSubstr("must be 0 or more"));
  EXPECT_THAT(
      RefusalOf(Replaced(WithBall(), "xyz=\"-0.02 0 0.05\"/><mass", "xyz=\"nan 0 0\"/><mass")),
      HasSubstr("origin xyz = nan: must be a finite number"));
}

// A caster's 0.2 kg stand for the whole base where its body's mass is 0.
TEST(UrdfRobot, ABaseWithoutItsBodysMassIsRefused) {
  const std::string whole =
      Replaced(WithBall(), "<link name=\"ball\">",
               "<link name=\"ball\"><inertial><mass value=\"0.2\"/><inertia ixx=\"1e-4\" "
               "iyy=\"1e-4\" izz=\"1e-4\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>");
  const auto weighing = [&](const std::string& kg, const std::string& of) {
    return Replaced(of, "<mass value=\"5\"/>", "<mass value=\"" + kg + "\"/>");
  };
  EXPECT_EQ(RefusalOf(whole), "taken");
  EXPECT_EQ(RefusalOf(weighing("0.4", whole)), "taken") << "light, and a robot";
  EXPECT_THAT(RefusalOf(weighing("0", whole)),
              AllOf(HasSubstr("my.urdf: mass: the base weighs 0.2 kg, its wheels 0.6 kg"),
                    HasSubstr("box holds 6 litres"),
                    HasSubstr("Without a mass: base_link; state it in the link's <inertial>")));
  EXPECT_THAT(RefusalOf(weighing("0.001", WithBall())), HasSubstr("no robot's base is as light"));
  // Its mass in a link of its own, as some vendors' files have it.
  const std::string apart = weighing(
      "0", WithBall("<link name=\"weight\"><inertial><mass value=\"4\"/><inertia ixx=\"0.03\" "
                    "iyy=\"0.04\" izz=\"0.06\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>"
                    "<joint name=\"weight_joint\" type=\"fixed\"><parent link=\"base_link\"/>"
                    "<child link=\"weight\"/></joint>"));
  EXPECT_EQ(RefusalOf(apart), "taken");
}

// Another link, fixed below the base, that collides as a shape at this place.
std::string Part(const std::string& geometry, const std::string& xyz) {
  return "<link name=\"part\"><collision><geometry>" + geometry +
         "</geometry></collision></link><joint name=\"part_joint\" type=\"fixed\">"
         "<parent link=\"base_footprint\"/><child link=\"part\"/><origin xyz=\"" +
         xyz + "\"/></joint>";
}

// Some simulators want a shape of every link.
TEST(UrdfRobot, AMarkOfAMillimetreIsNeitherBodyNorCaster) {
  const std::string mark = "<box size=\"0.001 0.001 0.001\"/>";
  const auto model = [](const std::string& urdf) {  // without what its head says
    const std::string text = Converted(urdf).text;
    return text.substr(text.find("<mujoco>"));
  };
  for (const char* xyz : {"0 0 0", "0.05 0 0.0005", "0 0 0.3"})
    EXPECT_EQ(model(WithBall(Part(mark, xyz))), model(WithBall())) << xyz;
}

// Skirts, squeegees and low bodies are a part of the body, however near to the floor: they are
// wider than a wheel, or boxes that do not touch.
TEST(UrdfRobot, WhatHangsLowIsBody) {
  struct Low {
    const char *geometry, *xyz;
    double belly_m;
  };
  for (const Low& low :
       {Low{"<box size=\"0.3 0.2 0.01\"/>", "0 0 0.008", 0.003},
        Low{"<box size=\"0.02 0.5 0.02\"/>", "-0.2 0 0.014", 0.004},
        Low{"<box size=\"0.02 0.02 0.02\"/>", "0.1 0 0.014", 0.004},
        Low{"<cylinder radius=\"0.15\" length=\"0.02\"/>", "0 0 0.0125", 0.0025}}) {
    const std::string text = WithBall(Part(low.geometry, low.xyz));
    EXPECT_EQ(Found(text).casters.size(), 1u) << low.geometry;
    const RobotSpec spec = ReadRobot(ConvertedFile(text)).spec;
    EXPECT_NEAR(spec.clearance_m, low.belly_m, 1e-6) << low.geometry;
    EXPECT_LE(spec.step_m, low.belly_m / 2 + 1e-6) << low.geometry;
  }
  const RobotSpec wide =
      ReadRobot(ConvertedFile(WithBall(Part("<box size=\"0.02 0.5 0.02\"/>", "-0.2 0 0.014"))))
          .spec;
  EXPECT_NEAR(wide.circumscribed_radius_m, std::hypot(0.21, 0.25), 1e-3);
  EXPECT_NEAR(wide.tool_width_m, 0.8 * 0.5, 1e-3);
  // What is round and no wider than a wheel may be drawn a little too high.
  EXPECT_EQ(Found(WithBall(Part("<sphere radius=\"0.015\"/>", "0.1 0 0.018"))).casters.size(), 2u);
  EXPECT_EQ(Found(WithBall(Part("<box size=\"0.03 0.02 0.02\"/>", "0.1 0 0.012"))).casters.size(),
            2u);
  EXPECT_THAT(RefusalOf(WithBall(Part("<box size=\"0.3 0.2 0.01\"/>", "0 0 0.005"))),
              HasSubstr("too large for a caster"));
}

// Whatever else of the robot collides: a lidar is no body.
TEST(UrdfRobot, ABodyWhoseMeshIsLostIsWrong) {
  const std::string lost = Replaced(WithBall(Part("<box size=\"0.05 0.05 0.05\"/>", "0 0 0.2")),
                                    "<box size=\"0.3 0.2 0.1\"/>", "<mesh filename=\"none.stl\"/>");
  EXPECT_THAT(Converted(lost).wrong,
              ElementsAre(AllOf(HasSubstr("a <collision> of link base_link is left out"),
                                HasSubstr("mesh none.stl is not there"))));
  // Casters of the same link are no body either.
  const std::string with_foot =
      Replaced(lost, "<collision><origin xyz=\"-0.02 0 0.05\"/>",
               "<collision><origin xyz=\"0.1 0 -0.015\"/><geometry><sphere radius=\"0.015\"/>"
               "</geometry></collision><collision><origin xyz=\"-0.02 0 0.05\"/>");
  EXPECT_THAT(Converted(with_foot).wrong,
              ElementsAre(HasSubstr("a <collision> of link base_link is left out")));
  EXPECT_THAT(Converted(WithBall()).wrong, IsEmpty());
  EXPECT_THAT(
      RefusalOf(
          Replaced(WithBall(), "<box size=\"0.3 0.2 0.1\"/>", "<mesh filename=\"none.stl\"/>")),
      AllOf(HasSubstr("no shape but its casters"), HasSubstr("mesh none.stl is not there")));
}

// Of a robot whose body's mesh is missing its casters still collide; they are no body.
TEST(UrdfRobot, ABaseOfWhichOnlyCastersCollideCollidesAsItIsSeen) {
  const std::string seen = Replaced(
      WithBall(),
      "<collision><origin xyz=\"-0.02 0 0.05\"/><geometry><box size=\"0.3 0.2 0.1\"/></geometry></"
      "collision>",
      "<visual><origin xyz=\"-0.02 0 0.05\"/><geometry><box size=\"0.3 0.2 0.1\"/></geometry></"
      "visual>");
  const UrdfRobot dut = Found(seen);
  EXPECT_EQ(dut.casters.size(), 1u);
  EXPECT_EQ(std::ranges::count(dut.shapes, true, &UrdfShape::collides), 1);
  EXPECT_THAT(dut.notes,
              Contains(HasSubstr("used for collision; it has no <collision> of its own")));
  const UrdfRobot lost = Found(Replaced(
      seen, "<link name=\"left\">",
      "<link name=\"shell\"><collision><geometry><mesh filename=\"none.stl\"/></geometry>"
      "</collision></link><joint name=\"shell_joint\" type=\"fixed\"><parent link=\"base_link\"/>"
      "<child link=\"shell\"/></joint><link name=\"left\">"));
  EXPECT_THAT(lost.notes, Contains(HasSubstr("the mesh of its <collision> is left out")));
  EXPECT_NEAR(ReadRobot(ConvertedFile(seen)).spec.clearance_m, 0.03, 1e-6);
  EXPECT_THAT(RefusalOf(Replaced(Replaced(seen, "<visual>", "<!--"), "</visual>", "-->")),
              HasSubstr("no shape but its casters"));
}

TEST(UrdfRobot, JointsWithoutLimitsTurnForEver) {
  const UrdfRobot dut = Found(Replaced(WithBall(), "type=\"continuous\"", "type=\"revolute\""));
  EXPECT_EQ(dut.wheels.size(), 2u);
}

// An arm on the base stands still, and its mass counts.
TEST(UrdfRobot, OtherJointsAreHeld) {
  const UrdfRobot dut = Found(WithBall(
      "<link name=\"arm\"><inertial><mass value=\"1\"/><inertia ixx=\"0.01\" iyy=\"0.01\" "
      "izz=\"0.01\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link><joint name=\"shoulder\" "
      "type=\"revolute\"><parent link=\"base_link\"/><child link=\"arm\"/><axis xyz=\"0 1 0\"/>"
      "<limit lower=\"0.5\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>"));
  EXPECT_NEAR(dut.base.mass_kg, 6, 1e-9);
  EXPECT_THAT(dut.notes, Contains("joint shoulder is held where it stands"));
}

// A tricycle's front wheel, below an upright joint with limits.
TEST(UrdfRobot, AWheelThatSteersIsRefused) {
  const std::string steered = Replaced(
      WithSwivel(), "<joint name=\"fork_joint\" type=\"continuous\">",
      "<joint name=\"fork_joint\" type=\"revolute\"><limit lower=\"-1\" upper=\"1\" effort=\"1\" "
      "velocity=\"1\"/>");
  EXPECT_THAT(RefusalOf(steered),
              AllOf(HasSubstr("fork_joint"), HasSubstr("steers the wheel of caster_joint")));
}

TEST(UrdfRobot, WithoutWheelsItIsRefused) {
  EXPECT_THAT(RefusalOf(Replaced(WithBall(), "type=\"continuous\"", "type=\"fixed\"")),
              HasSubstr("no driven wheels"));
  EXPECT_THAT(RefusalOf(Replaced(WithBall(), "<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 1 0\"/>")),
              HasSubstr("no driven wheels"))
      << "their axles stand upright";
}

// 10 mm higher than the other one, which alone reaches the floor.
TEST(UrdfRobot, AWheelOverTheFloorIsNamed) {
  const std::string raised = Replaced(WithBall(), "xyz=\"0 -0.12 0.02\"", "xyz=\"0 -0.12 0.03\"");
  EXPECT_THAT(
      RefusalOf(raised),
      AllOf(HasSubstr("needs two driven wheels, not 1"),
            HasSubstr("drive: right_joint hangs 10 mm over the floor that left_joint stands on"),
            Not(HasSubstr("--set"))));
  UrdfAnswers answers;
  answers.driven = "left_joint,right_joint";
  EXPECT_THAT(RefusalOf(raised, answers),
              HasSubstr("right_joint: hangs 10 mm over the floor that left_joint stands on"));
}

TEST(UrdfRobot, ABellyOnTheFloorIsRefused) {
  EXPECT_THAT(RefusalOf(Replaced(WithBall(), "<box size=\"0.3 0.2 0.1\"/>",
                                 "<box size=\"0.3 0.2 0.16\"/>")),
              AllOf(HasSubstr("base"), HasSubstr("too large for a caster")));
}

// A front axle of two more wheels: which are driven can be said, and is guessed where it is not.
TEST(UrdfRobot, OfFourWheelsTwoCanBeNamed) {
  std::string front = kBase;
  front = front.substr(front.find("<link name=\"left\">"));
  front = front.substr(0, front.find("<link name=\"laser\"/>"));
  for (const char* name : {"\"left", "\"right"})
    front = Replaced(front, name, std::string(name) + "_front");
  front = Replaced(front, "xyz=\"0 ", "xyz=\"0.12 ");
  front = Replaced(front, "<axis xyz=\"0.12 0 1\"/>", "<axis xyz=\"0 0 1\"/>");
  const std::string four = std::string(kBase) + front + kBall + "</robot>";
  UrdfAnswers answers;
  answers.driven = "left_front_joint, right_front_joint";
  const UrdfRobot dut = Found(four, answers);
  ASSERT_EQ(dut.wheels.size(), 2u);
  EXPECT_EQ(dut.wheels[0].name, "left_front_joint");
  EXPECT_EQ(dut.casters.size(), 3u);
  answers.driven = "left_jiont,right_joint";
  EXPECT_THAT(RefusalOf(four, answers), HasSubstr("left_joint"));
}

// Thirty-two sides and twenty millimetres.
TEST(UrdfRobot, AWheelsMeshGivesItsRadiusAndWidth) {
  std::ofstream obj(OwnFolder() / "wheel.obj");
  constexpr int kSides = 32;
  for (const double z : {-0.01, 0.01})
    for (int k = 0; k < kSides; ++k)
      obj << "v " << 0.05 * std::cos(2 * kPi * k / kSides) << " "
          << 0.05 * std::sin(2 * kPi * k / kSides) << " " << z << "\n";
  for (int k = 1; k <= kSides; ++k) {
    const int next = k % kSides + 1;
    obj << "f " << k << " " << next << " " << next + kSides << "\nf " << k << " " << next + kSides
        << " " << k + kSides << "\n";
    if (k > 1 && k < kSides)
      obj << "f 1 " << next << " " << k << "\nf " << kSides + 1 << " " << k + kSides << " "
          << next + kSides << "\n";
  }
  obj.close();
  const UrdfRobot dut = Found(Replaced(WithBall(), "<cylinder radius=\"0.05\" length=\"0.02\"/>",
                                       "<mesh filename=\"wheel.obj\"/>"));
  EXPECT_NEAR(dut.wheels[0].radius_m, 0.05, 1e-6);
  EXPECT_NEAR(dut.wheels[0].half_width_m, 0.005, 1e-6) << "half its width touches";
  EXPECT_THAT(dut.notes, Contains(HasSubstr("of wheel left_joint its radius and width")));
}

TEST(UrdfRobot, WheelsWithoutAShapeTakeTheirRadiusFromAKey) {
  const std::string bare = Replaced(
      WithBall(),
      "<collision><geometry><cylinder radius=\"0.05\" length=\"0.02\"/></geometry></collision>",
      "");
  EXPECT_THAT(RefusalOf(bare), HasSubstr("wheel_radius_m"));
  UrdfAnswers answers;
  answers.wheel_radius_m = 0.05;
  EXPECT_NEAR(Found(bare, answers).wheels[0].radius_m, 0.05, 1e-12);
}

}  // namespace
}  // namespace floorproof

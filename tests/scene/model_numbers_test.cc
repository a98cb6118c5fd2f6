// SPDX-License-Identifier: Apache-2.0
// Finite numbers with which no physics can be computed.
#include "env/scene/model_numbers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "env/scene/robot_model.h"
#include "tests/robots.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

// Of a model in which every attribute below is stated, a line each.
constexpr const char* kModel = R"(<mujoco>
  <compiler autolimits="true"/>
  <option timestep="0.002" density="0" impratio="1"/>
  <custom><numeric name="n" data="1"/></custom>
  <worldbody>
    <body name="base" pos="0 0 0.1"><freejoint/>
      <geom name="belly" size="0.1" friction="0.3 0.005 0.0001" mass="1" margin="0.001" solmix="1"
        solref="0.02 1" solimp="0.9 0.95 0.001 0.5 2" gap="0"/>
      <geom name="lump" size="0.1" density="900"/>
      <site name="lidar" pos="0 0 0.3" size="0.01"/>
      <body pos="0.1 0 0">
        <joint name="spring" type="slide" axis="0 0 1" range="-0.01 0.01" stiffness="900" springref="0"
          damping="1" armature="0.1" frictionloss="0.1" margin="0.001" solreflimit="0.02 1"
          solimplimit="0.9 0.95 0.001" solreffriction="0.02 1"/>
        <geom size="0.02"/></body>
    </body>
  </worldbody>
  <actuator><motor name="m" joint="spring" gear="2" forcerange="-1 1" ctrlrange="-1 1"/></actuator>
</mujoco>)";

std::string Refusal(const std::string& text) {
  char error[1000] = "";
  const SpecPtr spec(mj_parseXMLString(text.c_str(), nullptr, error, sizeof error));
  EXPECT_TRUE(spec) << error;
  if (!spec) return "not read";
  const ModelPtr model(mj_compile(spec.get(), nullptr));
  if (!model) return "not compiled";
  try {
    RefuseWrongNumbers(model.get(), spec.get(), "my.xml");
    return "accepted";
  } catch (const InputError& e) {
    return e.what();
  }
}

std::string With(const std::string& attribute, const std::string& value,
                 const std::string& behind = "<mujoco") {
  std::string text = kModel;
  const std::size_t at = text.find(' ' + attribute + "=\"", text.find(behind));
  EXPECT_NE(at, text.npos) << attribute;
  const std::size_t begin = at + attribute.size() + 3;
  return text.replace(begin, text.find('"', begin) - begin, value);
}

TEST(ModelNumbers, OfAGoodModelAreAccepted) { EXPECT_EQ(Refusal(kModel), "accepted"); }

TEST(ModelNumbers, OutOfRangeAreNamed) {
  const struct {
    const char *behind, *attribute, *value, *named;
  } kCases[] = {
      {"<option", "timestep", "0", "option timestep = 0: must be in (0, 1]"},
      {"<option", "timestep", "-0.01", "option timestep = -0.01: must be in (0, 1]"},
      {"<option", "impratio", "0", "option impratio = 0: must be in (0, "},
      {"<option", "density", "-1", "option density = -1: must be in [0, "},
      {"\"belly\"", "friction", "-0.3", ":7: geom 'belly' friction = -0.3: must be in [0, "},
      {"\"belly\"", "friction", "0.3 1e300", ":7: geom 'belly' friction = 1e+300: must be in"},
      {"\"belly\"", "mass", "1e300", ":7: geom 'belly' mass = 1e+300: must be in"},
      {"\"belly\"", "margin", "-0.1", ":7: geom 'belly' margin = -0.1: must be in"},
      {"\"belly\"", "solmix", "-1", ":7: geom 'belly' solmix = -1: must be in"},
      {"\"belly\"", "gap", "1e300", ":7: geom 'belly' gap = 1e+300: must be in"},
      {"\"belly\"", "solref", "0.02 -1", ":7: geom 'belly' solref = -1: must be above 0 where"},
      {"\"belly\"", "solref", "-1e300 -1", ":7: geom 'belly' solref = -1e+300: must be in"},
      {"\"belly\"", "solimp", "1.1", ":7: geom 'belly' solimp = 1.1: must be in [0, 1]"},
      {"\"belly\"", "solimp", "0.9 -1", ":7: geom 'belly' solimp = -1: must be in [0, 1]"},
      {"\"belly\"", "solimp", "0.9 1 -1", ":7: geom 'belly' solimp = -1: must be in [0, "},
      {"\"belly\"", "solimp", "0.9 1 1 2", ":7: geom 'belly' solimp = 2: must be in [0, 1]"},
      {"\"belly\"", "solimp", "0.9 1 1 1 0", ":7: geom 'belly' solimp = 0: must be in [1, "},
      {"\"lump\"", "density", "1e300", ":9: geom 'lump' density = 1e+300: must be in"},
      {"\"lidar\"", "pos", "1e300 0 0", ":10: site 'lidar' pos = 1e+300: must be in"},
      {"\"base\"", "pos", "1e100 0 0", ":6: body 'base' pos = 1e+100: must be in"},
      {"\"spring\"", "range", "-1e300 1", ":12: joint 'spring' range = -1e+300: must be in"},
      {"\"spring\"", "stiffness", "-1", ":12: joint 'spring' stiffness = -1: must be in [0, "},
      {"\"spring\"", "stiffness", "1e300", ":12: joint 'spring' stiffness = 1e+300: must be in"},
      {"\"spring\"", "springref", "1e300", ":12: joint 'spring' springref = 1e+300: must be in"},
      {"\"spring\"", "damping", "-1", ":12: joint 'spring' damping = -1: must be in [0, "},
      {"\"spring\"", "armature", "-0.01", ":12: joint 'spring' armature = -0.01: must be in"},
      {"\"spring\"", "frictionloss", "-1", ":12: joint 'spring' frictionloss = -1: must be in"},
      {"\"spring\"", "margin", "-1", ":12: joint 'spring' margin = -1: must be in"},
      {"\"spring\"", "solreflimit", "1 0", ":12: joint 'spring' solreflimit = 0: must be above"},
      {"\"spring\"", "solimplimit", "2", ":12: joint 'spring' solimplimit = 2: must be in"},
      {"\"spring\"", "solreffriction", "1 -1", ":12: joint 'spring' solreffriction = -1: must"},
      {"<motor", "gear", "0", ":18: actuator 'm' gear = 0: must not be 0"},
      {"<motor", "gear", "1e300", ":18: actuator 'm' gear = 1e+300: must be in"},
      {"<motor", "forcerange", "-1e300 1", ":18: actuator 'm' forcerange = -1e+300: must be in"},
      {"<motor", "ctrlrange", "-1e300 1", ":18: actuator 'm' ctrlrange = -1e+300: must be in"},
      {"<numeric", "data", "inf", ":4: numeric 'n' data = inf: must be a finite number"},
  };
  for (const auto& c : kCases)
    EXPECT_THAT(Refusal(With(c.attribute, c.value, c.behind)), HasSubstr(c.named));
}

// What MuJoCo documents as allowed: stiffness and damping in solref, impedances at their ends.
TEST(ModelNumbers, AtTheEndsOfTheirRangesAreAccepted) {
  EXPECT_EQ(Refusal(With("solref", "-1000 -10")), "accepted");
  EXPECT_EQ(Refusal(With("solref", "0 0")), "accepted");
  EXPECT_EQ(Refusal(With("solimp", "0 1 0 1 1")), "accepted");
  EXPECT_EQ(Refusal(With("friction", "0 0 0")), "accepted");
  EXPECT_EQ(Refusal(With("stiffness", "0")), "accepted");
  EXPECT_EQ(Refusal(With("gear", "-1")), "accepted");
}

// Each number of the compiled model, whichever attribute it comes of.
TEST(ModelNumbers, AreAllLookedAt) {
  char error[1000] = "";
  const SpecPtr spec(mj_parseXMLString(kModel, nullptr, error, sizeof error));
  const ModelPtr model(mj_compile(spec.get(), nullptr));
  const auto refused = [&](mjtNum& number) {
    const mjtNum was = std::exchange(number, std::nan(""));
    std::string refusal = "accepted";
    try {
      RefuseWrongNumbers(model.get(), spec.get(), "my.xml");
    } catch (const InputError& e) {
      refusal = e.what();
    }
    number = was;
    return refusal;
  };
  EXPECT_THAT(refused(model->body_quat[4]), HasSubstr("body 'base' quat = nan: must be a finite"));
  EXPECT_THAT(refused(model->geom_aabb[0]), HasSubstr("geom 'belly' aabb = nan"));
  EXPECT_THAT(refused(model->qpos0[7]), HasSubstr("joint 'spring' ref = nan"));
  EXPECT_THAT(refused(model->dof_invweight0[6]), HasSubstr("joint 'spring' invweight0 = nan"));
  EXPECT_THAT(refused(model->actuator_acc0[0]), HasSubstr("actuator 'm' acc0 = nan"));
}

TEST(ModelNumbers, OfTheBundledRobotsAreAccepted) {
  for (const std::string& robot : RobotNames())
    EXPECT_NO_THROW(ReadRobot(FindRobotFile(robot, {})));
}

}  // namespace
}  // namespace floorproof

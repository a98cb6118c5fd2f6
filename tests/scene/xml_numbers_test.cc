// SPDX-License-Identifier: Apache-2.0
// Numbers that are none, put in turn into every attribute of real robots that holds numbers.
#include "env/scene/xml_numbers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "env/scene/robot_model.h"
#include "tests/own_folder.h"
#include "tests/places.h"
#include "tests/robot_file.h"
#include "tests/robots.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

constexpr const char* kNoNumbers[] = {"nan",  "NaN",       "-nan",  "nan(1)", "inf",
                                      "-inf", "+Infinity", "1e999", "-1e999", "&#110;an"};

// Whether the value is numbers alone, all finite.
bool HoldsNumbers(std::string_view value) {
  std::istringstream in{std::string(value)};
  int count = 0;
  for (std::string word; in >> word; ++count) {
    char* end = nullptr;
    std::strtod(word.c_str(), &end);
    if (*end != '\0') return false;
  }
  return count > 0;
}

// A number of a text, and whose it is.
struct Number {
  std::size_t begin, end;
  std::string element, attribute;
};

// The first and last number of each attribute.
std::vector<Number> NumbersOf(const std::string& text) {
  std::vector<Number> numbers;
  for (const XmlElement& element : XmlElements(text))
    for (const XmlAttribute& a : element.attributes) {
      if (a.name == "name" || !HoldsNumbers(a.value)) continue;
      const std::size_t from = a.value.find_first_not_of(" \n"),
                        to = a.value.find_last_not_of(" \n") + 1;
      const std::size_t first = std::min(a.value.find_first_of(" \n", from), to);
      const std::size_t last = a.value.find_last_of(" \n", to - 1);
      const auto add = [&](std::size_t begin, std::size_t end) {
        numbers.push_back(
            {a.begin + begin, a.begin + end, std::string(element.name), std::string(a.name)});
      };
      add(from, first);
      if (first != to) add(last + 1, to);
    }
  return numbers;
}

std::string With(const std::string& text, const Number& number, const std::string& written) {
  return text.substr(0, number.begin) + written + text.substr(number.end);
}

std::string RefusalOfText(const std::string& text) {
  try {
    RefuseBadNumbers(XmlElements(text), text, "my.xml");
    return "accepted";
  } catch (const InputError& e) {
    return e.what();
  }
}

void ExpectEachRefused(const std::string& text, const std::string& file) {
  ASSERT_EQ(RefusalOfText(text), "accepted") << file;
  const std::vector<Number> numbers = NumbersOf(text);
  ASSERT_GT(numbers.size(), 50u) << file;
  for (const Number& number : numbers)
    for (const std::string written : kNoNumbers) {
      const bool unlimited = number.element == "limit" && written.find("inf") == 0;
      if (unlimited && (number.attribute == "effort" || number.attribute == "velocity")) continue;
      const std::string refusal = RefusalOfText(With(text, number, written));
      const std::string place = "my.xml:" + std::to_string(LineAt(text, number.begin)) + ": ";
      EXPECT_TRUE(refusal.starts_with(place + number.element + " ")) << file << ": " << refusal;
      EXPECT_THAT(refusal, HasSubstr(" " + number.attribute + " = "))
          << file << " " << place << written;
      EXPECT_TRUE(refusal.ends_with(": must be a finite number")) << refusal;
    }
}

TEST(XmlNumbers, EveryNumberOfEveryBundledRobotMustBeFinite) {
  for (const std::string& robot : RobotNames())
    ExpectEachRefused(Slurp(FindRobotFile(robot, {})), robot);
}

TEST(XmlNumbers, EveryNumberOfAUrdfMustBeFinite) {
  int robots = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SourceFile("models/others"))) {
    if (entry.path().extension() != ".urdf") continue;
    ExpectEachRefused(Slurp(entry.path()), entry.path().filename());
    ++robots;
  }
  EXPECT_GT(robots, 5);
}

TEST(XmlNumbers, AUrdfsJointMayHaveNoLimit) {
  const auto limit = [](const std::string& attribute) {
    return RefusalOfText("<robot><joint name='j'><limit " + attribute + "/></joint></robot>");
  };
  EXPECT_EQ(limit("effort='inf' velocity='1e999'"), "accepted");
  EXPECT_THAT(limit("effort='nan'"), HasSubstr("limit effort = nan"));
  EXPECT_THAT(limit("velocity='-inf'"), HasSubstr("limit velocity = -inf"));
  EXPECT_THAT(limit("upper='inf'"), HasSubstr("limit upper = inf"));
}

TEST(XmlNumbers, WhatAUrdfSaysToOtherProgramsIsNotRead) {
  EXPECT_EQ(RefusalOfText("<robot><gazebo><range max='inf'/></gazebo><link name='nan'/></robot>"),
            "accepted");
}

TEST(XmlNumbers, AreNamedWithElementAndLine) {
  EXPECT_EQ(RefusalOfText("<mujoco>\n<geom name='a &lt; b'\n  mass='1 2 NAN'/></mujoco>"),
            "my.xml:3: geom 'a < b' mass = NAN: must be a finite number");
  const std::string line = RefusalOfText("<mujoco><geom name='" + std::string(5000, 'x') +
                                         "' mass='1" + std::string(5000, '0') + "'/></mujoco>");
  EXPECT_THAT(line, HasSubstr("...' mass = 1" + std::string(56, '0') + "...: must be a finite"));
  EXPECT_LT(line.size(), 200u);
}

// Their squares overflow: of such an axis MuJoCo makes another.
TEST(XmlNumbers, MustHaveFiniteSquares) {
  EXPECT_EQ(RefusalOfText("<mujoco><joint axis='1e300 0 0'/></mujoco>"),
            "my.xml:1: joint axis = 1e300: must be at most 1e150, so that its square is finite");
  EXPECT_EQ(RefusalOfText("<mujoco><joint axis='1e-320 -1e150 0x1p9'/></mujoco>"), "accepted");
}

// A colour of what is drawn of joints; elsewhere `joint` names one.
TEST(XmlNumbers, ColoursAreNumbers) {
  EXPECT_THAT(RefusalOfText("<mujoco><visual><rgba joint='1 1 nan 1'/></visual></mujoco>"),
              HasSubstr("rgba joint = nan"));
}

// Of beluga, with joints, geoms, classes, materials and texts whose names are no numbers.
TEST(XmlNumbers, ANameMayBeSpelledLikeOne) {
  std::string text = Slurp(FindRobotFile("beluga", {}));
  const auto rename = [&](const std::string& from, const std::string& to) {
    const std::string old = '"' + from + '"', now = '"' + to + '"';
    std::size_t count = 0;
    for (std::size_t at = text.find(old); at != text.npos; at = text.find(old, at), ++count)
      text.replace(at, old.size(), now);
    EXPECT_GE(count, 1u) << from;
  };
  rename("belly", "nan");
  rename("shell", "infinity");
  rename("wheel", "1e999");
  rename("wheel_left", "inf");
  const RobotFile file(text);
  EXPECT_EQ(ReadRobot(file.path()).spec.wheels.size(), 2u);
}

using XmlNumbersOfFiles = OwnFolderTest;

TEST_F(XmlNumbersOfFiles, IncludesAreReadToo) {
  std::ofstream(folder_ / "robot.xml") << "<mujoco><include file=\"parts/more.xml\"/></mujoco>";
  std::filesystem::create_directory(folder_ / "parts");
  std::ofstream(folder_ / "parts/more.xml")
      << "<mujoco>\n<worldbody><geom size=\"0.1\" mass=\"nan\"/></worldbody></mujoco>";
  try {
    ReadRobot(folder_ / "robot.xml");
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("parts/more.xml:2: geom mass = nan: must be a finite number"));
  }
}

// The reader itself, over each attribute of a small robot.
TEST_F(XmlNumbersOfFiles, TheReaderRefusesThem) {
  const std::string text = R"(<mujoco>
  <custom><text name="drive" data="differential"/><numeric name="tool_width_m" data="0.3"/></custom>
  <worldbody>
    <body name="base" pos="0 0 0.1"><freejoint/>
      <geom name="belly" type="cylinder" size="0.1 0.02" friction="0.3 0.005 0.0001" mass="1"/>
      <site name="lidar" pos="0 0 0.3"/>
      <body pos="0.1 0 0"><joint type="slide" axis="0 0 1" range="-0.01 0.01" stiffness="900"/>
        <geom size="0.02" solimp="0.95 0.99 0.0005" solref="0.02 1"/></body>
      <body name="left" pos="0 0.1 0"><joint name="left" axis="0 1 0" damping="0.1"/>
        <geom type="cylinder" size="0.05 0.01" euler="90 0 0" density="900"/></body>
    </body>
  </worldbody>
  <actuator><dcmotor name="left" joint="left" nominal="12 4 10" saturation="3 0 0" input="vel"
    controller="0 0 5 0 0 12"/></actuator>
</mujoco>)";
  const std::vector<Number> numbers = NumbersOf(text);
  ASSERT_GT(numbers.size(), 25u);
  for (const Number& number : numbers)
    for (const char* written : {"nan", "-inf"}) {
      std::ofstream(folder_ / "robot.xml") << With(text, number, written);
      try {
        ReadRobot(folder_ / "robot.xml");
        ADD_FAILURE() << "accepted";
      } catch (const InputError& e) {
        EXPECT_THAT(e.what(), HasSubstr(" " + number.attribute + " = " + written +
                                        ": must be a finite number"));
      }
    }
}

// Robots that were accepted, and failed or went on with other numbers than their files state.
TEST(XmlNumbers, TheRobotsThatWereTakenAreRefused) {
  const std::filesystem::path folder = SharedFile("repro/nan-robot");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().stem() == "ok") {
      EXPECT_NO_THROW(ReadRobot(entry.path()));
      continue;
    }
    try {
      ReadRobot(entry.path());
      ADD_FAILURE() << entry.path() << " was accepted";
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr(" = nan: must be a finite number"));
    }
  }
}

}  // namespace
}  // namespace floorproof

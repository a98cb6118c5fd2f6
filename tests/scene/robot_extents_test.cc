// SPDX-License-Identifier: Apache-2.0
// How far a robot's body reaches, by closed forms: of every type of geom, however it is turned.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "env/scene/robot_model.h"
#include "tests/physics/one_caster.h"
#include "tests/robot_file.h"

namespace floorproof {
namespace {

// The robot with this geom for its body, and these assets.
RobotSpec WithBody(const std::string& geom, const std::string& assets = "") {
  std::string xml = kOneCaster;
  const auto begin = xml.find("      <geom class=\"body\" type=\"cylinder\""),
             end = xml.find("      <body name=\"wheel_left\"");
  xml.replace(begin, end - begin, "      <geom class=\"body\" mass=\"5\" " + geom + "/>\n");
  xml.insert(xml.find("  <worldbody>"), assets);
  return ReadRobot(RobotFile(xml).path()).spec;
}

constexpr double kFine_m = 0.002 * 0.25;  // of 72 directions around

TEST(RobotExtents, OfARoundBodyAreItsRadiusAndItsBelly) {
  for (const char* turned : {"", " euler=\"0.7 0.4 0\""}) {
    const RobotSpec sphere =
        WithBody(fmt::format("type=\"sphere\" size=\"0.25\" pos=\"0 0 0.3\"{}", turned));
    EXPECT_NEAR(sphere.circumscribed_radius_m, 0.25, kFine_m) << turned;
    EXPECT_NEAR(sphere.clearance_m, 0.05, 1e-9) << turned;
    EXPECT_NEAR(sphere.height_m, 0.55, 1e-9) << turned;
  }
  const RobotSpec capsule = WithBody("type=\"capsule\" size=\"0.2 0.03\" pos=\"0 0 0.27\"");
  EXPECT_NEAR(capsule.circumscribed_radius_m, 0.2, kFine_m);
  EXPECT_NEAR(capsule.clearance_m, 0.04, 1e-9);
  EXPECT_NEAR(capsule.height_m, 0.5, 1e-9);
  const RobotSpec ellipsoid = WithBody("type=\"ellipsoid\" size=\"0.25 0.2 0.1\" pos=\"0 0 0.14\"");
  EXPECT_NEAR(ellipsoid.circumscribed_radius_m, 0.25, kFine_m);
  EXPECT_NEAR(ellipsoid.clearance_m, 0.04, 1e-9);
  EXPECT_NEAR(ellipsoid.inscribed_radius_m, 0.2, kFine_m);
}

// Half as long again along the axis that it leans by.
TEST(RobotExtents, OfALeaningCapsuleFollowItsAxis) {
  const double lean = 0.5, half_m = 0.1, radius_m = 0.15;
  const RobotSpec dut = WithBody(fmt::format(
      "type=\"capsule\" size=\"{} {}\" pos=\"0 0 0.3\" euler=\"0 {} 0\"", radius_m, half_m, lean));
  EXPECT_NEAR(dut.circumscribed_radius_m, radius_m + half_m * std::sin(lean), kFine_m);
  EXPECT_NEAR(dut.clearance_m, 0.3 - radius_m - half_m * std::cos(lean), 1e-9);
}

// A mesh is as large as its hull, not as the box around that: here a prism on many corners.
TEST(RobotExtents, OfAMeshAreThoseOfItsHull) {
  std::string vertices;
  constexpr int kCorners = 60;
  for (int i = 0; i < kCorners; ++i)
    for (const double z : {-0.05, 0.05})
      vertices += fmt::format("{} {} {} ", 0.25 * std::cos(2 * kPi * i / kCorners),
                              0.25 * std::sin(2 * kPi * i / kCorners), z);
  const std::string assets =
      "  <asset><mesh name=\"round\" vertex=\"" + vertices + "\"/></asset>\n";
  const RobotSpec dut = WithBody("type=\"mesh\" mesh=\"round\" pos=\"0 0 0.08\"", assets);
  EXPECT_NEAR(dut.circumscribed_radius_m, 0.25, 1e-6);
  EXPECT_NEAR(dut.clearance_m, 0.03, 1e-6);
}

}  // namespace
}  // namespace floorproof

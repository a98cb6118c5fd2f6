// SPDX-License-Identifier: Apache-2.0
#include "env/scene/robot_stance.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace floorproof {
namespace {

RobotModel Bundled(const std::string& name) { return ReadRobot(FindRobotFile(name, {})); }

TEST(RobotStance, EveryBundledRobotStandsOnAllOfItsWheelsAndCasters) {
  for (const RobotEntry& entry : Robots()) {
    const RobotModel robot = Bundled(std::string(entry.name));
    const RobotStance dut = StanceOf(robot);
    const auto driven = std::ranges::count(dut.carriers, true, &Carrier::driven);
    EXPECT_EQ(static_cast<std::size_t>(driven), robot.spec.wheels.size()) << entry.name;
    for (const Carrier& carrier : dut.carriers)
      EXPECT_NEAR(carrier.p_B.z(), 0, 2e-4) << entry.name << " " << carrier.name;
  }
}

TEST(RobotStance, TheLeastEdgeIsTheStaticTipAngle) {
  for (const RobotEntry& entry : Robots()) {
    const RobotModel robot = Bundled(std::string(entry.name));
    const auto edges = StanceOf(robot).edges;
    ASSERT_GE(edges.size(), 3u) << entry.name;
    EXPECT_NEAR(std::ranges::min(edges, {}, &SupportEdge::tip_rad).tip_rad,
                robot.spec.static_tip_rad, 1e-6)
        << entry.name;
  }
}

// BELUGA: two wheels and two casters, a rhombus; its scanner's plane stands in its file.
TEST(RobotStance, BelugasEdgesLookAslant) {
  const RobotStance dut = StanceOf(Bundled("beluga"));
  for (const SupportEdge& edge : dut.edges) {
    const Vec2 outward(std::cos(edge.bearing_rad), std::sin(edge.bearing_rad));
    EXPECT_NEAR(outward.dot(edge.a_B - edge.b_B), 0, 1e-9);
    EXPECT_GT(outward.dot(edge.a_B), 0) << "outward, from the middle";
    EXPECT_GT(std::min(std::abs(outward.x()), std::abs(outward.y())), 0.5);
  }
  ASSERT_TRUE(dut.lidar_z_m);
  EXPECT_NEAR(*dut.lidar_z_m, 0.335, 1e-9);
}

// The picture's points fill the extent that the program knows.
TEST(RobotParts, ReachAsFarAsTheRobot) {
  for (const RobotEntry& entry : Robots()) {
    const RobotModel robot = Bundled(std::string(entry.name));
    double high_m = 0, reach_m = 0, low_m = 1;
    for (const RobotPart& part : PartsOf(robot))
      for (const Vec3& p : part.points_B) {
        low_m = std::min(low_m, p.z());
        if (part.kind == RobotPart::Kind::kLook) continue;
        high_m = std::max(high_m, p.z());
        reach_m = std::max(reach_m, p.head<2>().norm());
      }
    EXPECT_NEAR(high_m, robot.spec.height_m, 1e-4) << entry.name;
    EXPECT_NEAR(reach_m, robot.spec.circumscribed_radius_m, 2e-3) << entry.name;
    EXPECT_NEAR(low_m, 0, 2e-3) << entry.name;
  }
}

}  // namespace
}  // namespace floorproof

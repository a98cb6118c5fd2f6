// SPDX-License-Identifier: Apache-2.0
// Robots that others make go the way of any user's URDF, and nothing is wrong with them.
#include "tests/real_robots/real_robots.h"

#include <gmock/gmock.h>

#include "tests/validate/wrongs.h"

namespace floorproof {
namespace {

class RealRobotModels : public ::testing::TestWithParam<RealRobot> {};
INSTANTIATE_TEST_SUITE_P(Robots, RealRobotModels, ::testing::ValuesIn(RealRobots()),
                         [](const auto& robot) { return std::string(robot.param.name); });

TEST_P(RealRobotModels, NothingIsWrongWithThem) {
  const RobotCheck dut = CheckRobot(MjcfFile(GetParam()).string());
  EXPECT_THAT(Wrongs(dut), ::testing::IsEmpty());
  EXPECT_NEAR(dut.spec.mass_kg, GetParam().mass_kg, 0.01 * GetParam().mass_kg);
}

// Whoever answers none of the questions gets a robot that drives.
TEST_P(RealRobotModels, NothingIsWrongByGuessesAlone) {
  EXPECT_THAT(Wrongs(CheckRobot(GuessedMjcfFile(GetParam()).string())), ::testing::IsEmpty());
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Whatever planner made the plan: for a robot that cannot turn on the spot it is one that this
// robot can drive, it is as clear as before, and says what the turns cost.
#include "planners/lines/turned_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/planners/curvature.h"
#include "tests/planners/floors.h"

namespace floorproof {
namespace {

using testing::Coverage;
using testing::Draw;
using testing::EmptyFloor;
using testing::ExpectSound;
using testing::MakePlanner;
using testing::TightestTurn;

constexpr double kTightest_m = 0.15;

RobotSpec Tricycle() {
  RobotSpec robot = testing::DiscRobot(0.3, 0.4);
  robot.turn_radius_m = kTightest_m;
  return robot;
}

struct Floor {
  const char* name;
  HazardMap map;
  Pose2 start;
};
std::vector<Floor> Floors() {
  return {{"open", EmptyFloor(24, 16, 0.25), {1, 1, 0}},
          {"facing_a_wall", EmptyFloor(24, 16, 0.25), {1, 1, -2}},
          {"pillar",
           Draw(R"(
             ........................
             ........................
             ........................
             ........................
             ........................
             ..........##............
             ..........##............
             ..........##............
             ........................
             ........................
             ........................
             ........................
             ........................)",
                0.25),
           {1, 1, 1}},
          {"two_rooms",
           Draw(R"(
             ##########################
             #............#...........#
             #............#...........#
             #............#...........#
             #............#...........#
             #........................#
             #........................#
             #........................#
             #........................#
             #............#...........#
             #............#...........#
             #............#...........#
             ##########################)",
                0.25, {-3, 2, 0.4}),
           Pose2{-3, 2, 0.4} * Pose2{1.5, 1.5, 0}}};
}

class TurnedPlans : public ::testing::TestWithParam<std::tuple<const char*, Floor>> {};

TEST_P(TurnedPlans, CanBeDrivenAndAreClear) {
  const auto& [planner, floor] = GetParam();
  const RobotSpec robot = Tricycle();
  const PlanRequest request{floor.map, robot, floor.start, {}, 1};
  PlanResult dut = MakePlanner(planner)->Plan(request);
  const double before = Coverage(floor.map, robot, floor.start, dut);
  FitTurns(request, dut);
  ExpectSound(floor.map, floor.start, dut);
  EXPECT_GE(TightestTurn(dut.path), 0.99 * kTurnReserve * kTightest_m);
  const double after = Coverage(floor.map, robot, floor.start, dut);
  EXPECT_GT(after, 0.85);
  const auto cost =
      std::ranges::find(dut.figures, "turns_cost_coverage", [](const auto& f) { return f.first; });
  ASSERT_NE(cost, dut.figures.end());
  EXPECT_NEAR(cost->second, std::max(0.0, before - after), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, TurnedPlans,
                         ::testing::Combine(::testing::Values("boustrophedon", "spiral"),
                                            ::testing::ValuesIn(Floors())),
                         [](const auto& suite) {
                           return std::string(std::get<0>(suite.param)) + "_" +
                                  std::get<1>(suite.param).name;
                         });

TEST(FitTurns, LeavesAPlanOfARobotThatTurnsOnTheSpotAlone) {
  const RobotSpec robot = testing::DiscRobot(0.3, 0.4);
  const HazardMap map = EmptyFloor(24, 16, 0.25);
  const PlanRequest request{map, robot, {1, 1, 0}, {}, 1};
  PlanResult dut = MakePlanner("boustrophedon")->Plan(request);
  const Path before = dut.path;
  FitTurns(request, dut);
  ASSERT_EQ(dut.path.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(dut.path[i].p_W, before[i].p_W);
  EXPECT_EQ(dut.message, "");
}

TEST(FitTurns, SaysThatItCannotLeaveTheStart) {
  RobotSpec robot = Tricycle();
  robot.turn_radius_m = 1;
  const HazardMap map = EmptyFloor(8, 8, 0.25);
  const PlanRequest request{map, robot, {0.5, 0.5, 0.7}, {}, 1};
  PlanResult dut = MakePlanner("boustrophedon")->Plan(request);
  FitTurns(request, dut);
  EXPECT_EQ(dut.status, PlanStatus::kFailed);
  EXPECT_TRUE(dut.path.empty());
  EXPECT_THAT(dut.message, ::testing::HasSubstr("arcs of 1.2 m radius"));
}

}  // namespace
}  // namespace floorproof

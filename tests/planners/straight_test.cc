// SPDX-License-Identifier: Apache-2.0
// The planner `straight`: where it goes, how it holds the body, and when it does not go.
#include <gmock/gmock.h>

#include "tests/planners/floors.h"

namespace floorproof {
namespace {

using testing::DiscRobot;
using testing::EmptyFloor;
using ::testing::HasSubstr;
using testing::MakePlanner;

class StraightPlan : public ::testing::Test {
 protected:
  PlanResult Plan(const std::string& keys = "{}") {
    const auto dut = MakePlanner("straight");
    ReadParams(ParseYaml(keys, "plan.yaml"), "plan.", *dut);
    return dut->Plan({map_, robot_, start_, goal_});
  }
  void AddStep(double height_m) {
    Hazard& step = map_.hazards.emplace_back();
    step.hazard_class = HazardClass::kLevelChange;
    step.height_m = height_m;
    step.footprint = {Rectangle({2, 0}, {2.5, 3})};
  }
  HazardMap map_ = EmptyFloor(8, 6, 0.5);
  RobotSpec robot_ = DiscRobot(0.2, 0.3);
  Pose2 start_{0.75, 1.25, 0.7};
  std::optional<Vec2> goal_ = Vec2(3.25, 1.75);
};

TEST_F(StraightPlan, IsOneLineAtTheStartsYawAndTheSpeedAsked) {
  const PlanResult dut = Plan("{speed_mps: 0.3}");
  ASSERT_EQ(dut.status, PlanStatus::kSuccess) << dut.message;
  ASSERT_EQ(dut.path.size(), 2u);
  EXPECT_EQ(dut.path[0].p_W, start_.p());
  EXPECT_EQ(dut.path[1].p_W, *goal_);
  EXPECT_EQ(dut.path[1].yaw_rad, 0.7);
  EXPECT_EQ(dut.path[1].speed_mps, 0.3);
  EXPECT_EQ(Plan().path[1].speed_mps, 0) << "cruise";
}

TEST_F(StraightPlan, GoesOverWhatTheRobotIsTrustedToCross) {
  AddStep(robot_.step_m);
  EXPECT_EQ(Plan().status, PlanStatus::kSuccess);
}

TEST_F(StraightPlan, CrossesObstaclesOnlyIfAsked) {
  AddStep(2 * robot_.step_m);
  const PlanResult dut = Plan();
  EXPECT_EQ(dut.status, PlanStatus::kGoalUnreachable);
  EXPECT_THAT(dut.message, HasSubstr("is not free at (1.8"));
  EXPECT_TRUE(dut.path.empty());
  EXPECT_EQ(Plan("{cross_obstacles: true}").status, PlanStatus::kSuccess);
  start_.x_m = 2.25;
  EXPECT_EQ(Plan().status, PlanStatus::kStartBlocked);
  EXPECT_EQ(Plan("{cross_obstacles: true}").status, PlanStatus::kSuccess) << "from amid it";
}

TEST_F(StraightPlan, NeverGoesThroughAWall) {
  map_.occupancy(4, 2) = map_.occupancy(4, 3) = CellState::kOccupied;
  for (const char* keys : {"{}", "{cross_obstacles: true}"}) {
    EXPECT_EQ(Plan(keys).status, PlanStatus::kGoalUnreachable);
    EXPECT_TRUE(Plan(keys).path.empty());
  }
}

// A bar 0.8 m long, 0.2 m wide passes a gap of 0.5 m lengthwise and not crosswise.
TEST_F(StraightPlan, TheYawThatIsHeldDecidesWhereItFits) {
  map_.occupancy(4, 1) = map_.occupancy(4, 3) = CellState::kOccupied;
  robot_.clear.kind = Shape2::Kind::kFootprint;
  robot_.clear.footprint_B = Rectangle({-0.4, -0.1}, {0.4, 0.1});
  start_ = {0.75, 1.25, 0};
  goal_ = Vec2(3.25, 1.25);
  EXPECT_EQ(Plan().status, PlanStatus::kSuccess);
  start_.yaw_rad = kPi / 2;
  EXPECT_EQ(Plan().status, PlanStatus::kGoalUnreachable);
}

std::vector<Vec2> Places(const PlanResult& plan) {
  std::vector<Vec2> places;
  for (const Waypoint& waypoint : plan.path) places.push_back(waypoint.p_W);
  return places;
}

MATCHER_P(AreNear, places, "") {
  if (arg.size() != places.size()) return false;
  for (std::size_t i = 0; i < places.size(); ++i)
    if ((arg[i] - places[i]).norm() > 1e-9) return false;
  return true;
}

class LanesOfStraight : public StraightPlan {
 protected:
  LanesOfStraight() {
    start_ = {0.75, 1.25, 0};
    goal_ = Vec2(2.75, 1.25);
  }
  std::vector<Vec2> Lanes(const std::string& keys) { return Places(Plan("{" + keys + "}")); }
};

TEST_F(LanesOfStraight, LeadThereAndBackOrAside) {
  const std::string keys = "turn_at: 0.5, turn_deg: 90, aside_m: 0.3";
  const std::vector<Vec2> back = {
      {0.75, 1.25}, {1.75, 1.25}, {1.75, 1.55}, {0.75, 1.55}, {0.75, 1.25}};
  EXPECT_THAT(Lanes("lanes: back, " + keys), AreNear(back));
  const std::vector<Vec2> thrice = {{0.75, 1.25}, {1.75, 1.25}, {1.75, 1.55}, {1.25, 1.55},
                                    {1.25, 1.85}, {2.75, 1.85}, {2.75, 1.25}};
  EXPECT_THAT(Lanes("lanes: thrice, " + keys), AreNear(thrice));
  const std::vector<Vec2> aside = {
      {0.75, 1.25}, {1.75, 1.25}, {1.75, 1.55}, {2.75, 1.55}, {2.75, 1.25}};
  EXPECT_THAT(Lanes("lanes: aside, " + keys), AreNear(aside));
  const std::vector<Vec2> slanting = {{0.75, 1.25},
                                      {1.75, 1.25},
                                      {1.9, 1.25 + 0.15 * std::sqrt(3)},
                                      {2.75, 1.25 + 0.15 * std::sqrt(3)},
                                      {2.75, 1.25}};
  EXPECT_THAT(Lanes("lanes: aside, turn_at: 0.5, turn_deg: 60, aside_m: 0.3"), AreNear(slanting));
}

// To the right where a wall stands on the left; where both sides are closed, none is changed.
TEST_F(LanesOfStraight, AreChangedWhereThereIsRoom) {
  const std::string keys = "lanes: aside, turn_at: 0.5, turn_deg: 90, aside_m: 0.5";
  EXPECT_GT(Lanes(keys)[2].y(), 1.25);
  map_.occupancy(3, 3) = CellState::kOccupied;
  EXPECT_LT(Lanes(keys)[2].y(), 1.25);
  map_.occupancy(3, 1) = CellState::kOccupied;
  EXPECT_THAT(Lanes(keys), ::testing::SizeIs(2));
  EXPECT_THAT(Plan("{" + keys + "}").message, HasSubstr("no room"));
}

// Even for who crosses obstacles; a step takes none.
TEST_F(LanesOfStraight, WhatStandsInTheWayTakesRoom) {
  const std::string keys = "cross_obstacles: true, lanes: aside, turn_deg: 90, aside_m: 0.5";
  Hazard& hazard = map_.hazards.emplace_back();
  hazard.hazard_class = HazardClass::kLevelChange;
  hazard.height_m = 0.1;
  hazard.footprint = {Rectangle({1.5, 1.7}, {2, 2.2})};
  EXPECT_GT(Lanes(keys)[2].y(), 1.25);
  hazard.hazard_class = HazardClass::kGlass;
  EXPECT_LT(Lanes(keys)[2].y(), 1.25);
}

TEST_F(StraightPlan, SaysWhyItHasNoWay) {
  goal_ = start_.p();
  EXPECT_THAT(Plan().message, HasSubstr("where the robot starts"));
  goal_.reset();
  EXPECT_THAT(Plan().message, HasSubstr("needs a goal"));
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Success depends on the robot's true place, on its being at rest, and on the plan it truly
// covered.
#include "run/episode/arrival.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "run/episode/records.h"
#include "run/scenario/scenario.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

Path Way(const std::vector<Vec2>& places) {
  Path path;
  for (const Vec2& p : places) path.emplace_back().p_W = p;
  return path;
}

void Walk(PlanPassed& dut, const Vec2& from, const Vec2& to) {
  for (int i = 0; i <= 1000; ++i) dut.Add(from + i / 1000.0 * (to - from), false);
}

TEST(PlanPassed, LeavesWhatTheRobotDidNotComeNearTo) {
  PlanPassed dut(Way({{0, 0}, {10, 0}}), 0.25);
  EXPECT_NEAR(dut.left_m(), 10, 1e-9);
  Walk(dut, {0, 0.2}, {6, 0.2});
  EXPECT_NEAR(dut.left_m(), 4 - std::sqrt(0.25 * 0.25 - 0.2 * 0.2), 0.06);
  Walk(dut, {6, 0.3}, {10, 0.3});
  EXPECT_GT(dut.left_m(), 3.7) << "too far beside it";
  Walk(dut, {10, 0}, {6, 0});
  EXPECT_EQ(dut.left_m(), 0);
}

// A loop ends where it began: a robot that never moved is at its end, but has left out the path.
TEST(PlanPassed, OfALoopALotIsLeftWhereTheRobotNeverMoved) {
  PlanPassed dut(Way({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}}), 0.25);
  Walk(dut, {0, 0}, {0.1, 0});
  EXPECT_GT(dut.left_m(), 11);
}

// Far from the origin, and on a plan of many kilometres.
TEST(PlanPassed, IsTheSameAnywhere) {
  for (const Vec2& at : {Vec2(0, 0), Vec2(-1e5, 3e5)}) {
    std::vector<Vec2> rows;
    for (int i = 0; i < 1000; ++i)
      for (const double x : {0.0, 100.0}) rows.push_back(at + Vec2(i % 2 ? 100 - x : x, 0.4 * i));
    PlanPassed dut(Way(rows), 0.25);
    for (std::size_t i = 0; i + 1 < rows.size() / 2; ++i) Walk(dut, rows[i], rows[i + 1]);
    EXPECT_NEAR(dut.left_m() / (1000 * 100.4), 0.5, 0.01);
  }
}

TEST(PlanPassed, ATaskIsDoneWhereTheRobotStandsOnPurpose) {
  Path plan = Way({{0, 0}, {2, 0}, {4, 0}});
  plan[1].task.emplace();
  PlanPassed dut(plan, 0.25);
  Walk(dut, {0, 0}, {4, 0});
  EXPECT_EQ(dut.tasks_missed(), 1) << "driven past";
  dut.Add({2.4, 0}, true);
  EXPECT_EQ(dut.tasks_missed(), 1) << "done elsewhere";
  EXPECT_EQ(dut.first_missed_W(), Vec2(2, 0));
  dut.Add({2.2, 0}, true);
  EXPECT_EQ(dut.tasks_missed(), 0);
}

class Arrivals : public ScenarioTest {
 protected:
  Arrivals() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n6.5,2.5\n"); }
  static std::string Step(double height_m) {
    return "{type: step, id: st, known: false, height_m: " + std::to_string(height_m) +
           ", polygon_m: [[4, 0.5], [8.5, 0.5], [8.5, 4.5], [4, 4.5]]}";
  }
};

// Its wheels turn before an unknown step; by odometry it has driven its whole plan.
TEST_F(Arrivals, WhoOnlyBelievesThatItArrivedDidNot) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n5.2,2.5\n");  // at its end before it counts as stuck
  Scenario s = Read(RoomScenario(Step(0.03), "estimator: odometry\n"), {{"robot", "htetro"}});
  const EpisodeRecord dut =
      Drive(Read(RoomScenario(Step(0.03), "estimator: odometry\n"), {{"robot", "htetro"}}));
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  ASSERT_TRUE(dut.arrival);
  EXPECT_TRUE(dut.arrival->believed);
  EXPECT_GT(*dut.metrics.end_off_m, 1);
  EXPECT_GT(*dut.metrics.plan_left_m, 1);
  EXPECT_THAT(dut.message, HasSubstr("believed that it had arrived"));
  EXPECT_THAT(dut.message, HasSubstr("success.arrival_m"));
  const auto json = ResultJson(s, dut);
  EXPECT_TRUE(json["arrival"]["believed"]);
  EXPECT_EQ(json["arrival"]["end_off_m"], *dut.metrics.end_off_m);
}

TEST_F(Arrivals, WhoIsThereAndBelievesItSucceeds) {
  for (const char* estimator : {"truth", "odometry"}) {
    const EpisodeRecord dut =
        Drive(Read(RoomScenario("", std::string("estimator: ") + estimator + "\n")));
    EXPECT_EQ(dut.outcome, Outcome::kSuccess) << dut.message;
    EXPECT_LT(*dut.metrics.end_off_m, 0.25);
    EXPECT_LT(*dut.metrics.plan_left_m, 0.1);
    EXPECT_TRUE(dut.arrival->at_rest);
  }
}

TEST_F(Arrivals, TheToleranceIsTheScenarios) {
  const EpisodeRecord dut =
      Drive(Read(RoomScenario("", "estimator: odometry\nsuccess: {arrival_m: 0.01}\n")));
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  EXPECT_THAT(dut.message, HasSubstr("success.arrival_m allows 0.01 m"));
}

// Passing its goal on ice, and on into a pit.
TEST_F(Arrivals, OnlyWhoStandsHasArrived) {
  const std::string ice =
      "{type: wet, id: ice, known: false, friction: 0.03, polygon_m: [[4, 0.5], [8.5, 0.5], [8.5, "
      "4.5], [4, 4.5]]}";
  const std::string pit =
      "{type: step, id: pit, height_m: -0.3, polygon_m: [[6.8, 0.5], [8.5, 0.5], [8.5, 4.5], [6.8, "
      "4.5]]}";
  Save("plan.csv", "x_m,y_m,speed_mps\n1.5,2.5,0.8\n6.0,2.5,0.8\n");
  const EpisodeRecord dut = Drive(Read(RoomScenario(ice + ", " + pit), {{"robot", "scrubber"}}));
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  ASSERT_FALSE(dut.events.empty()) << dut.message;
  EXPECT_EQ(dut.events[0].kind, "fell");
}

// Enough is covered: the drive ends by that, wherever the robot is.
TEST_F(Arrivals, WhoStopsByItsCoverageNeedNotArrive) {
  const EpisodeRecord dut = Drive(Read(RoomScenario("", "success: {stop_at_coverage: 0.02}\n")));
  EXPECT_EQ(dut.outcome, Outcome::kSuccess) << dut.message;
  EXPECT_FALSE(dut.arrival);
}

}  // namespace
}  // namespace floorproof

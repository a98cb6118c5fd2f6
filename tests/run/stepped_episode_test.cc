// SPDX-License-Identifier: Apache-2.0
// An episode a control period at a time, and one that nobody leads.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "controllers/twist_tracker.h"
#include "run/episode/episode.h"
#include "run/episode/free_navigator.h"
#include "run/episode/make_plan.h"
#include "run/episode/records.h"
#include "run/episode/robot_side.h"
#include "run/scenario/agents.h"
#include "run/scenario/scenario.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

class Constant final : public TwistTracker {
 public:
  explicit Constant(const BodyTwist& twist) : TwistTracker(true), twist_(twist) {}

 private:
  BodyTwist Twist(const Situation&) override { return twist_; }
  BodyTwist twist_;
};

class SteppedEpisodeTest : public ScenarioTest {
 protected:
  SteppedEpisodeTest() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n3,2.5\n3,3.5\n1.5,3.5\n"); }

  static Agents DrivenBy(const Scenario& s, const BodyTwist& twist) {
    Agents agents = MakeAgents(s.spec);
    agents.tracker = std::make_unique<Constant>(twist);
    return agents;
  }
  // Driven freely with this twist for so long, or until it ends.
  EpisodeRecord GoFreely(const Scenario& s, const BodyTwist& twist, double for_s) const {
    PlanResult plan = MakePlan(s);
    plan.path.resize(1);
    const Scene scene = BuildScene(s.world.site.map, s.world.robot, s.world.physics, s.world.start);
    SteppedEpisode dut(s, DrivenBy(s, twist), scene, plan,
                       std::make_unique<FreeNavigator>(s.world.start));
    std::optional<Outcome> ended;
    while (!ended && dut.view().sample.t_s < for_s) ended = dut.Advance();
    return dut.Finish(ended.value_or(Outcome::kInterrupted));
  }
};

TEST_F(SteppedEpisodeTest, StepsGiveTheBytesOfTheWholeDrive) {
  for (const char* more :
       {"", "control_hz: 25\ntrace_hz: 5\nsensors: {lidar: {noise_m: 0.02}}\n"}) {
    Scenario whole = Read(RoomScenario("", more)), s = Read(RoomScenario("", more));
    const EpisodeRecord expected = Execute(whole).record;
    const PlanResult plan = MakePlan(s);
    const Scene scene = BuildScene(s.world.site.map, s.world.robot, s.world.physics, s.world.start);
    SteppedEpisode dut(s, MakeAgents(s.spec), scene, plan);
    std::optional<Outcome> ended;
    while (!ended) ended = dut.Advance();
    EXPECT_EQ(*ended, Outcome::kSuccess);
    const EpisodeRecord record = dut.Finish(*ended);
    EXPECT_EQ(TraceCsv(record, s.world.robot.spec), TraceCsv(expected, whole.world.robot.spec));
    EXPECT_EQ(ResultJson(s, record).dump(), ResultJson(whole, expected).dump());
    EXPECT_EQ(record.passes.cells, expected.passes.cells);
  }
}

// Circles without end are no failure where nobody says where to go: nothing is off a way that is
// not there, and who drives gets on.
TEST_F(SteppedEpisodeTest, AFreeRobotIsOffNothingAndGetsOnByDriving) {
  const Scenario s = Read(RoomScenario(""));
  const EpisodeRecord dut = GoFreely(s, {0.25, 0, 0.8}, 30);
  EXPECT_THAT(dut.events, ::testing::IsEmpty());
  EXPECT_EQ(dut.metrics.max_cross_track_m, 0);
  EXPECT_GT(dut.metrics.path_length_m, 5);
  EXPECT_NEAR(dut.metrics.duration_s, 30, 0.05);
}

// 2 m from the wall, and on into it.
TEST_F(SteppedEpisodeTest, AFreeRobotThatPushesAWallIsStuck) {
  const Scenario s = Read(RoomScenario(""));
  const EpisodeRecord dut = GoFreely(s, {0, 0.25, 0}, 60);
  ASSERT_EQ(dut.events.size(), 1u);
  EXPECT_EQ(dut.events[0].mode, FailureMode::kStuck);
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  EXPECT_LT(dut.metrics.path_length_m, 3);
}

TEST_F(SteppedEpisodeTest, AFreeDriveEndsWhereEnoughIsCovered) {
  const Scenario s = Read(RoomScenario("", "success: {stop_at_coverage: 0.03}\n"));
  const EpisodeRecord dut = GoFreely(s, {0.25, 0, 0}, 60);
  EXPECT_EQ(dut.outcome, Outcome::kSuccess);
  EXPECT_NEAR(dut.metrics.coverage, 0.03, 0.002);
}

// Whoever commands each period sees no period in which nothing is driven.
TEST_F(SteppedEpisodeTest, TheTimeLimitEndsThePeriodThatReachesIt) {
  const Scenario s = Read(RoomScenario("", "time_limit_s: 0.5\n"));
  const PlanResult plan = MakePlan(s);
  const Scene scene = BuildScene(s.world.site.map, s.world.robot, s.world.physics, s.world.start);
  SteppedEpisode dut(s, DrivenBy(s, {0.2, 0, 0}), scene, plan,
                     std::make_unique<FreeNavigator>(s.world.start));
  std::optional<Outcome> ended;
  int periods = 0;
  for (double before_s = 0; !ended; before_s = dut.view().sample.t_s, ++periods) {
    ended = dut.Advance();
    EXPECT_GT(dut.view().sample.t_s, before_s + 0.019);
  }
  EXPECT_EQ(*ended, Outcome::kTimeout);
  EXPECT_EQ(periods, 25);
}

// A failure breaks a period off; the record is the same whether or not somebody looks once more.
TEST_F(SteppedEpisodeTest, AfterItsEndWhatIsSensedIsOfTheEnd) {
  const Scenario s = Read(RoomScenario("", "sensors: {lidar: {rate_hz: 100}}\nmapper: {}\n"));
  const PlanResult plan = MakePlan(s);
  const Scene scene = BuildScene(s.world.site.map, s.world.robot, s.world.physics, s.world.start);
  SteppedEpisode dut(s, DrivenBy(s, {0.25, 0, 0.6}), scene, plan);  // which it leaves
  std::optional<Outcome> ended;
  while (!ended) ended = dut.Advance();
  ASSERT_EQ(*ended, Outcome::kFailure);
  const double sensed_s = dut.view().sensed.t_s;
  const KnownMap before = *dut.robot().known();
  const EpisodeRecord record = dut.Finish(*ended);
  EXPECT_LT(sensed_s, dut.view().sample.t_s);
  EXPECT_EQ(dut.view().sensed.t_s, dut.view().sample.t_s);
  EXPECT_EQ(dut.view().estimate.X_WB.p(), dut.view().sample.X_WB().p());  // `truth`
  EXPECT_EQ(dut.view().coverage, record.metrics.coverage);
  EXPECT_EQ(record.known->log_odds.cells, before.log_odds.cells);
  EXPECT_NE(dut.robot().known()->log_odds.cells, before.log_odds.cells);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "run/episode/episode.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "run/episode/records.h"
#include "run/scenario/agents.h"
#include "run/scenario/scenario.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

class EpisodeTest : public ScenarioTest {
 protected:
  EpisodeTest() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n3,2.5\n3,3.5\n1.5,3.5\n"); }
};

TEST_F(EpisodeTest, TheSameSeedGivesTheSameBytes) {
  const Scenario a = Read(RoomScenario("")), b = Read(RoomScenario(""));
  const EpisodeRecord first = Drive(Read(RoomScenario(""))), second = Drive(Read(RoomScenario("")));
  EXPECT_EQ(ResultJson(a, first).dump(), ResultJson(b, second).dump());
  EXPECT_EQ(TraceCsv(first, {}), TraceCsv(second, {}));
  EXPECT_EQ(first.passes.cells, second.passes.cells);
}

// Plug-ins with a state, and noise that is drawn.
TEST_F(EpisodeTest, OneScenarioDrivenTwiceGivesTheSameBytes) {
  const Scenario s = Read(RoomScenario(
      "",
      "estimator: mcl\nsensors: {lidar: {noise_m: 0.02}, encoders: {noise: 0.02}}\nmapper: {}\n"));
  const EpisodeRecord first = Drive(s), second = Drive(s);
  EXPECT_EQ(ResultJson(s, first).dump(), ResultJson(s, second).dump());
  EXPECT_EQ(TraceCsv(first, {}), TraceCsv(second, {}));
}

TEST_F(EpisodeTest, ACleanDriveEndsAtTheLastWaypoint) {
  const EpisodeRecord dut = Drive(Read(RoomScenario("")));
  EXPECT_EQ(dut.outcome, Outcome::kSuccess);
  EXPECT_TRUE(dut.events.empty());
  EXPECT_NEAR(dut.trace.back().x_m, 1.5, 0.05);
  EXPECT_NEAR(dut.trace.back().y_m, 3.5, 0.05);
  EXPECT_NEAR(dut.metrics.path_length_m, 4.0, 0.1);
  for (const auto& margin : dut.margins) EXPECT_GT(margin.value, 0) << margin.detector;
}

// Two detectors of one failure mode do not hide each other's margins.
TEST_F(EpisodeTest, EachDetectorHasItsOwnMargin) {
  class Content final : public Detector {
   public:
    FailureMode mode() const override { return FailureMode::kStuck; }
    void Start(const EpisodeContext&) override { margin_ = 1234; }
    bool Update(const Sample&) override { return false; }
  };
  const Scenario scenario = Read(RoomScenario(""));
  Agents agents = MakeAgents(scenario.spec);
  agents.detectors.push_back({"content", std::make_unique<Content>()});
  const auto margins = ResultJson(scenario, DriveWith(scenario, agents)).at("margins");
  EXPECT_EQ(margins.size(), Detectors().size() + 1);
  EXPECT_EQ(margins.at("content"), 1234);
  EXPECT_LT(margins.at("stuck"), 10);
}

// Its plan runs 2 cm inside the wall for 4 m.
TEST_F(EpisodeTest, ScrapingIsMeasured) {
  const EpisodeRecord clear = Drive(Read(RoomScenario("")));
  EXPECT_EQ(clear.metrics.contact_s, 0);
  EXPECT_EQ(clear.metrics.contact_m, 0);
  EXPECT_EQ(clear.metrics.max_contact_n, 0);
  const auto scrape = [&](double inside_m) {
    constexpr double kWall_m = 0.5 - 0.03;  // drawn back by inset_m
    const std::string y = std::to_string(kWall_m + 0.18 - inside_m);
    Save("plan.csv", "x_m,y_m\n1.5,2.5\n1.5,0.75\n2," + y + "\n6," + y + "\n6,2.5\n");
    return Drive(Read(RoomScenario(""))).metrics;
  };
  const Metrics shallow = scrape(0.01), deep = scrape(0.02);
  for (const Metrics& dut : {shallow, deep}) {
    EXPECT_NEAR(dut.contact_m, 4, 0.3);
    EXPECT_GT(dut.contact_s, dut.contact_m / 0.26) << "at its speed, at most";
    EXPECT_LT(dut.contact_s, dut.duration_s);
    EXPECT_GT(dut.max_contact_n, 0);
    EXPECT_LT(dut.contacts, 5);
  }
  EXPECT_GT(deep.max_contact_n, 0.5 * shallow.max_contact_n);
}

// A ROS map may lie kilometres from the world's origin; its trace has the digits of any other.
TEST(TraceCsv, KeepsATenthOfAMillimetreAnywhere) {
  const auto line_of = [](double x_m) {
    EpisodeRecord record;
    TraceRow row{};
    row.x_m = x_m;
    row.y_m = -x_m;
    row.est_x_m = x_m + 0.0001;
    record.trace = {row};
    const std::string csv = TraceCsv(record, {});
    return csv.substr(csv.find('\n') + 1);
  };
  EXPECT_THAT(line_of(0.1234), ::testing::StartsWith("0.000,0.12340,-0.12340,"));
  EXPECT_THAT(line_of(654321.1234), ::testing::StartsWith("0.000,654321.12340,-654321.12340,"));
  EXPECT_THAT(line_of(654321.1234), ::testing::HasSubstr("654321.12350"));
  EXPECT_THAT(line_of(1e-9), ::testing::StartsWith("0.000,0.00000,0.00000,"));
}

// E = integral of power: at least the hotel load for all of the time.
TEST_F(EpisodeTest, EnergyIsHotelLoadAndMotors) {
  const Scenario scenario = Read(RoomScenario(""));
  const EpisodeRecord dut = Drive(Read(RoomScenario("")));
  const double hotel_j = scenario.world.robot.spec.hotel_load_w * dut.metrics.duration_s;
  EXPECT_GT(dut.metrics.energy_j, hotel_j);
  EXPECT_LT(dut.metrics.energy_j, 1.2 * hotel_j)
      << "the motors of a slow robot on flat floor take little";
}

// There and back, with something to do on the way.
class Errand : public Planner {
 public:
  void Visit(ParamVisitor&) override {}
  PlannerPromises promises() const override { return {}; }
  PlanResult Plan(const PlanRequest& request) const override {
    PlanResult plan;
    plan.status = PlanStatus::kSuccess;
    for (const double x_m : {0.0, 1.0, 0.0})
      plan.path.emplace_back().p_W = request.start.p() + Vec2(x_m, 0);
    plan.path[1].task = WaypointTask{.id = 3};
    return plan;
  }
};

TEST_F(EpisodeTest, APlansTasksReachTheOneWhoDrivesIt) {
  Scenario scenario = Read(RoomScenario(""));
  scenario.spec.user_plan[1].task = WaypointTask{.id = 8};
  EXPECT_EQ(MakePlan(scenario).path[1].task, scenario.spec.user_plan[1].task);
  GuestPlugins<Planner>::Add(Planners(), "errand", [] { return std::make_unique<Errand>(); });
  const PlanResult plan = MakePlan(Read(RoomScenario(""), {{"plan", "{planner: errand}"}}));
  EXPECT_EQ(plan.path[1].task, WaypointTask{.id = 3});
  EXPECT_FALSE(plan.path[0].task || plan.path[2].task);
}

TEST_F(EpisodeTest, DwellingTakesItsTimeAndIsNotStuck) {
  Save("plan.csv", "x_m,y_m,dwell_s\n1.5,2.5,0\n2.5,2.5,15\n3,2.5,0\n");
  const EpisodeRecord dwelt = Drive(Read(RoomScenario("")));
  Save("plan.csv", "x_m,y_m,dwell_s\n1.5,2.5,0\n2.5,2.5,0\n3,2.5,0\n");
  const EpisodeRecord driven = Drive(Read(RoomScenario("")));
  EXPECT_EQ(dwelt.outcome, Outcome::kSuccess);
  EXPECT_GT(dwelt.metrics.duration_s, driven.metrics.duration_s + 14.9);
  EXPECT_LT(dwelt.metrics.duration_s, driven.metrics.duration_s + 20);
}

TEST_F(EpisodeTest, ATimeLimitIsATimeoutAndNoFailure) {
  const EpisodeRecord dut = Drive(Read(RoomScenario("", "time_limit_s: 3\n")));
  EXPECT_EQ(dut.outcome, Outcome::kTimeout);
  EXPECT_TRUE(dut.events.empty());
  EXPECT_NEAR(dut.metrics.duration_s, 3, 0.03);
}

TEST_F(EpisodeTest, ATimeoutSaysWhereAndByWhat) {
  const Scenario scenario = Read(RoomScenario(""));
  const EpisodeRecord open = Drive(Read(RoomScenario("", "time_limit_s: 3\n")));
  ASSERT_TRUE(open.timeout);
  EXPECT_EQ(open.timeout->t_s, open.metrics.duration_s);
  EXPECT_EQ(open.timeout->hazard, "") << "nothing was near";
  const auto json = ResultJson(scenario, open).at("timeout");
  EXPECT_NEAR(json.at("x_m"), open.trace.back().x_m, 1e-6);
  EXPECT_NEAR(json.at("y_m"), open.trace.back().y_m, 1e-6);
  EXPECT_THAT(open.message, ::testing::HasSubstr("at x 2."));
  // At a sill that is too high, before ten seconds have shown that it holds.
  const EpisodeRecord held = Drive(Read(RoomScenario(
      "{id: sill, type: step, height_m: 0.04, known: false, polygon_m: [[2.5, 1], [3, 1], [3, 4], "
      "[2.5, 4]]}",
      "time_limit_s: 8\n")));
  ASSERT_TRUE(held.timeout) << held.message;
  EXPECT_EQ(held.timeout->hazard, "sill");
  EXPECT_NEAR(held.timeout->X_WB.x_m, 2.5 - 0.18, 0.08);
  EXPECT_THAT(held.message, ::testing::HasSubstr("sill"));
  // Any other outcome has none.
  EXPECT_FALSE(ResultJson(scenario, Drive(Read(RoomScenario("")))).contains("timeout"));
}

// 60 right angles, and a minute of dwells: the limit knows them.
TEST_F(EpisodeTest, TheDefaultTimeLimitCountsTurnsAndDwells) {
  std::string stairs = "x_m,y_m,dwell_s\n";
  Vec2 p(1.5, 2.5);
  for (int i = 0; i < 60; ++i) {
    stairs += fmt::format("{:.2f},{:.2f},{}\n", p.x(), p.y(), i % 10 == 0 ? 10 : 0);
    if (i % 2 == 0)
      p.x() += 0.15;
    else
      p.y() += i % 4 == 1 ? 0.15 : -0.15;
  }
  Save("plan.csv", stairs);
  for (const char* robot : {"beluga", "htetro"}) {
    const EpisodeRecord dut = Drive(Read(RoomScenario(""), {{"robot", robot}}));
    EXPECT_EQ(dut.outcome, Outcome::kSuccess) << dut.message;
  }
}

TEST_F(EpisodeTest, LessCoverageThanAskedForIsNoSuccess) {
  const EpisodeRecord dut = Drive(Read(RoomScenario("", "success: {min_coverage: 0.9}\n")));
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  EXPECT_TRUE(dut.events.empty());
  EXPECT_THAT(dut.message, ::testing::HasSubstr("min_coverage"));
}

// A user's plan straight into a wall is driven and judged.
TEST_F(EpisodeTest, APlanThroughAWallFailsAtTheWall) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n1.5,4.9\n");
  const EpisodeRecord dut = Drive(Read(RoomScenario("")));
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  ASSERT_FALSE(dut.events.empty());
  EXPECT_EQ(dut.events[0].mode, FailureMode::kStuck);
  EXPECT_EQ(dut.events[0].hazard, "wall");
  EXPECT_NEAR(dut.events[0].y_m, 4.5 - 0.18, 0.08);
}

class Interrupter : public EpisodeObserver {
 public:
  bool OnControl(const EpisodeView&) override { return ++count_ < 50; }

 private:
  int count_ = 0;
};

TEST_F(EpisodeTest, AnInterruptedEpisodeKeepsWhatWasDriven) {
  Interrupter observer;
  const EpisodeRecord dut = Drive(Read(RoomScenario("")), &observer);
  EXPECT_EQ(dut.outcome, Outcome::kInterrupted);
  EXPECT_EQ(dut.trace.size(), 50u);
}

// Throws the robot away at an impossible speed: the engine warns, and that is no robot's failure.
class Vandal : public EpisodeObserver {
 public:
  bool OnControl(const EpisodeView& now) override {
    if (++count_ == 20) now.simulation->data()->qvel[0] = 1e12;
    return true;
  }

 private:
  int count_ = 0;
};

TEST_F(EpisodeTest, DivergedPhysicsIsAnErrorAndNoFailure) {
  Vandal observer;
  const EpisodeRecord dut = Drive(Read(RoomScenario("")), &observer);
  EXPECT_EQ(dut.outcome, Outcome::kError);
  EXPECT_TRUE(dut.events.empty());
}

TEST_F(EpisodeTest, IgnoredFailuresAreLoggedAndTheDriveGoesOn) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n1.5,4.9\n");
  const EpisodeRecord dut = Drive(Read(RoomScenario("", "on_failure: ignore\ntime_limit_s: 60\n")));
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  EXPECT_NEAR(dut.metrics.duration_s, 60, 0.1);
}

// Held aslant it trembles for a minute and more.
TEST_F(EpisodeTest, ARobotThatIsHeldDrivesNoWay) {
  Save("plan.csv", "x_m,y_m\n1.5,1.5\n6,1.5\n");
  const EpisodeRecord dut = Drive(
      Read(RoomScenario("{type: blind_object, known: false, height_m: 0.5, polygon_m: [[3, 0.7], "
                        "[3.5, 0.7], [3.5, 2.2], [3.3, 2.3]]}",
                        "on_failure: ignore\ntime_limit_s: 100\n"),
           {{"site.start.y_m", "1.5"}}));
  EXPECT_GT(dut.metrics.contact_s, 60);
  EXPECT_LT(dut.metrics.contact_m, 0.15);
  EXPECT_NEAR(dut.metrics.path_length_m, dut.trace.back().x_m - 1.5, 0.1);
}

TEST_F(EpisodeTest, StopsWhenEnoughIsCovered) {
  Save("plan.csv", "x_m,y_m\n1.5,1.5\n6,1.5\n1.5,1.5\n");
  const EpisodeRecord whole = Drive(Read(RoomScenario("")));
  const double enough = 0.5 * whole.metrics.coverage;
  const EpisodeRecord dut =
      Drive(Read(RoomScenario(""), {{"success.stop_at_coverage", std::to_string(enough)}}));
  EXPECT_EQ(dut.outcome, Outcome::kSuccess) << dut.message;
  EXPECT_GE(dut.metrics.coverage, enough);
  EXPECT_LT(dut.metrics.coverage, enough + 0.01);
  EXPECT_LT(dut.metrics.path_length_m, 0.5 * whole.metrics.path_length_m);
}

// Out and back on one line: nearly all that is swept is swept again.
TEST_F(EpisodeTest, WhatIsSweptAgainIsRevisitedOnce) {
  Save("plan.csv", "x_m,y_m\n1.5,1.5\n6,1.5\n1.5,1.5\n");
  const Metrics dut = Drive(Read(RoomScenario(""))).metrics;
  EXPECT_NEAR(dut.revisited, dut.overlap * dut.coverage, 1e-12);
  EXPECT_GT(dut.revisited, 0.7 * dut.coverage);
  EXPECT_NEAR(dut.extra_visits, dut.revisited, 0.002) << "no third pass";
}

}  // namespace
}  // namespace floorproof

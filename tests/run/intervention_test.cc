// SPDX-License-Identifier: Apache-2.0
// `on_failure: assist`: how a person helps a robot that failed, and how the record shows it.
#include "run/episode/intervention.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "run/episode/records.h"
#include "run/scenario/agents.h"
#include "run/scenario/scenario.h"
#include "tests/controllers/allocation_guard.h"
#include "tests/robots.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;

constexpr const char* kAssist = "on_failure: assist\n";

// Across the room from wall to wall, on no map, higher than a robot climbs or deeper than it
// survives.
std::string Barrier(double x_m, double height_m = 0.12) {
  return fmt::format(
      "{{type: step, polygon_m: [[{0},0.5],[{1},0.5],[{1},4.5],[{0},4.5]], height_m: {2}, "
      "known: false}}",
      x_m, x_m + 0.4, height_m);
}

double Error(const TraceRow& row) {
  return std::hypot(row.est_x_m - row.x_m, row.est_y_m - row.y_m);
}

class AssistTest : public ScenarioTest {
 protected:
  AssistTest() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n2.4,2.5\n4.5,2.5\n6,2.5\n6,3.5\n"); }

  EpisodeRecord DriveRoom(const std::string& hazards, const std::string& keys,
                          EpisodeObserver* observer = nullptr) const {
    return Drive(Read(RoomScenario(hazards, keys)), observer);
  }
  // The first row of the trace after this assist.
  static std::vector<TraceRow>::const_iterator After(const EpisodeRecord& record,
                                                     const Intervention& assist) {
    return std::ranges::find_if(record.trace,
                                [&](const TraceRow& row) { return row.t_s > assist.t_s + 1e-6; });
  }
};

class EachRobot : public AssistTest, public ::testing::WithParamInterface<std::string> {
 protected:
  // Stopped by a barrier at x = 3 m between the second waypoint and the third, without
  // bounce_back: the scrubber pitches and comes off it at a sixth of its speed.
  EpisodeRecord Stopped(double height_m, const std::string& keys = kAssist) const {
    return Drive(Read(
        RoomScenario(Barrier(3, height_m), keys + "failures: {bounce_back: {closing_mps: 1}}\n"),
        {{"robot", GetParam()}}));
  }
};
INSTANTIATE_TEST_SUITE_P(Robots, EachRobot, ::testing::ValuesIn(RobotNames()),
                         [](const auto& robot) { return robot.param; });

TEST_P(EachRobot, IsSetDownAtRestAtTheNextWaypointAndDrivesToTheEnd) {
  for (const double height_m : {0.12, -0.15}) {
    const EpisodeRecord dut = Stopped(height_m);
    EXPECT_EQ(dut.outcome, Outcome::kFailure) << "helped, it failed all the same";
    EXPECT_EQ(dut.message, "");
    ASSERT_THAT(dut.events, SizeIs(1));
    EXPECT_EQ(dut.events[0].mode, height_m > 0 ? FailureMode::kStuck : FailureMode::kRollOver);
    EXPECT_EQ(dut.metrics.interventions, 1);
    ASSERT_THAT(dut.interventions, SizeIs(1));
    const Intervention& help = dut.interventions[0];
    EXPECT_GE(help.t_s, dut.events[0].t_s + 30 - 1e-6);
    EXPECT_LT(help.t_s, dut.events[0].t_s + 30 + 0.0201) << "within a control period";
    EXPECT_LT((help.from_W - Vec2(dut.events[0].x_m, dut.events[0].y_m)).norm(), 0.3);
    EXPECT_EQ(help.to_W, Vec2(4.5, 2.5));
    EXPECT_EQ(help.yaw_rad, 0) << "as the way goes on";

    const auto after = After(dut, help);
    ASSERT_NE(after, dut.trace.end());
    EXPECT_NEAR(after->x_m, 4.5, 0.002);
    EXPECT_NEAR(after->y_m, 2.5, 0.002);
    EXPECT_NEAR(after->z_m, dut.trace.front().z_m, 0.0005) << "as at the start";
    EXPECT_NEAR(after->yaw_rad, 0, 0.002);
    EXPECT_LT(std::hypot(after->roll_rad, after->pitch_rad), 0.002);
    EXPECT_LT(std::hypot(after->vx_mps, after->vy_mps), 0.005);
    EXPECT_NEAR(dut.trace.back().x_m, 6, 0.05);
    EXPECT_NEAR(dut.trace.back().y_m, 3.5, 0.05);
    EXPECT_EQ(dut.trace.back().est_x_m, dut.trace.back().x_m) << "the truth is always known";
  }
}

TEST_P(EachRobot, StandsStillUntilThePersonComes) {
  const EpisodeRecord dut = Stopped(0.12);
  ASSERT_THAT(dut.interventions, SizeIs(1));
  const double failed_s = dut.events[0].t_s;
  int rows = 0;
  for (const TraceRow& row : dut.trace) {
    if (row.t_s < failed_s + 0.0201 || row.t_s > dut.interventions[0].t_s) continue;
    ++rows;
    EXPECT_EQ(std::hypot(row.cmd_vx_mps, row.cmd_vy_mps) + std::abs(row.cmd_wz_radps), 0);
    if (row.t_s < failed_s + 1) continue;
    EXPECT_LT(std::hypot(row.vx_mps, row.vy_mps), 0.01) << "at " << row.t_s;
  }
  EXPECT_NEAR(rows, 30 * 50, 2) << "time goes on and is recorded";
}

TEST_P(EachRobot, WhoNeverFailsDrivesAsEver) {
  const auto record = [&](const std::string& keys) {
    const Scenario s = Read(RoomScenario("", keys), {{"robot", GetParam()}});
    const EpisodeRecord driven = Drive(Read(RoomScenario("", keys), {{"robot", GetParam()}}));
    return ResultJson(s, driven).dump() + TraceCsv(driven, {});
  };
  EXPECT_EQ(record(kAssist), record(""));
}

TEST_P(EachRobot, TheSameHelpTwiceIsTheSameRecord) {
  const std::string keys = std::string(kAssist) +
                           "estimator: odometry\nsensors: {encoders: {noise: 0.05}}\n"
                           "time_limit_s: 60\n";
  const EpisodeRecord first = Stopped(0.12, keys), second = Stopped(0.12, keys);
  ASSERT_FALSE(first.interventions.empty());
  const Scenario s = Read(RoomScenario("", keys));
  EXPECT_EQ(ResultJson(s, first).dump(), ResultJson(s, second).dump());
  EXPECT_EQ(TraceCsv(first, {}), TraceCsv(second, {}));
  EXPECT_EQ(first.passes.cells, second.passes.cells);
}

// The way that it is carried is neither driven nor swept.
TEST_P(EachRobot, IsCarriedOverWhatItDoesNotSweep) {
  const EpisodeRecord dut = Stopped(0.12);
  ASSERT_THAT(dut.interventions, SizeIs(1));
  const Intervention& help = dut.interventions[0];
  const double carried_m = (help.to_W - help.from_W).norm();
  ASSERT_GT(carried_m, 1.2);
  const double whole_m = 4.5 + 1;
  EXPECT_NEAR(dut.metrics.path_length_m, whole_m - carried_m, 0.3) << "it rocked at the barrier";
  const auto passes = [&](double x_m) {
    return dut.passes(dut.passes_frame.ToCell(Vec2(x_m, 2.5)));
  };
  EXPECT_GT(passes(2.0), 0);
  EXPECT_EQ(passes(3.6), 0);
  EXPECT_GT(passes(4.5), 0) << "there it stands";
  EXPECT_GT(passes(5.2), 0);
}

// It knew well where it was until then; from then on it is wrong by as far as it was carried.
TEST_P(EachRobot, OdometryDoesNotNoticeThatItIsCarried) {
  const EpisodeRecord dut =
      Stopped(-0.15, std::string(kAssist) + "estimator: odometry\ntime_limit_s: 60\n");
  ASSERT_FALSE(dut.interventions.empty());
  const Intervention& help = dut.interventions[0];
  const double carried_m = (help.to_W - help.from_W).norm();
  const auto after = After(dut, help), before = after - 1;
  EXPECT_NEAR(before->t_s, help.t_s, 1e-6);
  EXPECT_NEAR(after->est_x_m, before->est_x_m, 1e-3);
  EXPECT_NEAR(after->est_y_m, before->est_y_m, 1e-3);
  EXPECT_NEAR(after->est_yaw_rad, before->est_yaw_rad, 1e-3);
  EXPECT_GT(carried_m, 1);
  EXPECT_NEAR(Error(*after), carried_m, 0.2);
  EXPECT_NEAR(Error(*(after + 100)), Error(*after), 0.05) << "it never learns";
  EXPECT_GE(dut.metrics.max_estimate_error_m, Error(*after) - 1e-5);
}

// Lays the robot on its back, once, when a condition holds.
class Tumbler : public EpisodeObserver {
 public:
  // `lift_m`: above the floor, more than the robot is high.
  explicit Tumbler(std::function<bool(const EpisodeView&)> when, double lift_m = 0.5)
      : when_(std::move(when)), lift_m_(lift_m) {}
  bool OnControl(const EpisodeView& now) override {
    if (done_ || !when_(now)) return true;
    done_ = true;
    mjtNum* q = now.simulation->data()->qpos;
    q[2] += lift_m_;
    q[3] = q[5] = q[6] = 0;
    q[4] = 1;
    return true;
  }
  bool done() const { return done_; }

 private:
  std::function<bool(const EpisodeView&)> when_;
  double lift_m_;
  bool done_ = false;
};

TEST_P(EachRobot, ARobotOnItsBackIsTurnedUpright) {
  const double height_m = ReadRobot(FindRobotFile(GetParam(), {})).spec.height_m;
  Tumbler tumbler([](const EpisodeView& now) { return now.sample.t_s > 2; },
                  std::max(0.5, height_m + 0.05));
  const EpisodeRecord dut =
      Drive(Read(RoomScenario("", kAssist), {{"robot", GetParam()}}), &tumbler);
  ASSERT_THAT(dut.interventions, SizeIs(1));
  EXPECT_EQ(dut.events[0].mode, FailureMode::kRollOver);
  const auto after = After(dut, dut.interventions[0]);
  // A tall one comes to lie on an edge, or against a wall.
  EXPECT_GT(std::hypot((after - 1)->roll_rad, (after - 1)->pitch_rad), height_m > 0.5 ? 0.5 : 1)
      << "it lay there till then";
  EXPECT_LT(std::hypot(after->roll_rad, after->pitch_rad), 0.002);
  EXPECT_THAT(dut.events, SizeIs(1)) << "and it drives on";
  EXPECT_NEAR(dut.trace.back().y_m, 3.5, 0.05);
}

// Notes what a detector is asked.
struct Asked {
  int starts = 0;
  std::vector<double> at_s;
};
class Witness : public Detector {
 public:
  explicit Witness(Asked& asked) : asked_(asked) {}
  void Visit(ParamVisitor&) override {}
  FailureMode mode() const override { return FailureMode::kStuck; }
  void Start(const EpisodeContext&) override { ++asked_.starts; }
  bool Update(const Sample& sample) override {
    asked_.at_s.push_back(sample.t_s);
    return false;
  }

 private:
  Asked& asked_;
};

// Whatever happens to a robot that waits is no failure of its own.
TEST_F(AssistTest, NoDetectorIsAskedInBetweenAndAllStartAfresh) {
  Tumbler tumbler([](const EpisodeView& now) { return now.sample.t_s > 25; });
  const Scenario scenario = Read(RoomScenario(Barrier(3), kAssist));
  Asked asked;
  Agents agents = MakeAgents(scenario.spec);
  agents.detectors.push_back({"witness", std::make_unique<Witness>(asked)});
  const EpisodeRecord dut = DriveWith(scenario, agents, &tumbler);
  ASSERT_THAT(dut.events, SizeIs(1));
  ASSERT_THAT(dut.interventions, SizeIs(1));
  ASSERT_LT(dut.events[0].t_s, 25);
  ASSERT_TRUE(tumbler.done());
  EXPECT_EQ(asked.starts, 2);
  const auto in_between = [&](double t_s) {
    return t_s > dut.events[0].t_s + 1e-6 && t_s < dut.interventions[0].t_s + 1e-6;
  };
  EXPECT_EQ(std::ranges::count_if(asked.at_s, in_between), 0);
  EXPECT_NEAR(static_cast<double>(asked.at_s.size()), static_cast<double>(dut.steps) - 30 / 0.004,
              6);
}

// In the middle of backing off from what it bumped into, it is thrown over: that is forgotten.
TEST_F(AssistTest, AReactionEndsWithTheHelp) {
  Tumbler tumbler([](const EpisodeView& now) { return now.sensed.bump.pressed; });
  const EpisodeRecord dut = DriveRoom(
      "{type: blind_object, polygon_m: [[3,2],[3.2,2],[3.2,3],[3,3]], height_m: 0.5, "
      "known: false}",
      std::string(kAssist) + "react: {}\n", &tumbler);
  ASSERT_TRUE(tumbler.done());
  ASSERT_FALSE(dut.interventions.empty());
  for (auto row = After(dut, dut.interventions[0]); row->t_s < dut.interventions[0].t_s + 2; ++row)
    EXPECT_GE(row->cmd_vx_mps, 0) << "at " << row->t_s;
  EXPECT_EQ(dut.metrics.reactions, 1) << "and is still counted";
  EXPECT_NEAR(dut.trace.back().y_m, 3.5, 0.05);
}

TEST_F(AssistTest, EachFailureIsHelpedOnceAndFarther) {
  Save("plan.csv",
       "x_m,y_m,speed_mps\n1.5,2.5,0.4\n3,2.5,0.4\n4.5,2.5,0.4\n6.2,2.5,0.4\n7.5,2.5,0.4\n");
  const EpisodeRecord dut =
      DriveRoom(Barrier(2.2) + "," + Barrier(3.6) + "," + Barrier(5.2), kAssist);
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  ASSERT_THAT(dut.events, SizeIs(3));
  ASSERT_THAT(dut.interventions, SizeIs(3));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(dut.interventions[i].to_W.x(), (std::array{3.0, 4.5, 6.2})[i]);
  EXPECT_NEAR(dut.trace.back().x_m, 7.5, 0.05);
  for (const Margin& margin : dut.margins) {
    if (margin.detector == "stuck") {
      EXPECT_LT(margin.value, 0) << "the worst of all four drives, not the last one's";
    }
  }
  // Longer than the scenario's own limit, but for the waits.
  const double limit_s = 60 + 3 * 6 / 0.4;
  EXPECT_GT(dut.metrics.duration_s, limit_s);
}

TEST_F(AssistTest, AWrittenTimeLimitCountsTheWait) {
  const EpisodeRecord dut = DriveRoom(Barrier(3), std::string(kAssist) + "time_limit_s: 35\n");
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  EXPECT_THAT(dut.events, SizeIs(1));
  EXPECT_THAT(dut.interventions, SizeIs(0));
  EXPECT_EQ(dut.metrics.interventions, 0);
  EXPECT_NEAR(dut.metrics.duration_s, 35, 0.03);
}

TEST_F(AssistTest, WithNoPlaceAheadItEndsThereAndSaysSo) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n1.5,4.9\n");
  const EpisodeRecord dut = DriveRoom("", kAssist);
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  EXPECT_THAT(dut.message, HasSubstr("nowhere ahead of x 1.50, y 4.3"));
  ASSERT_THAT(dut.events, SizeIs(1));
  EXPECT_NEAR(dut.metrics.duration_s, dut.events[0].t_s, 1e-6);
  EXPECT_EQ(dut.metrics.interventions, 0);
}

// One that thinks it is elsewhere may fail beside its last waypoint.
TEST_F(AssistTest, PastTheLastWaypointNobodyCanHelp) {
  const Scenario scenario = Read(RoomScenario("", kAssist));
  Interventions dut(scenario.spec.episode, scenario.world);
  Sample failed;
  failed.p_WB = {6, 3.2, 0};
  failed.battery_v = 12;
  EXPECT_FALSE(dut.Call({scenario.spec.user_plan.back()}, failed));
  EXPECT_FALSE(dut.awaited());
  EXPECT_EQ(dut.why_not(),
            "nowhere ahead of x 6.00, y 3.20 m could the robot be set down: no waypoint is left");
}

TEST_F(AssistTest, ARobotWithoutPowerIsNotCarriedFromPlaceToPlace) {
  const EpisodeRecord dut = DriveRoom("", std::string(kAssist) + "battery: {capacity_wh: 0.05}\n");
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  EXPECT_THAT(dut.message, HasSubstr("it was empty"));
  EXPECT_THAT(dut.events, SizeIs(1));
  EXPECT_THAT(dut.interventions, SizeIs(0));
}

TEST_F(AssistTest, TheResultTellsOfEachHelp) {
  const EpisodeRecord dut = DriveRoom(Barrier(3), kAssist);
  const auto json = ResultJson(Read(RoomScenario("", kAssist)), dut);
  ASSERT_THAT(json["assists"], SizeIs(1));
  EXPECT_EQ(json["assists"][0]["t_s"], dut.interventions[0].t_s);
  EXPECT_EQ(json["assists"][0]["x_m"], dut.interventions[0].from_W.x());
  EXPECT_EQ(json["assists"][0]["to_x_m"], 4.5);
  EXPECT_EQ(json["assists"][0]["to_y_m"], 2.5);
  EXPECT_EQ(json["metrics"]["interventions"], 1);
}

TEST_F(AssistTest, IsRefusedWithAPlanThatFolds) {
  Save("plan.csv", "x_m,y_m,shape\n1.5,2.5,I\n3,2.5,O\n");
  EXPECT_THAT(
      [&] {
        Read(RoomScenario("", kAssist), {{"robot", "htetro"}});
      },
      ThrowsMessage<InputError>(
          HasSubstr("on_failure = assist: cannot be with a plan that changes the robot's shape")));
}

// Allocations between control periods in which the robot waits, and in which it drives again.
class CountAllocations : public EpisodeObserver {
 public:
  bool OnControl(const EpisodeView& now) override {
    const std::int64_t count = AllocationCount();
    if (last_ >= 0 && count > last_) at_s_.push_back(now.sample.t_s);
    last_ = AllocationCount();
    return true;
  }
  const std::vector<double>& at_s() const { return at_s_; }

 private:
  std::int64_t last_ = -1;
  std::vector<double> at_s_;
};

TEST_F(AssistTest, OnlyAFailureAndItsHelpAllocate) {
  CountAllocations dut;
  const EpisodeRecord record = DriveRoom(Barrier(3), kAssist, &dut);
  ASSERT_THAT(record.interventions, SizeIs(1));
  std::vector<double> known_s = {record.events[0].t_s, record.interventions[0].t_s};
  for (const Encounter& met : record.encounters) known_s.push_back(met.t_s);
  std::size_t others = 0;
  for (const double t_s : dut.at_s())
    others +=
        std::ranges::none_of(known_s, [&](double at_s) { return std::abs(t_s - at_s) < 0.0201; });
  EXPECT_LE(others, 2u) << "the barrier comes within reach before it is met, once and again";
}

// It had enough when it failed, and stood without power when the person came.
TEST_F(AssistTest, ABatteryThatCutsOffDuringTheWaitEndsTheEpisode) {
  const std::string barrier = Barrier(3);
  const EpisodeRecord full = Drive(Read(RoomScenario(barrier, kAssist)));
  ASSERT_THAT(full.interventions, SizeIs(1));
  double used_j = 0;
  for (const TraceRow& row : full.trace)
    if (row.t_s <= full.events[0].t_s) used_j += row.power_w * 0.02;
  const EpisodeRecord dut =
      Drive(Read(RoomScenario(barrier, kAssist),
                 {{"battery.capacity_wh", std::to_string(used_j / 3600 + 0.1)}}));
  EXPECT_THAT(dut.interventions, SizeIs(0));
  ASSERT_THAT(dut.events, SizeIs(1));
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  EXPECT_THAT(dut.message, HasSubstr("the battery cut off after"));
  EXPECT_NEAR(dut.metrics.duration_s, dut.events[0].t_s + 30, 0.03);
}

}  // namespace
}  // namespace floorproof

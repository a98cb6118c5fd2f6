// SPDX-License-Identifier: Apache-2.0
// A scenario's faults: read, drawn, resolved, and what they do to a drive.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

class FaultsInAScenario : public ScenarioTest {
 protected:
  FaultsInAScenario() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n6,2.5\n"); }
  std::string Refusal(const std::string& faults) const {
    try {
      Read(RoomScenario("", "faults: " + faults + "\n"));
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  }
  EpisodeRecord DriveWith(const std::string& faults, const std::string& more = "") const {
    return Drive(Read(
        RoomScenario("", "on_failure: ignore\ntime_limit_s: 20\nfaults: " + faults + "\n" + more)));
  }
};

TEST_F(FaultsInAScenario, AreResolvedWithEveryDefaultAndNotWhereThereAreNone) {
  const std::string text = RoomScenario(
      "", "faults:\n  - {type: weak_motor, wheel: wheel_left}\n  - {type: battery_sag, id: old}\n");
  const Scenario first =
      Read(text, {{"faults.0.torque_share", "0.3"}, {"faults.old.onset_s", "7"}});
  const std::string once = ResolvedScenario(first, folder_);
  EXPECT_THAT(once, HasSubstr("torque_share: 0.3\n"));
  EXPECT_THAT(once, HasSubstr("id: \"old\"\n    voltage_share: 0.8\n    onset_s: 7\n"));
  EXPECT_EQ(ResolvedScenario(Read(once), folder_), once);
  EXPECT_EQ(ResolvedScenario(Read(RoomScenario("")), folder_).find("faults"), std::string::npos);
}

TEST_F(FaultsInAScenario, AreDrawnByTheirIdOrTheirPlace) {
  Save("scenario.yaml", RoomScenario("", R"(faults: [{type: battery_sag, id: old}]
randomise: {faults.old.onset_s: {uniform: [1, 9]}, faults.0.voltage_share: {uniform: [0.5, 0.9]}}
)"));
  const floorproof::ScenarioFile file(folder_ / "scenario.yaml");
  const Scenario one = file.Read(0), two = file.Read(1);
  EXPECT_NE(one.faults[0].timing.onset_s, two.faults[0].timing.onset_s);
  EXPECT_GE(one.faults[0].timing.onset_s, 1);
  Alterations drawn;
  one.faults[0].fault->Break(drawn);
  EXPECT_LT(drawn.battery_voltage, 0.9);
}

TEST_F(FaultsInAScenario, BadOnesAreOneLineThatNamesTheRule) {
  EXPECT_THAT(Refusal("{}"), HasSubstr("scenario.yaml:"));
  EXPECT_THAT(Refusal("{}"), HasSubstr("faults: must be a list"));
  EXPECT_THAT(Refusal("[1]"), HasSubstr("faults[0]: must be a map"));
  EXPECT_THAT(Refusal("[{}]"), HasSubstr("faults[0].type: missing"));
  EXPECT_THAT(Refusal("[{type: weak_moter}]"), HasSubstr("did you mean weak_motor?"));
  EXPECT_THAT(Refusal("[{type: battery_sag, onset: 3}]"), HasSubstr("did you mean onset_s?"));
  EXPECT_THAT(Refusal("[{type: battery_sag, duty: 0}]"), HasSubstr("faults[0].duty = 0"));
  EXPECT_THAT(Refusal("[{type: battery_sag}, {type: weak_motor, wheel: left}]"),
              HasSubstr("faults[1].wheel = left: is no driven wheel of the robot"));
  EXPECT_THAT(Refusal("[{type: blocked_rollers}]"), HasSubstr("has no rollers"));
  EXPECT_THAT(Refusal("[{type: silent_sensor, sensor: lidar}]"),
              HasSubstr("the robot carries no such sensor (all, or one of: truth)"));
  EXPECT_THAT(Refusal("[{type: battery_sag, id: a}, {type: battery_sag, id: a}]"),
              HasSubstr("two faults have this id"));
}

// Its wheel is dragged: the other one turns the robot to the dead one's side.
TEST_F(FaultsInAScenario, ADeadMotorTurnsTheRobotToItsSideFromTheOnsetOn) {
  const EpisodeRecord sound = DriveWith("[]");
  for (const bool left : {true, false}) {
    const EpisodeRecord dead =
        DriveWith(std::string("[{type: weak_motor, onset_s: 3, wheel: wheel_") +
                  (left ? "left" : "right") + "}]");
    std::size_t same = 0;
    while (same < dead.trace.size() && dead.trace[same].x_m == sound.trace[same].x_m &&
           dead.trace[same].yaw_rad == sound.trace[same].yaw_rad)
      ++same;
    EXPECT_NEAR(dead.trace[same].t_s, 3, 0.05) << "it was noticed then";
    const auto later = std::ranges::find_if(dead.trace, [](const auto& r) { return r.t_s > 4; });
    ASSERT_NE(later, dead.trace.end());
    EXPECT_GT(std::abs(later->yaw_rad), 0.01) << "the tracker steers against it";
    EXPECT_EQ(later->yaw_rad > 0, left);
    EXPECT_NE(dead.outcome, Outcome::kSuccess);
  }
}

// Odometry without encoders believes that the robot stands.
TEST_F(FaultsInAScenario, WithoutEncodersOdometryStandsStill) {
  const EpisodeRecord deaf =
      DriveWith("[{type: silent_sensor, sensor: encoders, onset_s: 4}]", "estimator: odometry\n");
  const auto at = [&](double t_s) {
    return *std::ranges::find_if(deaf.trace, [&](const auto& r) { return r.t_s >= t_s; });
  };
  EXPECT_GT(at(4).est_x_m, 1.8);
  EXPECT_NEAR(at(8).est_x_m, at(4.1).est_x_m, 0.01);
  EXPECT_GT(at(8).x_m, at(4).x_m + 0.4) << "it drives on";
}

TEST_F(FaultsInAScenario, AWeakBatterySlowsTheRobotWhileItLasts) {
  const EpisodeRecord sagging =
      DriveWith("[{type: battery_sag, voltage_share: 0.1, onset_s: 3, duration_s: 3}]");
  const auto speed_at = [&](double t_s) {
    return std::ranges::find_if(sagging.trace, [&](const auto& r) { return r.t_s >= t_s; })->vx_mps;
  };
  EXPECT_LT(speed_at(5.5), 0.8 * speed_at(2.5));
  EXPECT_GT(speed_at(8), 0.95 * speed_at(2.5));
}

TEST_F(FaultsInAScenario, TheSameEpisodeTwiceIsTheSame) {
  const std::string text = RoomScenario(
      "", "faults: [{type: weak_motor, wheel: wheel_left, torque_share: 0.2, period_s: 1}]\n");
  Scenario scenario = Read(text);
  const Execution once = Execute(scenario), twice = Execute(scenario);
  ASSERT_EQ(once.record.trace.size(), twice.record.trace.size());
  EXPECT_EQ(once.record.trace.back().yaw_rad, twice.record.trace.back().yaw_rad);
}

}  // namespace
}  // namespace floorproof

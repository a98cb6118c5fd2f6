// SPDX-License-Identifier: Apache-2.0
// A scenario's faults: read, drawn, resolved, and what they do to a drive.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario_file.h"
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
  EXPECT_NE(one.world.faults[0].timing.onset_s, two.world.faults[0].timing.onset_s);
  EXPECT_GE(one.world.faults[0].timing.onset_s, 1);
  Alterations drawn;
  one.world.faults[0].fault->Break(drawn);
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
              HasSubstr("faults[1].id = a: two faults have this id"));
  EXPECT_THAT(Refusal("[{type: battery_sag, id: 1}]"), HasSubstr("faults[0].id = 1: must be"));
  EXPECT_THAT(Refusal("[{type: battery_sag, id: a.b}]"), HasSubstr("without a dot"));
  EXPECT_THAT(Refusal("[{type: battery_sag, duration_s: 0.001}]"),
              HasSubstr("faults[0].duration_s = 0.001: must last a physics step"));
  EXPECT_THAT(Refusal("[{type: battery_sag, period_s: 0.001, duty: 0.1}]"),
              HasSubstr("faults[0].period_s = 0.001: must leave a physics step"));
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

// A plain wheel does not give way to the side, whichever model of the wheels says so.
TEST_F(FaultsInAScenario, BlockedRollersHoldAgainstASidewaysDrive) {
  Save("plan.csv", "x_m,y_m,yaw_rad\n1.5,1.5,0\n1.5,3,0\n");
  for (const char* wheels : {"ideal", "rollers"})
    for (const char* drag : {"0", "1"}) {
      const EpisodeRecord record = Drive(Read(RoomScenario("",
                                                           "on_failure: ignore\ntime_limit_s: 9\n"
                                                           "faults: [{type: blocked_rollers}]\n"),
                                              {{"robot", "htetro"},
                                               {"wheels", wheels},
                                               {"start", "{x_m: 1.5, y_m: 1.5, yaw_deg: 0}"},
                                               {"faults.0.drag", drag}}));
      const double way_m = record.trace.back().y_m - 1.5;
      if (drag[0] == '0') {
        EXPECT_GT(way_m, 1) << wheels;
      } else {
        EXPECT_LT(way_m, 0.1) << wheels;
      }
    }
}

// A sensor is silent from the reading at the onset on, and heard at the end.
TEST_F(FaultsInAScenario, ASensorIsSilentInThePeriodsOfTheFaultAndInNoOther) {
  class Ear : public EpisodeObserver {
   public:
    bool OnControl(const EpisodeView& now) override {
      if (!now.sensed.has_imu) silent_at.push_back(now.sensed.t_s);
      return now.sensed.t_s < 3;
    }
    std::vector<double> silent_at;
  };
  const auto silent_at = [&](const std::string& timing) {
    Ear ear;
    Drive(
        Read(RoomScenario("", "estimator: odometry\nfaults: [{type: silent_sensor, sensor: imu, " +
                                  timing + "}]\n")),
        &ear);
    return ear.silent_at;
  };
  using ::testing::DoubleNear;
  using ::testing::ElementsAre;
  using ::testing::IsEmpty;
  EXPECT_THAT(silent_at("onset_s: 1, duration_s: 0.04"),
              ElementsAre(DoubleNear(1, 1e-6), DoubleNear(1.02, 1e-6)));
  EXPECT_THAT(silent_at("onset_s: 0, duration_s: 0.02"), ElementsAre(DoubleNear(0, 1e-6)));
  EXPECT_THAT(silent_at("onset_s: 1.004, duration_s: 0.012"), IsEmpty()) << "between two readings";
}

// What was never heard of is not heard of as 0: motors that fold would turn against it.
TEST_F(FaultsInAScenario, ARobotOfHingesKeepsItsShapeWhateverIsSilentFromTheStart) {
  Save("plan.csv", "x_m,y_m,shape\n1.5,2.5,O\n3,2.5,O\n3.5,2.5,I\n");
  for (const char* estimator : {"odometry", "truth"}) {
    const EpisodeRecord record = Drive(Read(RoomScenario("",
                                                         "on_failure: ignore\ntime_limit_s: 6\n"
                                                         "faults: [{type: silent_sensor}]\n"),
                                            {{"robot", "htetro"}, {"estimator", estimator}}));
    for (const TraceRow& row : record.trace)
      ASSERT_EQ(row.shape, record.trace.front().shape) << estimator << " at " << row.t_s;
  }
}

TEST_F(FaultsInAScenario, TheWeakestMotorIsADeadOne) {
  const char* kShares[] = {"0", "1e-320"};
  std::vector<double> x_m;
  for (const char* share : kShares)
    x_m.push_back(DriveWith(std::string("[{type: weak_motor, torque_share: ") + share + "}]")
                      .trace.back()
                      .x_m);
  EXPECT_NEAR(x_m[0], x_m[1], 1e-6);
}

// It stands upright under a load that will tip it, and tips only then.
TEST_F(FaultsInAScenario, APersonSetsATippingRobotDownOnItsWheels) {
  const EpisodeRecord record = Drive(
      Read(RoomScenario("{type: step, polygon_m: [[3, 1], [4, 1], [4, 4], [3, 4]], height_m: 0.06}",
                        "on_failure: assist\ntime_limit_s: 90\n"
                        "faults: [{type: shifted_load, mass_kg: 15, x_m: 0.3, onset_s: 20}]\n"),
           {{"site.hazards.0.known", "false"}}));
  ASSERT_FALSE(record.interventions.empty());
  const double t_s = record.interventions[0].t_s;
  const auto down = std::ranges::find_if(record.trace, [&](const auto& r) { return r.t_s > t_s; });
  ASSERT_NE(down, record.trace.end());
  EXPECT_LT(std::abs(down->z_m), 0.005) << "m above the floor, " << down->t_s - t_s << " s later";
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

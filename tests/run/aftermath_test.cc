// SPDX-License-Identifier: Apache-2.0
// What becomes of a robot that failed: whether it gets on alone, and how hard it fell or was hit.
#include "run/episode/aftermath.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>

#include "run/episode/blow_meter.h"
#include "run/episode/encounter_table.h"
#include "run/scenario/scenario.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::SizeIs;

constexpr double kGravity_mps2 = 9.81;
constexpr const char* kWatch = "on_failure: watch\n";

class AftermathDrive : public ScenarioTest {
 protected:
  AftermathDrive() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n6.5,2.5\n"); }

  // Across the room, on no map: a robot that goes straight meets it.
  static std::string Step(double x_m, double height_m) {
    return fmt::format(
        "{{type: step, id: step, polygon_m: [[{0},0.5],[{1},0.5],[{1},4.5],[{0},4.5]], height_m: "
        "{2}, known: false}}",
        x_m, x_m + 1, height_m);
  }
  static const Encounter& FailedOf(const EpisodeRecord& record) {
    const auto at =
        std::ranges::find(record.encounters, Encounter::Outcome::kFailed, &Encounter::outcome);
    EXPECT_NE(at, record.encounters.end());
    return *at;
  }
  static double Drop_m(const Encounter& e) { return e.energy_j / (e.at.mass_kg * kGravity_mps2); }
};

// What was judged, and every row, is as if the failure had ended the drive; which goes on for five
// seconds, because the robot gets nowhere.
TEST_F(AftermathDrive, HeldByAKerbItNeedsHelpAndNothingElseChanges) {
  const std::string room = RoomScenario(Step(3, 0.05));
  EpisodeRecord stopped = Drive(Read(room));
  EpisodeRecord dut = Drive(Read(room + kWatch));
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  ASSERT_THAT(dut.events, SizeIs(1));
  EXPECT_EQ(dut.events[0].t_s, stopped.events[0].t_s);
  EXPECT_NEAR(dut.metrics.duration_s, dut.events[0].t_s + 5, 0.05);
  EXPECT_EQ(FailedOf(dut).after, Encounter::After::kNeedsHelp);
  EXPECT_LT(Drop_m(FailedOf(dut)), 0.01) << "at 0.25 m/s a kerb takes as much as a drop of 3 mm";
  EXPECT_EQ(FailedOf(stopped).after, Encounter::After::kUnseen);
  ASSERT_EQ(dut.encounters.size(), stopped.encounters.size());
  for (std::size_t i = 0; i < dut.encounters.size(); ++i) {
    dut.encounters[i].after = {};
    dut.encounters[i].energy_j = stopped.encounters[i].energy_j;
    EXPECT_EQ(EncounterValues(dut.encounters[i]), EncounterValues(stopped.encounters[i])) << i;
  }
}

// Without power on a cover it goes nowhere, and fails; then the motors are back, and it drives on
// by itself. A second cover that it meets then is no encounter: its failure or none is another
// drive's.
TEST_F(AftermathDrive, HeldForAWhileItGetsOnAlone) {
  const auto cover = [](const char* id, double x_m) {
    return fmt::format(
        "{{type: cable_cover, id: {0}, line_m: [[{1}, 0.5], [{1}, 4.5]], height_m: 0.005}}", id,
        x_m);
  };
  Scenario s = Read(
      RoomScenario(cover("first", 2.6) + ", " + cover("second", 3.4), kWatch) +
      "faults:\n"
      "  - {type: weak_motor, wheel: wheel_left, torque_share: 0, onset_s: 4, duration_s: 10}\n"
      "  - {type: weak_motor, wheel: wheel_right, torque_share: 0, onset_s: 4, duration_s: 10}\n");
  const EpisodeRecord dut = Drive(std::move(s));
  ASSERT_THAT(dut.events, SizeIs(1));
  EXPECT_EQ(dut.events[0].mode, FailureMode::kStuck);
  EXPECT_EQ(dut.outcome, Outcome::kFailure) << "it failed all the same";
  EXPECT_EQ(FailedOf(dut).hazard, "first");
  EXPECT_EQ(FailedOf(dut).after, Encounter::After::kRecovered);
  EXPECT_LT(Drop_m(FailedOf(dut)), 0.01);
  EXPECT_GT(dut.trace.back().x_m, 3.6) << "beyond the second";
  EXPECT_TRUE(std::ranges::none_of(dut.encounters,
                                   [](const Encounter& e) { return e.hazard == "second"; }));
}

// The deeper, the harder; never more than the height gives, m g h. Nobody climbs out.
TEST_F(AftermathDrive, AFallIsAsHardAsItIsDeep) {
  double hardest_m = 0;
  for (const double depth_m : {0.08, 0.15}) {
    const EpisodeRecord dut = Drive(Read(RoomScenario(Step(3, -depth_m), kWatch)));
    ASSERT_THAT(dut.events, SizeIs(1));
    EXPECT_EQ(dut.events[0].kind, "fell");
    EXPECT_EQ(FailedOf(dut).after, Encounter::After::kNeedsHelp);
    EXPECT_LT(Drop_m(FailedOf(dut)), depth_m) << depth_m;
    EXPECT_GT(Drop_m(FailedOf(dut)), hardest_m) << depth_m;
    hardest_m = Drop_m(FailedOf(dut));
  }
  EXPECT_GT(hardest_m, 0.15 / 3) << "one edge first: about half of it at a time";
}

// Moved by hand: a body of 2 kg that falls and lies, that stops dead, that is let down.
TEST(BlowMeter, TakesWhatAMomentTakes) {
  RobotSpec robot;
  robot.mass_kg = 2;
  robot.p_BCom = {0.1, 0, 0.2};
  constexpr double kStep_s = 0.004;
  const auto hardest = [&](const std::function<Vec3(double)>& place, double end_s) {
    BlowMeter dut(robot, kStep_s);
    for (double t_s = 0; t_s < end_s; t_s += kStep_s) {
      Truth truth;
      truth.p_WB = place(t_s);
      dut.OnStep(truth);
    }
    const double energy_j = dut.Take();
    EXPECT_EQ(dut.Take(), 0) << "since it was last asked";
    return energy_j;
  };
  const auto falls = [](double t_s) {
    return Vec3(0, 0, std::max(0.0, 0.15 - kGravity_mps2 * t_s * t_s / 2));
  };
  EXPECT_NEAR(hardest(falls, 0.5), 2 * kGravity_mps2 * 0.15, 0.1 * 2 * kGravity_mps2 * 0.15);
  const auto stops = [](double t_s) { return Vec3(std::min(0.5, t_s), 0, 0); };
  EXPECT_NEAR(hardest(stops, 1), 2 * 1 / 2.0, 0.01) << "1 m/s";
  const auto rolls_down = [](double t_s) { return Vec3(0.5 * t_s, 0, -0.2 * t_s); };
  EXPECT_NEAR(hardest(rolls_down, 2), 0, 1e-9);
  const auto brakes = [](double t_s) { return Vec3(0.5 * t_s - 0.25 * t_s * t_s, 0, 0); };
  EXPECT_LT(hardest(brakes, 1), 0.03) << "at 0.5 m/s^2, from 0.5 m/s";
}

TEST(Aftermath, LastsTenSecondsAndFiveWithoutWay) {
  const auto ends = [](double speed_mps) {
    Aftermath dut;
    double t_s = 0;
    for (; t_s < 100; t_s += 0.01) {
      dut.OnStep(t_s, t_s < 3 ? 0 : (t_s - 3) * speed_mps);
      if (t_s >= 3 && !dut.watched()) dut.OnFailure(t_s);
      if (dut.watched() && dut.HasEnded(t_s)) break;
    }
    return std::pair(t_s, dut.Gains(t_s));
  };
  EXPECT_NEAR(ends(0).first, 8, 0.02);
  EXPECT_FALSE(ends(0).second);
  EXPECT_NEAR(ends(0.1).first, 13, 0.02);
  EXPECT_TRUE(ends(0.1).second);
  EXPECT_FALSE(ends(-0.1).second) << "going back is no gain";
}

}  // namespace
}  // namespace floorproof

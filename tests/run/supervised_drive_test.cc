// SPDX-License-Identifier: Apache-2.0
// Supervised robots in physics, and scenarios that supervise.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "run/episode/records.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario.h"
#include "run/scenario/written_safety.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class SupervisedDrive : public ScenarioTest {
 protected:
  SupervisedDrive() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n7,2.5\n7,1.5\n3,1.5\n"); }
  EpisodeRecord DriveWith(const std::string& faults, const std::string& more = "safety: {}\n",
                          const std::string& hazards = "") const {
    return Drive(Read(RoomScenario(hazards, "faults: " + faults + "\n" + more)));
  }
  std::string Refusal(const std::string& more) const {
    try {
      Read(RoomScenario("", more));
    } catch (const InputError& e) {
      return e.what();
    }
    return "taken";
  }
};

constexpr const char* kDead = "[{type: weak_motor, wheel: wheel_left, onset_s: 5}]";

TEST_F(SupervisedDrive, WithoutAFaultIsAsLongAsWithoutSupervision) {
  const EpisodeRecord with = DriveWith("[]"), without = DriveWith("[]", "");
  EXPECT_EQ(with.outcome, Outcome::kSuccess);
  EXPECT_THAT(with.safety, IsEmpty());
  EXPECT_EQ(with.metrics.false_alarms, 0);
  EXPECT_EQ(with.metrics.held_s, 0);
  EXPECT_NEAR(with.metrics.duration_s, without.metrics.duration_s, 0.1);
  EXPECT_EQ(without.metrics.alarms, std::nullopt);
}

TEST_F(SupervisedDrive, ADeadWheelOfTwoStopsItBeforeItVeersOff) {
  const EpisodeRecord without = DriveWith(kDead, "");
  ASSERT_FALSE(without.events.empty());
  const EpisodeRecord dut = DriveWith(kDead);
  EXPECT_EQ(dut.outcome, Outcome::kAborted);
  EXPECT_THAT(dut.events, IsEmpty());
  EXPECT_LT(dut.metrics.max_cross_track_m, 0.2);
  EXPECT_THAT(dut.message, HasSubstr("definitive_stop"));
  EXPECT_THAT(dut.message, HasSubstr("wheel_left"));
  EXPECT_LT(dut.metrics.detection_s.value(), 2);
  EXPECT_GT(dut.metrics.held_s.value(), 5);
}

// A motor that runs on is no more stopped by what it is told than it was driven by it.
TEST_F(SupervisedDrive, AMotorThatRunsOnIsCutOff) {
  const EpisodeRecord dut = DriveWith("[{type: stuck_motor, wheel: wheel_left, onset_s: 5}]",
                                      "safety: {}\nfailures: {veer_off: {max_cross_track_m: 1}}\n");
  EXPECT_EQ(dut.outcome, Outcome::kAborted);
  EXPECT_THAT(dut.message, HasSubstr("it does not stand when it is told to"));
  EXPECT_LT(dut.metrics.duration_s, 15) << "it comes to rest";
}

TEST_F(SupervisedDrive, WhatAFaultIsCalledChangesNothing) {
  const auto drive = [&](const std::string& id) {
    EpisodeRecord record =
        DriveWith("[{type: weak_motor, id: " + id + ", wheel: wheel_left, onset_s: 5}]");
    return std::pair(SafetyCsv(record), record.metrics.path_length_m);
  };
  EXPECT_EQ(drive("a-dead-motor"), drive("battery"));
}

TEST_F(SupervisedDrive, WhoReactsNotIsStillWatched) {
  // Long enough for its state to grow while the robot turns about the dead wheel.
  const EpisodeRecord dut =
      DriveWith(kDead, "safety: {react: false}\nfailures: {stuck: {window_s: 20}}\n");
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  EXPECT_THAT(dut.alarms, Contains(Field(&RaisedAlarm::wheel, "wheel_left")));
  EXPECT_THAT(dut.safety, Contains(Field(&SafetyRow::machine, DecisionState::kAbort)));
  EXPECT_EQ(dut.metrics.held_s, 0);
}

TEST_F(SupervisedDrive, ALidarThatIsBlindForAWhileIsWaitedFor) {
  const std::string blind = "[{type: silent_sensor, sensor: lidar, onset_s: 6, duration_s: 4}]";
  const EpisodeRecord dut = DriveWith(blind, "safety: {}\nestimator: mcl\n");
  EXPECT_EQ(dut.outcome, Outcome::kSuccess);
  EXPECT_NEAR(dut.metrics.held_s.value(), 4, 1);
}

TEST_F(SupervisedDrive, OfSixteenWheelsAStuckOneIsSpared) {
  const std::string stuck = "[{type: stuck_motor, wheel: front_left_fl, onset_s: 5}]";
  const auto htetro = [&](const std::string& faults, const std::string& more) {
    Scenario s = Read(RoomScenario("", "faults: " + faults + "\nestimator: odometry\n" + more),
                      {{"robot", "htetro"}});
    return Drive(std::move(s));
  };
  const EpisodeRecord sound = htetro("[]", ""), without = htetro(stuck, ""),
                      dut = htetro(stuck, "safety: {}\n");
  EXPECT_EQ(dut.outcome, Outcome::kSuccess);
  EXPECT_THAT(dut.safety,
              Contains(Field(&SafetyRow::reason, "reconfiguration: driven without front_left_fl")));
  EXPECT_LT(dut.metrics.max_estimate_error_m - sound.metrics.max_estimate_error_m,
            0.3 * (without.metrics.max_estimate_error_m - sound.metrics.max_estimate_error_m))
      << "what the wheel turns is believed no more";
  EXPECT_LT(dut.metrics.energy_j, 0.85 * without.metrics.energy_j) << "the others fight it no more";
}

TEST_F(SupervisedDrive, IsRecordedChangeByChange) {
  const Scenario scenario = Read(RoomScenario("", std::string("safety: {}\nfaults: ") + kDead));
  const EpisodeRecord record = DriveWith(kDead);
  const std::string csv = SafetyCsv(record);
  EXPECT_TRUE(csv.starts_with("t_s,node,safety_state,level,machine_state,reason\n"));
  EXPECT_THAT(csv, HasSubstr("cover.drive.wheels,48,serious,"));
  EXPECT_THAT(csv,
              HasSubstr("follow the plan,48,serious,fault_mode,the sum rose above Xcrit: 48 > 20"));
  EXPECT_THAT(csv, HasSubstr(",abort,"));
  for (std::size_t i = 1; i < record.safety.size(); ++i)
    EXPECT_GE(record.safety[i].t_s, record.safety[i - 1].t_s);
  const auto json = ResultJson(scenario, record);
  EXPECT_EQ(json["outcome"], "aborted");
  EXPECT_EQ(json["alarms"][0]["wheel"], "wheel_left");
}

// The lean of the floor is not the load's, whether or not the map knows the ramps.
TEST_F(SupervisedDrive, RampsAreDrivenAsWithoutSupervision) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n7.5,2.5\n7.5,1.5\n1.5,1.5\n");
  for (const char* known : {"", ", known: false"}) {
    const auto ramp = [&](const char* from_m, const char* to_m, int toward_deg) {
      return fmt::format(
          "{{type: ramp, polygon_m: [[{0}, 0.5], [{1}, 0.5], [{1}, 4.5], [{0}, 4.5]], "
          "slope_deg: 4.7636, toward_deg: {2}{3}}}",
          from_m, to_m, toward_deg, known);
    };
    const std::string ramps = ramp("2.82", "4.5", 0) + ", " + ramp("4.5", "6.18", 180);
    const EpisodeRecord dut = DriveWith("[]", "safety: {}\n", ramps);
    EXPECT_EQ(dut.outcome, Outcome::kSuccess) << known << dut.message;
    EXPECT_EQ(dut.metrics.false_alarms, 0) << known;
    EXPECT_THAT(dut.alarms, IsEmpty()) << known;
  }
}

// A person who comes because it asked tells it where it is.
TEST_F(SupervisedDrive, WhoIsHelpedGoesOn) {
  const std::string blind = "[{type: silent_sensor, sensor: lidar, onset_s: 6, duration_s: 90}]";
  const EpisodeRecord dut = DriveWith(blind, "safety: {}\nestimator: mcl\non_failure: assist\n");
  EXPECT_EQ(dut.outcome, Outcome::kSuccess) << dut.message;
  EXPECT_EQ(dut.metrics.interventions, 1);
}

TEST_F(SupervisedDrive, WhoIsCarriedOffHasNotDrivenThere) {
  const EpisodeRecord dut =
      DriveWith("[{type: kidnapped, left_m: 0, forward_m: 1, onset_s: 8}]", "estimator: truth\n");
  const EpisodeRecord plain = DriveWith("[]", "estimator: truth\n");
  EXPECT_EQ(dut.outcome, Outcome::kSuccess);
  EXPECT_NEAR(dut.metrics.path_length_m, plain.metrics.path_length_m - 1, 0.1);
  EXPECT_LT(dut.metrics.coverage, plain.metrics.coverage - 0.005);
}

// Whether it stands is asked of its wheels, whoever says that it must.
TEST_F(SupervisedDrive, WhoIsWatchedByItsLidarAloneIsStillToldOfItsWheels) {
  Save("m.yaml", R"(mission: 1
primitives:
  follow_plan: {}
  lidar: {type: service, monitors: [scan_signal], severity: catastrophic, extent: external}
skills: {drive: {run: [follow_plan], with: [lidar]}}
tasks: {t: [drive]}
run: [t]
)");
  const EpisodeRecord dut =
      DriveWith("[{type: silent_sensor, sensor: lidar, onset_s: 6, duration_s: 4}]",
                "mission: m.yaml\nsensors: {lidar: {}}\n");
  EXPECT_EQ(dut.outcome, Outcome::kSuccess) << dut.message;
  EXPECT_NEAR(dut.metrics.held_s.value(), 4, 1);
}

constexpr const char* kMission = R"(mission: 1
name: there and back
primitives:
  rotation: {severity: minor, extent: external, occurrence: low, availability: eminent}
  line: {severity: catastrophic, extent: external, occurrence: very_low, availability: singular}
  acceleration_control: {severity: catastrophic, extent: external, occurrence: high, availability: redundant, max_accel_mps2: 3}
skills:
  go: {run: [rotation, line, rotation], with: [acceleration_control], x_m: 5, y_m: 3.5, yaw_deg: 90, speed_mps: 0.2, timeout_s: 60}
  back: {run: [rotation, line, rotation], with: [acceleration_control], x_m: 2, y_m: 1.5, yaw_deg: 0, timeout_s: 60}
tasks: {there: [go], home: [back]}
run: [there, home]
)";

TEST_F(SupervisedDrive, AMissionOfGoTosIsDrivenWithoutAPlan) {
  Save("m.yaml", kMission);
  std::string text = RoomScenario("", "mission: m.yaml\n");
  text.replace(text.find("plan: {file: plan.csv}\n"), 23, "");
  for (const char* robot : {"beluga", "htetro"}) {
    Scenario scenario = Read(text, {{"robot", robot}});
    EXPECT_TRUE(LeadsItself(scenario.spec));
    EXPECT_EQ(scenario.spec.user_plan.size(), 2u);
    const EpisodeRecord dut = Drive(std::move(scenario));
    EXPECT_EQ(dut.outcome, Outcome::kSuccess) << robot << dut.message;
    const TraceRow& end = dut.trace.back();
    EXPECT_NEAR(end.x_m, 2, 0.05);
    EXPECT_NEAR(end.y_m, 1.5, 0.05);
    EXPECT_NEAR(end.yaw_rad, 0, 0.06);
    double nearest_m = 1e9;
    for (const TraceRow& row : dut.trace)
      if (std::abs(row.yaw_rad - kPi / 2) < 0.06)
        nearest_m = std::min(nearest_m, (Vec2(row.x_m, row.y_m) - Vec2(5, 3.5)).norm());
    EXPECT_LT(nearest_m, 0.05) << "it was there, and faced as it should";
    EXPECT_THAT(dut.safety, IsEmpty());
  }
}

// Section 4 in physics: an intermittent fault of both motors is 60, and 96 once the time-out makes
// it permanent. There it is the time-out alone that does: monitors are not to decide it earlier,
// and the robot goes on trying.
TEST_F(SupervisedDrive, TheWorkedExampleIsDriven) {
  std::string mission = kMission;
  for (const char* name : {"rotation: {", "line: {", "acceleration_control: {"})
    mission.insert(mission.find(name) + std::string(name).size(),
                   "monitors: [wheel_speed, motor_current], ");
  Save("m.yaml", mission);
  std::string text =
      RoomScenario("",
                   "mission: m.yaml\n"
                   "faults: [{type: weak_motor, wheel: all, onset_s: 9}]\n"
                   "safety: {most_waits: 1000, monitors: {wheel_speed: {permanent_s: "
                   "1000}, motor_current: {permanent_s: 1000}}}\n");
  text.replace(text.find("plan: {file: plan.csv}\n"), 23, "");
  const EpisodeRecord dut = Drive(Read(text));
  EXPECT_EQ(dut.outcome, Outcome::kAborted);
  std::vector<double> states;  // of the GoTo skill
  std::vector<DecisionState> machine;
  for (const SafetyRow& row : dut.safety) {
    if (row.node == "there.go" && row.safety_state > 0) states.push_back(row.safety_state);
    if (machine.empty() || machine.back() != row.machine) machine.push_back(row.machine);
  }
  EXPECT_EQ(states, (std::vector<double>{60, 96}));
  EXPECT_THAT(dut.safety, Contains(Field(&SafetyRow::safety_state, 36))) << "Line";
  EXPECT_THAT(machine, Contains(DecisionState::kReconfiguring));
  EXPECT_EQ(machine.back(), DecisionState::kAbort);
  EXPECT_THAT(dut.message, HasSubstr("there.go reached Zcrit: 96 >= 61"));
  EXPECT_THAT(dut.message, HasSubstr("its skill took longer than timeout_s; permanent"));
  const auto fatal = std::ranges::find(dut.safety, 96, &SafetyRow::safety_state);
  ASSERT_NE(fatal, dut.safety.end());
  EXPECT_NEAR(fatal->t_s, 60, 0.1) << "the skill began with the drive";
}

constexpr const char* kBeside = R"(mission: 1
name: m
primitives:
  follow_plan: {}
  lidar: {type: service, monitors: [scan_signal], severity: catastrophic, occurrence: very_low, availability: singular}
  bumper: {type: service, monitors: [bumper_signal], severity: catastrophic, occurrence: low, availability: eminent}
  battery: {type: service, monitors: [battery_trend], severity: catastrophic, occurrence: low, availability: eminent}
skills:
  drive: {run: [follow_plan]}
  see: {with: [lidar]}
  feel: {with: [bumper]}
  feed: {with: [battery]}
tasks:
  cover: {run: [drive], with: [senses, feed]}
  senses: {with: [see, feel]}
run: [cover]
)";
constexpr const char* kThreeFaults =
    "[{type: silent_sensor, sensor: lidar, onset_s: 6}, {type: stuck_bumper, onset_s: 8}, "
    "{type: battery_sag, onset_s: 10}]";

// Section 3.3 in physics: three skills of at most 30 each, none near Zcrit, are 18 + 18 + 30
// together.
TEST_F(SupervisedDrive, TheSumOfSkillsBesideEachOtherStopsIt) {
  Save("m.yaml", kBeside);
  const std::string more = "mission: m.yaml\nsensors: {lidar: {}, bumper: {}}\n";
  const EpisodeRecord dut = DriveWith(kThreeFaults, more);
  EXPECT_EQ(dut.outcome, Outcome::kAborted) << dut.message;
  EXPECT_THAT(dut.message, HasSubstr("definitive_stop: the sum reached ZZcrit: "));
  double greatest = 0, sum = 0;
  for (const SafetyRow& row : dut.safety) {
    if (row.node != "m") continue;
    greatest = std::max(greatest, row.safety_state);
    sum = std::max(sum, row.sum);
  }
  EXPECT_LT(greatest, 43) << "no skill is even serious";
  EXPECT_GE(sum, 61);
  EXPECT_THAT(SafetyCsv(dut), HasSubstr("cover.senses.see.lidar,"));
  EXPECT_THAT(SafetyCsv(dut), HasSubstr(",by its worst; the sum is "));
}

TEST_F(SupervisedDrive, IsResolvedWithEveryDefaultAndDrivesTheSame) {
  Save("m.yaml", kMission);
  for (const char* more : {"safety: {wait_s: 3}\n", "mission: m.yaml\nsafety: {monitors: {}}\n"}) {
    std::string text = RoomScenario("", std::string(more) + "faults: " + kDead + "\n");
    if (std::string(more).starts_with("mission"))
      text.replace(text.find("plan: {file: plan.csv}\n"), 23, "");
    const Scenario first = Read(text);
    const std::string once = ResolvedScenario(first, folder_);
    EXPECT_THAT(once, HasSubstr("adapt_share: 0.5"));
    EXPECT_EQ(ResolvedScenario(Read(once), folder_), once);
    EXPECT_EQ(SafetyCsv(Drive(Read(once))), SafetyCsv(Drive(Read(text))));
  }
  const std::string plain = ResolvedScenario(Read(RoomScenario("")), folder_);
  EXPECT_EQ(plain.find("safety"), std::string::npos);
  EXPECT_EQ(plain.find("mission"), std::string::npos);
}

TEST_F(SupervisedDrive, MonitorsOfWhatItDoesNotCarryAreLeftOut) {
  const auto names = [&](const std::string& more) {
    const Scenario scenario = Read(RoomScenario("", "safety: {}\n" + more));
    std::vector<std::string> kept;
    for (const PluginSpec& m : scenario.spec.safety->monitors) kept.push_back(m.name);
    return kept;
  };
  EXPECT_THAT(names(""), testing::Not(Contains("scan_signal"))) << "no lidar for its sake";
  EXPECT_THAT(names(""), Contains("motor_current"));
  EXPECT_THAT(names("estimator: mcl\n"), Contains("scan_signal"));
  EXPECT_THAT(Read(RoomScenario("", "safety: {monitors: {tilt: none}}\n")).spec.safety->monitors,
              testing::Not(Contains(Field(&PluginSpec::name, "tilt"))));
}

TEST_F(SupervisedDrive, BadOnesAreOneLineThatNamesTheRule) {
  Save("m.yaml", kMission);
  EXPECT_THAT(Refusal("safety: {wait: 3}\n"),
              HasSubstr("safety.wait: unknown key; did you mean wait_s?"));
  EXPECT_THAT(Refusal("safety: {adapt_share: 2}\n"), HasSubstr("safety.adapt_share = 2: must be"));
  EXPECT_THAT(Refusal("safety: {monitors: {tilt: {limit: 3}}}\n"),
              HasSubstr("safety.monitors.tilt.limit: unknown key; did you mean limit_deg?"));
  EXPECT_THAT(Refusal("safety: {monitors: {tillt: {}}}\n"), HasSubstr("did you mean tilt?"));
  EXPECT_THAT(Refusal("safety: {monitors: {tilt: off}}\n"),
              HasSubstr("safety.monitors.tilt = off: must be a map of its keys, or none: off"));
  EXPECT_THAT(Refusal("safety: {monitors: 3}\n"), HasSubstr("safety.monitors = 3: must be a map"));
  EXPECT_THAT(Refusal("mission: go\n"),
              HasSubstr("mission = go: must be follow_plan, or a .yaml file"));
  EXPECT_THAT(Refusal("mission: n.yaml\n"), HasSubstr("n.yaml"));
  std::string both = kMission;
  both.replace(both.find("there: [go]"), 11, "there: {run: [go], with: [back]}");
  Save("both.yaml", both);
  EXPECT_THAT(Refusal("mission: both.yaml\n"),
              HasSubstr("both.yaml:10: tasks.there.with = back: needs the wheels while go does, "
                        "which runs beside it"));
  EXPECT_THAT(Refusal("mission: m.yaml\n"),
              HasSubstr("plan: stands beside a mission that says itself where to drive"));
  Save("far.yaml",
       std::string(kMission).replace(std::string(kMission).find("x_m: 5"), 6, "x_m: 50"));
  EXPECT_THAT(Refusal("mission: far.yaml\n"), HasSubstr("far.yaml"));
  EXPECT_THAT(Refusal("mission: far.yaml\n"),
              HasSubstr("far.yaml:8: skills.go = 50, 3.5: lies off the map"));
  Save("p1.yaml",
       std::string(kMission).replace(std::string(kMission).find("timeout_s: 60"), 13, "p1_s: -1"));
  EXPECT_THAT(Refusal("mission: p1.yaml\n"),
              HasSubstr("p1.yaml:8: rotation.p1_s = -1: must be > 0"));
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Sensors, estimator, mapper and recovery behaviour, in a scenario and through an episode.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/file_output.h"
#include "run/campaign/episode_maker.h"
#include "run/episode/records.h"
#include "run/scenario/carried_sensors.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario_file.h"
#include "tests/controllers/allocation_guard.h"
#include "tests/robots.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<Override> kHtetro = {{"robot", "htetro"}};

class SensingTest : public ScenarioTest {
 protected:
  SensingTest() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n2.5,2.5\n2.5,3.2\n"); }

  static std::vector<std::string> Carried(const Scenario& s) {
    std::vector<std::string> names;
    for (const SensorSpec& sensor : s.spec.sensors) names.push_back(sensor.plugin.name);
    return names;
  }
  // A parameter of a plug-in, as it is written.
  static std::string Value(const PluginSpec& plugin, const char* key) {
    return WithValues(ConfigNode::Map(), plugin.params).Find(key)->scalar;
  }
  static const PluginSpec& SensorOf(const Scenario& s, const std::string& name) {
    return std::ranges::find(s.spec.sensors, name,
                             [](const SensorSpec& sensor) { return sensor.plugin.name; })
        ->plugin;
  }
  // The room with these keys, driven.
  EpisodeRecord DriveRoom(const std::string& keys, const std::vector<Override>& overrides = {}) {
    return Drive(Read(RoomScenario("", keys), overrides));
  }
  static std::string Trace(const EpisodeRecord& record) { return TraceCsv(record, {}); }
};

// By the memory that its cells take, whatever the floor's own cells are.
TEST_F(SensingTest, ARobotsMapHasABoundedNumberOfCells) {
  const auto refusal = [&](const std::string& cell_m) -> std::string {
    std::string rows;
    for (int y = 0; y < 40; ++y)
      rows += "      " + (y % 39 == 0 ? std::string(160, '#') : "#" + std::string(158, '.') + "#") +
              "\n";
    try {
      Read("scenario: 1\nsite:\n  site: 1\n  grid:\n    cell_m: 2.5\n    rows: |\n" + rows +
           "  start: {x_m: 5, y_m: 5, yaw_deg: 0}\nrobot: beluga\nplan: {file: plan.csv}\n"
           "mapper: {cell_m: " +
           cell_m + "}\n");
    } catch (const InputError& e) {
      return e.what();
    }
    return "taken";
  };
  EXPECT_EQ(refusal("0.05"), "taken");
  EXPECT_THAT(refusal("0.01"), HasSubstr("mapper.cell_m = 0.01: makes 400 million cells"));
}

TEST_F(SensingTest, WhatAPartNeedsIsCarried) {
  const auto carried = [&](const std::string& keys) {
    return Carried(Read(RoomScenario("", keys + "\n")));
  };
  EXPECT_THAT(carried("estimator: truth"), ElementsAre("truth"));
  EXPECT_THAT(carried("estimator: odometry"), ElementsAre("encoders", "imu"));
  EXPECT_THAT(carried("estimator: mcl"), ElementsAre("lidar", "encoders", "imu"));
  EXPECT_THAT(carried("estimator: {name: mcl}\nsensors: {encoders: , cliff: {}}"),
              ElementsAre("lidar", "encoders", "imu", "cliff"));
  EXPECT_THAT(carried("mapper: {}"), ElementsAre("lidar", "truth"));
  EXPECT_THAT(carried("react: {}"), ElementsAre("bumper", "cliff", "truth"));
  EXPECT_THAT(carried("react: {bumper: false}"), ElementsAre("cliff", "truth"));
  EXPECT_THAT(carried("sensors: \nmapper: \nreact: "), ElementsAre("truth"));
}

// Two that fill the same part of the observation would overwrite each other.
TEST_F(SensingTest, OfEachReadingThereIsOneSensor) {
  const auto lidar = std::ranges::find(Sensors(), "lidar", &PluginEntry<Sensor>::name);
  const auto imu = std::ranges::find(Sensors(), "imu", &PluginEntry<Sensor>::name);
  const PluginEntry<Sensor> table[] = {*lidar, {"sonar", "", lidar->make}, *imu};
  const auto carried = [&](const std::string& written, std::vector<Reading> needed = {}) {
    std::vector<std::string> names;
    for (const auto& s : CarriedSensors(table, ParseYaml(written, "scenario.yaml"), needed))
      names.push_back(s.name);
    return names;
  };
  EXPECT_THAT(carried("{}", {Reading::kScan}), ElementsAre("lidar"));
  EXPECT_THAT(carried("{sonar: }", {Reading::kScan}), ElementsAre("sonar")) << "in its place";
  EXPECT_THAT(carried("{sonar: }", {Reading::kScan, Reading::kImu}), ElementsAre("sonar", "imu"));
  try {
    carried("lidar: {}\nsonar: {}\n");
    ADD_FAILURE() << "two scans";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(),
                 "scenario.yaml:2: sensors.sonar: tells the scan, as lidar does: a robot carries "
                 "one of them");
  }
}

TEST_F(SensingTest, WhoReactsKeepsWhatItMet) {
  const Scenario dut = Read(RoomScenario("", "react: {}\n"));
  EXPECT_TRUE(dut.spec.recovery);
  EXPECT_TRUE(dut.spec.mapper);
}

TEST_F(SensingTest, WithoutTheirKeysThereIsNone) {
  const Scenario dut = Read(RoomScenario(""));
  EXPECT_EQ(dut.spec.estimator.name, "truth");
  EXPECT_THAT(Carried(dut), ElementsAre("truth")) << "which its estimator goes by";
  EXPECT_FALSE(dut.spec.mapper);
  EXPECT_FALSE(dut.spec.recovery);
  const std::string resolved = ResolvedScenario(dut, folder_);
  for (const char* key : {"\nsensors:", "\nmapper:", "\nreact:"})
    EXPECT_THAT(resolved, Not(HasSubstr(key)));
}

TEST_F(SensingTest, ResolvedTwiceIsItself) {
  for (const char* keys :
       {"estimator: {name: odometry, start_error_x_m: 0.1, start_error_yaw_deg: -3}\n",
        "estimator: {name: mcl, particles: 300, prior_m: 0.2}\nsensors: {lidar: {beams: 60}}\n",
        "sensors: {lidar: {z_m: 0.4}, bumper: {force_n: 5}}\n", "mapper: {cell_m: 0.1}\n",
        "react: {then: go_on, most: 3}\n", "react: {bumper: false, cliff: false}\n",
        "react: {}\nmapper: {mark_m: 0.2}\n", "react: {}\nestimator: mcl\n"}) {
    const std::string once = ResolvedScenario(Read(RoomScenario("", keys)), folder_);
    EXPECT_EQ(ResolvedScenario(Read(once), folder_), once) << keys;
  }
}

TEST_F(SensingTest, TheResolvedScenarioDrivesTheSame) {
  const std::string text =
      RoomScenario("", "estimator: mcl\nreact: {}\nsensors: {encoders: {noise: 0.05}}\nseed: 7\n");
  const Scenario s = Read(text);
  EXPECT_EQ(Trace(Drive(Read(ResolvedScenario(s, folder_)))), Trace(Drive(Read(text))));
}

// One that may be stood on by the site's word is as good as a free one.
TEST_F(SensingTest, MclNeedsMoreThanOneCellToStandOn) {
  const auto read = [&](const std::string& unknown) {
    return Read("scenario: 1\nrobot: beluga\nestimator: mcl\nsite: {site: 1, unknown: " + unknown +
                ", start: {x_m: 0.5, y_m: 0.5, yaw_deg: 0}, grid: {cell_m: 1, rows: \".??\"}}\n");
  };
  EXPECT_NO_THROW(read("free"));
  EXPECT_THROW(read("wall"), InputError);
}

TEST_F(SensingTest, WhatIsCarriedAndNotUsedChangesNothing) {
  const EpisodeRecord without = DriveRoom("");
  const EpisodeRecord with = DriveRoom(
      "sensors: {lidar: {}, encoders: {noise: 0.1}, imu: {}, bumper: {}, cliff: {}}\n"
      "mapper: {}\n");
  EXPECT_EQ(Trace(with), Trace(without));
  EXPECT_FALSE(without.known);
  EXPECT_TRUE(with.known);
  EXPECT_EQ(without.metrics.max_estimate_error_m, 0) << "it is told the truth";
}

// Keys of sensors and estimator that no line of the scenario writes.
constexpr const char* kDrawn =
    "estimator: mcl\n"
    "randomise:\n"
    "  estimator.start_error_x_m: {uniform: [-0.2, 0.2]}\n"
    "  sensors.encoders.bias: {normal: [0, 0.01]}\n"
    "  sensors.encoders.noise: {uniform: [0.01, 0.1]}\n"
    "  sensors.lidar.noise_m: {lognormal: [0.01, 0.5]}\n";

TEST_F(SensingTest, ErrorsAreDrawnAnewInEachEpisode) {
  const ScenarioFile file(Save("s.yaml", RoomScenario("", kDrawn)));
  EXPECT_NO_THROW(file.CheckDraws());
  std::vector<std::string> before;
  for (const std::uint64_t episode : {0u, 1u, 2u}) {
    const Scenario s = file.Read(episode);
    ASSERT_EQ(s.spec.drawn.size(), 4u);
    EXPECT_THAT(Carried(s), ElementsAre("lidar", "encoders", "imu"));
    const std::vector<std::string> values = {
        Value(s.spec.estimator, "start_error_x_m"), Value(SensorOf(s, "encoders"), "bias"),
        Value(SensorOf(s, "encoders"), "noise"), Value(SensorOf(s, "lidar"), "noise_m")};
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_EQ(values[i], s.spec.drawn[i].second.scalar) << s.spec.drawn[i].first;
      if (!before.empty()) {
        EXPECT_NE(values[i], before[i]) << s.spec.drawn[i].first;
      }
    }
    before = values;
  }
}

TEST_F(SensingTest, AnEpisodesErrorsFollowFromItsSeed) {
  const ScenarioFile file(Save("s.yaml", RoomScenario("", kDrawn)));
  EpisodeMaker one(file), other(file);
  const std::string first = ToLine(one.Run({"default", {}}, 1));
  EXPECT_NE(first, ToLine(one.Run({"default", {}}, 0)));
  EXPECT_EQ(first, ToLine(other.Run({"default", {}}, 1))) << "whatever was driven before it";
}

TEST_F(SensingTest, TheSameSeedIsLostTheSameWay) {
  const std::string keys = "estimator: mcl\nmapper: {}\nseed: ";
  for (const auto& robot : {std::vector<Override>{}, kHtetro}) {
    const EpisodeRecord first = DriveRoom(keys + "3\n", robot);
    const EpisodeRecord again = DriveRoom(keys + "3\n", robot);
    EXPECT_EQ(Trace(first), Trace(again));
    EXPECT_EQ(first.known->log_odds.cells, again.known->log_odds.cells);
    EXPECT_NE(Trace(first), Trace(DriveRoom(keys + "4\n", robot)));
  }
}

// Particles are drawn, and so is a gyro's noise; what is exact is the same whatever the seed.
TEST_F(SensingTest, WhatIsDrawnHangsOnTheSeed) {
  const std::string exact =
      "sensors: {lidar: {noise_m: 0, noise_share: 0, dropout: 0}, imu: {gyro_noise_radps: 0, "
      "gyro_bias_radps: 0, accel_noise_mps2: 0, accel_bias_mps2: 0}}\n";
  const auto differ = [&](const std::string& keys) {
    return Trace(DriveRoom(keys + "seed: 1\n")) != Trace(DriveRoom(keys + "seed: 2\n"));
  };
  EXPECT_TRUE(differ("estimator: mcl\n" + exact));
  EXPECT_TRUE(differ("estimator: odometry\n"));
  EXPECT_FALSE(differ("estimator: odometry\n" + exact));
}

class CountAllocations : public EpisodeObserver {
 public:
  bool OnControl(const EpisodeView&) override {
    last_ = AllocationCount();
    if (periods_++ == 0) first_ = last_;
    return true;
  }
  std::int64_t made() const { return last_ - first_; }  // after the first control period
  int periods() const { return periods_; }

 private:
  std::int64_t first_ = 0, last_ = 0;
  int periods_ = 0;
};

TEST_F(SensingTest, AnEpisodesLoopAllocatesNothing) {
  for (const auto& robot : {std::vector<Override>{}, kHtetro}) {
    CountAllocations dut;
    const EpisodeRecord record =
        Drive(Read(RoomScenario("", "estimator: mcl\nmapper: {}\nreact: {}\n"), robot), &dut);
    EXPECT_EQ(record.outcome, Outcome::kSuccess);
    EXPECT_GT(dut.periods(), 200);
    EXPECT_EQ(dut.made(), 0);
  }
}

// Wheels that tell 5 % too much: the robot thinks that it is there when 1 / 1.05 of the way is
// driven.
TEST_F(SensingTest, ABiasedEncoderMakesOdometryDrift) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n4.5,2.5\n");
  const std::string keys = "estimator: odometry\nsensors: {encoders: {bias: ";
  const EpisodeRecord dut = DriveRoom(keys + "0.05}}\n");
  const TraceRow& last = dut.trace.back();
  EXPECT_EQ(dut.outcome, Outcome::kSuccess) << "as far as it knows";
  EXPECT_NEAR(last.est_x_m, 4.5, 0.05);
  EXPECT_NEAR(last.x_m, 1.5 + (last.est_x_m - 1.5) / 1.05, 0.01);
  const EpisodeRecord unbiased = DriveRoom(keys + "0}}\n");
  EXPECT_NEAR(unbiased.trace.back().x_m, unbiased.trace.back().est_x_m, 0.01);
}

TEST_F(SensingTest, ErrorsOfTheEstimateAreThoseOfTheTrace) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n4.5,2.5\n");
  const EpisodeRecord dut = DriveRoom(
      "estimator: {name: odometry, start_error_y_m: 0.05}\n"
      "sensors: {encoders: {bias: 0.05}}\n");
  std::vector<double> errors;
  double sum = 0;
  for (const TraceRow& row : dut.trace) {
    errors.push_back(std::hypot(row.est_x_m - row.x_m, row.est_y_m - row.y_m));
    sum += errors.back();
  }
  constexpr double kRounded_m = 1e-6;  // the trace's numbers are floats
  EXPECT_NEAR(errors.front(), 0.05, kRounded_m);
  std::ranges::sort(errors);
  const auto n = static_cast<double>(errors.size());
  EXPECT_NEAR(dut.metrics.mean_estimate_error_m, sum / n, kRounded_m);
  EXPECT_NEAR(dut.metrics.max_estimate_error_m, errors.back(), kRounded_m);
  EXPECT_NEAR(dut.metrics.p95_estimate_error_m, errors[static_cast<std::size_t>(0.95 * n)], 0.0011);
  const auto metrics = MetricsJson(dut.metrics);
  EXPECT_EQ(metrics["mean_estimate_error_m"], dut.metrics.mean_estimate_error_m);
}

// A pit that is on no map, across the way but not across the room.
constexpr const char* kPit =
    "{type: step, id: pit, polygon_m: [[3,2],[3.8,2],[3.8,3],[3,3]], height_m: -0.10, "
    "known: false}";

class ReactionTest : public SensingTest, public ::testing::WithParamInterface<std::string> {
 protected:
  ReactionTest() { Save("plan.csv", "x_m,y_m\n1.8,2.5\n5.5,2.5\n"); }
  EpisodeRecord Past(const std::string& hazard, const std::string& keys) const {
    return Drive(Read(RoomScenario(hazard, "start: {x_m: 1.8}\n" + keys), {{"robot", GetParam()}}));
  }
};

TEST_P(ReactionTest, AnUnseenPitIsFallenInto) {
  const EpisodeRecord dut = Past(kPit, "");
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  ASSERT_FALSE(dut.events.empty());
  EXPECT_EQ(dut.events[0].hazard, "pit");
  EXPECT_EQ(dut.metrics.reactions, 0) << "off by default";
}

TEST_P(ReactionTest, WhoReactsDrivesAroundIt) {
  const EpisodeRecord dut = Past(kPit, "react: {}\n");
  EXPECT_EQ(dut.outcome, Outcome::kSuccess) << dut.message;
  EXPECT_TRUE(dut.events.empty());
  EXPECT_NEAR(dut.trace.back().x_m, 5.5, 0.1);
  EXPECT_NEAR(dut.trace.back().y_m, 2.5, 0.1);
  EXPECT_GE(dut.metrics.reactions, 1);
  EXPECT_EQ(MetricsJson(dut.metrics)["reactions"], dut.metrics.reactions);
  ASSERT_TRUE(dut.known);
  ASSERT_FALSE(dut.known->marks.empty());
  for (const FloorMark& mark : dut.known->marks) {
    EXPECT_EQ(mark.kind, FloorMark::Kind::kDrop);
    EXPECT_GT(mark.p_W.x(), 2.9);
    EXPECT_LT(mark.p_W.x(), 3.9);
    EXPECT_GT(mark.p_W.y(), 1.9);
    EXPECT_LT(mark.p_W.y(), 3.1);
  }
}

// The first drop that is told is no more than the pit's edge; it takes several to get past.
TEST_P(ReactionTest, NoMoreOftenThanItMay) {
  EXPECT_EQ(Past(kPit, "react: {most: 1}\n").metrics.reactions, 1);
}

TEST_P(ReactionTest, WithoutCliffSensorsAPitIsNoAlarm) {
  const EpisodeRecord dut = Past(kPit, "react: {cliff: false}\n");
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  EXPECT_EQ(dut.events[0].hazard, "pit");
}

TEST_P(ReactionTest, OnAFloorAsKnownItIsTheSameDrive) {
  EXPECT_EQ(Trace(Past("", "react: {}\n")), Trace(Past("", "")));
}

INSTANTIATE_TEST_SUITE_P(Robots, ReactionTest, ::testing::ValuesIn(RobotNames()),
                         [](const auto& suite) { return suite.param; });

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What `randomise` draws: the moments and bounds of each distribution, streams of their own, and
// bad input.
#include "run/scenario/draws.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/params.h"
#include "run/scenario/scenario_file.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

constexpr int kDraws = 20'000;
// Five standard errors: one right program in 1.7 million fails such a check by chance, and this one
// draws the same for ever.
constexpr double kSigmas = 5;

std::vector<RandomisedKey> Read(const std::string& yaml) {
  const ConfigNode node = ParseYaml(yaml, "s.yaml");
  return ReadRandomise(&node);
}

std::vector<double> Sample(const std::string& distribution) {
  const auto keys = Read("k: " + distribution + "\n");
  std::vector<double> values;
  for (std::uint64_t episode = 0; episode < kDraws; ++episode)
    values.push_back(AsDouble(Draw(keys, 7, episode).front().second, "k"));
  return values;
}

double Mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double Deviation(const std::vector<double>& values) {
  const double mean = Mean(values);
  double sum = 0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

// `kurtosis`: the fourth central moment over the square of the variance, which the deviation's
// error hangs on.
void ExpectMoments(const std::vector<double>& values, double mean, double deviation,
                   double kurtosis) {
  const double n = kDraws;
  EXPECT_NEAR(Mean(values), mean, kSigmas * deviation / std::sqrt(n));
  EXPECT_NEAR(Deviation(values), deviation,
              kSigmas * deviation * std::sqrt((kurtosis - 1) / (4 * n)));
}

TEST(Draws, UniformHasItsMomentsAndBounds) {
  const auto dut = Sample("{uniform: [2, 6]}");
  ExpectMoments(dut, 4, 4 / std::sqrt(12), 1.8);
  EXPECT_GE(*std::ranges::min_element(dut), 2);
  EXPECT_LT(*std::ranges::max_element(dut), 6);
  EXPECT_LT(*std::ranges::min_element(dut), 2.01) << "all of it is drawn";
  EXPECT_GT(*std::ranges::max_element(dut), 5.99);
}

TEST(Draws, NormalHasItsMoments) {
  const auto dut = Sample("{normal: [1, 0.5]}");
  ExpectMoments(dut, 1, 0.5, 3);
  const auto near = std::ranges::count_if(dut, [](double x) { return std::abs(x - 1) < 0.5; });
  EXPECT_NEAR(static_cast<double>(near) / kDraws, 0.6827,
              kSigmas * std::sqrt(0.6827 * 0.3173 / kDraws));
}

TEST(Draws, LognormalIsAMedianAndTheDeviationOfTheLogarithm) {
  auto dut = Sample("{lognormal: [2, 0.3]}");
  EXPECT_GT(*std::ranges::min_element(dut), 0);
  for (double& value : dut) value = std::log(value);
  ExpectMoments(dut, std::log(2), 0.3, 3);
}

// Drawn again, not cut: of a normal above its mean plus half a deviation the mean is
// phi(0.5) / (1 - Phi(0.5)) = 1.14108; cut values would lie at the bound in heaps.
TEST(Draws, BoundsCutTheTailsOff) {
  const auto dut = Sample("{normal: [0, 1], min: 0.5}");
  const double deviation = std::sqrt(1 + 0.5 * 1.14108 - 1.14108 * 1.14108);
  EXPECT_NEAR(Mean(dut), 1.14108, kSigmas * deviation / std::sqrt(kDraws));
  EXPECT_GE(*std::ranges::min_element(dut), 0.5);
  EXPECT_LE(std::ranges::count(dut, 0.5), 1);
  const auto both = Sample("{lognormal: [1, 1], min: 0.9, max: 1.1}");
  EXPECT_GE(*std::ranges::min_element(both), 0.9);
  EXPECT_LE(*std::ranges::max_element(both), 1.1);
}

// The least that may be kept is one draw in a hundred; even there no value leaves the bounds.
TEST(Draws, NarrowBoundsHold) {
  const auto dut = Sample("{normal: [0, 1], min: 2.3}");
  EXPECT_GE(*std::ranges::min_element(dut), 2.3);
}

TEST(Draws, ADeviationOfNoughtIsTheMean) {
  for (const double value : Sample("{normal: [3, 0], min: 3}")) ASSERT_EQ(value, 3);
  for (const double value : Sample("{uniform: [3, 3]}")) ASSERT_EQ(value, 3);
}

TEST(Draws, EachChoiceIsAsLikely) {
  const auto keys = Read("robot: {choice: [beluga, htetro, [1, 2]]}\n");
  std::map<std::string, int> dut;
  for (std::uint64_t episode = 0; episode < kDraws; ++episode)
    ++dut[WriteYaml(Draw(keys, 1, episode).front().second)];
  ASSERT_EQ(dut.size(), 3u);
  for (const auto& [value, n] : dut)
    EXPECT_NEAR(static_cast<double>(n) / kDraws, 1.0 / 3, kSigmas * std::sqrt(2.0 / 9 / kDraws))
        << value;
}

std::string Text(const std::vector<RandomisedKey>& keys, std::uint64_t seed,
                 std::uint64_t episode) {
  std::string text;
  for (const auto& [key, value] : Draw(keys, seed, episode))
    text += key + "=" + value.scalar + "\n";
  return text;
}

TEST(Draws, FollowFromSeedEpisodeAndKeyAlone) {
  const auto a = Read("start.x_m: {uniform: [0, 1]}\nstart.y_m: {uniform: [0, 1]}\n");
  EXPECT_EQ(Text(a, 3, 5), Text(a, 3, 5));
  EXPECT_NE(Text(a, 3, 5), Text(a, 3, 6));
  EXPECT_NE(Text(a, 3, 5), Text(a, 4, 5));
  EXPECT_NE(Text(a, 3, 5), Text(a, 5, 3)) << "the sum of the two is the same";
  const auto drawn = Draw(a, 3, 5);
  EXPECT_NE(drawn[0].second.scalar, drawn[1].second.scalar) << "keys share no stream";
}

TEST(Draws, AKeyAddedChangesNoOthers) {
  const auto few = Read("start.x_m: {uniform: [0, 1]}\nstart.y_m: {normal: [0, 1]}\n");
  const auto more = Read(
      "goal.x_m: {normal: [0, 1]}\nstart.y_m: {normal: [0, 1]}\n"
      "start.x_m: {uniform: [0, 1]}\n");
  for (std::uint64_t episode = 0; episode < 50; ++episode) {
    const auto a = Draw(few, 0, episode), b = Draw(more, 0, episode);
    ASSERT_EQ(a[0].second.scalar, b[2].second.scalar);
    ASSERT_EQ(a[1].second.scalar, b[1].second.scalar);
  }
}

// Two keys' draws, and two neighbouring episodes', have nothing in common.
TEST(Draws, StreamsAreNotCorrelated) {
  const auto keys = Read("a: {normal: [0, 1]}\nb: {normal: [0, 1]}\n");
  double keys_sum = 0, episodes_sum = 0, last = 0;
  for (std::uint64_t episode = 0; episode < kDraws; ++episode) {
    const auto drawn = Draw(keys, 11, episode);
    const double a = AsDouble(drawn[0].second, "a"), b = AsDouble(drawn[1].second, "b");
    keys_sum += a * b;
    episodes_sum += a * last;
    last = a;
  }
  EXPECT_NEAR(keys_sum / kDraws, 0, kSigmas / std::sqrt(kDraws));
  EXPECT_NEAR(episodes_sum / kDraws, 0, kSigmas / std::sqrt(kDraws));
}

TEST(Draws, BadInputNamesLineKeyAndRule) {
  const std::tuple<const char*, const char*, const char*> cases[] = {
      {"[1]", "s.yaml:1: randomise", "must be a map"},
      {"a: 3", "s.yaml:1: randomise.a = 3", "must be {uniform"},
      {"a: {uniform: [0, 1]}\nb: {unifrm: [0, 1]}", "s.yaml:2: randomise.b.unifrm",
       "did you mean uniform?"},
      {"a: {uniform: [0, 1], normal: [0, 1]}", "randomise.a", "two distributions"},
      {"a: {min: 1}", "randomise.a", "names no distribution"},
      {"a: {uniform: 4}", "randomise.a.uniform = 4", "must be a list"},
      {"a: {uniform: [1]}", "randomise.a.uniform", "two numbers"},
      {"a: {uniform: [1, x]}", "randomise.a.uniform", "x"},
      {"a: {uniform: [1, .inf]}", "randomise.a.uniform", "inf"},
      {"a: {uniform: [2, 1]}", "randomise.a.uniform = 1", "must not be below"},
      {"a: {normal: [2, -1]}", "randomise.a.normal = -1", "must be >= 0"},
      {"a: {lognormal: [0, 1]}", "randomise.a.lognormal = 0", "must be > 0"},
      {"a: {choice: []}", "randomise.a.choice", "a value or more"},
      {"a: {uniform: [0, 1], min: 0}", "randomise.a", "min and max are for normal"},
      {"a: {normal: [0, 1], min: 3}", "randomise.a", "fewer than one draw in a hundred"},
      {"a: {normal: [0, 1], min: 1, max: 0}", "randomise.a", "fewer than one draw in a hundred"},
      {"a: {normal: [0, 0], min: 1}", "randomise.a", "fewer than one draw in a hundred"},
      {"seed: {uniform: [0, 9]}", "randomise.seed", "cannot differ between episodes"},
      {"plan.command: {choice: [[./a], [./b]]}", "s.yaml:1: randomise.plan.command",
       "cannot be drawn"},
      {"plan.command.0: {choice: [./a, ./b]}", "randomise.plan.command.0", "cannot be drawn"},
      {"plan.folder: {choice: [a, b]}", "randomise.plan.folder", "cannot be drawn"},
      {"plan.made: {choice: [null, a]}", "randomise.plan.made", "cannot be drawn"},
      {"plan: {choice: [spiral, {command: [./a]}]}", "randomise.plan.command", "cannot be drawn"},
      {"gate.max_rate: {uniform: [0, 1]}", "randomise.gate.max_rate", "cannot differ"},
  };
  for (const auto& [yaml, where, rule] : cases) {
    try {
      Read(yaml);
      ADD_FAILURE() << yaml << " is taken";
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr(where)) << yaml;
      EXPECT_THAT(e.what(), HasSubstr(rule)) << yaml;
      EXPECT_THAT(e.what(), HasSubstr("s.yaml:")) << yaml;
    }
  }
}

constexpr const char* kSill =
    "{type: step, id: sill, polygon_m: [[4,0.5],[4.1,0.5],[4.1,4.5],[4,4.5]], height_m: 0.006}";

class DrawnScenario : public ScenarioTest {
 protected:
  std::filesystem::path Room(const std::string& more) {
    Save("plan.csv", "x_m,y_m\n1.5,2.5\n2.5,2.5\n");
    return Save("s.yaml", RoomScenario(kSill, more));
  }
  using ScenarioTest::Read;
  static std::string HeightOf(const Scenario& s) {
    return s.text.site.Find("hazards")->items[0].Find("height_m")->scalar;
  }
};

// In lists a key is an entry's id or its index.
TEST_F(DrawnScenario, KeysReachIntoTheSitesLists) {
  const auto file = Room("");
  for (const char* key : {"site.hazards.sill.height_m", "site.hazards.0.height_m"})
    EXPECT_EQ(HeightOf(ReadScenario(file, {{key, "0.009"}})), "0.009") << key;
  for (const char* key : {"site.hazards.sil.height_m", "site.hazards.1.height_m",
                          "site.hazards.-1.height_m", "site.hazards..height_m"})
    EXPECT_THROW(ReadScenario(file, {{key, "0.009"}}), InputError) << key;

  const ScenarioFile drawn(
      Room("randomise:\n"
           "  site.hazards.0.height_m: {uniform: [0.01, 0.02]}\n"
           "  site.hazards.0.polygon_m.1.0: {uniform: [4.2, 4.3]}\n"));
  const Scenario s = drawn.Read(3);
  EXPECT_EQ(HeightOf(s), s.spec.drawn[0].second.scalar);
  EXPECT_EQ(s.text.site.Find("hazards")->items[0].Find("polygon_m")->items[1].items[0].scalar,
            s.spec.drawn[1].second.scalar);
  EXPECT_EQ(HeightOf(drawn.Read(std::nullopt)), "0.006") << "without an episode nothing is drawn";
}

TEST_F(DrawnScenario, WhatIsSetIsNotDrawn) {
  const auto file =
      Room("randomise: {start.y_m: {uniform: [2, 3]}, site.floor.friction: {uniform: [0.4, 1]}}\n");
  const Scenario all = ScenarioFile(file).Read(1);
  const Scenario one = ScenarioFile(file, {{"start.y_m", "2.25"}}).Read(1);
  ASSERT_EQ(one.spec.drawn.size(), 1u);
  EXPECT_EQ(one.world.start.y_m, 2.25);
  EXPECT_EQ(one.spec.drawn[0].second.scalar, all.spec.drawn[1].second.scalar);
  const Scenario whole = ScenarioFile(file, {{"start", "{x_m: 1.5, y_m: 2.75}"}}).Read(1);
  EXPECT_EQ(whole.world.start.y_m, 2.75) << "the key above it is set";
}

TEST_F(DrawnScenario, VariantsShareTheDraws) {
  const ScenarioFile file(
      Room("randomise: {start.y_m: {uniform: [2, 3]}}\nmatrix: {robot: [beluga, htetro]}\n"));
  ASSERT_EQ(file.variants().size(), 2u);
  for (std::uint64_t episode : {0u, 1u, 9u}) {
    const Scenario a = file.Read(episode, file.variants()[0]);
    const Scenario b = file.Read(episode, file.variants()[1]);
    EXPECT_EQ(a.world.start.y_m, b.world.start.y_m);
    EXPECT_EQ(a.spec.robot_name, "beluga");
    EXPECT_EQ(b.spec.robot_name, "htetro");
  }
}

}  // namespace
}  // namespace floorproof

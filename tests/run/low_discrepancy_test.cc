// SPDX-License-Identifier: Apache-2.0
// `sampling: low_discrepancy`: each distribution's quantiles, how evenly the points lie, and that
// an episode's point hangs on nothing but seed, episode, key and dimension.
#include "run/scenario/low_discrepancy.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "base/params.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario_file.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

std::vector<RandomisedKey> Read(const std::string& yaml,
                                Sampling sampling = Sampling::kLowDiscrepancy) {
  const ConfigNode node = ParseYaml(yaml, "s.yaml");
  return ReadRandomise(&node, sampling);
}

double QuantileOf(const std::string& distribution, double probability) {
  const auto keys = Read("k: " + distribution + "\n");
  return AsDouble(keys.front().distribution.Quantile(probability), "k");
}

// Standard normal quantiles: 0.8413447460685429 at 1, 0.9772498680518208 at 2.
TEST(Quantile, IsWhatTablesSay) {
  constexpr double kOne = 0.8413447460685429, kTwo = 0.9772498680518208;
  EXPECT_DOUBLE_EQ(QuantileOf("{uniform: [2, 6]}", 0.25), 3);
  EXPECT_NEAR(QuantileOf("{normal: [1, 0.5]}", 0.5), 1, 1e-12);
  EXPECT_NEAR(QuantileOf("{normal: [1, 0.5]}", kOne), 1.5, 1e-12);
  EXPECT_NEAR(QuantileOf("{normal: [1, 0.5]}", 1 - kTwo), 0, 1e-12);
  EXPECT_NEAR(QuantileOf("{lognormal: [2, 0.3]}", kOne), 2 * std::exp(0.3), 1e-12);
  EXPECT_EQ(QuantileOf("{normal: [3, 0], min: 3}", 0.9), 3);
  EXPECT_EQ(QuantileOf("{uniform: [3, 3]}", 0.9), 3);
  EXPECT_EQ(QuantileOf("{choice: [4, 5, 6, 7]}", 0.499), 5);
  EXPECT_EQ(QuantileOf("{choice: [4, 5, 6, 7]}", 0.5), 6);
}

// Of several ranges, each place is as likely: 3 of 4 parts lie in the second.
TEST(Quantile, OfSeveralRangesPassesOverTheGaps) {
  const std::string dut = "{uniform: [[-2, -1], [1, 4]]}";
  EXPECT_DOUBLE_EQ(QuantileOf(dut, 0.125), -1.5);
  EXPECT_DOUBLE_EQ(QuantileOf(dut, 0.25), 1);
  EXPECT_DOUBLE_EQ(QuantileOf(dut, 0.5), 2);
  const auto keys = Read("k: " + dut + "\n", Sampling::kIndependent);
  int low = 0;
  for (std::uint64_t e = 0; e < 1000; ++e) {
    const double x = AsDouble(Draw(keys, 1, e).front().second, "k");
    EXPECT_TRUE((x >= -2 && x < -1) || (x >= 1 && x < 4)) << x;
    low += x < 0;
  }
  EXPECT_NEAR(low, 250, 5 * std::sqrt(1000 * 0.25 * 0.75));
}

// What lies within the bounds keeps its proportions: half of the mass between 0 and infinity of a
// normal distribution lies below 0.6744897501960817, its upper quartile.
TEST(Quantile, OfWhatIsCutOffKeepsProportionsAndBounds) {
  EXPECT_NEAR(QuantileOf("{normal: [0, 1], min: 0}", 0.5), 0.6744897501960817, 1e-12);
  EXPECT_NEAR(QuantileOf("{lognormal: [1, 1], max: 1}", 0.5), std::exp(-0.6744897501960817), 1e-12);
  const std::string bounded = "{normal: [0, 1], min: -0.5, max: 2.5}";
  for (const double u : {1e-16, 1e-3, 0.3, 0.999, 1 - 1e-16}) {
    EXPECT_GE(QuantileOf(bounded, u), -0.5) << u;
    EXPECT_LE(QuantileOf(bounded, u), 2.5) << u;
    EXPECT_TRUE(std::isfinite(QuantileOf("{normal: [0, 1]}", u))) << u;
    EXPECT_GT(QuantileOf("{lognormal: [1, 1]}", u), 0) << u;
  }
}

// Both ways to draw are of the same distribution: as many draws below each tenth quantile.
TEST(Quantile, IsOfTheDistributionThatIsDrawn) {
  constexpr int kDraws = 4000;
  constexpr double kSigmas = 5;
  for (const char* text : {"{uniform: [2, 6]}", "{normal: [1, 0.5], min: 0.8, max: 2}",
                           "{lognormal: [2, 0.3], max: 2.5}"}) {
    const auto keys = Read("k: " + std::string(text) + "\n", Sampling::kIndependent);
    for (const double p : {0.1, 0.5, 0.9}) {
      const double below = QuantileOf(text, p);
      int k = 0;
      for (std::uint64_t e = 0; e < kDraws; ++e)
        k += AsDouble(Draw(keys, 7, e).front().second, "k") < below;
      EXPECT_NEAR(static_cast<double>(k) / kDraws, p, kSigmas * std::sqrt(p * (1 - p) / kDraws))
          << text;
    }
  }
}

constexpr int kLog2 = 10, kPoints = 1 << kLog2;

// `kPoints` points of three keys in the unit cube.
std::vector<std::vector<double>> Points(Sampling sampling) {
  const auto keys = Read("a: {uniform: [0, 1]}\nb: {uniform: [0, 1]}\nc: {uniform: [0, 1]}\n");
  std::vector<std::vector<double>> points;
  for (std::uint64_t e = 0; e < kPoints; ++e) {
    auto& point = points.emplace_back();
    for (const auto& [key, value] : Draw(keys, 5, e, sampling))
      point.push_back(AsDouble(value, key));
  }
  return points;
}

// Of `cells` x (kPoints / cells) equal boxes over two coordinates, how many hold no point.
int EmptyBoxes(const std::vector<std::vector<double>>& points, std::size_t a, std::size_t b,
               int cells) {
  std::set<std::pair<int, int>> hit;
  for (const auto& p : points)
    hit.insert({static_cast<int>(p[a] * cells), static_cast<int>(p[b] * (kPoints / cells))});
  return kPoints - static_cast<int>(hit.size());
}

// The largest difference between the share of points in [0, x) x [0, y) and its area.
double Discrepancy(const std::vector<std::vector<double>>& points, std::size_t a, std::size_t b) {
  double worst = 0;
  for (double x = 0.05; x <= 1; x += 0.05)
    for (double y = 0.05; y <= 1; y += 0.05) {
      const auto in =
          std::ranges::count_if(points, [&](const auto& p) { return p[a] < x && p[b] < y; });
      worst = std::max(worst, std::abs(static_cast<double>(in) / kPoints - x * y));
    }
  return worst;
}

TEST(LowDiscrepancy, EveryBoxHoldsItsPoint) {
  const auto dut = Points(Sampling::kLowDiscrepancy);
  for (const std::size_t key : {0u, 1u, 2u})
    EXPECT_EQ(EmptyBoxes(dut, key, 0, kPoints), 0) << "intervals of one coordinate, " << key;
  for (const int cells : {4, 32, 128}) EXPECT_EQ(EmptyBoxes(dut, 0, 1, cells), 0) << cells;
  // Independent points leave 1 - 1/e of the boxes filled.
  const auto chance = Points(Sampling::kIndependent);
  EXPECT_GT(EmptyBoxes(chance, 0, 1, 32), kPoints / 4);
}

TEST(LowDiscrepancy, TwoProjectionsAreMoreEvenThanChance) {
  const auto dut = Points(Sampling::kLowDiscrepancy), chance = Points(Sampling::kIndependent);
  for (const std::size_t other : {1u, 2u}) {
    EXPECT_LT(Discrepancy(dut, 0, other), 0.01);
    EXPECT_GT(Discrepancy(chance, 0, other), 0.01) << "else the bound says nothing";
  }
}

// The point without its shift is the sequence's: 0, then 1/2, then 3/4 and 1/4 in turns.
TEST(LowDiscrepancy, PointsAreThoseOfTheSequence) {
  constexpr std::uint64_t kHalf = 1ULL << 63, kQuarter = 1ULL << 62;
  EXPECT_EQ(SobolPoint(0, 2), (std::vector<std::uint64_t>{0, 0}));
  EXPECT_EQ(SobolPoint(1, 2), (std::vector<std::uint64_t>{kHalf, kHalf}));
  EXPECT_EQ(SobolPoint(2, 2), (std::vector<std::uint64_t>{kHalf + kQuarter, kQuarter}));
  EXPECT_EQ(SobolPoint(3, 2), (std::vector<std::uint64_t>{kQuarter, kHalf + kQuarter}));
  EXPECT_EQ(SobolPoint(99'999'999, 1000).size(), 1000u) << "found directly";
  EXPECT_GT(Shifted(0, 0), 0);
  EXPECT_LT(Shifted(~0ULL, 0), 1);
}

std::string Text(const std::vector<RandomisedKey>& keys, std::uint64_t seed,
                 std::uint64_t episode) {
  std::string text;
  for (const auto& [key, value] : Draw(keys, seed, episode, Sampling::kLowDiscrepancy))
    text += key + "=" + value.scalar + "\n";
  return text;
}

TEST(LowDiscrepancy, FollowsFromSeedEpisodeAndKeyAlone) {
  const auto two = Read("a: {uniform: [0, 1]}\nb: {uniform: [0, 1]}\n");
  EXPECT_EQ(Text(two, 3, 5), Text(two, 3, 5));
  EXPECT_NE(Text(two, 3, 5), Text(two, 3, 6));
  EXPECT_NE(Text(two, 3, 5), Text(two, 4, 5));
  const auto more = Read("a: {uniform: [0, 1]}\nb: {uniform: [0, 1]}\nc: {uniform: [0, 1]}\n");
  EXPECT_TRUE(Text(more, 3, 5).starts_with(Text(two, 3, 5))) << "one added at the end";
  const auto alone = Read("b: {uniform: [0, 1], dimension: 2}\n");
  EXPECT_TRUE(Text(two, 3, 5).ends_with(Text(alone, 3, 5))) << "its dimension is written";
}

TEST(LowDiscrepancy, BadInputNamesLineKeyAndRule) {
  const std::tuple<const char*, const char*, const char*> cases[] = {
      {"a: {uniform: [0, 1], dimension: 0}", "randomise.a.dimension = 0", "[1, 1000]"},
      {"a: {uniform: [0, 1], dimension: 1001}", "randomise.a.dimension = 1001", "[1, 1000]"},
      {"a: {uniform: [[0, 1], [0.5, 2]]}", "randomise.a.uniform = 0.5", "must not overlap"},
      {"a: {uniform: [[0, 1], [2, 1]]}", "randomise.a.uniform = 1", "must not be below"},
      {"a: {uniform: [[0, 1], 3]}", "randomise.a.uniform", "a list of [low, high]"},
      {"a: {uniform: [[0, 1], [2, 2]]}", "randomise.a.uniform = 2", "none may be empty"},
      {"a: {uniform: [0, 1], dimension: 2}\nb: {uniform: [0, 1]}", "s.yaml:2: randomise.b",
       "is that of a too"},
  };
  for (const auto& [yaml, where, rule] : cases) try {
      Read(yaml);
      ADD_FAILURE() << yaml << " is taken";
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr(where)) << yaml;
      EXPECT_THAT(e.what(), HasSubstr(rule)) << yaml;
    }
  EXPECT_THROW(Read("a: {uniform: [0, 1], dimension: 1}", Sampling::kIndependent), InputError);
  std::string many;
  for (int i = 0; i <= 1000; ++i) many += "k" + std::to_string(i) + ": {uniform: [0, 1]}\n";
  EXPECT_THROW(Read(many), InputError);
}

class EvenlyDrawn : public ScenarioTest {
 protected:
  std::filesystem::path Room(const std::string& more) {
    Save("plan.csv", "x_m,y_m\n1.5,2.5\n2.5,2.5\n");
    return Save("s.yaml", RoomScenario("", "sampling: low_discrepancy\n" + more));
  }
};

TEST_F(EvenlyDrawn, WhatIsSetMovesNoOthersPoint) {
  const auto file = Room(
      "randomise: {start.y_m: {uniform: [2, 3]}, start.x_m: {uniform: [1, 2]}, "
      "site.floor.friction: {uniform: [0.4, 1]}}\n");
  const Scenario all = ScenarioFile(file).Read(6);
  const Scenario set = ScenarioFile(file, {{"start.y_m", "2.25"}}).Read(6);
  ASSERT_EQ(set.spec.drawn.size(), 2u);
  EXPECT_EQ(set.world.start.x_m, all.world.start.x_m);
  EXPECT_EQ(set.world.site.map.floor_friction, all.world.site.map.floor_friction);
}

// A drawn site's keys leave `randomise` when an episode's scenario is resolved: the others' points
// stay.
TEST_F(EvenlyDrawn, AResolvedEpisodeIsTheSameEpisode) {
  const auto file = Save("g.yaml",
                         "scenario: 1\nsampling: low_discrepancy\nrobot: beluga\nplan: spiral\n"
                         "site: {site: 1, generate: {kind: room, cells: [8, 8]}}\nrandomise:\n"
                         "  site.generate.obstacle_density: {uniform: [0.0, 0.1]}\n"
                         "  site.floor.friction: {uniform: [0.4, 1]}\n");
  const Scenario whole = ScenarioFile(file, {{"episode", "7"}}).Read(7);
  const std::string text = ResolvedScenario(whole, folder_);
  EXPECT_THAT(text, HasSubstr("sampling: low_discrepancy"));
  const Scenario again = ReadScenario(Save("r.yaml", text));
  ASSERT_EQ(again.spec.drawn.size(), 1u);
  EXPECT_EQ(again.world.site.map.floor_friction, whole.world.site.map.floor_friction);
  EXPECT_EQ(ResolvedScenario(again, folder_), text);
}

TEST_F(EvenlyDrawn, BadSamplingIsRefused) {
  const auto file = Save("s.yaml", RoomScenario("", "sampling: sobol\n"));
  try {
    ReadScenario(file);
    ADD_FAILURE() << "is taken";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("sampling = sobol: must be independent or low_discrepancy"));
  }
}

}  // namespace
}  // namespace floorproof

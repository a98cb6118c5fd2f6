// SPDX-License-Identifier: Apache-2.0
// What failures depend on, of rows whose truth is known.
#include "run/campaign/dependence.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "base/streams.h"
#include "run/campaign/dependence_text.h"
#include "stats/binomial.h"
#include "tests/own_folder.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

struct Episode {
  Json drawn = Json::object();
  bool failed = false;
  std::string outcome{};  // empty: success or failure
  double duration_s = 0;  // 0: another in each episode
};

// A campaign of one variant, "v", whose episodes are as `make` says.
class DependenceTest : public OwnFolderTest {
 protected:
  VariantDependence Depend(std::uint64_t n,
                           const std::function<Episode(std::uint64_t, Stream&)>& make,
                           const std::optional<GateSummary>& gate = std::nullopt) {
    fs::remove(folder_ / "campaign.sqlite");
    CampaignStore store =
        CampaignStore::Create(folder_ / "campaign.sqlite", {"id", "seed: 1\n", "{}"});
    std::vector<EpisodeRow> rows;
    for (std::uint64_t id = 0; id < n; ++id) {
      Stream stream(23, id, "dependence");
      const Episode episode = make(id, stream);
      EpisodeRow row;
      row.variant = "v";
      row.episode = id;
      row.outcome = !episode.outcome.empty() ? episode.outcome
                    : episode.failed         ? "failure"
                                             : "success";
      row.drawn = episode.drawn.dump();
      if (row.outcome != "not_planned")  // an error may come while it drives
        row.metrics[MetricIndex(&Metrics::duration_s)] =
            episode.duration_s > 0 ? episode.duration_s : 10.0 + double(id);
      rows.push_back(std::move(row));
    }
    store.Add(rows);
    Variant variant;
    variant.name = "v";
    CampaignSummary summary = Summarise(store, {variant}, {}, "");
    summary.gate = gate;
    return DependenceOf(store, summary).at(0);
  }
};

// Fails with chance 1/2 where the friction is below 0.6, else never; the mass has no say.
Episode LowFriction(std::uint64_t, Stream& stream) {
  const double friction = stream.Uniform(0.4, 1), mass = stream.Normal();
  return {{{"mass_kg", mass}, {"friction", friction}}, friction < 0.6 && stream.Uniform() < 0.5};
}

TEST_F(DependenceTest, TheTellingValueComesFirstAndSaysWhere) {
  const VariantDependence dut = Depend(400, LowFriction);
  ASSERT_EQ(dut.values.size(), 2u);
  const ValueDependence& friction = dut.values[0];
  EXPECT_EQ(friction.key, "friction");
  EXPECT_EQ(friction.shape, InfluenceShape::kLower);
  EXPECT_TRUE(friction.telling());
  EXPECT_FALSE(dut.values[1].telling());
  EXPECT_EQ(dut.looked_at, 2);
  EXPECT_DOUBLE_EQ(friction.p_holm, 2 * friction.p);

  ASSERT_EQ(friction.bins.size(), 8u);
  int k = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    const ValueBin& bin = friction.bins[i];
    EXPECT_EQ(bin.rate.n, 50);
    EXPECT_EQ(bin.rate.upper, ClopperPearson(bin.rate.k, 50, 0.95).upper);
    EXPECT_GT(bin.low, i > 0 ? friction.bins[i - 1].high : 0);
    EXPECT_TRUE(bin.low < 0.6 || bin.rate.k == 0);
    k += bin.rate.k;
  }
  EXPECT_EQ(k, dut.k);
  ASSERT_TRUE(friction.safe && friction.safe->from);
  EXPECT_GT(friction.safe->from->edge, 0.55);
  EXPECT_LT(friction.safe->from->edge, 0.65);
  EXPECT_THAT(DependenceText(dut),
              ElementsAre(StartsWith(
                  "friction: failures at lower values (p < 0.0001 after Holm for "
                  "2 values); safe on average (not_success below 5 % at 95 %) from 0.")));
}

TEST_F(DependenceTest, WithoutAnInfluenceItSaysSo) {
  const VariantDependence dut = Depend(300, [](std::uint64_t, Stream& stream) {
    return Episode{{{"a", stream.Uniform()}, {"b", stream.Uniform()}}, stream.Uniform() < 0.2};
  });
  EXPECT_THAT(
      DependenceText(dut),
      ElementsAre(StartsWith("nothing drawn shows an influence on failures (the least p = ")));
}

TEST_F(DependenceTest, OnlyEpisodesThatCountDo) {
  const auto all = Depend(200, LowFriction);
  const auto some = Depend(260, [](std::uint64_t id, Stream& stream) {
    Episode episode = LowFriction(id, stream);
    if (id >= 200) episode.outcome = "error";
    return episode;
  });
  EXPECT_EQ(some.n, 200);
  EXPECT_EQ(DependenceCsv({some}), DependenceCsv({all}));
}

// No sill above 10 mm is crossed, for want of a plan: those heights are not safe.
TEST_F(DependenceTest, WithoutAPlanThereIsNoSuccess) {
  const auto sill = [](std::uint64_t, Stream& stream) {
    const double height_mm = stream.Uniform(2, 12);
    return Episode{{{"height_mm", height_mm}}, false, height_mm > 10 ? "not_planned" : ""};
  };
  const auto dut = Depend(300, sill);
  EXPECT_EQ(dut.n, 300);
  EXPECT_NEAR(dut.k, 60, 25);
  EXPECT_TRUE(dut.values[0].telling());
  ASSERT_TRUE(dut.values[0].safe && dut.values[0].safe->up_to);
  EXPECT_LT(dut.values[0].safe->up_to->edge, 10.6);
  GateSummary gate;
  gate.metric = "any_failure";
  gate.max_rate = 0.05, gate.confidence = 0.95;
  const auto driven = Depend(300, sill, gate);
  EXPECT_EQ(driven.n, 300 - dut.k) << "no robot failed";
  EXPECT_EQ(driven.k, 0);
}

// As people say it: 0.0159 m is 15.9 mm, and an edge is rounded so that no value beyond it is
// claimed.
TEST_F(DependenceTest, ValuesHaveTheirUnit) {
  const auto dut = Depend(400, [](std::uint64_t, Stream& stream) {
    const double height_m = 0.03 * stream.Uniform();
    return Episode{{{"site.hazards.0.height_m", height_m}}, height_m > 0.02};
  });
  const std::vector<std::string> lines = DependenceText(dut);
  ASSERT_THAT(lines, testing::SizeIs(1));
  EXPECT_THAT(lines[0],
              StartsWith("hazard 0 height (site.hazards.0.height_m): failures at higher values"));
  const double edge_mm = 1000 * dut.values[0].safe->up_to->edge;
  EXPECT_THAT(lines[0], testing::ContainsRegex("up to [0-9.]+ mm"));
  const double said = std::stod(lines[0].substr(lines[0].find(" up to ") + 7));
  EXPECT_LE(said, edge_mm + 1e-9);
  EXPECT_GT(said, edge_mm - 0.1);
  const auto& bins = dut.values[0].bins;
  EXPECT_THAT(BinText(bins.back(), BinScale(dut.values[0].key, bins)), testing::EndsWith(" mm"));
}

TEST_F(DependenceTest, TimeoutsCountAndAreNoSuccess) {
  const auto dut = Depend(40, [](std::uint64_t id, Stream&) {
    return Episode{{{"a", id}}, id < 5, id >= 30 ? id % 2 == 0 ? "timeout" : "aborted" : ""};
  });
  EXPECT_EQ(dut.n, 40);
  EXPECT_EQ(dut.k, 15);
}

TEST_F(DependenceTest, AValueThatSomeDoNotDrawIsOfThoseThatDo) {
  const auto dut = Depend(200, [](std::uint64_t id, Stream& stream) {
    Episode episode{{{"always", stream.Uniform()}}, id % 4 == 0};
    if (id % 2 == 0) episode.drawn["höhe ↑"] = stream.Uniform();
    return episode;
  });
  ASSERT_EQ(dut.values.size(), 2u);
  const ValueDependence& some = dut.values[dut.values[0].key == "always" ? 1 : 0];
  EXPECT_EQ(some.key, "höhe ↑");
  EXPECT_EQ(some.n, 100);
  EXPECT_EQ(some.k, 50);
  ASSERT_EQ(dut.pairs.size(), 1u);
  int n = 0;
  for (const PairCell& cell : dut.pairs[0].cells) n += cell.rate.n;
  EXPECT_EQ(n, 100) << "of those that drew both";
}

TEST_F(DependenceTest, AFewValuesHaveABinEachAndOneValueIsNotLookedAt) {
  const auto dut = Depend(90, [](std::uint64_t id, Stream& stream) {
    return Episode{{{"step", 0.5 * double(id % 3)}, {"same", 4}},
                   id % 3 == 2 && stream.Uniform() < 0.5};
  });
  EXPECT_EQ(dut.looked_at, 1);
  ASSERT_EQ(dut.values[0].key, "step");
  ASSERT_EQ(dut.values[0].bins.size(), 3u);
  EXPECT_EQ(dut.values[0].bins[1].low, 0.5);
  EXPECT_EQ(dut.values[0].bins[1].high, 0.5);
  EXPECT_EQ(dut.values[0].bins[1].rate.n, 30);
  EXPECT_EQ(dut.values[1].bins.size(), 1u);
  EXPECT_EQ(dut.values[1].p_holm, 1);
  EXPECT_THAT(dut.pairs, IsEmpty());
}

TEST_F(DependenceTest, ChoicesHaveABinEachAndTheOneThatStandsOutIsNamed) {
  const auto dut = Depend(160, [](std::uint64_t id, Stream& stream) {
    const char* robots[] = {"htetro", "beluga", "=cmd()", "a,b"};
    return Episode{{{"robot", robots[id % 4]}, {"known", id % 8 < 4}},
                   id % 4 == 1 && stream.Uniform() < 0.6};
  });
  const ValueDependence& robot = dut.values[0];
  EXPECT_FALSE(robot.is_number);
  EXPECT_FALSE(robot.safe);
  EXPECT_EQ(robot.choice, "beluga");
  EXPECT_TRUE(robot.choice_fails_more);
  ASSERT_EQ(robot.bins.size(), 4u);
  EXPECT_EQ(robot.bins[2].rate.name, "beluga") << "alphabetical";
  EXPECT_EQ(robot.bins[2].rate.n, 40);
  EXPECT_EQ(dut.values[1].bins[0].rate.name, "false");
  EXPECT_THAT(DependenceText(dut).at(0),
              StartsWith("robot: more failures with beluga (p < 0.0001"));
  const std::string csv = DependenceCsv({dut});
  EXPECT_THAT(csv,
              StartsWith("variant,value,low,high,n,k,rate,lower,upper\nv,robot,'=cmd(),'=cmd(),"
                         "40,0,0,0,"));
  EXPECT_THAT(csv, HasSubstr("\nv,robot,\"a,b\",\"a,b\",40,"));
}

TEST_F(DependenceTest, NumbersAmongTextsAreChoices) {
  const auto dut = Depend(60, [](std::uint64_t id, Stream&) {
    return Episode{{{"limit", id % 3 == 0 ? Json("none") : Json(0.25 * double(id % 3))}},
                   id % 3 == 0 && id < 30};
  });
  EXPECT_FALSE(dut.values[0].is_number);
  EXPECT_THAT(dut.values[0].bins[0].rate.name, "0.25");
  EXPECT_EQ(dut.values[0].choice, "none");
}

TEST_F(DependenceTest, NothingIsMadeOfNoise) {
  const auto few = Depend(19, LowFriction);
  EXPECT_THAT(few.note, HasSubstr("19 episodes"));
  const auto clean = Depend(100, [](std::uint64_t, Stream& stream) {
    return Episode{{{"a", stream.Uniform()}}};
  });
  EXPECT_THAT(clean.note, HasSubstr("no episode failed"));
  const auto broken = Depend(30, [](std::uint64_t, Stream& stream) {
    return Episode{{{"a", stream.Uniform()}}, true};
  });
  EXPECT_THAT(broken.note, HasSubstr("every episode failed"));
  for (const VariantDependence* dut : {&few, &clean, &broken}) {
    EXPECT_THAT(dut->values[0].bins, IsEmpty());
    EXPECT_THAT(dut->pairs, IsEmpty());
    EXPECT_THAT(DependenceText(*dut), IsEmpty());
    EXPECT_EQ(DependenceCsv({*dut}), "variant,value,low,high,n,k,rate,lower,upper\n");
  }
  EXPECT_EQ(SafeText(clean.values[0], clean.limit),
            "safe on average (not_success below 5 % at 95 %) over the whole range drawn (0 of 100 "
            "failed)");
  EXPECT_THAT(
      SafeText(few.values[0], few.limit),
      StartsWith("19 episodes are too few to say up to which value not_success below 5 % at "
                 "95 % holds: it takes 59"));
  EXPECT_THAT(SafeText(broken.values[0], broken.limit), HasSubstr("every one failed, 30 drives"))
      << "more drives would not help";
  EXPECT_THAT(Depend(50, [](std::uint64_t, Stream&) { return Episode{}; }).values, IsEmpty());
}

// A mean over much that never fails hides what fails at one end: the parts do not.
TEST_F(DependenceTest, WhatIsSafeOnAverageIsToldApartFromEachPart) {
  ValueDependence dut;
  SafeRange& safe = dut.safe.emplace();
  safe = {.answer = SafeAnswer::kWhole, .needed = 59, .whole = {0.46, 2000, 18}, .parts = 8};
  safe.each_from = Stretch{-0.13726, 250, 0};
  EXPECT_EQ(SafeText(dut, {}),
            "safe on average (not_success below 5 % at 95 %) over the whole range drawn (18 of "
            "2000 failed); in "
            "each part by itself only from -0.137 on");
  safe.each_up_to = Stretch{0.46, 250, 0};
  EXPECT_THAT(SafeText(dut, {}), HasSubstr("failed); and in each part by itself"));
  safe.answer = SafeAnswer::kPart;
  safe.each_up_to = safe.each_from = std::nullopt;
  safe.up_to = Stretch{0.12345, 300, 2};
  safe.from = Stretch{0.23451, 400, 3};
  EXPECT_EQ(SafeText(dut, {.max_rate = 0.01, .confidence = 0.9}),
            "safe on average (not_success below 1 % at 90 %) up to 0.123 (2 of 300 failed) and "
            "from 0.235 on (3 "
            "of 400 failed); no part at either end is by itself")
      << "rounded so that no value beyond is claimed";
}

// A drive that runs out of time is not safe; nor is it a failure for a gate of failures alone.
TEST_F(DependenceTest, WhatCountsIsTheGatesMetric) {
  const auto late = [](std::uint64_t, Stream& stream) {
    const double a = stream.Uniform();
    Episode episode{{{"a", a}}};
    if (a > 0.7) episode.outcome = "timeout";
    return episode;
  };
  const auto whole = [](const VariantDependence& v) { return v.values[0].safe->answer; };
  const VariantDependence none = Depend(200, late);
  EXPECT_EQ(none.metric, "not_success");
  EXPECT_EQ(whole(none), SafeAnswer::kPart);
  GateSummary gate;
  gate.max_rate = 0.05;
  gate.confidence = 0.95;
  gate.metric = "not_success";
  EXPECT_EQ(whole(Depend(200, late, gate)), SafeAnswer::kPart);
  gate.metric = "any_failure";
  const VariantDependence failures = Depend(200, late, gate);
  EXPECT_EQ(whole(failures), SafeAnswer::kWhole);
  EXPECT_THAT(SafeText(failures.values[0], failures.limit, failures.metric),
              StartsWith("safe on average (any_failure below 5 % at 95 %)"));
}

TEST_F(DependenceTest, TheLimitIsTheGates) {
  const auto clean = [](std::uint64_t, Stream& stream) {
    return Episode{{{"a", stream.Uniform()}}};
  };
  const GateSummary gate{.max_rate = 0.01, .confidence = 0.9, .mode = "fixed"};
  const auto dut = Depend(200, clean, gate);
  EXPECT_EQ(dut.values[0].safe->answer, SafeAnswer::kTooFew);
  EXPECT_EQ(dut.values[0].safe->needed, 230);
  const GateSummary sequential{.max_rate = 0.05, .confidence = 0.95, .mode = "sequential"};
  EXPECT_TRUE(Depend(80, clean, sequential).limit.anytime);
}

TEST_F(DependenceTest, OneEpisodeRepeatedSaysNothing) {
  const auto dut = Depend(100, [](std::uint64_t, Stream& stream) {
    return Episode{{{"a", stream.Uniform()}}, false, "", 7.0};
  });
  EXPECT_THAT(dut.note, HasSubstr("came out the same"));
  EXPECT_FALSE(dut.values[0].safe) << "not even that it is safe";
}

// High friction and a high step together, neither alone.
TEST_F(DependenceTest, PairsShowWhatNoValueShowsAlone) {
  const auto dut = Depend(720, [](std::uint64_t, Stream& stream) {
    const double friction = stream.Uniform(), height = stream.Uniform();
    return Episode{{{"friction", friction}, {"height", height}}, friction > 0.5 && height > 0.5};
  });
  ASSERT_EQ(dut.pairs.size(), 1u);
  const PairDependence& pair = dut.pairs[0];
  ASSERT_EQ(pair.x_bins.size(), 6u);
  ASSERT_EQ(pair.y_bins.size(), 6u);
  ASSERT_EQ(pair.cells.size(), 36u);
  int n = 0;
  for (const PairCell& cell : pair.cells) {
    n += cell.rate.n;
    const bool high = pair.x_bins[cell.x].low > 0.5 && pair.y_bins[cell.y].low > 0.5;
    const bool low = pair.x_bins[cell.x].high < 0.5 || pair.y_bins[cell.y].high < 0.5;
    EXPECT_TRUE(!high || cell.rate.k == cell.rate.n);
    EXPECT_TRUE(!low || cell.rate.k == 0);
  }
  EXPECT_EQ(n, 720);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Two variants' rows, joined by episode and compared.
#include "run/campaign/campaign_comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "tests/own_folder.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

EpisodeRow Row(const std::string& variant, std::uint64_t episode, bool fails) {
  EpisodeRow row;
  row.variant = variant;
  row.episode = episode;
  row.outcome = fails ? "failure" : "success";
  row.events_of[static_cast<std::size_t>(FailureMode::kStuck)] = fails;
  row.metrics.fill(0.0);
  row.metrics[MetricIndex(&Metrics::coverage)] = fails ? 1 : 0;
  row.metrics[MetricIndex(&Metrics::duration_s)] = variant == "a" ? 10 : 12;
  row.drawn = R"({"site.floor.friction": 0.5})";
  return row;
}

class CompareVariantsTest : public OwnFolderTest {
 protected:
  void Add(const std::vector<EpisodeRow>& rows) { store_.Add(rows); }
  Comparison Compare() const { return CompareVariants(store_, "a", store_, "b"); }
  static const ComparedMetric* Find(const Comparison& comparison, std::string_view metric) {
    for (const ComparedMetric& compared : comparison.metrics)
      if (compared.metric == metric) return &compared;
    return nullptr;
  }

  CampaignStore store_ =
      CampaignStore::Create(folder_ / "campaign.sqlite", {"id", "seed: 1\n", "{}"});
};

TEST_F(CompareVariantsTest, EpisodesAreJoinedByTheirIds) {
  for (const auto& [episode, fails] :
       {std::pair(0, true), {1, true}, {3, false}, {4, false}, {7, true}})
    Add({Row("a", static_cast<std::uint64_t>(episode), fails)});
  for (const auto& [episode, fails] :
       {std::pair(1, true), {2, true}, {3, true}, {4, false}, {7, false}, {9, true}})
    Add({Row("b", static_cast<std::uint64_t>(episode), fails)});
  const Comparison dut = Compare();
  EXPECT_EQ(dut.n, 4);
  EXPECT_EQ(dut.only_a, 1) << "0";
  EXPECT_EQ(dut.only_b, 2) << "2 and 9";
  for (const ComparedFailure& failure : dut.failures) {
    const bool happened =
        failure.mode == "any_failure" || failure.mode == "stuck" || failure.mode == "not_success";
    EXPECT_EQ(failure.both, happened) << failure.mode;
    EXPECT_EQ(failure.only_a, happened) << failure.mode;
    EXPECT_EQ(failure.only_b, happened) << failure.mode;
    EXPECT_EQ(failure.neither, happened ? 1 : 4) << failure.mode;
    EXPECT_EQ(failure.difference, 0);
    EXPECT_EQ(failure.p, McNemarExact(failure.only_a, failure.only_b));
  }
  // b - a of the four: 0, 1, 0, -1.
  const double differences[] = {0, 1, 0, -1};
  const ComparedMetric* coverage = Find(dut, "coverage");
  ASSERT_NE(coverage, nullptr);
  EXPECT_EQ(coverage->mean.n, 4);
  EXPECT_EQ(coverage->mean.estimate, 0);
  EXPECT_EQ(coverage->mean.interval.upper, MeanDifference(differences, 0.95).interval.upper);
  EXPECT_EQ(coverage->median.estimate, 0);
}

TEST_F(CompareVariantsTest, DifferencesAreOfTheSecondAgainstTheFirst) {
  for (std::uint64_t episode = 0; episode < 20; ++episode)
    Add({Row("a", episode, false), Row("b", episode, episode < 8)});
  const Comparison dut = Compare();
  EXPECT_EQ(dut.failures.front().only_b, 8);
  EXPECT_DOUBLE_EQ(dut.failures.front().difference, 0.4);
  EXPECT_GT(dut.failures.front().interval.lower, 0);
  EXPECT_NEAR(dut.failures.front().p, 2.0 / 256, 1e-15);
  EXPECT_DOUBLE_EQ(Find(dut, "coverage")->mean.estimate, 0.4);
}

// A drive that ran out of time has failed by no mode, and has not succeeded.
TEST_F(CompareVariantsTest, TimeoutsAreNoSuccess) {
  for (std::uint64_t episode = 0; episode < 10; ++episode) {
    EpisodeRow late = Row("a", episode, false);
    late.outcome = episode < 6 ? "timeout" : "success";
    Add({late, Row("b", episode, false)});
  }
  const Comparison dut = Compare();
  EXPECT_EQ(dut.failures.front().only_a, 0);
  EXPECT_EQ(dut.failures.back().mode, "not_success");
  EXPECT_EQ(dut.failures.back().only_a, 6);
  EXPECT_DOUBLE_EQ(dut.failures.back().difference, -0.6);
}

// What failed early has driven for less time: no merit of its own.
TEST_F(CompareVariantsTest, WhatAFailureCutsShortIsComparedWhereBothSucceed) {
  for (std::uint64_t episode = 0; episode < 5; ++episode)
    Add({Row("a", episode, false), Row("b", episode, episode < 2)});
  const Comparison dut = Compare();
  EXPECT_FALSE(Find(dut, "coverage")->successes_only);
  EXPECT_EQ(Find(dut, "coverage")->mean.n, 5);
  EXPECT_TRUE(Find(dut, "duration_s")->successes_only);
  EXPECT_EQ(Find(dut, "duration_s")->mean.n, 3);
  EXPECT_DOUBLE_EQ(Find(dut, "duration_s")->mean.estimate, 2);
}

TEST_F(CompareVariantsTest, WhatDoesNotCountHasNoPair) {
  EpisodeRow error = Row("b", 0, false), no_plan = Row("b", 1, false);
  error.outcome = "error";
  no_plan.outcome = "not_planned";
  Add({Row("a", 0, false), Row("a", 1, false), Row("a", 2, false), error, no_plan,
       Row("b", 2, false)});
  const Comparison dut = Compare();
  EXPECT_EQ(dut.n, 1);
  EXPECT_EQ(dut.only_a, 2);
  EXPECT_EQ(dut.only_b, 0);
  const ComparedFailure& not_success = dut.failures.back();
  EXPECT_EQ(not_success.only_b, 1) << "there was no plan";
  EXPECT_EQ(not_success.neither, 1);
  EXPECT_EQ(dut.failures.front().neither, 1) << "nobody failed who did not drive";
}

TEST_F(CompareVariantsTest, EqualPairsAreOnePairWhateverHadNoPlan) {
  for (std::uint64_t episode = 0; episode < 20; ++episode) {
    EpisodeRow b = Row("b", episode, true);
    if (episode == 19) b.outcome = "not_planned";
    Add({Row("a", episode, false), b});
  }
  const Comparison dut = Compare();
  EXPECT_EQ(dut.n, 1);
  EXPECT_EQ(dut.repeats, 19);
  EXPECT_EQ(dut.failures.front().only_b, 1);
}

TEST_F(CompareVariantsTest, PairsThatAreEqualAreOnePair) {
  for (std::uint64_t episode = 0; episode < 20; ++episode)
    Add({Row("a", episode, false), Row("b", episode, true)});
  const Comparison dut = Compare();
  EXPECT_EQ(dut.n, 1);
  EXPECT_EQ(dut.repeats, 20);
  EXPECT_EQ(dut.failures.front().only_b, 1);
  EXPECT_EQ(dut.failures.front().p, 1) << "one pair shows nothing";
  EXPECT_LE(dut.failures.front().interval.lower, 0);
}

TEST_F(CompareVariantsTest, APairThatDiffersMakesAllCount) {
  for (std::uint64_t episode = 0; episode < 20; ++episode)
    Add({Row("a", episode, false), Row("b", episode, episode > 0)});
  const Comparison dut = Compare();
  EXPECT_EQ(dut.n, 20);
  EXPECT_EQ(dut.repeats, 0);
  EXPECT_LT(dut.failures.front().p, 1e-4);
}

// Ninety degrees' cosine is 6e-17, not 0: no figure is a share of that.
TEST_F(CompareVariantsTest, NothingIsDividedByRounding) {
  const auto plan = [](double overlap, double length_m) {
    return "{\"overlap\": " + std::to_string(overlap) +
           "e-16, \"length_m\": " + std::to_string(length_m) + "}";
  };
  for (std::uint64_t episode = 0; episode < 4; ++episode) {
    EpisodeRow a = Row("a", episode, false), b = Row("b", episode, false);
    a.plan = plan(1 + static_cast<double>(episode), 10);
    b.plan = plan(7, 11 + static_cast<double>(episode));
    Add({a, b});
  }
  const Comparison dut = Compare();
  const auto figure = [&](const std::string& name) {
    return *std::ranges::find(dut.plans, name, &ComparedPlanFigure::figure);
  };
  EXPECT_FALSE(figure("overlap").change);
  EXPECT_EQ(figure("overlap").same, 4);
  ASSERT_TRUE(figure("length_m").change);
  EXPECT_NEAR(figure("length_m").change->median, 0.25, 1e-12);
}

TEST_F(CompareVariantsTest, OtherDrawsAreRefused) {
  EpisodeRow other = Row("b", 3, false);
  other.drawn = R"({"site.floor.friction": 0.6, "seat": [1, 2]})";
  Add({Row("a", 3, false), other});
  try {
    Compare();
    ADD_FAILURE() << "accepted";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(),
                 "episode = 3: drew site.floor.friction 0.5 in a and 0.6 in b, seat in b alone: a "
                 "paired comparison needs the same draws, of the same `seed` and the same "
                 "`randomise`");
  }
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Known truths: hand-counted distributions, silence without an influence, each shape found.
#include "stats/influence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/streams.h"
#include "tests/stats/distributions.h"

namespace floorproof {
namespace {

using Groups = std::vector<GroupCounts>;

TEST(Influence, OfTwoGroupsItIsFishersTest) {
  // 3 of 10 and 9 of 10: P(3 or fewer of the 12 in the first) = 0.0099 by the hypergeometric law.
  double tail = 0;
  for (int i = 2; i <= 3; ++i)
    tail += std::exp(std::lgamma(11) - std::lgamma(i + 1.0) - std::lgamma(11.0 - i) +
                     std::lgamma(11) - std::lgamma(13.0 - i) - std::lgamma(i - 1.0) -
                     (std::lgamma(21) - std::lgamma(13) - std::lgamma(9)));
  const Groups groups = {{10, 3}, {10, 9}};
  const OrderedInfluence ordered = TestOrdered(groups);
  EXPECT_NEAR(ordered.p, 2 * tail, 1e-12);
  EXPECT_EQ(ordered.shape, InfluenceShape::kHigher);
  const ChoiceInfluence choice = TestChoices(groups);
  EXPECT_NEAR(choice.p, 2 * tail, 1e-12);
  EXPECT_EQ(choice.choice, 1u);
  EXPECT_GT(choice.z, 0);
  EXPECT_EQ(TestChoices(Groups{{10, 9}, {10, 3}}).choice, 0u);
}

TEST(Influence, ATrendIsCountedOut) {
  // Two failures among six episodes in three groups of two, both in the last: one of 15 ways for a
  // sum of 4; two tests, two sides.
  const OrderedInfluence dut = TestOrdered(Groups{{2, 0}, {2, 0}, {2, 2}});
  EXPECT_NEAR(dut.p, 2 * 2 / 15.0, 1e-12);
  EXPECT_EQ(dut.shape, InfluenceShape::kHigher);
}

TEST(Influence, FindsEachShape) {
  EXPECT_EQ(TestOrdered(Groups{{50, 9}, {50, 4}, {50, 2}, {50, 0}}).shape, InfluenceShape::kLower);
  EXPECT_EQ(TestOrdered(Groups{{50, 0}, {50, 2}, {50, 4}, {50, 9}}).shape, InfluenceShape::kHigher);
  const OrderedInfluence ends = TestOrdered(Groups{{50, 9}, {50, 1}, {50, 0}, {50, 8}});
  EXPECT_EQ(ends.shape, InfluenceShape::kEnds);
  EXPECT_LT(ends.p, 0.001) << "no trend sees it";
  EXPECT_EQ(TestOrdered(Groups{{50, 0}, {50, 8}, {50, 9}, {50, 1}}).shape, InfluenceShape::kMiddle);
}

TEST(Influence, AChoiceThatStandsOutIsNamed) {
  const ChoiceInfluence more = TestChoices(Groups{{40, 2}, {40, 1}, {40, 17}, {40, 2}});
  EXPECT_EQ(more.choice, 2u);
  EXPECT_GT(more.z, 0);
  EXPECT_LT(more.p, 1e-4);
  const ChoiceInfluence less = TestChoices(Groups{{40, 12}, {40, 0}, {40, 13}});
  EXPECT_EQ(less.choice, 1u);
  EXPECT_LT(less.z, 0);
}

TEST(Influence, SaysNothingWhereNothingCanBeSaid) {
  for (const Groups& groups : {Groups{}, Groups{{10, 3}}, Groups{{10, 0}, {10, 0}, {5, 0}},
                               Groups{{10, 10}, {5, 5}}, Groups{{0, 0}, {8, 3}}}) {
    EXPECT_EQ(TestOrdered(groups).p, 1);
    EXPECT_EQ(TestChoices(groups).p, 1);
  }
  EXPECT_EQ(TestOrdered(Groups{{10, 2}, {10, 2}}).p, 1);
  EXPECT_THROW(TestOrdered(Groups{{10, 2}, {3, 4}}), InputError);
  EXPECT_THROW(TestChoices(Groups{{10, 2}, {3, 4}}), InputError);
}

TEST(Influence, WhoPassedIsTheSameQuestionAsWhoFailed) {
  const Groups failed = {{30, 1}, {30, 3}, {30, 8}};
  Groups passed = failed;
  for (GroupCounts& group : passed) group.k = group.n - group.k;
  EXPECT_NEAR(TestOrdered(failed).p, TestOrdered(passed).p, 1e-12);
  EXPECT_EQ(TestOrdered(passed).shape, InfluenceShape::kLower);
}

TEST(Influence, CountedOutAndNormalAgreeWhereTheyMeet) {
  // 104 failures of four groups are counted out, 105 are not; p moves as one failure moves it.
  const double counted = TestOrdered(Groups{{400, 20}, {400, 23}, {400, 28}, {400, 33}}).p;
  const double normal = TestOrdered(Groups{{400, 20}, {400, 23}, {400, 28}, {400, 34}}).p;
  EXPECT_LT(normal, counted);
  EXPECT_GT(normal, 0.6 * counted);
  EXPECT_NEAR(counted, 0.07, 0.05);
}

// One failure among ten rare episodes of a hundred thousand, where a thousand fail, is no wonder:
// with chance 0.1 there is one or more. The normal law would have it be ten deviations off.
TEST(Influence, ARareGroupIsNotTakenForNormal) {
  const Groups rare = {{99'990, 999}, {6, 0}, {4, 1}};
  EXPECT_GT(TestOrdered(rare).p, 0.03);
  EXPECT_GT(TestChoices(rare).p, 0.03);
  EXPECT_LT(TestOrdered(Groups{{99'990, 999}, {6, 5}, {4, 4}}).p, 0.01);
  EXPECT_LT(TestChoices(Groups{{99'990, 999}, {6, 5}, {4, 4}}).p, 1e-6);
}

struct Rates {
  double ordered = 0, choices = 0;
};
// How often p <= 0.05 without an influence.
Rates FalseAlarms(int groups, int n, double p) {
  constexpr int kTrials = 2000;
  Stream stream(7, static_cast<std::uint64_t>(n), "influence");
  Rates rates;
  for (int trial = 0; trial < kTrials; ++trial) {
    Groups counts;
    for (int i = 0; i < groups; ++i) counts.push_back({n, DrawBinomial(stream, n, p)});
    rates.ordered += (TestOrdered(counts).p <= 0.05) / double{kTrials};
    rates.choices += (TestChoices(counts).p <= 0.05) / double{kTrials};
  }
  return rates;
}

TEST(Influence, WithoutOneAnAlarmIsAsRareAsItsLevel) {
  // Three standard deviations of 2000 trials above 5 %: 6.5 %.
  for (const Rates& rates :
       {FalseAlarms(8, 10, 0.02), FalseAlarms(8, 10, 0.4), FalseAlarms(5, 40, 0.15)}) {
    EXPECT_LE(rates.ordered, 0.065);
    EXPECT_LE(rates.choices, 0.065);
  }
  EXPECT_GE(FalseAlarms(5, 40, 0.15).ordered, 0.02) << "it is not silent either";
}

TEST(Influence, OfAHundredThousandEpisodesItIsFinite) {
  const OrderedInfluence dut = TestOrdered(Groups{{50'000, 10}, {50'000, 40'000}});
  EXPECT_EQ(dut.p, 0) << "beneath the least number";
  EXPECT_GT(dut.z, 100);
  const OrderedInfluence few = TestOrdered(Groups{{50'000'000, 0}, {50'000'000, 20}});
  EXPECT_NEAR(few.p, 2 * std::pow(0.5, 20), 1e-9);
}

}  // namespace
}  // namespace floorproof

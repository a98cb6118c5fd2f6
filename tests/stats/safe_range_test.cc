// SPDX-License-Identifier: Apache-2.0
// What is claimed is true, by simulation with curves of failure that are known; and claims are
// made where they can be.
#include "stats/safe_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "base/error.h"
#include "base/streams.h"
#include "stats/binomial.h"
#include "stats/sequential_gate.h"

namespace floorproof {
namespace {

using Outcomes = std::vector<DrawnOutcome>;
using Curve = std::function<double(double)>;  // chance of a failure at a value

// Values 0, 1, .. n - 1, of which those fail.
Outcomes Ranks(
    int n, const std::function<bool(int)>& fails = [](int) { return false; }) {
  Outcomes outcomes;
  for (int i = 0; i < n; ++i) outcomes.push_back({double(i), fails(i)});
  return outcomes;
}

TEST(SafeRange, WithoutAFailureTheWholeIsSafeFromTheGatesNumberOn) {
  EXPECT_EQ(FindSafeRange(Ranks(58), {}).answer, SafeAnswer::kTooFew);
  EXPECT_EQ(FindSafeRange(Ranks(58), {}).needed, 59);
  for (const int n : {59, 60, 72, 73, 100, 1000})
    EXPECT_EQ(FindSafeRange(Ranks(n), {}).answer, SafeAnswer::kWhole) << n;
  EXPECT_EQ(FindSafeRange({}, {}).answer, SafeAnswer::kTooFew);
  EXPECT_EQ(FindSafeRange(Ranks(298), {.max_rate = 0.01}).needed, 299);
}

TEST(SafeRange, EndsBeforeTheFailures) {
  const SafeRange dut = FindSafeRange(Ranks(1000, [](int i) { return i >= 600; }), {});
  ASSERT_EQ(dut.answer, SafeAnswer::kPart);
  ASSERT_TRUE(dut.up_to);
  EXPECT_FALSE(dut.from);
  EXPECT_GE(dut.up_to->edge, 599);
  EXPECT_LE(dut.up_to->edge, 632) << "the mean up to there is below 5 %";
  EXPECT_LT(ClopperPearsonUpper(dut.up_to->k, dut.up_to->n, 0.975), 0.05);
  ASSERT_TRUE(dut.each_up_to);
  EXPECT_EQ(dut.each_up_to->edge, 499) << "the part from 500 to 624 holds failures: eighths";
}

TEST(SafeRange, EndsMirrored) {
  const Outcomes low = Ranks(700, [](int i) { return i > 400 && i % 3 == 0; });
  Outcomes high(low.rbegin(), low.rend());
  for (DrawnOutcome& outcome : high) outcome.value = -outcome.value;
  const SafeRange a = FindSafeRange(low, {}), b = FindSafeRange(high, {});
  ASSERT_TRUE(a.up_to && b.from && a.each_up_to && b.each_from);
  EXPECT_EQ(a.up_to->edge, -b.from->edge);
  EXPECT_EQ(a.up_to->k, b.from->k);
  EXPECT_EQ(a.first_low.n, b.first_high.n);
  EXPECT_FALSE(b.up_to || b.each_up_to);
}

TEST(SafeRange, StopsAtTheFirstThatDoesNotPass) {
  // Failures at the very beginning: the first set does not pass, though many a longer one would.
  const SafeRange dut = FindSafeRange(Ranks(2000, [](int i) { return i < 20; }), {});
  EXPECT_FALSE(dut.up_to);
  EXPECT_EQ(dut.first_low.n, 216) << "three times the fewest that pass at 97.5 %";
  EXPECT_EQ(dut.first_low.k, 20);
  EXPECT_EQ(dut.answer, SafeAnswer::kWhole) << "shown from the other end";
}

TEST(SafeRange, NamesNoLaterSetBehindOneThatDidNotPass) {
  const auto fails = [](int i) { return i < 20 || i >= 1500; };
  const SafeRange dut = FindSafeRange(Ranks(2000, fails), {});
  EXPECT_LT(ClopperPearsonUpper(20, 1000, 0.975), 0.05) << "the lowest thousand would pass";
  EXPECT_EQ(dut.answer, SafeAnswer::kNotShown);
  EXPECT_FALSE(dut.up_to);
}

TEST(SafeRange, EachEndHasHalfOfTheErrorAllowed) {
  // One of a hundred passes at 95 %, not at 97.5 %.
  ASSERT_LT(ClopperPearsonUpper(1, 100, 0.95), 0.05);
  ASSERT_GT(ClopperPearsonUpper(1, 100, 0.975), 0.05);
  EXPECT_FALSE(FindSafeRange(Ranks(500, [](int i) { return i == 9 || i >= 250; }), {}).up_to);
  EXPECT_FALSE(FindSafeRange(Ranks(500, [](int i) { return i == 490 || i < 250; }), {}).from);
  EXPECT_TRUE(FindSafeRange(Ranks(500, [](int i) { return i >= 250; }), {}).up_to);
}

TEST(SafeRange, TheWholeIsTestedWithWhatTheEndsHandOn) {
  // Twenty of 600 pass at 95 %, not at 97.5 %.
  ASSERT_LT(ClopperPearsonUpper(20, 600, 0.95), 0.05);
  ASSERT_GT(ClopperPearsonUpper(20, 600, 0.975), 0.05);
  const auto low = [](int i) { return i < 20; };
  const auto both = [](int i) { return i < 10 || i >= 590; };
  EXPECT_EQ(FindSafeRange(Ranks(600, low), {}).answer, SafeAnswer::kPart) << "from one end";
  EXPECT_EQ(FindSafeRange(Ranks(600, both), {}).answer, SafeAnswer::kNotShown) << "from none";
  EXPECT_EQ(FindSafeRange(Ranks(60), {}).answer, SafeAnswer::kWhole)
      << "from both, which are empty";
}

TEST(SafeRange, OfASequentialGateItHoldsTheEvidenceToThatOfTheGate) {
  int told_apart = 0;
  for (int every = 30; every <= 150; every += 5) {  // a failure in so many, and above 450 all
    const auto fails = [every](int i) { return i % every == every / 2 || i > 450; };
    const SafeRange dut = FindSafeRange(Ranks(600, fails), {.anytime = true});
    const SafeRange fixed = FindSafeRange(Ranks(600, fails), {});
    if (dut.up_to) {
      EXPECT_EQ(JudgeSequentially(dut.up_to->k, dut.up_to->n, 0.05, 0.975),
                SequentialOutcome::kPass);
    }
    told_apart += fixed.up_to && !dut.up_to;
  }
  EXPECT_GT(told_apart, 0);
}

TEST(SafeRange, SaysWhereNothingIsShown) {
  const SafeRange dut = FindSafeRange(Ranks(500, [](int i) { return i % 4 == 0; }), {});
  EXPECT_EQ(dut.answer, SafeAnswer::kNotShown);
  EXPECT_EQ(dut.whole.k, 125);
  EXPECT_EQ(dut.first_low.n, 100) << "a fifth of all";
  EXPECT_EQ(FindSafeRange(Ranks(200), {}).first_low.n, 72) << "the fewest that pass";
}

TEST(SafeRange, AFewDistinctValuesAreNotParted) {
  Outcomes outcomes;
  for (const int value : {1, 2, 3})
    for (int i = 0; i < 200; ++i) outcomes.push_back({double(value), value == 3 && i < 100});
  const SafeRange dut = FindSafeRange(outcomes, {});
  ASSERT_TRUE(dut.up_to && dut.each_up_to);
  EXPECT_EQ(dut.up_to->edge, 2);
  EXPECT_EQ(dut.up_to->n, 400);
  EXPECT_EQ(dut.each_up_to->edge, 2);
  EXPECT_EQ(dut.each_up_to->n, 200);
  const SafeRange one = FindSafeRange(Outcomes(100, {7, false}), {});
  EXPECT_EQ(one.answer, SafeAnswer::kWhole);
  EXPECT_FALSE(one.each_up_to);
}

TEST(SafeRange, RefusesWhatIsNoGate) {
  EXPECT_THROW(FindSafeRange({}, {.max_rate = 0}), InputError);
  EXPECT_THROW(FindSafeRange({}, {.confidence = 1}), InputError);
}

// Draws n outcomes of values uniform in [0, 1), or of ten values.
Outcomes DrawOutcomes(const Curve& curve, int n, bool ties, Stream& stream) {
  Outcomes outcomes;
  for (int i = 0; i < n; ++i) {
    const double value =
        ties ? (static_cast<double>(stream.Below(10)) + 0.5) / 10 : stream.Uniform();
    outcomes.push_back({value, stream.Uniform() < curve(value)});
  }
  std::ranges::sort(outcomes, {}, &DrawnOutcome::value);
  return outcomes;
}

struct Claims {
  int trials = 0, made = 0, false_sets = 0, false_parts = 0;
};

// The mean of the curve over the values within, as they were driven.
double MeanOf(const Curve& curve, const Outcomes& outcomes, double low, double high) {
  double sum = 0;
  int n = 0;
  for (const DrawnOutcome& outcome : outcomes)
    if (outcome.value >= low && outcome.value <= high) sum += curve(outcome.value), ++n;
  return n > 0 ? sum / n : 0;
}

constexpr double kLimit = 0.05;
// Nowhere below the limit, and hardly above: the hardest truth.
double Flat(double) { return kLimit * (1 + 1e-9); }

// Whether any stretch that is claimed has a mean that is not below the limit.
bool ClaimsAFalseSet(const SafeRange& found, const Curve& curve, const Outcomes& outcomes) {
  const auto wrong = [&](double low, double high) {
    return MeanOf(curve, outcomes, low, high) >= kLimit;
  };
  return (found.answer == SafeAnswer::kWhole && wrong(-1, 2)) ||
         (found.up_to && wrong(-1, found.up_to->edge)) ||
         (found.from && wrong(found.from->edge, 2));
}

// By the parts' own counts: the last part that is claimed is the likeliest to be false.
bool ClaimsAFalsePart(const SafeRange& found, const Curve& curve, const Outcomes& outcomes) {
  if (found.each_up_to) {
    const auto end =
        std::ranges::upper_bound(outcomes, found.each_up_to->edge, {}, &DrawnOutcome::value);
    const double low = (end - found.each_up_to->n)->value;
    if (MeanOf(curve, outcomes, low, found.each_up_to->edge) >= kLimit) return true;
  }
  if (found.each_from) {
    const auto begin =
        std::ranges::lower_bound(outcomes, found.each_from->edge, {}, &DrawnOutcome::value);
    const double high = (begin + (found.each_from->n - 1))->value;
    if (MeanOf(curve, outcomes, found.each_from->edge, high) >= kLimit) return true;
  }
  return false;
}

Claims Simulate(const Curve& curve, int n, int trials, bool ties = false) {
  Claims claims{trials};
  for (int trial = 0; trial < trials; ++trial) {
    Stream stream(17, static_cast<std::uint64_t>(trial), "safe range");
    const Outcomes outcomes = DrawOutcomes(curve, n, ties, stream);
    const SafeRange found = FindSafeRange(outcomes, {.max_rate = kLimit});
    claims.made += found.answer == SafeAnswer::kPart || found.answer == SafeAnswer::kWhole;
    claims.false_sets += ClaimsAFalseSet(found, curve, outcomes);
    claims.false_parts += ClaimsAFalsePart(found, curve, outcomes);
  }
  return claims;
}

// Observed no more often than chance allows where the truth is 5 %.
bool WithinLevel(int k, int trials) { return ClopperPearsonLower(k, trials, 0.999) <= 0.05; }

TEST(SafeRange, FalseClaimsAreAsRareAsTheConfidenceSays) {
  const Curve ramp = [](double x) { return 0.2 * x; };  // the mean is at 5 % at 0.5
  const Curve step = [](double x) { return x < 0.3 ? 0.0 : 0.25; };
  const Curve bump = [](double x) { return x < 0.2 ? 0.12 : 0.001; };
  const Curve ends = [](double x) { return std::abs(x - 0.5) > 0.4 ? 0.2 : 0.02; };
  for (const int n : {65, 150, 600})
    for (const Curve& curve : {Curve(Flat), ramp, step, bump, ends})
      for (const bool ties : {false, true}) {
        const Claims claims = Simulate(curve, n, 100, ties);
        EXPECT_TRUE(WithinLevel(claims.false_sets, claims.trials)) << claims.false_sets << " " << n;
        EXPECT_TRUE(WithinLevel(claims.false_parts, claims.trials)) << claims.false_parts;
      }
  const Claims claims = Simulate(Flat, 200, 1000);
  EXPECT_TRUE(WithinLevel(claims.false_sets, claims.trials)) << claims.false_sets;
  EXPECT_GT(claims.false_sets, 25) << "the simulation is as hard as can be";
}

// What the sequence guards against: the last set that passes, whatever was before it.
bool NamesTheLastThatPasses(const Outcomes& outcomes, const Curve& curve) {
  int k = 0;
  double edge = -1;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    k += outcomes[i].failed;
    const auto n = static_cast<int>(i) + 1;
    if (n >= 59 && (n % 10 == 0 || i + 1 == outcomes.size()) &&
        ClopperPearsonUpper(k, n, 0.95) < kLimit)
      edge = outcomes[i].value;
  }
  return edge >= 0 && MeanOf(curve, outcomes, -1, edge) >= kLimit;
}

TEST(SafeRange, TheSimulationTellsWhoDoesNotStop) {
  int wrong = 0;
  for (std::uint64_t trial = 0; trial < 500; ++trial) {
    Stream stream(17, trial, "safe range");
    wrong += NamesTheLastThatPasses(DrawOutcomes(Flat, 300, false, stream), Flat);
  }
  EXPECT_FALSE(WithinLevel(wrong, 500)) << wrong;
}

TEST(SafeRange, ARobotThatFailsNowAndThenIsStillShownSafe) {
  const Curve good = [](double x) { return x < 0.6 ? 0.01 : 0.5; };
  const Claims claims = Simulate(good, 2000, 100);
  EXPECT_GE(claims.made, 80);
}

// A campaign that ends as soon as a sequential gate passes has few failures because it ended.
TEST(SafeRange, HoldsWhereASequentialGateEndedTheEpisodes) {
  constexpr int kTrials = 200;
  int by_anytime = 0, by_fixed = 0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Stream stream(19, trial, "safe range");
    Outcomes outcomes;
    int k = 0;
    for (int n = 1; n <= 400; ++n) {
      outcomes.push_back({stream.Uniform(), stream.Uniform() < Flat(0)});
      k += outcomes.back().failed;
      if (JudgeSequentially(k, n, kLimit, 0.95) == SequentialOutcome::kPass) break;
    }
    std::ranges::sort(outcomes, {}, &DrawnOutcome::value);
    const auto claimed = [&](bool anytime) {
      const SafeAnswer answer =
          FindSafeRange(outcomes, {.max_rate = kLimit, .anytime = anytime}).answer;
      return answer == SafeAnswer::kPart || answer == SafeAnswer::kWhole;
    };
    by_anytime += claimed(true);
    by_fixed += claimed(false);
  }
  EXPECT_TRUE(WithinLevel(by_anytime, kTrials)) << by_anytime;
  EXPECT_GT(by_fixed, by_anytime) << "a bound for a fixed number claims more than it may";
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "stats/gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/error.h"
#include "base/streams.h"
#include "stats/binomial.h"
#include "stats/sequential_gate.h"
#include "tests/stats/distributions.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

GateSettings Fixed(double max_rate, int n) { return {GateMode::kFixed, max_rate, 0.95, 1, n}; }
GateSettings Sequential(double max_rate, int min_n, int max_n) {
  return {GateMode::kSequential, max_rate, 0.95, min_n, max_n};
}

std::vector<std::uint8_t> Outcomes(int n, std::initializer_list<int> failures) {
  std::vector<std::uint8_t> outcomes(static_cast<std::size_t>(n), 0);
  for (const int i : failures) outcomes[static_cast<std::size_t>(i)] = 1;
  return outcomes;
}

GateReport Judge(const GateSettings& settings, const std::vector<std::uint8_t>& outcomes) {
  Gate gate(settings);
  for (const std::uint8_t outcome : outcomes) gate.Add(outcome != 0);
  return gate.Report();
}

TEST(FixedGate, FiftyNineCleanEpisodesShowLessThanFivePercent) {
  const GateReport report = Judge(Fixed(0.05, 59), Outcomes(59, {}));
  EXPECT_EQ(report.verdict, GateVerdict::kPassed);
  EXPECT_TRUE(report.final);
  EXPECT_EQ(report.n, 59);
  EXPECT_EQ(report.k, 0);
  EXPECT_NEAR(report.rate.upper, 1 - std::pow(0.05, 1.0 / 59), 1e-12);
  EXPECT_EQ(report.text,
            "0 of 59 episodes; with 95 % confidence the rate is below 5 % (at most 4.951 %)");
}

TEST(FixedGate, OneEpisodeIsSaidInTheSingular) {
  EXPECT_THAT(Judge(Fixed(0.96, 1), Outcomes(1, {0})).text,
              StartsWith("1 of 1 episode; with 95 % confidence"));
  EXPECT_EQ(Judge(Sequential(0.05, 1, 400), Outcomes(1, {})).text,
            "0 of the first 1 episode; goes on to at most 400");
}

TEST(FixedGate, IsNotDecidedByPeeking) {
  Gate gate(Fixed(0.05, 200));
  for (int n = 1; n < 200; ++n) {
    gate.Add(false);
    // 59 clean ones would do if they were all. Up to 4 of 200 may fail, so that the last 4 are
    // free.
    EXPECT_EQ(gate.final(), n >= 196) << n;
  }
  EXPECT_EQ(gate.Report().n, 196);
  EXPECT_THAT(gate.Report().text, HasSubstr("whatever the rest brings"));
}

TEST(FixedGate, OneFailureInFiftyNineLeavesItUndecidedAtOnce) {
  const GateReport report = Judge(Fixed(0.05, 59), Outcomes(59, {54}));
  EXPECT_EQ(report.verdict, GateVerdict::kUndecided);
  EXPECT_TRUE(report.final);
  EXPECT_EQ(report.n, 55);  // with one failure it cannot pass, with five it would not yet fail
  EXPECT_EQ(Judge(Fixed(0.05, 59), Outcomes(54, {})).final, false);
}

// Where some of the planned episodes do not count, it is judged at those that do.
TEST(FixedGate, IsJudgedAtWhatThereIs) {
  Gate gate(Fixed(0.05, 90));
  for (int n = 0; n < 70; ++n) gate.Add(false);
  EXPECT_FALSE(gate.final());
  gate.End();
  EXPECT_TRUE(gate.final());
  EXPECT_EQ(gate.verdict(), GateVerdict::kPassed);
  EXPECT_NEAR(gate.Report().rate.upper, 1 - std::pow(0.05, 1.0 / 70), 1e-12);
  Gate few(Fixed(0.05, 90));
  for (int n = 0; n < 58; ++n) few.Add(false);
  few.End();
  EXPECT_EQ(few.verdict(), GateVerdict::kUndecided) << "59 are needed";
  EXPECT_TRUE(few.final());
}

TEST(FixedGate, FailsAsSoonAsEnoughHaveFailed) {
  std::vector<std::uint8_t> all(59, 1);
  const GateReport report = Judge(Fixed(0.05, 59), all);
  EXPECT_EQ(report.verdict, GateVerdict::kFailed);
  EXPECT_GT(ClopperPearsonLower(report.k, 59, 0.95), 0.05);
  EXPECT_LE(ClopperPearsonLower(report.k - 1, 59, 0.95), 0.05);
  EXPECT_EQ(report.n, report.k);
  EXPECT_THAT(report.text, HasSubstr("above 5 %"));
}

// Stopping early gives the verdict that all the episodes would have given, which is that of the
// one-sided bounds.
TEST(FixedGate, StoppingEarlyChangesNoVerdict) {
  constexpr int kN = 150;
  int seen[3] = {0, 0, 0}, early = 0;
  for (std::uint64_t c = 0; c < 300; ++c) {
    Stream stream(21, c, "fixed gate");
    const double p = stream.Uniform(0, 0.15);
    Gate gate(Fixed(0.05, kN));
    int k = 0;
    for (int i = 0; i < kN; ++i) {
      const bool failure = stream.Uniform() < p;
      k += failure;
      gate.Add(failure);
    }
    const GateVerdict expected = ClopperPearsonUpper(k, kN, 0.95) < 0.05 ? GateVerdict::kPassed
                                 : ClopperPearsonLower(k, kN, 0.95) > 0.05
                                     ? GateVerdict::kFailed
                                     : GateVerdict::kUndecided;
    const GateReport report = gate.Report();
    EXPECT_EQ(report.verdict, expected);
    EXPECT_TRUE(report.final);
    EXPECT_EQ(report.rate.upper < 0.05, expected == GateVerdict::kPassed);
    EXPECT_EQ(report.rate.lower > 0.05, expected == GateVerdict::kFailed);
    ++seen[static_cast<int>(expected)];
    early += report.n < kN;
  }
  for (const int count : seen) EXPECT_GT(count, 10);
  EXPECT_GT(early, 100);
}

// At p = max_rate each claim is wrong; the chance of either is summed over every outcome.
TEST(FixedGate, ErrsNoMoreOftenThanItSays) {
  for (const auto& [p0, n] : {std::pair{0.05, 59}, {0.05, 200}, {0.01, 299}, {0.01, 1000}}) {
    double passed = 0, failed = 0;
    for (int k = 0; k <= n; ++k) {
      std::vector<std::uint8_t> outcomes(static_cast<std::size_t>(n), 0);
      std::fill_n(outcomes.begin(), k, std::uint8_t{1});
      const GateVerdict verdict = Judge(Fixed(p0, n), outcomes).verdict;
      if (verdict == GateVerdict::kPassed) passed += BinomialPmf(k, n, p0);
      if (verdict == GateVerdict::kFailed) failed += BinomialPmf(k, n, p0);
    }
    EXPECT_LE(passed, 0.05);
    EXPECT_LE(failed, 0.05);
    EXPECT_GT(passed, 0.005);
    EXPECT_GT(failed, 0.005);
  }
}

TEST(SequentialGate, PassesAtTheFirstEpisodeThatAllowsIt) {
  const GateReport report = Judge(Sequential(0.01, 1, 3000), Outcomes(1000, {}));
  EXPECT_EQ(report.verdict, GateVerdict::kPassed);
  EXPECT_EQ(report.n, 361);
  EXPECT_LE(report.rate.upper, 0.01);
  EXPECT_GE(report.log_e_pass, std::log(20));
  EXPECT_LT(report.log_e_fail, 0);
  EXPECT_THAT(report.text, HasSubstr("0 of the first 361 episodes; "));
}

TEST(SequentialGate, WaitsForMinNAndEndsAtMaxN) {
  EXPECT_EQ(Judge(Sequential(0.01, 500, 3000), Outcomes(1000, {})).n, 500);
  const std::vector<std::uint8_t> all(100, 1);
  EXPECT_EQ(Judge(Sequential(0.01, 50, 3000), all).n, 50);
  EXPECT_EQ(Judge(Sequential(0.01, 50, 3000), all).verdict, GateVerdict::kFailed);

  const GateReport ended = Judge(Sequential(0.01, 1, 400), Outcomes(500, {10, 20}));
  EXPECT_EQ(ended.verdict, GateVerdict::kUndecided);
  EXPECT_TRUE(ended.final);
  EXPECT_EQ(ended.n, 400);
  EXPECT_TRUE(ended.rate.Contains(0.01));
  EXPECT_THAT(ended.text,
              HasSubstr("2 of 400 episodes; with 95 % confidence the rate is shown neither"));

  const GateReport going_on = Judge(Sequential(0.01, 1, 400), Outcomes(100, {}));
  EXPECT_FALSE(going_on.final);
  EXPECT_EQ(going_on.text, "0 of the first 100 episodes; goes on to at most 400");
  EXPECT_EQ(Judge(Sequential(0.01, 1, 400), {}).rate.upper, 1);
}

// The verdict, the e-values and the bounds agree at every episode of a campaign.
TEST(SequentialGate, VerdictEvidenceAndBoundsAgree) {
  int passed = 0, failed = 0;
  for (std::uint64_t c = 0; c < 24; ++c) {
    Stream stream(22, c, "sequential gate");
    const double p = c % 2 == 0 ? 0.01 : 0.2;
    Gate gate(Sequential(0.05, 1, 1500));
    int k = 0;
    for (int n = 1; !gate.final(); ++n) {
      const bool failure = stream.Uniform() < p;
      k += failure;
      gate.Add(failure);
      const bool pass = LogEPass(k, n, 0.05) >= std::log(20),
                 fail = LogEFail(k, n, 0.05) >= std::log(20);
      EXPECT_EQ(gate.verdict() == GateVerdict::kPassed, pass);
      EXPECT_EQ(gate.verdict() == GateVerdict::kFailed, fail);
    }
    const GateReport report = gate.Report();
    EXPECT_EQ(report.verdict == GateVerdict::kPassed, report.rate.upper <= 0.05);
    EXPECT_EQ(report.verdict == GateVerdict::kFailed, report.rate.lower >= 0.05);
    passed += report.verdict == GateVerdict::kPassed;
    failed += report.verdict == GateVerdict::kFailed;
    gate.Add(true);  // ignored: what comes after the verdict is extra
    EXPECT_EQ(gate.Report().k, k);
  }
  EXPECT_EQ(passed, 12);
  EXPECT_EQ(failed, 12);
}

TEST(Gate, KnowsTheFewestEpisodesThatCanPass) {
  EXPECT_EQ(FewestEpisodesToPass(Fixed(0.05, 1)), 59);
  EXPECT_EQ(FewestEpisodesToPass(Fixed(0.01, 1)), 299);
  EXPECT_EQ(FewestEpisodesToPass(Fixed(0.001, 1)), 2995);
  EXPECT_EQ(FewestEpisodesToPass(Sequential(0.01, 1, 1)), 361);
  EXPECT_EQ(FewestEpisodesToPass(Sequential(0.01, 500, 500)), 500);
  EXPECT_NO_THROW(CheckGate(Fixed(0.05, 59)));
  EXPECT_THROW(CheckGate(Fixed(0.05, 58)), InputError);
  EXPECT_THROW(CheckGate(Sequential(0.01, 1, 360)), InputError);
}

TEST(Gate, RefusesSettingsThatMeanNothing) {
  EXPECT_THROW(CheckGate(Fixed(0, 59)), InputError);
  EXPECT_THROW(CheckGate(Fixed(1, 59)), InputError);
  EXPECT_THROW(CheckGate(Sequential(1e-308, 1, 59)), InputError);
  EXPECT_THROW(CheckGate(Sequential(1e-9, 1, 59)), InputError);  // billions of episodes
  EXPECT_THROW(CheckGate(Fixed(std::nan(""), 59)), InputError);
  EXPECT_THROW(CheckGate(Sequential(0.05, 0, 3000)), InputError);
  EXPECT_THROW(CheckGate(Sequential(0.05, 3001, 3000)), InputError);
  EXPECT_THROW(CheckGate(Fixed(0.05, std::numeric_limits<int>::max())), InputError);
  GateSettings settings = Fixed(0.05, 1000);
  for (const double confidence : {0.0, 0.4, 1.0, 95.0}) {
    settings.confidence = confidence;
    EXPECT_THROW(CheckGate(settings), InputError) << confidence;
  }
  for (const double confidence : {0.5, 0.8, 0.999}) {
    settings.confidence = confidence;
    EXPECT_NO_THROW(CheckGate(settings)) << confidence;
  }
}

}  // namespace
}  // namespace floorproof

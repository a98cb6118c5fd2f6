// SPDX-License-Identifier: Apache-2.0
#include "stats/sequential_gate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "stats/binomial.h"
#include "tests/stats/campaigns.h"
#include "tests/stats/distributions.h"

namespace floorproof {
namespace {

constexpr double kConfidence = 0.95;

// The counts at which JudgeSequentially stops; both grow with n, so that each is found by steps.
StoppingRule SequentialRule(double p0, int max_n) {
  StoppingRule rule;
  int pass = -1, fail = 0;
  for (int n = 1; n <= max_n; ++n) {
    const auto judged = [&](int k) { return JudgeSequentially(k, n, p0, kConfidence); };
    while (pass + 1 <= n && judged(pass + 1) == SequentialOutcome::kPass) ++pass;
    while (fail <= n && judged(fail) != SequentialOutcome::kFail) ++fail;
    rule.pass_at_most.push_back(pass);
    rule.fail_at_least.push_back(fail);
  }
  return rule;
}

// int over p of the likelihood ratio under Beta(1, b) cut off at p0, by Simpson's rule.
double EValueByQuadrature(int k, int n, double p0, double b, double from, double to) {
  constexpr int kSteps = 4000;
  double e = 0, prior = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double p = from + (to - from) * i / kSteps;
    const double weight = i == 0 || i == kSteps ? 1 : i % 2 == 0 ? 2 : 4;
    const double density = std::pow(1 - p, b - 1);
    prior += weight * density;
    e += weight * density * std::pow(p / p0, k) * std::pow((1 - p) / (1 - p0), n - k);
  }
  return e / prior;
}

TEST(EProcess, IsTheMixtureThatItsDefinitionSays) {
  for (const double p0 : {0.005, 0.01, 0.05})
    for (const int n : {1, 30, 500})
      for (int k = 0; k <= std::min(n, 40); k += 4) {
        // b from the priors' mean odds, p0's over 4 and times 5
        const double pass = EValueByQuadrature(k, n, p0, 4 * (1 - p0) / p0, 0, p0);
        const double fail = EValueByQuadrature(k, n, p0, (1 - p0) / p0 / 5, p0, 1 - 1e-12);
        EXPECT_NEAR(LogEPass(k, n, p0), std::log(pass), 1e-5) << k << " of " << n << " at " << p0;
        EXPECT_NEAR(LogEFail(k, n, p0), std::log(fail), 1e-5) << k << " of " << n << " at " << p0;
      }
}

// A fair bet: at p = p0 the mean e-value is 1 after any number of episodes; E_pass loses where
// p > p0, E_fail where p < p0, and each wins on the other side.
TEST(EProcess, HasMeanOneAtTheLimit) {
  for (const double p0 : {0.01, 0.1, 0.5})
    for (const int n : {1, 20, 400}) {
      const auto mean = [&](double (*log_e)(int, int, double), double p) {
        double sum = 0;
        for (int k = 0; k <= n; ++k) sum += std::exp(LogBinomialPmf(k, n, p) + log_e(k, n, p0));
        return sum;
      };
      EXPECT_NEAR(mean(LogEPass, p0), 1, 1e-9);
      EXPECT_NEAR(mean(LogEFail, p0), 1, 1e-9);
      EXPECT_LT(mean(LogEPass, 1.2 * p0), 1);
      EXPECT_LT(mean(LogEFail, 0.8 * p0), 1);
      EXPECT_GT(mean(LogEPass, 0.8 * p0), 1);
      EXPECT_GT(mean(LogEFail, 1.2 * p0), 1);
    }
}

// The same for the next episode alone, from any count, also far out in the tails where the
// incomplete beta function underflows: E(k, n) = p0 E(k + 1, n + 1) + (1 - p0) E(k, n + 1).
TEST(EProcess, IsAFairBetFromEpisodeToEpisode) {
  for (const double p0 : {1e-3, 0.01, 0.3, 0.9})
    for (const int n : {0, 10, 3000, 100000})
      for (const double share : {0.0, 0.2 * p0, p0, 0.5 * (1 + p0), 1.0})
        for (const auto& log_e : {LogEPass, LogEFail}) {
          const int k = static_cast<int>(share * n);
          const double now = log_e(k, n, p0);
          EXPECT_NEAR(p0 * std::exp(log_e(k + 1, n + 1, p0) - now) +
                          (1 - p0) * std::exp(log_e(k, n + 1, p0) - now),
                      1, 1e-8)
              << k << " of " << n << " at " << p0;
        }
}

TEST(EProcess, NothingSeenIsNoEvidence) {
  EXPECT_NEAR(LogEPass(0, 0, 0.01), 0, 1e-12);
  EXPECT_NEAR(LogEFail(0, 0, 0.01), 0, 1e-12);
}

TEST(EProcess, BothNeverSpeakAtOnce) {
  for (const double p0 : {0.001, 0.01, 0.2, 0.7})
    for (const int n : {1, 7, 100, 3000})
      for (int k = 0; k <= n; k += 1 + n / 50) {
        EXPECT_LE(k >= n * p0 ? LogEPass(k, n, p0) : LogEFail(k, n, p0), 1e-9)
            << k << " of " << n << " at " << p0;
      }
}

TEST(EProcess, StaysFiniteAndOrderedToAHundredThousandEpisodes) {
  for (const double p0 : {1e-4, 0.01, 0.3, 0.9})
    for (const int n : {1000, 100000}) {
      double last_pass = std::numeric_limits<double>::infinity(), last_fail = -last_pass;
      for (int k = 0; k <= n; k += n / 200) {
        const double pass = LogEPass(k, n, p0), fail = LogEFail(k, n, p0);
        ASSERT_TRUE(std::isfinite(pass) && std::isfinite(fail)) << k << " of " << n << " at " << p0;
        EXPECT_LT(pass, last_pass) << k << " of " << n << " at " << p0;  // failures speak against
        EXPECT_GT(fail, last_fail) << k << " of " << n << " at " << p0;
        last_pass = pass;
        last_fail = fail;
      }
    }
}

// How quick it is at a limit of 1 %.
TEST(SequentialGate, StopsWhenItShould) {
  const StoppingRule rule = SequentialRule(0.01, 6000);
  const auto first = std::find(rule.pass_at_most.begin(), rule.pass_at_most.end(), 0);
  EXPECT_EQ(first - rule.pass_at_most.begin() + 1, 361);
  constexpr int kCampaigns = 4000;
  const auto median_pass = [&](double p) {
    return MedianOfAll(Simulate(rule, p, kCampaigns).passed_at, kCampaigns);
  };
  const auto median_fail = [&](double p) {
    return MedianOfAll(Simulate(rule, p, kCampaigns).failed_at, kCampaigns);
  };
  std::printf("  medians: 0.2 %% %d, 2 %% %d, 5 %% %d\n", median_pass(0.002), median_fail(0.02),
              median_fail(0.05));
  EXPECT_NEAR(median_pass(0.002), 622, 10);
  EXPECT_NEAR(median_fail(0.02), 870, 30);
  EXPECT_NEAR(median_fail(0.05), 70, 3);
}

// The chances of the campaigns' ends, exact and simulated.
TEST(SequentialGate, RarelyErrsHoweverOftenOneLooks) {
  constexpr int kCampaigns = 5000, kEpisodes = 3000;
  for (const double p0 : {0.01, 0.05}) {
    const StoppingRule rule = SequentialRule(p0, kEpisodes);
    const auto chances = [&](const char* at, double p) {
      const StopChances exact = Enumerate(rule, p);
      const CampaignTally simulated = Simulate(rule, p, kCampaigns);
      std::printf("  limit %.2f, %s: passes %.4f (simulated %.4f), fails %.4f (%.4f)\n", p0, at,
                  exact.passed, simulated.Passed(), exact.failed, simulated.Failed());
      EXPECT_NEAR(simulated.Passed(), exact.passed, 0.015);
      EXPECT_NEAR(simulated.Failed(), exact.failed, 0.015);
      return exact;
    };
    const StopChances at_limit = chances("p0", p0), good = chances("p0 / 5", p0 / 5),
                      bad = chances("2 p0", 2 * p0);
    EXPECT_LE(at_limit.passed, 0.05);
    EXPECT_LE(at_limit.failed, 0.05);
    EXPECT_GE(good.passed, 0.99);
    EXPECT_LE(good.failed, 0.001);
    EXPECT_GE(bad.failed, 0.95);
    EXPECT_LE(bad.passed, 0.005);
  }
}

// The control: the same campaigns, judged by the bound for a fixed n at every 50th episode.
TEST(SequentialGate, PeekingAtAFixedBoundErrsFarMoreOften) {
  constexpr int kCampaigns = 5000, kEpisodes = 3000;
  constexpr double kLimit = 0.01;
  StoppingRule peeking;
  int pass = -1;
  for (int n = 1; n <= kEpisodes; ++n) {
    const bool looks = n % 50 == 0;
    while (looks && ClopperPearsonUpper(pass + 1, n, kConfidence) < kLimit) ++pass;
    peeking.pass_at_most.push_back(looks ? pass : -1);
    peeking.fail_at_least.push_back(n + 1);
  }
  const CampaignTally naive = Simulate(peeking, kLimit, kCampaigns),
                      valid = Simulate(SequentialRule(kLimit, kEpisodes), kLimit, kCampaigns);
  EXPECT_LE(valid.Passed(), 0.05);
  std::printf("  false passes: peeking %.4f, sequential %.4f\n", naive.Passed(), valid.Passed());
  EXPECT_GT(naive.Passed(), 3 * 0.05);
  EXPECT_GT(naive.Passed(), 3 * valid.Passed());
}

// The bounds are the same tests at every limit.
TEST(AnytimeBounds, SplitTheLimitsIntoPassedOpenAndFailed) {
  for (const auto& [k, n] : {std::pair{0, 361},
                             {3, 1000},
                             {1, 1},
                             {0, 1},
                             {2, 2},
                             {1, 40},
                             {50, 100},
                             {97, 100},
                             {400, 100000}}) {
    const Interval open = AnytimeBounds(k, n, kConfidence);
    EXPECT_TRUE(open.Contains(static_cast<double>(k) / n));
    for (double p0 = 1e-5; p0 < 1; p0 += 0.02 * std::min(p0, 1 - p0) + 1e-5) {
      const SequentialOutcome outcome = JudgeSequentially(k, n, p0, kConfidence);
      EXPECT_EQ(outcome == SequentialOutcome::kPass, p0 >= open.upper)
          << k << "/" << n << " " << p0;
      EXPECT_EQ(outcome == SequentialOutcome::kFail, p0 <= open.lower)
          << k << "/" << n << " " << p0;
    }
    const Interval fixed = ClopperPearson(k, n, 0.9);  // each end at 95 %, for one look only
    EXPECT_LE(open.lower, fixed.lower);
    EXPECT_GE(open.upper, fixed.upper);
  }
  EXPECT_EQ(AnytimeBounds(0, 0, kConfidence).lower, 0);
  EXPECT_EQ(AnytimeBounds(0, 0, kConfidence).upper, 1);
  EXPECT_EQ(AnytimeBounds(0, 9, kConfidence).lower, 0);
  EXPECT_EQ(AnytimeBounds(9, 9, kConfidence).upper, 1);
}

TEST(SequentialGate, RefusesImpossibleValues) {
  EXPECT_THROW(LogEPass(2, 1, 0.01), InputError);
  EXPECT_THROW(LogEFail(0, 1, 0), InputError);
  EXPECT_THROW(JudgeSequentially(0, 1, 0.01, 1), InputError);
  EXPECT_THROW(AnytimeBounds(-1, 1, 0.95), InputError);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "stats/binomial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/error.h"
#include "stats/outward.h"
#include "tests/stats/distributions.h"

namespace floorproof {
namespace {

TEST(Binomial, NoEventsAndOnlyEventsHaveClosedForms) {
  for (const int n : {1, 10, 59, 1000, 100000}) {
    const Interval none = ClopperPearson(0, n, 0.95);
    EXPECT_EQ(none.lower, 0);
    const double upper = -std::expm1(std::log(0.025) / n);  // 1 - (alpha / 2)^(1 / n)
    EXPECT_NEAR(none.upper, upper, 1e-12 * upper) << n;
    const Interval all = ClopperPearson(n, n, 0.95);
    EXPECT_NEAR(all.lower, std::pow(0.025, 1.0 / n), 1e-12);
    EXPECT_EQ(all.upper, 1);
  }
  EXPECT_EQ(ClopperPearson(0, 0, 0.95).lower, 0);
  EXPECT_EQ(ClopperPearson(0, 0, 0.95).upper, 1);
}

TEST(RoundedOutward, KeepsThreeDigitsAndAllThatWasHeld) {
  const struct {
    Interval exact, told;
  } cases[] = {{{0, 60.236}, {0, 60.3}},
               {{0.012345, 99.99}, {0.0123, 100}},
               {{-1.2341, 0.1}, {-1.24, 0.1}},
               {{16.8, 25}, {16.8, 25}}};
  for (const auto& c : cases) {
    const Interval dut = RoundedOutward(c.exact);
    EXPECT_NEAR(dut.lower, c.told.lower, 1e-9);
    EXPECT_NEAR(dut.upper, c.told.upper, 1e-9);
  }
}

// How many clean episodes it takes: 3 / p, nearly.
TEST(Binomial, RuleOfThree) {
  const struct {
    int n;
    double rate;
  } cases[] = {{59, 0.05}, {299, 0.01}, {2995, 0.001}};
  for (const auto& c : cases) {
    EXPECT_LT(ClopperPearsonUpper(0, c.n, 0.95), c.rate);
    EXPECT_GT(ClopperPearsonUpper(0, c.n - 1, 0.95), c.rate);
  }
}

TEST(Binomial, ThreeOfAThousand) {
  const Interval i = ClopperPearson(3, 1000, 0.95);
  EXPECT_NEAR(100 * i.lower, 0.0619, 0.0001);
  EXPECT_NEAR(100 * i.upper, 0.8742, 0.0001);
}

TEST(Binomial, TheTailsBeyondTheEndsHoldHalfOfAlphaEach) {
  for (const int n : {5, 60, 400})
    for (int k = 1; k < n; k += 1 + n / 7) {
      const Interval i = ClopperPearson(k, n, 0.9);
      double at_most = 0, at_least = 0;
      for (int j = 0; j <= k; ++j) at_most += BinomialPmf(j, n, i.upper);
      for (int j = k; j <= n; ++j) at_least += BinomialPmf(j, n, i.lower);
      EXPECT_NEAR(at_most, 0.05, 1e-9);
      EXPECT_NEAR(at_least, 0.05, 1e-9);
    }
}

TEST(Binomial, EventsAndNonEventsMirror) {
  for (const int n : {7, 300})
    for (int k = 0; k <= n; ++k) {
      const Interval i = ClopperPearson(k, n, 0.95), mirrored = ClopperPearson(n - k, n, 0.95);
      EXPECT_NEAR(i.lower, 1 - mirrored.upper, 1e-12);
      EXPECT_NEAR(i.upper, 1 - mirrored.lower, 1e-12);
    }
}

TEST(Binomial, GrowsWithEventsNarrowsWithEpisodesWidensWithConfidence) {
  for (int k = 0; k < 50; ++k) {
    const Interval i = ClopperPearson(k, 50, 0.95), next = ClopperPearson(k + 1, 50, 0.95);
    EXPECT_LT(i.lower, next.lower);
    EXPECT_LT(i.upper, next.upper);
    EXPECT_TRUE(i.Contains(k / 50.0));
    const Interval more = ClopperPearson(10 * k, 500, 0.95), surer = ClopperPearson(k, 50, 0.99);
    EXPECT_LT(more.upper - more.lower, i.upper - i.lower);
    EXPECT_LE(surer.lower, i.lower);
    EXPECT_GT(surer.upper, i.upper);
    EXPECT_EQ(ClopperPearsonUpper(k, 50, 0.975), i.upper);
  }
}

// Exact: the chance that the interval holds the true rate, summed over every outcome.
TEST(Binomial, CoversAtLeastAsOftenAsItSays) {
  for (const int n : {10, 59, 300}) {
    std::vector<Interval> two_sided;
    std::vector<double> upper, lower;
    for (int k = 0; k <= n; ++k) {
      two_sided.push_back(ClopperPearson(k, n, 0.95));
      upper.push_back(ClopperPearsonUpper(k, n, 0.95));
      lower.push_back(ClopperPearsonLower(k, n, 0.95));
    }
    for (double p = 0.0005; p < 1; p *= 1.1) {
      double within = 0, below = 0, above = 0;
      for (int k = 0; k <= n; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const double chance = BinomialPmf(k, n, p);
        if (two_sided[i].Contains(p)) within += chance;
        if (p <= upper[i]) below += chance;
        if (p >= lower[i]) above += chance;
      }
      EXPECT_GE(within, 0.95) << n << " at " << p;
      EXPECT_GE(below, 0.95) << n << " at " << p;
      EXPECT_GE(above, 0.95) << n << " at " << p;
    }
  }
}

TEST(Binomial, CoversSimulatedCampaigns) {
  constexpr int kCampaigns = 4000;
  for (const int n : {59, 1000})
    for (const double p : {0.002, 0.01, 0.05, 0.3}) {
      std::vector<Interval> intervals;
      for (int k = 0; k <= n; ++k) intervals.push_back(ClopperPearson(k, n, 0.95));
      int covered = 0;
      for (int c = 0; c < kCampaigns; ++c) {
        Stream stream(1, static_cast<std::uint64_t>(c), "binomial coverage");
        const auto k = static_cast<std::size_t>(DrawBinomial(stream, n, p));
        covered += intervals[k].Contains(p);
      }
      std::printf("  n %4d p %.3f: coverage %.4f\n", n, p, covered / double{kCampaigns});
      EXPECT_GE(covered, 0.95 * kCampaigns) << n << " at " << p;
    }
}

TEST(Binomial, RefusesImpossibleCounts) {
  EXPECT_THROW(ClopperPearson(-1, 5, 0.95), InputError);
  EXPECT_THROW(ClopperPearson(6, 5, 0.95), InputError);
  EXPECT_THROW(ClopperPearsonUpper(0, -1, 0.95), InputError);
  for (const double confidence : {0.0, 1.0, -1.0, 95.0, std::nan("")})
    EXPECT_THROW(ClopperPearsonLower(1, 5, confidence), InputError);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "stats/paired.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "tests/stats/distributions.h"

namespace floorproof {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

PairedCounts Table(int only_a, int only_b, int n) {
  return {0, only_a, only_b, n - only_a - only_b};
}

TEST(McNemar, IsASignTestOnTheDiscordantPairs) {
  // 2 (C(15,0) + C(15,1) + C(15,2) + C(15,3)) / 2^15
  EXPECT_NEAR(McNemarExact(12, 3), 2.0 * (1 + 15 + 105 + 455) / 32768, 1e-14);
  EXPECT_NEAR(McNemarExact(12, 3), 0.035, 0.0005);
  EXPECT_NEAR(McNemarExact(6, 0), 2.0 / 64, 1e-15);
  EXPECT_EQ(McNemarExact(0, 0), 1);
  EXPECT_EQ(McNemarExact(8, 8), 1);
  for (int b = 0; b < 20; ++b)
    for (int c = 0; c < 20; ++c) EXPECT_EQ(McNemarExact(b, c), McNemarExact(c, b));
  for (int b = 10; b < 20; ++b) EXPECT_GT(McNemarExact(b, 20 - b), McNemarExact(b + 1, 19 - b));
  EXPECT_THROW(McNemarExact(-1, 3), InputError);
}

TEST(McNemar, RejectsEqualRatesNoMoreOftenThanItSays) {
  for (const int discordant : {5, 15, 60}) {
    double rejected = 0;
    for (int b = 0; b <= discordant; ++b)
      if (McNemarExact(b, discordant - b) <= 0.05) rejected += BinomialPmf(b, discordant, 0.5);
    EXPECT_LE(rejected, 0.05);
  }
}

// Airway hyper-responsiveness before and after stem-cell transplantation (Bentur et al. 2009), the
// example of Fagerland, Lydersen and Laake (2014): 1 and 7 discordant of 21 children.
TEST(Tango, PublishedExample) {
  const Interval i = PairedRateDifference(Table(1, 7, 21), 0.95);
  EXPECT_NEAR(i.lower, -0.517, 0.0005);
  EXPECT_NEAR(i.upper, -0.026, 0.0005);
}

TEST(Tango, NoDiscordantPairLeavesWilsonsBound) {
  const double z2 = 1.959963984540054 * 1.959963984540054;
  for (const int n : {1, 20, 1000}) {
    const Interval i = PairedRateDifference(Table(0, 0, n), 0.95);
    EXPECT_NEAR(i.upper, z2 / (n + z2), 1e-9);
    EXPECT_NEAR(i.lower, -i.upper, 1e-12);
  }
  EXPECT_EQ(PairedRateDifference({}, 0.95).lower, -1);
  EXPECT_EQ(PairedRateDifference({}, 0.95).upper, 1);
}

TEST(Tango, SwappingTheVariantsChangesTheSign) {
  for (const auto& [b, c] : {std::pair{12, 3}, {0, 5}, {40, 40}, {50, 0}}) {
    const Interval i = PairedRateDifference(Table(b, c, 80), 0.95),
                   swapped = PairedRateDifference(Table(c, b, 80), 0.95);
    EXPECT_NEAR(i.lower, -swapped.upper, 1e-12);
    EXPECT_NEAR(i.upper, -swapped.lower, 1e-12);
    EXPECT_TRUE(i.Contains((b - c) / 80.0));
    EXPECT_GE(i.lower, -1);
    EXPECT_LE(i.upper, 1);
  }
  const Interval all = PairedRateDifference(Table(9, 0, 9), 0.95);
  EXPECT_GT(all.lower, 0.3);
  EXPECT_EQ(all.upper, 1);
}

// The interval excludes 0 exactly where McNemar's score |b - c| / sqrt(b + c) exceeds z.
TEST(Tango, IsMcNemarsScoreTestAtZero) {
  for (int b = 0; b <= 25; ++b)
    for (int c = 0; c <= 25; ++c) {
      if (b + c == 0) continue;
      const bool rejects = std::abs(b - c) / std::sqrt(b + c) > 1.959963984540054;
      EXPECT_EQ(!PairedRateDifference(Table(b, c, 200), 0.95).Contains(0), rejects)
          << b << " " << c;
    }
}

TEST(Tango, CoversSimulatedCampaigns) {
  constexpr int kCampaigns = 4000;
  const struct {
    int n;
    double both, only_a, only_b;
  } cases[] = {{100, 0.02, 0.1, 0.04},
               {300, 0.01, 0.02, 0.02},
               {300, 0.0, 0.03, 0.005},
               {1000, 0.005, 0.01, 0.002}};
  for (const auto& c : cases) {
    int covered = 0;
    for (int campaign = 0; campaign < kCampaigns; ++campaign) {
      Stream stream(3, static_cast<std::uint64_t>(campaign), "tango coverage");
      PairedCounts counts;
      for (int i = 0; i < c.n; ++i) {
        const double u = stream.Uniform();
        ++(u < c.both                         ? counts.both
           : u < c.both + c.only_a            ? counts.only_a
           : u < c.both + c.only_a + c.only_b ? counts.only_b
                                              : counts.neither);
      }
      covered += PairedRateDifference(counts, 0.95).Contains(c.only_a - c.only_b);
    }
    const double coverage = covered / double{kCampaigns};
    std::printf("  n %4d a %.3f b %.3f: coverage %.4f\n", c.n, c.only_a, c.only_b, coverage);
    EXPECT_NEAR(coverage, 0.95, 0.015);
  }
}

// Chance of one failing where the other does not makes noise; what both share does not.
TEST(Tango, SharedFailuresDoNotWiden) {
  const Interval apart = PairedRateDifference({0, 10, 4, 186}, 0.95),
                 shared = PairedRateDifference({100, 10, 4, 86}, 0.95);
  EXPECT_EQ(apart.lower, shared.lower);
  EXPECT_EQ(apart.upper, shared.upper);
}

TEST(MeanDifference, StudentsSleepData) {
  // Cushny and Peebles' extra hours of sleep, Student 1908: mean 1.58, 95 % [0.70, 2.46].
  const double d[] = {1.2, 2.4, 1.3, 1.3, 0.0, 1.0, 1.8, 0.8, 4.6, 1.4};
  const PairedDifference mean = MeanDifference(d, 0.95);
  EXPECT_EQ(mean.n, 10);
  EXPECT_NEAR(mean.estimate, 1.58, 1e-12);
  EXPECT_NEAR(mean.interval.lower, 0.7001, 1e-4);
  EXPECT_NEAR(mean.interval.upper, 2.4599, 1e-4);
}

TEST(Differences, FewEpisodesSayLittle) {
  const std::vector<double> d = {3, 1, 2, 5, 4, 6};
  for (const auto& result : {MeanDifference({}, 0.95), MedianDifference({}, 0.95)}) {
    EXPECT_TRUE(std::isnan(result.estimate));
    EXPECT_EQ(result.interval.lower, -kInfinity);
    EXPECT_EQ(result.interval.upper, kInfinity);
  }
  EXPECT_EQ(MeanDifference(std::span(d).first(1), 0.95).estimate, 3);
  EXPECT_EQ(MeanDifference(std::span(d).first(1), 0.95).interval.upper, kInfinity);
  EXPECT_EQ(MedianDifference(std::span(d).first(5), 0.95).interval.upper,
            kInfinity);                                       // 2/2^5 > 5 %
  const PairedDifference median = MedianDifference(d, 0.95);  // 2 / 2^6 < 5 %: the extremes
  EXPECT_EQ(median.estimate, 3.5);
  EXPECT_EQ(median.interval.lower, 1);
  EXPECT_EQ(median.interval.upper, 6);
}

// n = 20: the 6th and the 15th smallest, coverage 95.9 % (tables of the sign test).
TEST(MedianDifference, LiesBetweenOrderStatistics) {
  std::vector<double> d;
  for (int i = 20; i >= 1; --i) d.push_back(i);
  const PairedDifference median = MedianDifference(d, 0.95);
  EXPECT_EQ(median.interval.lower, 6);
  EXPECT_EQ(median.interval.upper, 15);
}

TEST(Differences, MoveAndScaleWithTheData) {
  Stream stream(4, 0, "differences");
  std::vector<double> d, moved;
  for (int i = 0; i < 41; ++i) {
    d.push_back(stream.Normal());
    moved.push_back(7 - 2 * d.back());
  }
  for (const auto& locate : {MeanDifference, MedianDifference}) {
    const PairedDifference x = locate(d, 0.95), y = locate(moved, 0.95);
    EXPECT_NEAR(y.estimate, 7 - 2 * x.estimate, 1e-12);
    EXPECT_NEAR(y.interval.lower, 7 - 2 * x.interval.upper, 1e-12);
    EXPECT_NEAR(y.interval.upper, 7 - 2 * x.interval.lower, 1e-12);
  }
}

// Normal differences for the mean; skewed ones (exponential, median ln 2) for the median, of which
// no more is asked than that their median is what it is.
TEST(Differences, CoverSimulatedCampaigns) {
  constexpr int kCampaigns = 4000;
  for (const int n : {8, 50}) {
    int mean_covered = 0, median_covered = 0;
    std::vector<double> normal(static_cast<std::size_t>(n)), skewed(normal);
    for (int c = 0; c < kCampaigns; ++c) {
      Stream stream(5, static_cast<std::uint64_t>(c), "difference coverage");
      for (double& x : normal) x = 0.3 + 2 * stream.Normal();
      for (double& x : skewed) x = -std::log1p(-stream.Uniform());
      mean_covered += MeanDifference(normal, 0.95).interval.Contains(0.3);
      median_covered += MedianDifference(skewed, 0.95).interval.Contains(std::log(2.0));
    }
    std::printf("  n %2d: mean %.4f median %.4f\n", n, mean_covered / double{kCampaigns},
                median_covered / double{kCampaigns});
    EXPECT_NEAR(mean_covered / double{kCampaigns}, 0.95, 0.01);
    EXPECT_GE(median_covered, 0.95 * kCampaigns);
  }
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "stats/poisson.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/error.h"
#include "stats/binomial.h"
#include "tests/stats/distributions.h"

namespace floorproof {
namespace {

TEST(Garwood, PublishedAndClosedValues) {
  EXPECT_EQ(GarwoodInterval(0, 2, 0.95).lower, 0);
  EXPECT_NEAR(GarwoodInterval(0, 2, 0.95).upper, -std::log(0.025) / 2, 1e-12);  // 3.689 / T
  EXPECT_NEAR(GarwoodInterval(10, 1, 0.95).lower, 4.795, 0.001);  // tables of chi-square
  EXPECT_NEAR(GarwoodInterval(10, 1, 0.95).upper, 18.390, 0.001);
}

TEST(Garwood, NoExposureSaysNothing) {
  EXPECT_EQ(GarwoodInterval(0, 0, 0.95).lower, 0);
  EXPECT_EQ(GarwoodInterval(2, 0, 0.95).upper, std::numeric_limits<double>::infinity());
}

TEST(Garwood, TheTailsBeyondTheEndsHoldHalfOfAlphaEach) {
  for (const int k : {1, 4, 30}) {
    const Interval i = GarwoodInterval(k, 1, 0.95);
    double at_most = 0, fewer = 0;
    for (int j = 0; j <= k; ++j) at_most += PoissonPmf(j, i.upper);
    for (int j = 0; j < k; ++j) fewer += PoissonPmf(j, i.lower);
    EXPECT_NEAR(at_most, 0.025, 1e-9);
    EXPECT_NEAR(1 - fewer, 0.025, 1e-9);
  }
}

TEST(Garwood, ScalesWithTheUnitOfExposure) {
  const Interval per_km = GarwoodInterval(5, 12.5, 0.95), per_m = GarwoodInterval(5, 12500, 0.95);
  EXPECT_NEAR(per_km.lower, 1000 * per_m.lower, 1e-9);
  EXPECT_NEAR(per_km.upper, 1000 * per_m.upper, 1e-9);
}

// Many episodes, each with a small chance: the binomial is a Poisson.
TEST(Garwood, IsTheLimitOfClopperPearsonForRareEvents) {
  for (const int k : {0, 1, 7}) {
    const int n = 10000000;
    const Interval counts = ClopperPearson(k, n, 0.95), rate = GarwoodInterval(k, n, 0.95);
    EXPECT_NEAR(counts.lower, rate.lower, 1e-5 * rate.lower);
    EXPECT_NEAR(counts.upper, rate.upper, 1e-5 * rate.upper);
  }
}

TEST(Garwood, CoversAtLeastAsOftenAsItSays) {
  std::vector<Interval> intervals;
  for (int k = 0; k < 200; ++k) intervals.push_back(GarwoodInterval(k, 1, 0.95));
  for (double mean = 0.01; mean < 60; mean *= 1.05) {
    double covered = 0;
    for (int k = 0; k < 200; ++k)
      if (intervals[static_cast<std::size_t>(k)].Contains(mean)) covered += PoissonPmf(k, mean);
    EXPECT_GE(covered, 0.95) << mean;
  }
}

// Robots that fail at a constant rate, driven for a set distance: gaps between failures are
// exponential.
TEST(Garwood, CoversSimulatedDrives) {
  constexpr int kCampaigns = 4000;
  for (const double rate_per_km : {0.05, 0.5, 3.0}) {
    constexpr double kDistanceKm = 10;
    int covered = 0;
    for (int c = 0; c < kCampaigns; ++c) {
      Stream stream(2, static_cast<std::uint64_t>(c), "garwood coverage");
      int k = -1;
      for (double km = 0; km < kDistanceKm; ++k) km -= std::log1p(-stream.Uniform()) / rate_per_km;
      covered += GarwoodInterval(k, kDistanceKm, 0.95).Contains(rate_per_km);
    }
    std::printf("  %.2f per km: coverage %.4f\n", rate_per_km, covered / double{kCampaigns});
    EXPECT_GE(covered, 0.95 * kCampaigns) << rate_per_km;
  }
}

TEST(Garwood, RefusesImpossibleValues) {
  EXPECT_THROW(GarwoodInterval(-1, 1, 0.95), InputError);
  EXPECT_THROW(GarwoodInterval(1, 1, 1), InputError);
  for (const double exposure : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(GarwoodInterval(1, exposure, 0.95), InputError);
}

}  // namespace
}  // namespace floorproof

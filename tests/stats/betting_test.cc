// SPDX-License-Identifier: Apache-2.0
#include "stats/betting.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/error.h"
#include "base/streams.h"

namespace floorproof {
namespace {

// Weights as those of importance draws: most are 0, few are large.
std::vector<double> Weights(std::uint64_t seed, int n, double share, double weight) {
  Stream stream(seed, 0, "weights");
  std::vector<double> numbers;
  for (int i = 0; i < n; ++i)
    numbers.push_back(stream.Uniform() < share ? 2 * weight * stream.Uniform() : 0);
  return numbers;
}

TEST(BettingLowerBound, LiesBelowTheMeanAsOftenAsItSays) {
  int below = 0;
  double sum = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const double bound = BettingLowerBound(Weights(seed, 1000, 0.3, 1e-5), 0.95);
    below += bound <= 3e-6;
    sum += bound;
  }
  EXPECT_GE(below, 190);
  EXPECT_GT(sum / 200, 2e-6);  // and says something
}

// One number so large that a bound from the numbers' spread would be above the mean: it is as
// likely as the mean says, and no reason to raise the bound far.
TEST(BettingLowerBound, HoldsWhereFewLargeNumbersMakeTheMean) {
  int above = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed)
    above += BettingLowerBound(Weights(seed, 300, 1.0 / 300, 1), 0.95) > 1.0 / 300;
  EXPECT_LE(above, 20);
}

TEST(BettingLowerBound, ScalesWithTheNumbersAndSaysNothingOfZeros) {
  std::vector<double> numbers = Weights(1, 500, 0.2, 1);
  const double one = BettingLowerBound(numbers, 0.9);
  for (double& x : numbers) x *= 1e-6;
  EXPECT_NEAR(BettingLowerBound(numbers, 0.9) / one, 1e-6, 1e-12);
  EXPECT_EQ(BettingLowerBound(std::vector<double>(50, 0.0), 0.9), 0);
  EXPECT_EQ(BettingLowerBound({}, 0.9), 0);
  EXPECT_THROW(BettingLowerBound(std::vector<double>{-1}, 0.9), InputError);
  EXPECT_THROW(BettingLowerBound(numbers, 1), InputError);
}

}  // namespace
}  // namespace floorproof

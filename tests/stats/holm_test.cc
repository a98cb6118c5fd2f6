// SPDX-License-Identifier: Apache-2.0
#include "stats/holm.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "base/error.h"
#include "base/streams.h"

namespace floorproof {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<double> Adjusted(const std::vector<double>& p) { return HolmAdjusted(p); }

TEST(Holm, TheSmallestIsMultipliedByAllTheNextByOneLess) {
  EXPECT_THAT(Adjusted({0.01, 0.04, 0.03}),
              ElementsAre(DoubleEq(0.03), DoubleEq(0.06), DoubleEq(0.06)))
      << "0.04 by itself would be 0.04, but 0.03 before it is worth 0.06";
  EXPECT_THAT(Adjusted({0.5, 0.9}), ElementsAre(1.0, 1.0));
  EXPECT_THAT(Adjusted({0.02}), ElementsAre(0.02));
  EXPECT_THAT(Adjusted({}), IsEmpty());
}

TEST(Holm, RefusesWhatIsNoProbability) {
  EXPECT_THROW(Adjusted({0.1, -0.1}), InputError);
  EXPECT_THROW(Adjusted({1.1}), InputError);
}

// Without any influence, finding one among ten is as rare as 5 %; uncorrected it is 40 %.
TEST(Holm, AmongManyWithoutInfluenceNoneIsFound) {
  constexpr int kTrials = 2000;
  Stream stream(3, 0, "holm");
  int found = 0, uncorrected = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> p(10);
    for (double& one : p) one = stream.Uniform();
    found += std::ranges::min(Adjusted(p)) <= 0.05;
    uncorrected += std::ranges::min(p) <= 0.05;
  }
  EXPECT_NEAR(found, 0.05 * kTrials, 30);
  EXPECT_GT(uncorrected, 0.3 * kTrials);
}

}  // namespace
}  // namespace floorproof

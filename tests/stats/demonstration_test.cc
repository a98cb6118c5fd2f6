// SPDX-License-Identifier: Apache-2.0
#include "stats/demonstration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "stats/binomial.h"

namespace floorproof {
namespace {

TEST(RunsToDemonstrate, AreTheKnownNumbers) {
  EXPECT_EQ(RunsToDemonstrate(0.95, 0.95), 59);
  EXPECT_EQ(RunsToDemonstrate(0.99, 0.95), 299);
  EXPECT_EQ(RunsToDemonstrate(0.90, 0.90), 22);
  EXPECT_EQ(RunsToDemonstrate(0.999, 0.95), 2995);
  EXPECT_EQ(RunsToDemonstrate(0.5, 0.75), 2);
  EXPECT_EQ(RunsToDemonstrate(0.9, 0.19), 2);  // 0.9^2 = 1 - 0.19, but for rounding
}

// One run fewer would not do, and the exact bound says the same.
TEST(RunsToDemonstrate, AreTheLeast) {
  for (const double reliability : {0.3, 0.8, 0.95, 0.99})
    for (const double confidence : {0.2, 0.6, 0.9, 0.99}) {
      const int n = RunsToDemonstrate(reliability, confidence);
      ASSERT_GE(n, 1);
      EXPECT_LE(std::pow(reliability, n), 1 - confidence + 1e-9);
      EXPECT_GE(ClopperPearsonLower(n, n, confidence), reliability - 1e-9);
      if (n > 1) {
        EXPECT_GT(std::pow(reliability, n - 1), 1 - confidence);
      }
    }
}

TEST(RunsToDemonstrate, RefusesWhatCannotBeDemonstrated) {
  for (const double share : {0.0, 1.0, -0.1, 1.1, std::nan("")}) {
    EXPECT_THROW(RunsToDemonstrate(share, 0.95), InputError) << share;
    EXPECT_THROW(RunsToDemonstrate(0.95, share), InputError) << share;
  }
  EXPECT_THROW(RunsToDemonstrate(1 - 1e-9, 0.95), InputError);
}

}  // namespace
}  // namespace floorproof

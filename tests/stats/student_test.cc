// SPDX-License-Identifier: Apache-2.0
#include "stats/student.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/streams.h"

namespace floorproof {
namespace {

// Quantiles of Student's t as printed in tables.
TEST(Student, PublishedValues) {
  const auto reach = [](double degrees, double confidence) {
    return StudentInterval(0, 1, degrees, confidence).upper;
  };
  EXPECT_NEAR(reach(1, 0.95), 12.706, 0.001);
  EXPECT_NEAR(reach(2, 0.95), 4.303, 0.001);
  EXPECT_NEAR(reach(10, 0.95), 2.228, 0.001);
  EXPECT_NEAR(reach(30, 0.95), 2.042, 0.001);
  EXPECT_NEAR(reach(10, 0.99), 3.169, 0.001);
  EXPECT_NEAR(reach(1e9, 0.95), 1.960, 0.001);  // the normal distribution's
}

TEST(Student, LiesAroundTheMeanInItsUnit) {
  const Interval dut = StudentInterval(5, 0.1, 7.5, 0.95);
  EXPECT_NEAR(5 - dut.lower, dut.upper - 5, 1e-12);
  EXPECT_GT(dut.upper, StudentInterval(5, 0.1, 8, 0.95).upper);
  EXPECT_LT(dut.upper, StudentInterval(5, 0.1, 7, 0.95).upper);
  EXPECT_NEAR(StudentInterval(0, 1, 7.5, 0.95).upper * 0.1, dut.upper - 5, 1e-12);
  EXPECT_EQ(StudentInterval(5, 0, 3, 0.95).upper, 5);
}

TEST(Student, HoldsAsOftenAsItSays) {
  constexpr int kN = 4, kTries = 20000;
  Stream random(1, 0, "student");
  int held = 0;
  for (int i = 0; i < kTries; ++i) {
    double x[kN], mean = 0, squares = 0;
    for (double& value : x) value = 2 + random.Normal(), mean += value / kN;
    for (const double value : x) squares += (value - mean) * (value - mean);
    held += StudentInterval(mean, std::sqrt(squares / (kN - 1) / kN), kN - 1, 0.95).Contains(2);
  }
  EXPECT_NEAR(1.0 * held / kTries, 0.95, 0.006);  // four standard deviations
}

TEST(Student, RefusesWhatIsNoStandardError) {
  const double none = std::nan(""), endless = std::numeric_limits<double>::infinity();
  EXPECT_THROW(StudentInterval(0, -1, 3, 0.95), InputError);
  EXPECT_THROW(StudentInterval(0, none, 3, 0.95), InputError);
  EXPECT_THROW(StudentInterval(0, 1, 0, 0.95), InputError);
  EXPECT_THROW(StudentInterval(0, 1, endless, 0.95), InputError);
  EXPECT_THROW(StudentInterval(0, 1, 3, 1), InputError);
}

}  // namespace
}  // namespace floorproof

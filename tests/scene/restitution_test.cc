// SPDX-License-Identifier: Apache-2.0
// The livelier, the less damping; and with fine steps what the linear dashpot gives in closed form.
#include "env/scene/restitution.h"

#include <gtest/gtest.h>

#include <cmath>

namespace floorproof {
namespace {

constexpr double kSteps_s[] = {0.001, 0.002, 0.004, 0.005};

TEST(Restitution, TheDampingRatioFallsWithIt) {
  for (const double step_s : kSteps_s) {
    double last = SoftnessFor(0, step_s).damping_ratio;
    EXPECT_GT(last, 1);
    for (const double e : {0.1, 0.3, 0.5, 0.7, 0.9, 0.99}) {
      const double now = SoftnessFor(e, step_s).damping_ratio;
      EXPECT_LT(now, last) << e << " at " << step_s;
      EXPECT_GT(now, 0);
      last = now;
    }
    EXPECT_EQ(SoftnessFor(1, step_s).damping_ratio, last) << "1 is taken as 0.99";
  }
}

TEST(Restitution, IsWhatTheWalkGivesBack) {
  for (const double step_s : kSteps_s)
    for (const double e : {0.1, 0.3, 0.5, 0.7, 0.9})
      EXPECT_NEAR(ReboundOf(SoftnessFor(e, step_s).damping_ratio, step_s), e, 1e-3)
          << e << " at " << step_s;
}

// Schwager & Poeschel 2007, eq. 17-20; critically damped: exp(-2).
TEST(Restitution, ConvergesToTheLinearDashpot) {
  const auto closed = [](double zeta) {
    if (zeta < 1) {
      const double s = std::sqrt(1 - zeta * zeta);
      return std::exp(-zeta / s * std::atan2(2 * zeta * s, 2 * zeta * zeta - 1));
    }
    const double s = std::sqrt(zeta * zeta - 1);
    return std::exp(-zeta / s * std::log((zeta + s) / (zeta - s)));
  };
  EXPECT_NEAR(ReboundOf(1, 1e-5), std::exp(-2.0), 1e-3);
  for (const double zeta : {0.05, 0.2, 0.5, 0.8, 1.5, 3.0}) {
    EXPECT_NEAR(ReboundOf(zeta, 1e-5), closed(zeta), 1e-3) << zeta;
    EXPECT_LE(std::abs(ReboundOf(zeta, 0.001) - closed(zeta)),
              std::abs(ReboundOf(zeta, 0.004) - closed(zeta)) + 1e-3)
        << zeta;
  }
}

// A time constant below twice the step would be raised by the engine.
TEST(Restitution, TheEngineTakesItAsItIs) {
  for (const double step_s : kSteps_s)
    for (const double e : {0.0, 0.05, 0.1, 0.15, 0.3, 0.9, 1.0})
      EXPECT_GE(SoftnessFor(e, step_s).time_constant_s, 2 * step_s) << e << " at " << step_s;
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The livelier, the less damping; and with fine steps what the linear dashpot gives in closed form.
#include "env/scene/restitution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace floorproof {
namespace {

std::vector<ContactWalk> Walks() {
  std::vector<ContactWalk> walks;
  for (const double step_s : {0.001, 0.002, 0.004, 0.005})
    for (const bool implicit : {false, true}) walks.push_back({step_s, implicit});
  return walks;
}

TEST(Restitution, TheLivelierTheLessDampingOrTheSofter) {
  for (const ContactWalk& walk : Walks()) {
    ContactSoftness last = SoftnessFor(0, walk);
    EXPECT_GT(last.damping_ratio, 1);
    for (const double e : {0.1, 0.3, 0.5, 0.65}) {
      const ContactSoftness now = SoftnessFor(e, walk);
      EXPECT_GE(now.time_constant_s, last.time_constant_s) << e << " at " << walk.timestep_s;
      EXPECT_LE(now.damping_ratio, last.damping_ratio) << e << " at " << walk.timestep_s;
      EXPECT_GT(now.damping_ratio, 0);
      last = now;
    }
  }
}

TEST(Restitution, IsWhatTheWalkGivesBack) {
  for (const ContactWalk& walk : Walks())
    for (const double e : {0.1, 0.3, 0.5, 0.65})
      EXPECT_NEAR(ReboundOf(SoftnessFor(e, walk), walk), e, 1e-3)
          << e << " at " << walk.timestep_s << (walk.implicit ? ", discrete" : "");
}

// The engine's default steps damp; finer ones less, explicit ones not.
TEST(Restitution, TheLiveliestDependsOnTheStep) {
  const auto liveliest = [](const ContactWalk& walk) {
    return ReboundOf(SoftnessFor(1, walk), walk);
  };
  EXPECT_NEAR(liveliest({0.004, true}), 0.74, 0.01);
  EXPECT_GT(liveliest({0.002, true}), liveliest({0.004, true}));
  EXPECT_GT(liveliest({0.001, true}), 0.9);
  EXPECT_GT(liveliest({0.004, false}), 0.9);
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
  const auto contact = [](double zeta) {
    return ContactSoftness{0.01 / std::min(1.0, zeta), zeta};
  };
  for (const bool implicit : {false, true}) {
    EXPECT_NEAR(ReboundOf(contact(1), {1e-5, implicit}), std::exp(-2.0), 2e-3);
    for (const double zeta : {0.05, 0.2, 0.5, 0.8, 1.5, 3.0}) {
      EXPECT_NEAR(ReboundOf(contact(zeta), {1e-5, implicit}), closed(zeta), 2e-3) << zeta;
      EXPECT_LE(std::abs(ReboundOf(contact(zeta), {0.001, implicit}) - closed(zeta)),
                std::abs(ReboundOf(contact(zeta), {0.004, implicit}) - closed(zeta)) + 1e-3)
          << zeta;
    }
  }
}

// A time constant below twice the step would be raised by the engine.
TEST(Restitution, TheEngineTakesItAsItIs) {
  for (const ContactWalk& walk : Walks())
    for (const double e : {0.0, 0.05, 0.1, 0.15, 0.3, 0.9, 1.0})
      EXPECT_GE(SoftnessFor(e, walk).time_constant_s, 2 * walk.timestep_s) << e;
}

}  // namespace
}  // namespace floorproof

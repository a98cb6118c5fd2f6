// SPDX-License-Identifier: Apache-2.0
#include "env/failures/effects.h"

#include <gtest/gtest.h>

namespace floorproof {
namespace {

// Severity ranks 1 to 5 stand in the effect's name.
int Severity(std::string_view effect) { return effect[1] - '0'; }

TEST(Effects, FollowTheSeverityOfTheModes) {
  const int veer = Severity(EffectOf(FailureMode::kVeerOff, ""));
  const int stuck = Severity(EffectOf(FailureMode::kStuck, "high_centred"));
  const int tipped = Severity(EffectOf(FailureMode::kRollOver, "tipped"));
  const int fell = Severity(EffectOf(FailureMode::kRollOver, "fell"));
  const int over = Severity(EffectOf(FailureMode::kRollOver, ""));
  const int bounce = Severity(EffectOf(FailureMode::kBounceBack, "reversed"));
  EXPECT_EQ(veer, bounce);
  EXPECT_LT(veer, stuck);
  EXPECT_LE(stuck, tipped);
  EXPECT_LT(tipped, over);
  EXPECT_EQ(fell, over);
  EXPECT_EQ(over, 5);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A livelier pane throws a robot back faster, and so does a faster approach, but never faster than
// it came. A dead pane hardly ever throws it back.
#include "validate/bounce_chart.h"

#include <gtest/gtest.h>

namespace floorproof {
namespace {

TEST(BounceChart, MovesWithRestitutionAndSpeed) {
  const auto rows = BounceChart(1);
  ASSERT_FALSE(rows.empty());
  int dead = 0, dead_reported = 0;
  for (const BounceRow& row : rows) {
    const auto like = [&](double restitution, double speed_mps) {
      for (const BounceRow& other : rows)
        if (other.robot == row.robot && other.mass_kg == row.mass_kg &&
            other.restitution == restitution && other.speed_mps == speed_mps)
          return other.rebound_mps;
      ADD_FAILURE() << "no such row";
      return 0.0;
    };
    SCOPED_TRACE(BounceCsv({&row, 1}));
    EXPECT_NEAR(row.closing_mps, row.speed_mps, 0.02);
    dead += row.restitution == 0;
    dead_reported += row.restitution == 0 && row.bounce_back;
    if (row.restitution >= 0.3) {
      EXPECT_TRUE(row.bounce_back);
    }
    if (row.restitution >= 0.5 && row.speed_mps > 0.1) {  // slower ones pitch at the pane
      EXPECT_GT(row.rebound_mps, like(0.1, row.speed_mps));
    }
    if (row.restitution >= 0.5 && row.speed_mps > 0.3) {
      EXPECT_GT(row.rebound_mps, like(row.restitution, 0.1));
    }
    EXPECT_LT(row.rebound_mps, row.closing_mps);
  }
  EXPECT_LT(dead_reported, dead / 4) << "a dead pane throws hardly anything back";
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "planners/online/lane_frontier.h"

#include <gtest/gtest.h>

namespace floorproof {
namespace {

// Two rooms of 2 m x 4 m, and a short corridor between them, at their upper end.
class LaneFrontierTest : public ::testing::Test {
 protected:
  LaneFrontierTest() : known_(kFrame) { known_.changed.emplace(); }
  // Of the floor so far to the right.
  void Know(int first, int last) {
    for (int iy = 0; iy < kFrame.height; ++iy)
      for (int ix = first; ix < last; ++ix) {
        const bool wall = ix == 0 || iy == 0 || ix == kFrame.width - 1 || iy == kFrame.height - 1 ||
                          (std::abs(ix - 50) <= 10 && iy < 60);
        known_.Add(ix, iy, wall ? 4 : -4, 4);
      }
  }
  OnlineStep Next(LaneFrontier& dut) {
    Estimate estimate;
    estimate.X_WB = {here_.x(), here_.y(), 0};
    const std::vector<Cell> changed = *known_.changed;
    known_.changed->clear();
    return dut.Next({known_, changed, estimate});
  }

  inline static const GridFrame kFrame = {100, 80, 0.05, {}};
  inline static const OnlineTask kTask = {
      kFrame, {1, 1, 0}, {Vec2::Constant(0.195), true}, {Vec2::Constant(0.15), true},
      0.3,    1,         {Vec2::Constant(0.18), true}};
  KnownMap known_;
  Vec2 here_ = {1, 1};
};

// The way to a far place is found once and gone leg by leg; what comes into sight meanwhile may lie
// across a leg that nobody drives yet.
TEST_F(LaneFrontierTest, NoLegOfAWayLeadsThroughWhatHasComeIntoSightSince) {
  for (const bool seen : {false, true}) {
    known_ = KnownMap(kFrame);
    known_.changed.emplace();
    LaneFrontier dut(kTask);
    Know(0, 60);
    // All is swept, also what is worth its way only from nearby.
    for (const Vec2& from : {Vec2(1, 1), Vec2(1, 0.5)}) {
      here_ = from;
      OnlineStep step = Next(dut);
      for (; step.kind == OnlineStep::Kind::kTarget; step = Next(dut)) here_ = step.target_W;
    }
    Know(60, 100);
    const double ways = dut.dead_ends();
    for (int i = 0; i < 9 && here_.x() < 1.9; ++i) here_ = Next(dut).target_W;
    EXPECT_GT(here_.y(), 3) << "the corridor's entry";
    ASSERT_EQ(dut.dead_ends(), ways + 1);
    const Cell across = {50, 65};
    if (seen) known_.Add(across.ix, across.iy, 8, 4);
    const OnlineStep next = Next(dut);
    const bool meets =
        kTask.body.PassesOverSquare(kFrame.Center(across) - here_, 0.025, next.target_W - here_);
    EXPECT_EQ(meets, !seen);
    EXPECT_EQ(next.target_W.x() > 2.7, !seen);
  }
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "run/episode/driven_way.h"

#include <gtest/gtest.h>

namespace floorproof {
namespace {

TEST(DrivenWay, IsTheSumOfWhatWasDrivenStraight) {
  DrivenWay dut;
  for (const Vec2& p : {Vec2(1, 1), Vec2(2, 1), Vec2(2, 3), Vec2(2, 1)}) dut.Add(p);
  EXPECT_DOUBLE_EQ(dut.length_m(), 5);
}

TEST(DrivenWay, TremblingIsNone) {
  DrivenWay dut;
  for (int i = 0; i < 1000; ++i) dut.Add({0.004 * (i % 2), 0});
  EXPECT_LE(dut.length_m(), 0.004);
}

TEST(DrivenWay, BeingCarriedIsNone) {
  DrivenWay dut;
  dut.Add({0, 0});
  dut.Add({1, 0});
  dut.Lift();
  dut.Add({5, 5});
  dut.Add({5, 6});
  EXPECT_DOUBLE_EQ(dut.length_m(), 2);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "controllers/creep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace floorproof {
namespace {

constexpr double kStep_s = 0.02;

// A robot 20 mm before its stop that is commanded `speed(left)`, or the creep's minimum if that is
// more; its motor falls short by short_mps, and does not roll back.
struct Approach {
  double left_m = 0.02, t_s = 0, arrival_mps = 0, max_command_mps = 0;

  bool Arrives(Creep& dut, const std::function<double(double)>& speed, double short_mps) {
    for (; t_s < 20; t_s += kStep_s) {
      dut.Update(left_m, t_s);
      const double command_mps = std::max(speed(left_m), dut.speed());
      arrival_mps = std::max(0.0, command_mps - short_mps);
      max_command_mps = std::max(max_command_mps, command_mps);
      left_m -= arrival_mps * kStep_s;
      if (left_m < 0) return true;
    }
    return false;
  }
};

double Slowing(double left_m) { return 2 * left_m; }

TEST(Creep, SaysNothingWhileTheRobotGetsCloser) {
  Creep dut(Creep::kAlong);
  Approach approach;
  for (; approach.left_m > 0.001; approach.t_s += kStep_s) {
    approach.left_m -= 0.04 * kStep_s;
    dut.Update(approach.left_m, approach.t_s);
    EXPECT_EQ(dut.speed(), 0);
  }
}

// It stays near the speed that just moves the robot: it does not arrive fast.
TEST(Creep, BringsAWeakRobotToItsStopSlowly) {
  for (const double short_mps : {0.01, 0.03, 0.06}) {
    Creep dut(Creep::kAlong);
    Approach approach;
    ASSERT_TRUE(approach.Arrives(dut, &Slowing, short_mps)) << short_mps;
    EXPECT_LT(approach.arrival_mps, 0.03) << short_mps;
    EXPECT_LT(approach.max_command_mps, short_mps + 0.04) << short_mps;
  }
}

TEST(Creep, IsBounded) {
  Creep dut(Creep::kAlong);
  for (double t_s = 0; t_s < 60; t_s += kStep_s) dut.Update(0.01, t_s);
  EXPECT_EQ(dut.speed(), Creep::kAlong.max_speed);
}

// Standing for another reason is no stall, nor is what was left of another turn.
TEST(Creep, APauseOrAnotherWayStartsItAfresh) {
  Creep dut(Creep::kTurn);
  for (double t_s = 0; t_s < 5; t_s += kStep_s) dut.Update(0.1, t_s);
  EXPECT_GT(dut.speed(), 0);
  dut.Update(0.1, 10);
  EXPECT_EQ(dut.speed(), 0);
  for (double t_s = 10; t_s < 15; t_s += kStep_s) dut.Update(0.1, t_s);
  EXPECT_GT(dut.speed(), 0);
  dut.Update(1, 15);
  EXPECT_EQ(dut.speed(), 0);
}

}  // namespace
}  // namespace floorproof

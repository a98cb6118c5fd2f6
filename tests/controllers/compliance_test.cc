// SPDX-License-Identifier: Apache-2.0
#include "controllers/compliance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/controllers/driving.h"

namespace floorproof {
namespace {

constexpr double kControl_s = 0.02, kBearable_rad = 0.2;

class ComplianceTest : public ::testing::Test {
 protected:
  ComplianceTest() {
    robot_.circumscribed_radius_m = 0.18;
    dut_.Start(robot_, kBearable_rad);
  }
  // Drives along x for a time with this true velocity.
  void Drive(double commanded_mps, const Vec2& v_W, double time_s) {
    for (double t_s = 0; t_s < time_s; t_s += kControl_s) {
      p_W_ += kControl_s * v_W;
      dut_.Update(p_W_, {1, 0}, commanded_mps, kControl_s);
    }
  }

  RobotSpec robot_ = HolonomicRobot();
  Compliance dut_;
  Vec2 p_W_ = {3, -1};
};

// Wheels 0.1 s late, from rest to speed and back, at any acceleration: nothing is given way to.
TEST_F(ComplianceTest, StartingAndBrakingIsNotBeingHeld) {
  for (const double accel_mps2 : {0.2, 0.5, 2.0, 20.0}) {
    double commanded_mps = 0, true_mps = 0;
    dut_.Drop();
    for (int k = 0; k < 400; ++k) {
      const double wanted_mps = k < 200 ? 0.3 : 0.0, dv = accel_mps2 * kControl_s;
      commanded_mps += std::clamp(wanted_mps - commanded_mps, -dv, dv);
      true_mps += (commanded_mps - true_mps) * kControl_s / 0.1;
      Drive(commanded_mps, {true_mps, 0}, kControl_s);
      ASSERT_FALSE(dut_.active()) << accel_mps2 << " " << k * kControl_s;
    }
  }
}

// What is not held corrects its whole error and goes back as fast as it may.
TEST_F(ComplianceTest, GettingOnChangesNothing) {
  Drive(0.2, {0.2, 0.05}, 2);
  EXPECT_FALSE(dut_.held());
  EXPECT_EQ(dut_.YawError(0.1), 0.1);
  EXPECT_EQ(dut_.SquaringRate(), 0);
  EXPECT_EQ(dut_.BackSpeed(0.2, 0.25), 0.25);
}

// However slow it is meant to be: after 4 cm of way that it was to make, it knows.
TEST_F(ComplianceTest, WhoIsHeldNoticesAtAnyPace) {
  for (const double speed_mps : {0.01, 0.02, 0.05, 0.1, 0.3}) {
    dut_.Drop();
    Drive(speed_mps, {speed_mps, 0}, 0.2 / speed_mps);
    EXPECT_FALSE(dut_.active()) << speed_mps;
    Drive(speed_mps, {0, 0.1 * speed_mps}, std::max(0.4, 0.04 / speed_mps));
    EXPECT_TRUE(dut_.held()) << speed_mps;
    EXPECT_LT(dut_.SquaringRate(), 0) << speed_mps;
  }
}

// A robot of weak motors is slow all the time, and not held.
TEST_F(ComplianceTest, BeingSlowIsNotBeingHeld) {
  Drive(0.2, {0.13, 0}, 5);
  EXPECT_FALSE(dut_.active());
}

TEST_F(ComplianceTest, WhoIsHeldTurnsAgainstItsSlide) {
  for (const double aside_mps : {0.1, -0.1}) {
    Drive(0.2, {0.2, 0}, 1);
    Drive(0.2, {0, aside_mps}, 1);
    EXPECT_TRUE(dut_.held());
    EXPECT_LT(dut_.SquaringRate() * aside_mps, 0);
    // Not faster than about the caught wheel, which overshoots.
    EXPECT_LT(std::abs(dut_.SquaringRate()), std::abs(aside_mps) / robot_.circumscribed_radius_m);
  }
  Drive(0.2, {0, 0}, 2);
  EXPECT_NEAR(dut_.SquaringRate(), 0, 1e-6) << "it stands square";
}

TEST_F(ComplianceTest, WhoWasHeldBearsItsYawForItsOwnLength) {
  Drive(0.2, {0.2, 0}, 1);
  Drive(0.2, {0, 0}, 1);
  EXPECT_EQ(dut_.YawError(0.1), 0);
  EXPECT_NEAR(dut_.YawError(0.3), 0.1, 1e-12) << "what is beyond is corrected";
  EXPECT_NEAR(dut_.YawError(-0.3), -0.1, 1e-12);
  EXPECT_LT(dut_.BackSpeed(0.2, 0.25), 0.1);
  const double length_m = 2 * robot_.circumscribed_radius_m;
  Drive(0.2, {0.2, 0}, 0.9 * length_m / 0.2);
  EXPECT_TRUE(dut_.active());
  EXPECT_FALSE(dut_.held());
  Drive(0.2, {0.2, 0}, 1 * length_m / 0.2);
  EXPECT_FALSE(dut_.active());
  EXPECT_EQ(dut_.YawError(0.1), 0.1);
}

TEST_F(ComplianceTest, ARobotOfNoSizeDoesNotTurn) {
  robot_.circumscribed_radius_m = 0;
  dut_.Start(robot_, kBearable_rad);
  Drive(0.2, {0, 0.1}, 1);
  EXPECT_EQ(dut_.SquaringRate(), 0);
}

TEST_F(ComplianceTest, AnEndedLegIsForgotten) {
  Drive(0.2, {0.2, 0}, 1);
  Drive(0.2, {0, 0.1}, 1);
  dut_.Drop();
  EXPECT_FALSE(dut_.active());
  EXPECT_EQ(dut_.SquaringRate(), 0);
}

}  // namespace
}  // namespace floorproof

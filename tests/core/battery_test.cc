// SPDX-License-Identifier: Apache-2.0
// A battery is a voltage behind a resistance; a motor takes copper loss and work.
#include "env/core/battery.h"

#include <gtest/gtest.h>

namespace floorproof {
namespace {

TEST(MotorPower, IsCopperLossAndWork) {
  // 1 N m at 2 rad/s with R = 3.6 ohm, K = 1.2: i = 1/1.2 A; i^2 R + 1 * 2 W.
  EXPECT_NEAR(MotorPower(1, 2, 3.6, 1.2), 3.6 / 1.44 + 2, 1e-12);
  EXPECT_EQ(MotorPower(-0.1, 9, 3.6, 1.2), 0) << "braking gives nothing back";
}

TEST(DriveTorque, HoldsTheSpeedWithinVoltageAndTorque) {
  const VelocityDrive dut{3.6, 1.2, 5, 12, 3};
  EXPECT_NEAR(DriveTorque(dut, 4.1, 4), 0.5, 1e-12) << "gain times what is missing";
  EXPECT_NEAR(DriveTorque(dut, 100, 8), 1.2 * (12 - 1.2 * 8) / 3.6, 1e-12) << "all the voltage";
  EXPECT_EQ(DriveTorque(dut, 100, 0), 3) << "the driver's limit";
  EXPECT_EQ(DriveTorque(dut, -100, 0), -3);
}

TEST(Feed, GivesTheLoadItsPowerAndObeysOhm) {
  for (const double load_w : {0.0, 5.0, 40.0, 70.0}) {
    const BatteryOutput dut = Feed(12, 0.5, load_w);
    EXPECT_NEAR(dut.power_w(), load_w, 1e-9);
    EXPECT_NEAR(dut.voltage_v, 12 - 0.5 * dut.current_a, 1e-9);
    EXPECT_GE(dut.voltage_v, 6) << "the larger root";
  }
  EXPECT_EQ(Feed(12, 0, 48).voltage_v, 12);
  EXPECT_EQ(Feed(12, 0, 48).current_a, 4);
}

// The most that can be fed is V^2 / (4 R), at half the voltage; nothing feeds more.
TEST(Feed, GivesNoMoreThanItCan) {
  constexpr double kMax_w = 12 * 12 / (4 * 0.5);
  EXPECT_NEAR(Feed(12, 0.5, kMax_w).voltage_v, 6, 1e-6);
  EXPECT_EQ(Feed(12, 0.5, 1.001 * kMax_w).power_w(), 0);
}

TEST(BatteryInUse, CutsOffUnderALoadThatItCannotFeed) {
  BatteryInUse dut({.voltage_v = 12, .resistance_ohm = 0.5});
  EXPECT_GT(dut.Feed(50, 1).voltage_v, 6);
  EXPECT_FALSE(dut.cut_off());
  EXPECT_EQ(dut.Feed(1000, 1).power_w(), 0);
  EXPECT_TRUE(dut.cut_off());
  EXPECT_EQ(dut.Feed(50, 1).power_w(), 0) << "for good";
  EXPECT_FALSE(dut.empty());
}

TEST(BatteryInUse, CutsOffWhenItsCapacityIsDrawn) {
  BatteryInUse dut({.voltage_v = 12, .capacity_wh = 1});
  EXPECT_EQ(dut.left(), 1);
  EXPECT_EQ(dut.Feed(36, 50).power_w(), 36);
  EXPECT_NEAR(*dut.left(), 0.5, 1e-12);
  dut.Feed(36, 50);
  EXPECT_TRUE(dut.empty());
  EXPECT_EQ(dut.left(), 0);
  EXPECT_EQ(dut.Feed(36, 1).power_w(), 0);
  EXPECT_EQ(dut.voltage_v(), 0);
}

// What the internal resistance turns to heat is drawn too.
TEST(BatteryInUse, OwnLossesCount) {
  BatteryInUse ideal({.voltage_v = 12, .capacity_wh = 1});
  BatteryInUse real({.voltage_v = 12, .resistance_ohm = 0.5, .capacity_wh = 1});
  ideal.Feed(36, 50);
  real.Feed(36, 50);
  EXPECT_LT(*real.left(), *ideal.left());
  BatteryInUse endless({.voltage_v = 12});
  endless.Feed(1e6, 1e6);
  EXPECT_FALSE(endless.empty());
  EXPECT_FALSE(endless.left().has_value());
}

}  // namespace
}  // namespace floorproof

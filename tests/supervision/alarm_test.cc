// SPDX-License-Identifier: Apache-2.0
#include "controllers/monitors/alarm.h"

#include <gtest/gtest.h>

namespace floorproof {
namespace {

class AlarmTest : public ::testing::Test {
 protected:
  enum class Looks { kBad, kWell, kUnknown };
  void See(Looks looks, double for_s) {
    for (const double until_s = t_s_ + for_s; t_s_ < until_s - 1e-9; t_s_ += kPeriod_s)
      dut_.Update(t_s_, kPeriod_s, looks == Looks::kBad, looks == Looks::kWell, 3, 2);
  }
  static constexpr double kPeriod_s = 0.02;
  double t_s_ = 0;
  Alarm dut_{{.hold_s = 0.2, .clear_s = 2, .permanent_s = 10}};
};

TEST_F(AlarmTest, IsWhatLasts) {
  for (int i = 0; i < 100; ++i) {
    See(Looks::kBad, 0.18);
    See(Looks::kWell, 0.02);
  }
  EXPECT_FALSE(dut_.raised());
  See(Looks::kBad, 0.2);
  EXPECT_TRUE(dut_.raised());
  EXPECT_EQ(dut_.value(), 3);
  EXPECT_EQ(dut_.limit(), 2);
}

TEST_F(AlarmTest, EndsOnceAllWasSeenToBeWellForLong) {
  See(Looks::kBad, 1);
  See(Looks::kWell, 1.9);
  EXPECT_TRUE(dut_.raised());
  See(Looks::kUnknown, 100);
  EXPECT_TRUE(dut_.raised()) << "what cannot be told is no proof";
  See(Looks::kWell, 0.2);
  EXPECT_FALSE(dut_.raised());
}

TEST_F(AlarmTest, IsPermanentOnceItIsStillSeen) {
  See(Looks::kBad, 9.9);
  EXPECT_EQ(dut_.persistence(), Persistence::kIntermittent);
  See(Looks::kUnknown, 100);
  EXPECT_EQ(dut_.persistence(), Persistence::kIntermittent) << "time alone proves nothing";
  See(Looks::kBad, 0.1);
  EXPECT_EQ(dut_.persistence(), Persistence::kPermanent);
}

TEST_F(AlarmTest, WhatComesAgainAfterItWasRearmedIsTheSameFault) {
  for (int i = 0; i < 3; ++i) {
    See(Looks::kBad, 0.5);
    EXPECT_TRUE(dut_.raised());
    EXPECT_EQ(dut_.persistence(), i < 2 ? Persistence::kIntermittent : Persistence::kPermanent);
    See(Looks::kUnknown, 5);
    dut_.Rearm();
    EXPECT_FALSE(dut_.raised());
  }
  See(Looks::kWell, 2.1);
  See(Looks::kBad, 0.5);
  EXPECT_EQ(dut_.persistence(), Persistence::kIntermittent) << "it was well meanwhile: another one";
}

TEST_F(AlarmTest, OfWhatIsIgnoredThereIsNone) {
  See(Looks::kBad, 1);
  dut_.Ignore();
  EXPECT_FALSE(dut_.raised());
  See(Looks::kBad, 100);
  EXPECT_FALSE(dut_.raised());
}

}  // namespace
}  // namespace floorproof

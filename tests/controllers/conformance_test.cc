// SPDX-License-Identifier: Apache-2.0
// What every registered drive, estimator and tracker owes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include "controllers/estimator.h"
#include "tests/controllers/allocation_guard.h"
#include "tests/controllers/driving.h"

namespace floorproof {

void PrintTo(const PluginEntry<Tracker>& entry, std::ostream* os) { *os << entry.name; }

namespace {

class TrackerConformance : public testing::TestWithParam<PluginEntry<Tracker>> {};

const Path kRows =
    MakePath({{0, 0}, {1.5, 0}, {1.5, 0.3}, {0, 0.3}, {0, 0.6}, {0.7, 0.6}, {1.2, 0.8}});

TEST_P(TrackerConformance, CommandsARegisteredDrive) {
  const auto dut = GetParam().make();
  const auto drives = PluginNames(Drives());
  ASSERT_FALSE(dut->Drives().empty());
  for (const std::string& drive : dut->Drives()) EXPECT_THAT(drives, testing::Contains(drive));
}

TEST_P(TrackerConformance, ReachesTheEndOfAPathInOrder) {
  const auto dut = GetParam().make();
  const Driven driven = DriveAlong(*dut, kRows, {}, nullptr, RobotFor(*dut));
  ASSERT_TRUE(driven.done);
  EXPECT_TRUE(driven.SegmentsNeverDecrease());
  EXPECT_EQ(driven.steps.back().segment, kRows.size() - 2);
  EXPECT_LT((driven.steps.back().X_WB.p() - kRows.back().p_W).norm(), 0.05);
  EXPECT_LT(driven.max_cross_track_m, 0.10);
}

TEST_P(TrackerConformance, KeepsTheRobotsLimits) {
  const auto dut = GetParam().make();
  const RobotSpec robot = RobotFor(*dut);
  const Driven driven = DriveAlong(*dut, kRows, {}, nullptr, RobotFor(*dut));
  constexpr double kDt = 0.02, kSlack = 1e-9;
  BodyTwist last;
  for (const auto& step : driven.steps) {
    EXPECT_LE(std::hypot(step.twist.vx_mps, step.twist.vy_mps), robot.max_speed_mps + kSlack);
    EXPECT_LE(std::abs(step.twist.wz_radps), robot.max_yaw_rate_radps + kSlack);
    EXPECT_LE(std::hypot(step.twist.vx_mps - last.vx_mps, step.twist.vy_mps - last.vy_mps),
              robot.max_accel_mps2 * kDt + kSlack);
    EXPECT_LE(std::abs(step.twist.wz_radps - last.wz_radps),
              robot.max_yaw_accel_radps2 * kDt + kSlack);
    last = step.twist;
  }
}

TEST_P(TrackerConformance, StartForgetsThePathBefore) {
  const auto dut = GetParam().make();
  const RobotSpec robot = RobotFor(*dut);
  const Driven once = DriveAlong(*dut, kRows, {}, nullptr, robot);
  const Driven again = DriveAlong(*dut, kRows, {}, nullptr, robot);
  ASSERT_EQ(once.steps.size(), again.steps.size());
  for (std::size_t i = 0; i < once.steps.size(); ++i)
    EXPECT_EQ(once.steps[i].twist.vx_mps, again.steps[i].twist.vx_mps);
}

TEST_P(TrackerConformance, UpdateAllocatesNothing) {
  const auto dut = GetParam().make();
  const RobotSpec robot = RobotFor(*dut);
  const Driven driven = DriveAlong(
      *dut, kRows, {}, nullptr, RobotFor(*dut));  // poses to replay, without the test's own vectors
  dut->Start(kRows, robot, nullptr);
  const auto before = AllocationCount();
  for (const auto& step : driven.steps) dut->Update({step.X_WB, {}}, step.t_s, 0.02);
  EXPECT_EQ(AllocationCount(), before);
}

TEST_P(TrackerConformance, SaysWhichLimitARobotLacks) {
  const auto dut = GetParam().make();
  RobotSpec robot = RobotFor(*dut);
  robot.max_accel_mps2 = 0;
  EXPECT_THROW(dut->Start(kRows, robot, nullptr), InputError);
}

TEST_P(TrackerConformance, ParametersAreDocumented) {
  const auto dut = GetParam().make();
  for (const ParamDoc& doc : DocumentParams(*dut)) EXPECT_FALSE(doc.help.empty()) << doc.name;
}

INSTANTIATE_TEST_SUITE_P(All, TrackerConformance, testing::ValuesIn(Trackers()),
                         [](const auto& suite) { return std::string(suite.param.name); });

TEST(DefaultTracker, CommandsItsDrive) {
  EXPECT_EQ(DefaultTracker("differential"), "regulated_pursuit");
  EXPECT_EQ(DefaultTracker("mecanum"), "holonomic_follower");
  EXPECT_THROW(DefaultTracker("legs"), InputError);
}

TEST(TruthEstimator, IsTheTruth) {
  const auto dut = MakePlugin(Estimators(), "truth", "estimator");
  dut->Start({});
  Sample truth;
  truth.p_WB = {1, -2, 0.3};
  truth.yaw_rad = 0.4;
  truth.V_WB_B = {0.1, 0.02, -0.5};
  const Estimate estimate = dut->Update(truth, 0.02);
  EXPECT_EQ(estimate.X_WB.x_m, 1);
  EXPECT_EQ(estimate.X_WB.y_m, -2);
  EXPECT_EQ(estimate.X_WB.yaw_rad, 0.4);
  EXPECT_EQ(estimate.V_WB_B.wz_radps, -0.5);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// BELUGA's pace and hotel load are those that environment 1 of the audit paper's Table 3 gives,
// whatever values the fit starts from; and the calibrated trials themselves are met.
#include <gtest/gtest.h>

#include "validate/audit_tour.h"

namespace floorproof {
namespace {

// A tour's time moves in steps of N control periods with the dwell: 0.02 s a stop.
TEST(AuditCalibration, GivesWhatTheModelStates) {
  const RobotSpec robot = ReadRobot(FindRobotFile("beluga", {})).spec;
  const AuditCalibration dut = CalibrateAudit({0.11, 12});
  EXPECT_NEAR(dut.pace.speed_mps, robot.audit_speed_mps, 2e-4);
  EXPECT_NEAR(dut.pace.dwell_s, robot.audit_dwell_s, 0.04);
  EXPECT_NEAR(dut.hotel_load_w, robot.hotel_load_w, 0.1);
}

TEST(AuditCalibration, FitsItsOwnTrials) {
  const RobotSpec robot = ReadRobot(FindRobotFile("beluga", {})).spec;
  for (const AuditTrial& trial : AuditTrials()) {
    if (trial.environment != 1) continue;
    const AuditRun run = DriveAudit(trial, {robot.audit_speed_mps, robot.audit_dwell_s});
    EXPECT_NEAR(run.time_s, trial.time_s, 0.03 * trial.time_s) << trial.algorithm;
    EXPECT_NEAR(run.energy_j, trial.energy_j, 0.06 * trial.energy_j) << trial.algorithm;
  }
}

}  // namespace
}  // namespace floorproof

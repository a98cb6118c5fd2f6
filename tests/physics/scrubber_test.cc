// SPDX-License-Identifier: Apache-2.0
// The tricycle on flat floor, over edges, and along plans that are made for it. How tightly it
// turns is the law `tricycle`, too.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "controllers/odometry.h"
#include "run/scenario/scenario.h"
#include "tests/run/scenario_text.h"
#include "validate/ladder.h"
#include "validate/rig.h"

namespace floorproof {
namespace {

TEST(Scrubber, RestsOnThreeWheels) {
  Rig dut("scrubber");
  for (int i = 0; i < 500; ++i) dut.Step();
  EXPECT_NEAR(dut.truth().p_WB.z(), 0, 0.001);
  EXPECT_LT(dut.truth().tilt_rad, 1e-3);
  EXPECT_EQ(dut.truth().belly_load_n, 0);
  EXPECT_GE(dut.truth().wheel_contacts, 3);
  EXPECT_GT(dut.truth().support_margin_m, 0.08);
  EXPECT_NEAR(dut.truth().hinges.steer_rad, 0, 1e-4);
}

TEST(Scrubber, RollsAsItsWheelTurns) {
  for (const double speed_mps : {0.5, -0.3}) {
    Rig dut("scrubber");
    const BodyTwist v = dut.Run({speed_mps, 0, 0}, 4);
    EXPECT_NEAR(v.vx_mps, speed_mps, 0.01 * std::abs(speed_mps));
    EXPECT_NEAR(v.vy_mps, 0, 1e-3);
    EXPECT_NEAR(v.wz_radps, 0, 1e-3);
  }
}

// From stop to stop: its motor's pace, without overshoot, and no motion of the body that stands.
TEST(Scrubber, SteersAtItsForksPace) {
  Rig dut("scrubber");
  const SteeringSpec& fork = *dut.robot().steering;
  const double start_s = dut.truth().t_s, wanted_rad = 1.0;
  const double base_m = dut.robot().wheels[0].p_BW.x();
  dut.Command({1e-4, 0, 1e-4 * std::tan(wanted_rad) / base_m});
  double reached_s = 0, most_rad = 0;
  while (dut.truth().t_s < start_s + 3) {
    dut.Step();
    const double rad = dut.truth().hinges.steer_rad;
    if (reached_s == 0 && rad > 0.9 * wanted_rad) reached_s = dut.truth().t_s - start_s;
    most_rad = std::max(most_rad, rad);
    EXPECT_LE(std::abs(dut.truth().hinges.steer_radps), 1.05 * fork.max_rate_radps);
  }
  EXPECT_GT(reached_s, 0.9 * wanted_rad / fork.max_rate_radps);
  EXPECT_LT(reached_s, 0.9 * wanted_rad / fork.max_rate_radps + 0.4);
  EXPECT_LT(most_rad, wanted_rad + 0.01);
  EXPECT_NEAR(dut.truth().hinges.steer_rad, wanted_rad, 0.02);
  EXPECT_LT(dut.truth().p_WB.head<2>().norm(), 0.01);
}

TEST(Scrubber, MirroredCommandsGiveMirroredMotion) {
  Rig left("scrubber"), right("scrubber");
  left.Run({0.3, 0, 0.6}, 4);
  right.Run({0.3, 0, -0.6}, 4);
  const Truth &l = left.truth(), &r = right.truth();
  EXPECT_NEAR(l.p_WB.x(), r.p_WB.x(), 1e-4);
  EXPECT_NEAR(l.p_WB.y(), -r.p_WB.y(), 1e-4);
  EXPECT_NEAR(l.yaw_rad, -r.yaw_rad, 1e-4);
}

TEST(Scrubber, UpToItsStepItGoesUpAndDown) {
  const RobotModel robot = ReadRobot(FindRobotFile("scrubber", {}));
  const double size_mm = 1000 * robot.spec.step_m;
  for (const char* hazard : {"step", "drop"})
    for (const Direction direction : {Direction::kForward, Direction::kDiagonal})
      for (const double speed_mps : {0.1, 0.3}) {
        const LadderHazard& it = FindLadderHazard(hazard);
        const LadderCell cell{"scrubber", "ideal", it.name, direction, speed_mps, 0.8, {}};
        const CrossingPlan plan = PlanOf(cell, robot.spec, size_mm);
        EXPECT_EQ(Cross(robot, it.make(size_mm, plan.travel_rad), plan).held_by, "")
            << hazard << " " << Name(direction) << " " << speed_mps;
      }
}

// How far the wheel turned, and where its fork pointed: the way that it made.
TEST(Scrubber, WheelAndForkTellTheWay) {
  Rig dut("scrubber");
  const auto drive = MakePlugin(Drives(), dut.robot().drive, "drive");
  drive->Configure(dut.robot());
  const mjModel* m = dut.sim().model();
  const int wheel = m->jnt_qposadr[m->actuator_trnid[0]];
  Pose2 told = dut.truth().X_WB();
  double way_m = 0;
  for (const double turn_radps : {0.0, 0.6, -0.8, 0.3}) {
    dut.Command({0.3, 0, turn_radps});
    const double start_s = dut.truth().t_s;
    while (dut.truth().t_s < start_s + 4) {
      const double before_rad = dut.data()->qpos[wheel];
      dut.Step();
      const double step_rad[] = {dut.data()->qpos[wheel] - before_rad};
      told = Moved(told, drive->ToTwist(step_rad, dut.truth().hinges), 1);
      way_m += std::abs(step_rad[0]) * dut.robot().wheels[0].radius_m;
    }
  }
  EXPECT_GT(way_m, 4);
  EXPECT_LT((told.p() - dut.truth().X_WB().p()).norm(), 0.01 * way_m);
  EXPECT_LT(std::abs(WrapAngle(told.yaw_rad - dut.truth().yaw_rad)), 0.03);
}

class ScrubberDrives : public ScenarioTest {
 protected:
  // A hall of 7 x 5 m inside its walls.
  static std::string Hall(const std::string& more) {
    std::string rows = "      " + std::string(16, '#') + "\n";
    for (int i = 0; i < 10; ++i) rows += "      #" + std::string(14, '.') + "#\n";
    rows += "      " + std::string(16, '#') + "\n";
    return "scenario: 1\nsite:\n  site: 1\n  name: hall\n  grid:\n    cell_m: 0.5\n    rows: |\n" +
           rows + "  start: {x_m: 1.5, y_m: 1.5, yaw_deg: 0}\nrobot: scrubber\n" + more;
  }
};

TEST_F(ScrubberDrives, RowsAreDrivenAsPlanned) {
  Scenario scenario = Read(Hall("plan: {planner: boustrophedon}\n"));
  const Execution dut = Execute(scenario);
  EXPECT_EQ(dut.record.outcome, Outcome::kSuccess) << dut.record.message;
  EXPECT_TRUE(dut.record.events.empty());
  EXPECT_LT(dut.record.metrics.max_cross_track_m, 0.05);
  EXPECT_GT(dut.record.metrics.coverage, 0.85);
}

// A user's own corners are passed beside, and the plan is driven to its end.
TEST_F(ScrubberDrives, SharpCornersArePassedWide) {
  Save("plan.csv", "x_m,y_m\n1.5,1.5\n5.5,1.5\n5.5,3.5\n1.5,3.5\n");
  const EpisodeRecord dut = Drive(Read(Hall("plan: {file: plan.csv}\n")));
  EXPECT_EQ(dut.outcome, Outcome::kSuccess) << dut.message;
  EXPECT_LT(dut.metrics.max_cross_track_m, 0.35);
  EXPECT_NEAR(dut.trace.back().x_m, 1.5, 0.1);
  EXPECT_NEAR(dut.trace.back().y_m, 3.5, 0.1);
}

// Behind a sharp corner, nearer than its turn is wide: no dwell there is counted, and no end.
TEST_F(ScrubberDrives, WhatItPassesBesideIsSaidAndNotCounted) {
  const auto drive = [&](const std::string& rows) {
    Save("plan.csv", "x_m,y_m,dwell_s\n1.5,1.5,0\n2.5,1.5,0\n" + rows);
    return Drive(Read(Hall("plan: {file: plan.csv}\n")));
  };
  const EpisodeRecord stop = drive("2.3,1.7,1\n5,1.8,0\n");
  EXPECT_EQ(stop.outcome, Outcome::kSuccess);
  EXPECT_EQ(stop.metrics.stops_missed, 1);
  EXPECT_EQ(stop.message, "passed beside 1 stop of the plan at x 2.30, y 1.70 m");

  const EpisodeRecord end = drive("2.3,1.7,0\n");
  EXPECT_EQ(end.outcome, Outcome::kFailure);
  EXPECT_EQ(end.metrics.stops_missed, 1);
  EXPECT_EQ(end.message, "passed beside the plan's end at x 2.30, y 1.70 m");

  const EpisodeRecord both = drive("2.3,1.7,1\n4.5,1.8,0\n4.3,2,0\n");
  EXPECT_EQ(both.outcome, Outcome::kFailure);
  EXPECT_EQ(both.metrics.stops_missed, 2);
  EXPECT_EQ(both.message, "passed beside 1 stop of the plan at x 2.30, y 1.70 m, and its end");
}

TEST_F(ScrubberDrives, PlannersThatTurnOnTheSpotAreRefused) {
  try {
    Read(Hall("plan: {planner: rolling_window}\n"));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("scrubber cannot make"));
  }
}

}  // namespace
}  // namespace floorproof

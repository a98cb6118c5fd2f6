// SPDX-License-Identifier: Apache-2.0
// A reduced ladder: what limits must do when speed, friction, clearance and wheels change.
#include <gmock/gmock.h>

#include "validate/ladder.h"
#include "validate/ladder_findings.h"

namespace floorproof {
namespace {

constexpr int kJobs = 2;

LadderCell Cell(const char* robot, const char* hazard, Direction direction, double speed_mps = 0.2,
                double friction = 0.8) {
  return {robot, "ideal", FindLadderHazard(hazard).name, direction, speed_mps, friction, {}};
}

double LimitOf(const LadderCell& cell) { return FindRow(cell).value().limit; }

bool Crosses(const LadderCell& cell, double size, bool early) {
  const RobotModel robot = ReadRobot(FindRobotFile(cell.robot, {}), cell.changes);
  CrossingPlan plan = PlanOf(cell, robot.spec, size);
  plan.early = early;
  return Cross(robot, FindLadderHazard(cell.hazard).make(size, plan.travel_rad), plan).crossed;
}

// The paper's observation, at every speed and on both ends of friction.
TEST(Ladder, ACableCoverCrossedForwardHoldsHtetroSideways) {
  std::vector<LadderCell> cells;
  for (const Direction direction : {Direction::kForward, Direction::kSideways})
    for (const double speed_mps : {0.1, 0.2, 0.3})
      cells.push_back(Cell("htetro", "cable_cover", direction, speed_mps));
  const auto gaps = CoverGaps(ClimbLadder(cells, kJobs, {}));
  ASSERT_EQ(gaps.size(), 3u);
  for (const CoverGap& gap : gaps) {
    EXPECT_GT(gap.to_deg - gap.from_deg, 3) << Sentence(gap);
    LadderCell cell = gap.cell;
    const double middle_deg = (gap.from_deg + gap.to_deg) / 2;
    EXPECT_TRUE(Crosses(cell, middle_deg, true)) << Sentence(gap);
    cell.direction = Direction::kSideways;
    EXPECT_FALSE(Crosses(cell, middle_deg, true)) << Sentence(gap);
  }
}

TEST(Ladder, FasterAndWithMoreFrictionHtetroClimbsHigher) {
  for (const Direction direction : {Direction::kForward, Direction::kSideways}) {
    double last = 0;
    for (const double speed_mps : {0.1, 0.2, 0.3}) {
      const double limit = LimitOf(Cell("htetro", "step", direction, speed_mps));
      EXPECT_GT(limit, last) << speed_mps;
      last = limit;
    }
  }
  EXPECT_LT(LimitOf(Cell("htetro", "step", Direction::kForward, 0.2, 0.4)),
            LimitOf(Cell("htetro", "step", Direction::kForward, 0.2, 0.8)));
}

// A cover higher than the belly is crossed by neither: hTetro's belly is a plane between its
// wheels, BELUGA's rises a little while its wheels stand on the flanks.
TEST(Ladder, BellyClearanceBoundsTheCoversHeight) {
  for (const char* robot : {"beluga", "htetro"}) {
    double last_mm = 0;
    for (const double clearance_m : {0.015, 0.020}) {
      LadderCell cell = Cell(robot, "cable_cover_height", Direction::kForward);
      cell.changes.clearance_m = clearance_m;
      const double limit_mm = LimitOf(cell);
      EXPECT_GT(limit_mm, last_mm) << robot;
      EXPECT_LE(limit_mm, 1000 * clearance_m + 5) << robot;
      last_mm = limit_mm;
    }
  }
}

// Deciding early changes no verdict: the detectors, waited for, say the same.
TEST(Ladder, TheEarlyDecisionAgreesWithTheDetectors) {
  const LadderCell cells[] = {
      Cell("htetro", "step", Direction::kForward),
      Cell("htetro", "step", Direction::kSideways),
      Cell("htetro", "step", Direction::kDiagonal),
      Cell("htetro", "rough", Direction::kForward),
      Cell("htetro", "groove", Direction::kSideways),
      Cell("beluga", "step", Direction::kForward),
      Cell("beluga", "groove", Direction::kDiagonal),
      Cell("beluga", "rough", Direction::kForward),
      Cell("beluga", "drop", Direction::kDiagonal, 0.1),
      Cell("beluga", "cable_cover", Direction::kDiagonal, 0.1),
  };
  for (const LadderCell& cell : cells) {
    const Rungs& rungs = FindLadderHazard(cell.hazard).rungs;
    const double limit = LimitOf(cell), resolution = 1.0 / rungs.per_unit;
    for (const double size : {limit, limit + resolution, 0.8 * limit, 1.1 * limit, 1.3 * limit})
      EXPECT_EQ(Crosses(cell, size, true), Crosses(cell, size, false))
          << cell.robot << " " << cell.hazard << " " << Name(cell.direction) << " " << size;
  }
}

// The same from hubs with rollers that are bodies.
TEST(Ladder, RollerWheelsClimbAlike) {
  for (const Direction direction : {Direction::kForward, Direction::kSideways}) {
    LadderCell cell = Cell("htetro", "step", direction);
    const double ideal_mm = LimitOf(cell);
    cell.wheels = "rollers";
    EXPECT_NEAR(LimitOf(cell), ideal_mm, 0.25 * ideal_mm) << Name(direction);
  }
}

}  // namespace
}  // namespace floorproof

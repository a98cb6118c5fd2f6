// SPDX-License-Identifier: Apache-2.0
// What a charted limit is worth: at 0.7 of it, up to 10 degrees off square, no drive fails.
#include <gmock/gmock.h>

#include "base/streams.h"
#include "validate/ladder.h"

namespace floorproof {
namespace {

LadderCell Cell(const char* robot, const char* hazard, Direction direction) {
  return {robot, "ideal", FindLadderHazard(hazard).name, direction, 0.2, 0.8, {}};
}

TEST(ObliqueDrives, At70PercentOfTheChartedLimitNoneOf80Fails) {
  const std::vector<LadderCell> charted = {
      Cell("htetro", "step", Direction::kForward),
      Cell("htetro", "cable_cover", Direction::kForward),
      Cell("htetro", "step", Direction::kSideways),
      Cell("htetro", "cable_cover", Direction::kSideways),
      Cell("beluga", "step", Direction::kForward),
  };
  const std::vector<LadderRow> rows = ClimbLadder(charted, 2, {});
  ASSERT_EQ(rows.size(), charted.size());
  int drives = 0;
  for (const LadderRow& row : rows) {
    const RobotModel robot = ReadRobot(FindRobotFile(row.cell.robot, {}));
    const LadderHazard& hazard = FindLadderHazard(row.cell.hazard);
    for (std::uint64_t i = 0; i < 16; ++i, ++drives) {
      Stream draw(i, 0, "oblique drives");
      LadderCell cell = row.cell;
      cell.oblique_deg = draw.Uniform(-10, 10);
      cell.run_up_m = draw.Uniform(0.03, 0.5);
      const double size = 0.7 * row.limit;
      const CrossingPlan plan = PlanOf(cell, robot.spec, size);
      EXPECT_EQ(Cross(robot, hazard.make(size, plan.travel_rad), plan).held_by, "")
          << cell.robot << " " << cell.hazard << " " << Name(cell.direction) << " " << size << ", "
          << cell.oblique_deg << " deg off, from " << cell.run_up_m << " m";
    }
  }
  EXPECT_EQ(drives, 80);
}

}  // namespace
}  // namespace floorproof

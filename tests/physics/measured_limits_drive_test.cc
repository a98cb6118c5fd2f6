// SPDX-License-Identifier: Apache-2.0
// What measured limits are worth: a robot is measured, its plan leads over what is nine tenths of
// its limits, and the drive holds; it keeps off what is a tenth more.
#include <gmock/gmock.h>

#include "env/scene/measured_block.h"
#include "run/scenario/floors.h"
#include "run/scenario/scenario.h"
#include "tests/places.h"
#include "tests/run/scenario_text.h"
#include "tests/slurp.h"
#include "validate/ladder.h"
#include "validate/ladder_limits.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class MeasuredDrives : public ScenarioTest {
 protected:
  // A copy of BELUGA's model with its limits of these hazards on friction 0.8.
  RobotSpec Measure(const std::vector<std::string_view>& hazards) const {
    const fs::path file = Save("own.xml", Slurp(SourceFile("models/beluga.xml")));
    std::vector<LadderCell> cells = RobotCells(file.string());
    std::erase_if(cells, [&](const LadderCell& cell) {
      return cell.friction != 0.8 || std::ranges::find(hazards, cell.hazard) == hazards.end();
    });
    const std::vector<LadderRow> rows = ClimbLadder(cells, 2, {});
    EXPECT_EQ(rows.size(), cells.size());
    const std::string model = ModelHash(std::vector<fs::path>{file}, {});
    const std::string elements = MeasuredElements(rows, "a test", model);
    Save("own.xml", WithMeasured(Slurp(file), elements, file));
    return ReadRobot(file).spec;
  }

  // A room of 3 m x 1.5 m with this hazard, covered.
  Scenario Room(const std::string& hazard) const {
    std::string rows = "      " + std::string(14, '#') + "\n";
    for (int i = 0; i < 6; ++i) rows += "      #" + std::string(12, '.') + "#\n";
    rows += "      " + std::string(14, '#') + "\n";
    return Read("scenario: 1\nsite:\n  site: 1\n  name: room\n  grid:\n    cell_m: 0.25\n" +
                std::string("    rows: |\n") + rows +
                "  start: {x_m: 0.6, y_m: 1.0, yaw_deg: 0}\n  hazards: [" + hazard +
                "]\nrobot: own.xml\nplan: {planner: boustrophedon}\nsuccess: {min_coverage: 0}\n");
  }

  // Past the hazard, which lies across the room's middle.
  static bool LeadsPast(const Path& path) {
    return std::ranges::any_of(path, [](const Waypoint& w) { return w.p_W.x() > 2.4; });
  }

  void DriveOver(const std::string& hazard) const {
    SCOPED_TRACE(hazard);
    Scenario scenario = Room(hazard);
    const Execution dut = Execute(scenario);
    EXPECT_EQ(dut.plan.status, PlanStatus::kSuccess) << dut.plan.message;
    EXPECT_TRUE(LeadsPast(dut.plan.path));
    EXPECT_EQ(dut.record.outcome, Outcome::kSuccess) << dut.record.message;
    EXPECT_THAT(dut.record.events, IsEmpty());
  }
  void KeepOff(const std::string& hazard) const {
    SCOPED_TRACE(hazard);
    Scenario scenario = Room(hazard);
    EXPECT_TRUE(
        IsObstacle(KnownFloor(scenario.world).hazards.at(0), scenario.world.robot.spec.step_m));
    const PlanResult dut = MakePlan(scenario);
    EXPECT_EQ(dut.status, PlanStatus::kSuccess) << dut.message;
    EXPECT_FALSE(LeadsPast(dut.path));
  }
};

std::string Step(double height_m, double slant_m) {
  return "{type: step, height_m: " + std::to_string(height_m) + ", polygon_m: [[" +
         std::to_string(1.75 - slant_m) + ", 0.25], [3.25, 0.25], [3.25, 1.75], [" +
         std::to_string(1.75 + slant_m) + ", 1.75]]}";
}

std::string Cover(double height_m, double slant_m) {
  const double width_m = 0.05 + 2 * height_m / std::tan(kPi / 6);
  return "{type: cable_cover, height_m: " + std::to_string(height_m) +
         ", top_width_m: 0.05, width_m: " + std::to_string(width_m) + ", line_m: [[" +
         std::to_string(1.75 - slant_m) + ", 0.25], [" + std::to_string(1.75 + slant_m) +
         ", 1.75]]}";
}

// Square to the rows, and at 45 degrees.
TEST_F(MeasuredDrives, StepsAndDropsHoldAtNineTenths) {
  const double limit_m = TrustedStep(Measure({"step", "drop"}), 0.8);
  EXPECT_GT(limit_m, 0.005);
  for (const double slant_m : {0.0, 0.75})
    for (const double sign : {1.0, -1.0}) {
      DriveOver(Step(sign * 0.9 * limit_m, slant_m));
      KeepOff(Step(sign * 1.1 * limit_m, slant_m));
    }
}

TEST_F(MeasuredDrives, CoversHoldAtNineTenths) {
  const double limit_m =
      *LimitOn(Measure({"cable_cover_height"}).measured, "cable_cover_height", 0.8);
  EXPECT_GT(limit_m, 0.005);
  for (const double slant_m : {0.0, 0.75}) {
    DriveOver(Cover(0.9 * limit_m, slant_m));
    KeepOff(Cover(1.1 * limit_m, slant_m));
  }
}

}  // namespace
}  // namespace floorproof

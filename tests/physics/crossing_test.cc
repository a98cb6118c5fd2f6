// SPDX-License-Identifier: Apache-2.0
// What is crossed square is crossed aslant, and what is known is crossed as what is not.
#include <gmock/gmock.h>

#include "tests/run/scenario_text.h"
#include "validate/ladder.h"

namespace floorproof {
namespace {

// "" when it is crossed, else what held it.
std::string HeldBy(const char* robot, const char* hazard, Direction direction, double size,
                   double oblique_deg) {
  LadderCell cell{robot, "ideal", FindLadderHazard(hazard).name, direction, 0.2, 0.8, {}};
  cell.oblique_deg = oblique_deg;
  const RobotModel model = ReadRobot(FindRobotFile(robot, {}));
  const CrossingPlan plan = PlanOf(cell, model.spec, size);
  return Cross(model, FindLadderHazard(hazard).make(size, plan.travel_rad), plan).held_by;
}

// A robot that holds its yaw and is caught by one wheel slides along the edge; it has to square up.
// Seven tenths of what is crossed square, on both sides.
TEST(Oblique, WhatIsCrossedSquareIsCrossedAslant) {
  for (const double oblique_deg : {0.0, 0.5, 1.0, -1.0, 3.0, -3.0, 5.0, 10.0, -10.0}) {
    SCOPED_TRACE(oblique_deg);
    EXPECT_EQ(HeldBy("htetro", "step", Direction::kForward, 14, oblique_deg), "");
    EXPECT_EQ(HeldBy("htetro", "cable_cover", Direction::kForward, 29, oblique_deg), "");
    EXPECT_EQ(HeldBy("htetro", "step", Direction::kSideways, 3, oblique_deg), "");
    EXPECT_EQ(HeldBy("htetro", "cable_cover", Direction::kSideways, 24, oblique_deg), "");
    EXPECT_EQ(HeldBy("beluga", "step", Direction::kForward, 13, oblique_deg), "");
  }
}

// It still cannot climb a wall, nor does it leave its lane in trying.
TEST(Oblique, WhatHoldsSquareHoldsAslant) {
  for (const double oblique_deg : {1.0, 3.0, 10.0})
    EXPECT_EQ(HeldBy("htetro", "step", Direction::kForward, 40, oblique_deg), "no progress")
        << oblique_deg;
}

class KnownStep : public ScenarioTest, public ::testing::WithParamInterface<const char*> {
 protected:
  // Up a step, along it, and to its end.
  EpisodeRecord Drive(double height_m, bool known) const {
    Save("plan.csv", "x_m,y_m,yaw_rad,speed_mps\n1.5,2.5,0,0.2\n5.5,2.5,0,0.2\n");
    return ScenarioTest::Drive(
        Read(RoomScenario("{type: step, id: it, known: " + std::string(known ? "true" : "false") +
                          ", height_m: " + std::to_string(height_m) +
                          ", polygon_m: [[3.5, 0.6], [6.5, 0.6], [6.5, 4.4], [3.5, 4.4]]}"),
             {{"robot", GetParam()}}));
  }
};
INSTANTIATE_TEST_SUITE_P(Robots, KnownStep, ::testing::Values("beluga", "htetro"),
                         [](const auto& robot) { return std::string(robot.param); });

// A plan over a step says that it is to be crossed: nobody slows down for it, and limits hang on
// speed. 0.9 of the limit.
TEST_P(KnownStep, IsCrossedAsTheSameStepUnknown) {
  const bool htetro = std::string(GetParam()) == "htetro";
  const double height_m = htetro ? 0.0186 : 0.0153;
  const EpisodeRecord unknown = Drive(height_m, false), known = Drive(height_m, true);
  EXPECT_EQ(unknown.outcome, Outcome::kSuccess);
  EXPECT_EQ(known.outcome, Outcome::kSuccess);
  EXPECT_TRUE(known.events.empty());
  EXPECT_NEAR(known.metrics.duration_s, unknown.metrics.duration_s, 0.1);
}

}  // namespace
}  // namespace floorproof

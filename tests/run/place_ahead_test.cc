// SPDX-License-Identifier: Apache-2.0
// Where a robot that failed can be set down.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run/episode/intervention.h"
#include "run/scenario/scenario.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

class PlaceAheadTest : public ScenarioTest {
 protected:
  PlaceAheadTest() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n"); }
  // The waypoint at which hTetro, 0.5 m wide, is set down in the room with this.
  std::optional<SetDownPlace> Place(const std::string& hazards, const Path& path,
                                    const std::string& robot = "htetro") const {
    return PlaceAhead(Read(RoomScenario(hazards), {{"robot", robot}}).world, path, 1);
  }
  static Waypoint At(double x_m, double y_m, std::optional<double> yaw_rad = {}) {
    Waypoint waypoint;
    waypoint.p_W = {x_m, y_m};
    waypoint.yaw_rad = yaw_rad;
    return waypoint;
  }
};

TEST_F(PlaceAheadTest, AnyHazardUnderTheFootprintIsPassedOver) {
  const Path path = {At(1.5, 2.5), At(4, 2.5), At(6, 2.5)};
  const std::string square = "polygon_m: [[4.2,2.4],[4.4,2.4],[4.4,2.6],[4.2,2.6]]";
  const std::string line = "line_m: [[4.2,2],[4.2,3]]";
  for (const std::string& hazard :
       {"type: blind_object, height_m: 0.5, " + square, "type: glass, " + line,
        "type: step, height_m: -0.1, " + square, "type: step, height_m: 0.004, " + square,
        "type: cable_cover, " + line, "type: groove, " + line, "type: rough, " + square})
    for (const char* known : {"true", "false"}) {
      const auto dut = Place("{" + hazard + ", known: " + known + "}", path);
      ASSERT_TRUE(dut) << hazard;
      EXPECT_EQ(dut->waypoint, 2u) << hazard << " known " << known;
    }
}

TEST_F(PlaceAheadTest, ItsYawDecidesWhatItTouches) {
  // Beside it, and beneath a corner of it once it is turned by 45 degrees.
  const std::string beside = "{type: rough, polygon_m: [[4.25,2],[4.5,2],[4.5,3],[4.25,3]]}";
  const auto waypoint = [&](double yaw_rad) {
    return Place(beside, {At(1.5, 2.5), At(4, 2.5, yaw_rad), At(6, 2.5)})->waypoint;
  };
  EXPECT_EQ(waypoint(0), 1u) << "borders that coincide do not touch";
  EXPECT_EQ(waypoint(kPi / 2), 1u);
  EXPECT_EQ(waypoint(kPi / 4), 2u);
}

TEST_F(PlaceAheadTest, ARoundRobotTouchesWithItsCircle) {
  const auto waypoint = [&](double gap_m) {
    const double y_m = 2.5 + 0.18 + gap_m;
    return Place(fmt::format("{{type: rough, polygon_m: [[3.5,{0}],[4.5,{0}],[4.5,4],[3.5,4]]}}",
                             y_m),
                 {At(1.5, 2.5), At(4, 2.5), At(6, 2.5)}, "beluga")
        ->waypoint;
  };
  EXPECT_EQ(waypoint(0.002), 1u);
  EXPECT_EQ(waypoint(-0.003), 2u);
}

TEST_F(PlaceAheadTest, NeitherInAWallNorBeyondTheMap) {
  const Path path = {At(1.5, 2.5), At(8.6, 2.5), At(-3, 2.5), At(8.3, 2.5), At(8.25, 2.5)};
  const auto dut = Place("", path);
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->waypoint, 4u) << "there its side stands at the wall";
}

TEST_F(PlaceAheadTest, NotWhereNoFloorLeadsFromTheStart) {
  const auto waypoint = [&](const std::string& middle) {
    const Scenario s = Read(
        "scenario: 1\nrobot: beluga\nplan: {file: plan.csv}\nsite: {site: 1, "
        "start: {x_m: 1.5, y_m: 1.5, yaw_deg: 0}, grid: {cell_m: 1, rows: \"#######\\n#..#" +
        std::string("..#\\n#..") + middle + "..#\\n#######\"}}\n");
    return PlaceAhead(s.world, {At(1.5, 1.5), At(4.5, 1.5), At(2.5, 1.5)}, 1)->waypoint;
  };
  EXPECT_EQ(waypoint("."), 1u);
  EXPECT_EQ(waypoint("#"), 2u);
}

TEST_F(PlaceAheadTest, HeadsAsThePlanDoesThere) {
  const auto yaw = [&](const Path& path) { return Place("", path)->X_WB.yaw_rad; };
  EXPECT_DOUBLE_EQ(yaw({At(1.5, 2.5), At(4, 2.5, -0.3), At(4, 3.5)}), -0.3);
  EXPECT_DOUBLE_EQ(yaw({At(1.5, 2.5), At(4, 2.5), At(4, 2.5), At(4, 3.5)}), kPi / 2) << "onward";
  EXPECT_DOUBLE_EQ(yaw({At(4, 3.5), At(4, 2.5), At(4, 2.5)}), -kPi / 2) << "as it came";
}

}  // namespace
}  // namespace floorproof

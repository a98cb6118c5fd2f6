// SPDX-License-Identifier: Apache-2.0
// What is said of a plan's clearance, against geometry that is known, and against physics.
#include "run/plan_check/plan_clearance.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <string>

#include "env/scene/models_folder.h"
#include "run/plan_check/plan_check.h"
#include "run/scenario/scenario.h"
#include "tests/run/scenario_text.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kBeluga_m = 0.36;  // its width, whatever its heading
constexpr double kWall_m = 0.47;    // y of the room's lower wall as it is built, `inset_m` back

std::string Block(const char* id, const Pose2& X, const Vec2& low, const Vec2& high) {
  std::string corners;
  for (const Vec2& p : Rectangle(low, high)) {
    const Vec2 p_W = X * p;
    corners += fmt::format("{}[{}, {}]", corners.empty() ? "" : ", ", p_W.x(), p_W.y());
  }
  return fmt::format("{{type: blind_object, id: {}, polygon_m: [{}]}}", id, corners);
}

// A gap of that width, its middle at X, the way through along X's x axis.
std::string Gap(const Pose2& X, double width_m) {
  return Block("left", X, {-0.1, width_m / 2}, {0.1, width_m / 2 + 0.6}) + ", " +
         Block("right", X, {-0.1, -width_m / 2 - 0.6}, {0.1, -width_m / 2});
}

// A step 0.2 m wide right across the room, along X's y axis.
std::string Sill(const Pose2& X, double height_m) {
  std::string corners;
  for (const Vec2& p : Rectangle({-0.1, -3}, {0.1, 3})) {
    const Vec2 p_W = X * p;
    corners += fmt::format("{}[{}, {}]", corners.empty() ? "" : ", ", p_W.x(), p_W.y());
  }
  return fmt::format("{{type: step, id: sill, height_m: {}, polygon_m: [{}]}}", height_m, corners);
}

class PlanClearanceTest : public ScenarioTest {
 protected:
  // A plan in the room of RoomScenario, starting at (1.5, 2.5).
  Scenario Room(const std::string& hazards, const std::string& rows, const std::string& more = "") {
    Save("plan.csv", "x_m,y_m\n1.5,2.5\n" + rows);
    return Read(RoomScenario(hazards, more));
  }
  static PlanClearance Check(const Scenario& scenario) {
    return CheckClearance(scenario.world, MakePlan(scenario));
  }
};

TEST_F(PlanClearanceTest, IsTheDistanceToTheNearestWall) {
  const PlanClearance dut = Check(Room("", "6,2.5\n6,0.9\n"));
  EXPECT_THAT(dut.conflicts, IsEmpty());
  EXPECT_EQ(dut.obstacle, "wall");
  EXPECT_NEAR(dut.least_m, 0.9 - kWall_m - kBeluga_m / 2, 0.001);
  EXPECT_NEAR(dut.p_W.y(), 0.9, 0.01);
  EXPECT_NEAR(dut.along_m, 4.5 + 1.6, 0.01);
}

TEST_F(PlanClearanceTest, AWallThatIsClippedIsSaidWhereAndHowDeep) {
  const PlanClearance dut = Check(Room("", "4,2.5\n5,0.62\n6,2.5\n"));
  ASSERT_THAT(dut.conflicts, SizeIs(1));
  const PlanConflict& clip = dut.conflicts.front();
  EXPECT_EQ(clip.obstacle, "wall");
  EXPECT_NEAR(clip.overlap_m, 0.03, 0.001);
  EXPECT_NEAR((clip.p_W - Vec2(5, 0.62)).norm(), 0, 0.05);
  EXPECT_FALSE(clip.gap_m);
  EXPECT_NEAR(dut.least_m, -0.03, 0.001);
}

// Wherever a gap lies and however it is turned, half a millimetre of cells' edges included: it is
// said where it is narrower than the robot, and not where it is wider.
TEST_F(PlanClearanceTest, AGapIsSaidWhereItIsNarrowerThanTheRobot) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> of(0, 1);
  for (const double d_m : {-0.05, -0.02, -0.005, 0.005, 0.02, 0.05}) {
    for (int i = 0; i < 6; ++i) {
      const Pose2 X{3.5 + 2 * of(random), 2 + of(random), 0.6 * (of(random) - 0.5)};
      const Vec2 before = X * Vec2(-0.7, 0), after = X * Vec2(0.7, 0);
      const PlanClearance dut =
          Check(Room(Gap(X, kBeluga_m + d_m),
                     fmt::format("{},{}\n{},{}\n", before.x(), before.y(), after.x(), after.y())));
      const auto told = fmt::format("{} m more at x {} y {} yaw {}", d_m, X.x_m, X.y_m, X.yaw_rad);
      EXPECT_EQ(!dut.conflicts.empty(), d_m < 0) << told;
      EXPECT_NEAR(dut.least_m, d_m / 2, 0.001) << told;
      for (const PlanConflict& c : dut.conflicts) {
        ASSERT_TRUE(c.gap_m) << told;
        EXPECT_NEAR(*c.gap_m, kBeluga_m + d_m, 0.002) << told;
        EXPECT_NEAR(c.width_m, kBeluga_m, 0.002) << told;
        EXPECT_LT((c.p_W - X.p()).norm(), 0.2) << told;
      }
    }
  }
}

// The claim meets physics: what overlaps is touched, what does not is not. Off by 2 cm to a side
// (1 cm of tracking included).
TEST_F(PlanClearanceTest, WhatIsSaidToOverlapIsTouchedInADrive) {
  for (const double d_m : {-0.04, 0.04}) {
    const Pose2 X{4, 2.5, 0};
    Scenario scenario = Room(Gap(X, kBeluga_m + d_m), "5.5,2.5\n");
    const bool said = !Check(scenario).conflicts.empty();
    const EpisodeRecord record = Drive(std::move(scenario));
    EXPECT_EQ(said, d_m < 0);
    EXPECT_EQ(record.metrics.contacts > 0, said) << d_m;
    EXPECT_EQ(record.outcome == Outcome::kSuccess, !said) << d_m;
  }
}

TEST_F(PlanClearanceTest, AWallThatIsSaidToBeClippedIsTouchedInADrive) {
  for (const double d_m : {-0.03, 0.03}) {
    const double y_m = kWall_m + kBeluga_m / 2 + d_m;
    Scenario scenario = Room("", fmt::format("2.5,2.5\n3.5,{0}\n5.5,{0}\n", y_m));
    const PlanClearance dut = Check(scenario);
    EXPECT_EQ(dut.conflicts.size(), d_m < 0 ? 1u : 0u);
    EXPECT_NEAR(dut.least_m, d_m, 0.001);
    EXPECT_EQ(Drive(std::move(scenario)).metrics.contacts > 0, d_m < 0) << d_m;
  }
}

TEST_F(PlanClearanceTest, APlaceThatIsPassedOftenIsOnePlace) {
  const PlanClearance dut =
      Check(Room(Gap({4, 2.5, 0}, 0.3), "5.5,2.5\n1.5,2.5\n5.5,2.5\n1.5,2.5\n"));
  ASSERT_THAT(dut.conflicts, SizeIs(1)) << "left and right are one gap";
  const PlanConflict& gap = dut.conflicts.front();
  EXPECT_EQ(gap.times, 4);
  EXPECT_EQ(std::set({gap.obstacle, gap.other_side}), (std::set<std::string>{"left", "right"}));
}

// There and back at once, off the gap's middle by a little each time, however long the gap is and
// however it lies: a gap longer than the robot is deepest at the end where it is entered.
TEST_F(PlanClearanceTest, AGapThatIsPassedThereAndBackIsOnePlace) {
  for (const double length_m : {0.1, 0.4, 1.0, 2.0})
    for (const double yaw_deg : {0.0, 1.0, 17.0, 90.0}) {
      const Pose2 X{4, 2.5, yaw_deg * kPi / 180};
      const double half_m = length_m / 2;
      const std::string gap = Block("left", X, {-half_m, 0.16}, {half_m, 0.5}) + ", " +
                              Block("right", X, {-half_m, -0.5}, {half_m, -0.16});
      const Vec2 before = X * Vec2(-half_m - 0.6, 0), after = X * Vec2(half_m + 0.6, 0.004),
                 back = X * Vec2(-half_m - 0.6, -0.004);
      const PlanClearance dut =
          Check(Room(gap, fmt::format("{},{}\n{},{}\n{},{}\n", before.x(), before.y(), after.x(),
                                      after.y(), back.x(), back.y())));
      const std::string told = fmt::format("{} m long at {} deg", length_m, yaw_deg);
      ASSERT_THAT(dut.conflicts, SizeIs(1)) << told;
      EXPECT_EQ(dut.conflicts.front().times, 2) << told;
      EXPECT_NEAR(dut.conflicts.front().gap_m.value_or(0), 0.32, 0.01) << told;
    }
}

// Off its middle by more than it is too narrow: there the one side is touched, back the other.
TEST_F(PlanClearanceTest, AGapThatIsTouchedAtOneSideEachTimeIsOnePlace) {
  const PlanClearance dut =
      Check(Room(Gap({4, 2.5, 0}, 0.34), "2,2.53\n5.5,2.53\n5.5,2.47\n2,2.47\n"));
  ASSERT_THAT(dut.conflicts, SizeIs(1));
  EXPECT_EQ(dut.conflicts.front().times, 2);
  EXPECT_NEAR(dut.conflicts.front().gap_m.value_or(0), 0.34, 0.002);
}

// Two gaps one behind the other are two.
TEST_F(PlanClearanceTest, GapsApartAreNotOne) {
  std::string gaps = Gap({3, 2.5, 0}, 0.3);
  std::string second = Gap({4.5, 2.5, 0}, 0.3);
  for (const auto& [id, other] : {std::pair("left", "left2"), {"right", "right2"}})
    second.replace(second.find(id), std::string(id).size(), other);
  EXPECT_THAT(Check(Room(gaps + ", " + second, "5.5,2.5\n1.5,2.5\n")).conflicts, SizeIs(2));
}

TEST_F(PlanClearanceTest, ALongClipIsOneStretch) {
  const PlanClearance dut = Check(Room("", "1.5,0.63\n6.5,0.63\n6.5,2.5\n"));
  ASSERT_THAT(dut.conflicts, SizeIs(1));
  EXPECT_NEAR(dut.conflicts.front().over_m, 5.02, 0.02);
}

// Beside a post 0.1 m long, by as much as a circle's chord is longer than the post. A drive there
// and back is twice as long, and where the plan's legs are cut makes no difference.
TEST_F(PlanClearanceTest, TheLengthThatOverlapsIsExact) {
  const double r_m = kBeluga_m / 2, aside_m = 0.1;
  const double expected_m = 0.1 + 2 * std::sqrt(r_m * r_m - aside_m * aside_m);
  const std::string post = Block("post", {4, 2.5 + aside_m, 0}, {-0.05, 0}, {0.05, 0.2});
  for (const char* rows : {"6,2.5\n", "3.93,2.5\n4.02,2.5\n6,2.5\n"}) {
    const PlanClearance dut = Check(Room(post, rows));
    ASSERT_THAT(dut.conflicts, SizeIs(1));
    EXPECT_NEAR(dut.conflicts.front().over_m, expected_m, 0.01) << rows;
  }
  const PlanClearance dut = Check(Room(post, "6,2.5\n1.5,2.5\n"));
  ASSERT_THAT(dut.conflicts, SizeIs(1));
  EXPECT_NEAR(dut.conflicts.front().over_m, 2 * expected_m, 0.02);
  EXPECT_EQ(dut.conflicts.front().times, 2);
}

TEST_F(PlanClearanceTest, WhatIsNotKnownIsNotSaid) {
  std::string hazard = Block("box", {4, 2.5, 0}, {-0.2, -0.2}, {0.2, 0.2});
  EXPECT_THAT(Check(Room(hazard, "5.5,2.5\n")).conflicts, SizeIs(1));
  hazard.insert(hazard.size() - 1, ", known: false");
  EXPECT_THAT(Check(Room(hazard, "5.5,2.5\n")).conflicts, IsEmpty());
}

// What the plan leads over is no obstacle; where it is more than the robot is trusted to cross,
// that is said, with the place of its edge, whatever the heading.
TEST_F(PlanClearanceTest, AStepOnTheWayIsCrossedAndNoObstacle) {
  for (const double height_m : {0.008, 0.015, -0.05})
    for (const double turned_rad : {0.0, kPi / 180, 0.5}) {
      const Pose2 X{4.5, 2.5, turned_rad};
      const PlanClearance dut = Check(Room(Sill(X, height_m), "6.5,2.5\n"));
      const std::string told = fmt::format("{} m, {} rad", height_m, turned_rad);
      EXPECT_THAT(dut.conflicts, IsEmpty()) << told;
      EXPECT_NE(dut.obstacle, "sill") << told;
      ASSERT_EQ(dut.crossings.size(), height_m == 0.008 ? 0u : 1u) << told;
      if (dut.crossings.empty()) continue;
      const PlanCrossing& crossing = dut.crossings.front();
      EXPECT_EQ(crossing.hazard, "sill");
      EXPECT_EQ(crossing.height_m, height_m);
      EXPECT_EQ(crossing.times, 1);
      EXPECT_NEAR((crossing.p_W - Vec2(4.5 - 0.1 / std::cos(turned_rad), 2.5)).norm(), 0, 0.002);
      EXPECT_NEAR(crossing.along_m, crossing.p_W.x() - 1.5, 0.002) << told;
    }
}

// A mat over a pit lies in it.
TEST_F(PlanClearanceTest, APitIsCrossedWhateverLiesInIt) {
  const std::string
      pit = Sill({4, 2.5, 0}, -0.5),
      mat = "{type: rough, id: mat, polygon_m: [[3.5, 0.5], [4.5, 0.5], [4.5, 4.5], [3.5, 4.5]]}";
  for (const std::string& hazards : {pit, pit + ", " + mat, mat + ", " + pit}) {
    const PlanClearance dut = Check(Room(hazards, "6,2.5\n"));
    ASSERT_THAT(dut.crossings, SizeIs(1)) << hazards;
    EXPECT_EQ(dut.crossings.front().height_m, -0.5);
  }
}

TEST_F(PlanClearanceTest, AStepThatIsCrossedOftenIsSaidOnce) {
  const PlanClearance dut =
      Check(Room(Sill({4, 2.5, 0}, 0.015), "6,2.5\n6,2.0\n1.5,2.0\n1.5,3\n6,3\n"));
  ASSERT_THAT(dut.crossings, SizeIs(1));
  EXPECT_EQ(dut.crossings.front().times, 3);
  EXPECT_NEAR((dut.crossings.front().p_W - Vec2(3.9, 2.5)).norm(), 0, 0.002);
}

// Beside the way a step stays an obstacle: before it, along it, and where another stretch of the
// same plan crosses it.
TEST_F(PlanClearanceTest, AStepThatOnlyTheRobotsSideReachesIsOverlapped) {
  const double beside_m = kBeluga_m / 2 - 0.03;
  const std::string up_to = fmt::format("{},2.5\n", 3.9 - beside_m);
  for (const std::string& rows : {up_to, up_to + fmt::format("{},3.5\n", 3.9 - beside_m)}) {
    const PlanClearance dut = Check(Room(Sill({4, 2.5, 0}, 0.015), rows));
    EXPECT_THAT(dut.crossings, IsEmpty()) << rows;
    ASSERT_THAT(dut.conflicts, SizeIs(1)) << rows;
    EXPECT_EQ(dut.conflicts.front().obstacle, "sill");
    EXPECT_NEAR(dut.conflicts.front().overlap_m, 0.03, 0.001) << rows;
    EXPECT_NEAR(dut.least_m, -0.03, 0.001) << rows;
  }
  const PlanClearance dut =
      Check(Room(Sill({4, 2.5, 0}, 0.015),
                 fmt::format("{0},2.5\n{0},3.5\n2,3.5\n2,3\n6,3\n", 3.9 - beside_m)));
  EXPECT_THAT(dut.crossings, SizeIs(1));
  ASSERT_THAT(dut.conflicts, SizeIs(1));
  EXPECT_NEAR(dut.conflicts.front().overlap_m, 0.03, 0.001);
  EXPECT_NEAR(dut.least_m, -0.03, 0.001);
}

TEST_F(PlanClearanceTest, ACrossingIsSaidInWordsOfItsOwn) {
  const auto said = [&](double height_m, std::string& text, std::string& json) {
    Scenario scenario = Room(Sill({4, 2.5, 0}, height_m), "6,2.5\n1.5,2.5\n");
    const PlanResult plan = MakePlan(scenario);
    const PlanCheck check = CheckPlan(scenario, plan);
    text.clear();
    for (const std::string& line : PlanLines(scenario, plan, check)) text += line + "\n";
    json = PlanCheckJson(scenario.world, check).dump();
  };
  std::string text, json;
  said(0.015, text, json);
  EXPECT_THAT(text, HasSubstr("warning: the plan crosses 'sill' (step, 15 mm) at x 3.90, y 2.50 m, "
                              "2.4 m along, 2 times: higher than the robot is trusted to cross "
                              "(10 mm)\n"));
  EXPECT_THAT(text, Not(HasSubstr("into obstacles")));
  EXPECT_THAT(json, HasSubstr(R"("conflicts":[],"crossings":[{)"));
  EXPECT_THAT(json, HasSubstr(R"("hazard":"sill","height_m":0.015,"times":2}])"));
  said(-0.015, text, json);
  EXPECT_THAT(text, HasSubstr("crosses 'sill' (step, 15 mm deep) at"));
  EXPECT_THAT(text, HasSubstr(": deeper than the robot is trusted to cross (10 mm)\n"));
}

// From a raised floor or a pit: what is said is of the floor on which the robot starts.
TEST_F(PlanClearanceTest, HeightsAreOverTheFloorOfTheStart) {
  for (const double height_m : {0.05, -0.05}) {
    const std::string level = fmt::format(
        "{{type: step, height_m: {}, polygon_m: [[0.75,0.75],[6,0.75],[6,4],[0.75,4]]}}", height_m);
    const std::string on_it = fmt::format(
        "{{type: step, id: sill, height_m: {}, polygon_m: [[3,0.75],[4,0.75],[4,4],[3,4]]}}",
        height_m + 0.015);
    PlanClearance dut = Check(Room(level, "5,2.5\n"));
    EXPECT_THAT(dut.conflicts, IsEmpty()) << height_m;
    EXPECT_THAT(dut.crossings, IsEmpty()) << height_m;
    EXPECT_EQ(dut.obstacle, "base_floor") << height_m;
    EXPECT_NEAR(dut.least_m, 0.75 - kBeluga_m / 2, 0.001) << "where it starts";

    dut = Check(Room(level, "7,2.5\n"));
    EXPECT_THAT(dut.conflicts, IsEmpty()) << height_m;
    ASSERT_THAT(dut.crossings, SizeIs(1)) << height_m;
    EXPECT_EQ(dut.crossings[0].hazard, "base_floor");
    EXPECT_EQ(dut.crossings[0].height_m, -height_m);
    EXPECT_NEAR((dut.crossings[0].p_W - Vec2(6, 2.5)).norm(), 0, 0.002);

    dut = Check(Room(level + ", " + on_it, "5,2.5\n"));
    ASSERT_THAT(dut.crossings, SizeIs(1)) << height_m;
    EXPECT_EQ(dut.crossings[0].hazard, "sill");
    EXPECT_NEAR(dut.crossings[0].height_m, 0.015, 1e-9);
  }
}

TEST_F(PlanClearanceTest, OnARaisedFloorTheFloorBelowHasAName) {
  const auto said = [&](const char* height_m) {
    const std::string level = std::string("{type: step, height_m: ") + height_m +
                              ", polygon_m: [[0.75,0.75],[6,0.75],[6,4],[0.75,4]]}";
    Scenario scenario = Room(level, "7,2.5\n");
    const PlanResult plan = MakePlan(scenario);
    std::string text;
    for (const std::string& line : PlanLines(scenario, plan, CheckPlan(scenario, plan)))
      text += line + "\n";
    return text;
  };
  EXPECT_THAT(
      said("0.05"),
      HasSubstr("crosses 'base_floor' (floor, 50 mm deep) at x 6.00, y 2.50 m, 4.5 m along: "
                "deeper than the robot is trusted to cross (10 mm)"));
  EXPECT_THAT(said("-0.05"),
              HasSubstr("crosses 'base_floor' (floor, 50 mm) at x 6.00, y 2.50 m, 4.5 m "
                        "along: higher than the robot is trusted to cross (10 mm)"));
}

// Where floors overlap, the later one is crossed, and not what it covers.
TEST_F(PlanClearanceTest, WhatABridgeCoversIsNotCrossed) {
  const std::string pit =
      "{type: step, id: pit, height_m: -0.3, polygon_m: [[3,0.5],[5,0.5],[5,4.5],[3,4.5]]}, "
      "{type: step, id: bridge, height_m: 0.02, polygon_m: [[2.5,2],[5.5,2],[5.5,3],[2.5,3]]}";
  const PlanClearance dut = Check(Room(pit, "6.5,2.5\n"));
  ASSERT_THAT(dut.crossings, SizeIs(1));
  EXPECT_EQ(dut.crossings[0].hazard, "bridge");
  EXPECT_THAT(dut.conflicts, IsEmpty());
  EXPECT_EQ(dut.obstacle, "pit");
  EXPECT_NEAR(dut.least_m, 0.5 - kBeluga_m / 2, 0.001);
}

// hTetro is a square of 0.5 m: along its side it passes where it does not pass diagonally.
TEST_F(PlanClearanceTest, TheFootprintIsThatOfTheHeadingAndTheShape) {
  const auto square = [&](double yaw_deg, double gap_m) {
    Save("plan.csv", fmt::format("x_m,y_m,yaw_rad\n1.5,2.5,{0}\n3,2.5,{0}\n5.5,2.5,{0}\n",
                                 yaw_deg * kPi / 180));
    return Check(Read(RoomScenario(Gap({4, 2.5, 0}, gap_m)), {{"robot", "htetro"}}));
  };
  EXPECT_THAT(square(0, 0.52).conflicts, IsEmpty());
  EXPECT_THAT(square(45, 0.52).conflicts, SizeIs(1));
  EXPECT_THAT(square(45, 0.72).conflicts, IsEmpty());
  EXPECT_THAT(square(0, 0.48).conflicts, SizeIs(1));
  const auto folded = [&](const char* shape) {
    Save("plan.csv", fmt::format("x_m,y_m,yaw_rad,shape\n1.5,2.5,0,O\n2.5,2.5,0,{0}\n"
                                 "5.5,2.5,0,{0}\n",
                                 shape));
    return Check(Read(RoomScenario(Gap({4, 2.5, 0}, 0.4)), {{"robot", "htetro"}}));
  };
  EXPECT_THAT(folded("O").conflicts, SizeIs(1));
  // In a row, along x or y: one of the two fits through 0.4 m.
  const bool along = folded("I").conflicts.empty();
  Save("plan.csv",
       "x_m,y_m,yaw_rad,shape\n1.5,2.5,0,O\n2.5,2.5,0,I\n3,2.5,1.5707963,I\n"
       "5.5,2.5,1.5707963,I\n");
  const bool across =
      Check(Read(RoomScenario(Gap({4, 2.5, 0}, 0.4)), {{"robot", "htetro"}})).conflicts.empty();
  EXPECT_NE(along, across);
}

// A robot that keeps a circle clear need not fill it: a box 0.4 m long and 0.2 m wide passes
// lengthwise through 0.24 m, and where it turns its corners reach out.
TEST_F(PlanClearanceTest, ARobotThatKeepsACircleClearIsCheckedByItsBody) {
  std::string mjcf = Slurp(ModelsFolder() / "beluga.xml");
  const std::string round = R"(type="cylinder" size="0.180 0.045" pos="0 0 0.070")";
  ASSERT_NE(mjcf.find(round), std::string::npos);
  mjcf.replace(mjcf.find(round), round.size(),
               R"(type="box" size="0.20 0.10 0.045" pos="0 0 0.070")");
  for (const char* wheel : {"0 0.135 0.05", "0 -0.135 0.05"})
    mjcf.replace(mjcf.find(wheel), std::string(wheel).size(),
                 wheel[2] == '-' ? "0 -0.085 0.05" : "0 0.085 0.05");
  const std::string deck = R"(type="cylinder" size="0.125 0.075" pos="-0.02 0 0.19")";
  ASSERT_NE(mjcf.find(deck), std::string::npos);
  mjcf.replace(mjcf.find(deck), deck.size(),
               R"(type="cylinder" size="0.08 0.075" pos="-0.02 0 0.19")");
  Save("box.xml", mjcf);
  const auto check = [&](const std::string& rows, double gap_m) {
    Save("plan.csv", "x_m,y_m\n1.5,2.5\n" + rows);
    return Check(
        Read(RoomScenario(Gap({4, 2.5, 0}, gap_m)), {{"robot", (folder_ / "box.xml").string()}}));
  };
  EXPECT_THAT(check("5.5,2.5\n", 0.24).conflicts, IsEmpty());
  EXPECT_THAT(check("5.5,2.5\n", 0.18).conflicts, SizeIs(1));
  EXPECT_THAT(check("4,2.5\n4,3.2\n", 0.24).conflicts, Not(IsEmpty())) << "turns in the gap";
}

TEST_F(PlanClearanceTest, OneIsNotSeveral) {
  const auto text = [&](const std::string& rows) { return PlannedText(MakePlan(Room("", rows))); };
  EXPECT_EQ(text("4,2.5\n"), "planned: 2 waypoints, 2.5 m, 0 turns");
  EXPECT_EQ(text("4,2.5\n4,3.5\n"), "planned: 3 waypoints, 3.5 m, 1 turn");
  PlanClearance clearance;
  clearance.conflicts.resize(1);
  EXPECT_THAT(ConflictsLine(clearance), ::testing::EndsWith("at 1 place"));
  clearance.conflicts.resize(2);
  EXPECT_THAT(ConflictsLine(clearance), ::testing::EndsWith("at 2 places"));
}

// A path of 6 m that passes a wall at 18 mm: enough clearance for a robot that knows its pose
// exactly, but not for one whose estimate may be 25 mm off.
TEST_F(PlanClearanceTest, HowNearIsTooNearDependsOnTheEstimator) {
  constexpr double kCloseBy_m = 0.018;
  const auto warned = [&](const std::string& estimator, double clearance_m) {
    Scenario scenario =
        Room("", fmt::format("1.5,{0}\n6,{0}\n", kWall_m + kBeluga_m / 2 + clearance_m),
             "estimator: " + estimator + "\n");
    const PlanResult plan = MakePlan(scenario);
    for (const std::string& line : PlanLines(scenario, plan, CheckPlan(scenario, plan)))
      if (line.starts_with("warning: the least clearance")) return line;
    return std::string();
  };
  EXPECT_EQ(warned("truth", kCloseBy_m), "");
  EXPECT_EQ(warned("truth", 0.008),
            "warning: the least clearance is below 10 mm, which is within the tracking error");
  EXPECT_EQ(warned("mcl", kCloseBy_m),
            "warning: the least clearance is below 35 mm, which is within the errors of tracking "
            "(10 mm) and of `mcl` (25 mm)");
  EXPECT_EQ(warned("mcl", 0.037), "");
  EXPECT_THAT(warned("odometry", 0.2), HasSubstr("and of `odometry` (3"));
  EXPECT_EQ(warned("odometry", 0.5), "");
}

// The way from the start to a given plan is nobody's plan: who reads a warning of it should know.
TEST_F(PlanClearanceTest, ALegBeforeTheGivenPlanIsSaid) {
  const auto said = [&](const std::string& rows) {
    Save("plan.csv", "x_m,y_m\n" + rows);
    Scenario scenario = Read(RoomScenario("", ""));
    const PlanResult plan = MakePlan(scenario);
    std::string text;
    for (const std::string& line : PlanLines(scenario, plan, CheckPlan(scenario, plan)))
      text += line + "\n";
    return text;
  };
  EXPECT_THAT(said("4.5,2.5\n7.8,2.5\n"),
              HasSubstr("the plan begins 3 m from the start at x 1.50, y 2.50 m"));
  EXPECT_THAT(said("1.6,2.5\n7.8,2.5\n"), ::testing::Not(HasSubstr("the plan begins")));
}

TEST_F(PlanClearanceTest, LinesNameThePlacesAndCountTheRest) {
  std::string posts, rows;
  for (int i = 0; i < 7; ++i) {
    const double x_m = 2.2 + 0.8 * i;
    posts += (i > 0 ? ", " : "") +
             Block(fmt::format("post{}", i).c_str(), {x_m, 2.5, 0}, {-0.05, 0.15}, {0.05, 0.3});
  }
  Scenario scenario = Room(posts, "7.8,2.5\n");
  const PlanResult plan = MakePlan(scenario);
  const auto lines = PlanLines(scenario, plan, CheckPlan(scenario, plan));
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  EXPECT_THAT(text, HasSubstr("warning: the plan leads the robot into obstacles at 7 places:"));
  EXPECT_THAT(text, HasSubstr("overlaps 'post0' (blind object, 500 mm) by 30 mm"));
  EXPECT_THAT(text, HasSubstr("  and 2 more\n"));
}

}  // namespace
}  // namespace floorproof

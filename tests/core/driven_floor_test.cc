// SPDX-License-Identifier: Apache-2.0
#include "env/core/driven_floor.h"

#include <gmock/gmock.h>

namespace floorproof {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Hazard At(HazardClass hazard_class, double from_x_m, double to_x_m, double low_y_m = 0.5,
          double high_y_m = 3.5) {
  Hazard hazard;
  hazard.hazard_class = hazard_class;
  hazard.height_m = 0.02;
  hazard.footprint = {Rectangle({from_x_m, low_y_m}, {to_x_m, high_y_m})};
  return hazard;
}

// A room of 8 m x 4 m with a step from x = 3 to 5 m.
HazardMap Room() {
  HazardMap map;
  map.frame = {8, 4, 1.0, {}};
  map.occupancy = Grid<CellState>(8, 4, CellState::kFree);
  map.hazards = {At(HazardClass::kLevelChange, 3, 5)};
  return map;
}

Path Line(const Vec2& from, const Vec2& to) {
  Path path(2);
  path[0].p_W = from;
  path[1].p_W = to;
  return path;
}

double ClearanceAt(const HazardMap& map, const Path& path, const Vec2& p_W) {
  return ClearanceOnTheWay(map, LevelChangesOnTheWay(map, path), 0.001).At(p_W);
}

TEST(DrivenFloor, AStepOnTheWayIsNoObstacleAndOneBesideIsOne) {
  const HazardMap map = Room();
  const Path across = Line({1, 2}, {7, 2}), beside = Line({1, 2}, {2.8, 2});
  EXPECT_GT(ClearanceAt(map, across, {2.9, 2}), 1.5) << "the walls";
  EXPECT_GT(ClearanceAt(map, across, {4, 2}), 1.5);
  EXPECT_LT(ClearanceAt(map, beside, {2.9, 2}), 0.2);
}

// Nor is terrain that the robot was not measured to cross: who drives over it all the same does not
// slow down before it.
TEST(DrivenFloor, TerrainBeyondMeasuredLimitsIsMetAsStepsAre) {
  HazardMap map = Room();
  map.hazards = {At(HazardClass::kTerrain, 3, 5)};
  const Path across = Line({1, 2}, {7, 2}), beside = Line({1, 2}, {2.8, 2});
  EXPECT_THAT(LevelChangesOnTheWay(map, across), IsEmpty());
  EXPECT_GT(ClearanceAt(map, beside, {2.9, 2}), 1.5);
  map.hazards[0].crossable = false;
  EXPECT_THAT(LevelChangesOnTheWay(map, across), ElementsAre(0u));
  EXPECT_GT(ClearanceAt(map, across, {4, 2}), 1.5);
  EXPECT_LT(ClearanceAt(map, beside, {2.9, 2}), 0.2);
}

TEST(DrivenFloor, TheWayMeetsWhatItCrossesTouchesOrLiesWithin) {
  const HazardMap map = Room();
  EXPECT_THAT(LevelChangesOnTheWay(map, Line({1, 2}, {7, 2})), ElementsAre(0u));
  EXPECT_THAT(LevelChangesOnTheWay(map, Line({1, 1}, {7, 3})), ElementsAre(0u));
  EXPECT_THAT(LevelChangesOnTheWay(map, Line({1, 2}, {4, 2})), ElementsAre(0u));
  EXPECT_THAT(LevelChangesOnTheWay(map, Line({3.5, 2}, {4.5, 2})), ElementsAre(0u));
  EXPECT_THAT(LevelChangesOnTheWay(map, Line({2, 1.5}, {4, -0.5})), ElementsAre(0u))
      << "through its corner";
  EXPECT_THAT(LevelChangesOnTheWay(map, Line({1, 2}, {2.9, 2})), IsEmpty());
  EXPECT_THAT(LevelChangesOnTheWay(map, Line({1, 0.4}, {7, 0.4})), IsEmpty());
  EXPECT_THAT(LevelChangesOnTheWay(map, {}), IsEmpty());
  Path stands(1);
  stands[0].p_W = {4, 2};
  EXPECT_THAT(LevelChangesOnTheWay(map, stands), ElementsAre(0u));
}

// A pane or a blind object in the way is not crossed, whatever the plan says.
TEST(DrivenFloor, OnlyLevelChangesAreDrivenOver) {
  for (const HazardClass kind : {HazardClass::kGlass, HazardClass::kBlindObject}) {
    HazardMap map = Room();
    map.hazards[0].hazard_class = kind;
    const Path across = Line({1, 2}, {7, 2});
    EXPECT_THAT(LevelChangesOnTheWay(map, across), IsEmpty());
    EXPECT_LT(ClearanceAt(map, across, {2.9, 2}), 0.2);
  }
}

// Of two steps, the one that is crossed; the other one stays.
TEST(DrivenFloor, EachStepIsJudgedByItself) {
  HazardMap map = Room();
  map.hazards.push_back(At(HazardClass::kLevelChange, 0.5, 7.5, 3.5, 4));
  const Path across = Line({1, 2}, {7, 2});
  EXPECT_THAT(LevelChangesOnTheWay(map, across), ElementsAre(0u));
  EXPECT_NEAR(ClearanceAt(map, across, {4, 2}), 1.5, 0.06);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// How a floor of several levels looks from one of them.
#include "env/core/levels.h"

#include <gmock/gmock.h>

#include "env/core/coverage.h"
#include "env/core/driven_floor.h"

namespace floorproof {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kStep_m = 0.01;  // what the robot is trusted to cross

// Two wheels beside the middle.
RobotSpec Robot() {
  RobotSpec robot;
  for (const double y : {0.15, -0.15}) {
    WheelSpec wheel;
    wheel.p_BW = {0, y, 0.05};
    wheel.radius_m = 0.05;
    robot.wheels.push_back(wheel);
  }
  robot.clear.radius_m = robot.inscribed_radius_m = robot.circumscribed_radius_m = 0.2;
  robot.outline_B = {RegularPolygon(Vec2::Zero(), 0.2, 64)};
  robot.height_m = 0.3;
  robot.step_m = kStep_m;
  return robot;
}

Hazard Of(HazardClass hazard_class, const char* id, const Pose2& X, const Vec2& low,
          const Vec2& high, double height_m) {
  Hazard hazard;
  hazard.id = id;
  hazard.hazard_class = hazard_class;
  hazard.height_m = height_m;
  hazard.footprint = {Rectangle(low, high)};
  for (Vec2& p : hazard.footprint[0]) p = X * p;
  hazard.solids = {{height_m < 0 ? Solid::Kind::kCut : Solid::Kind::kPrism,
                    hazard.footprint[0],
                    {},
                    std::min(height_m, 0.0),
                    std::max(height_m, 0.0)}};
  return hazard;
}

Hazard Level(const char* id, const Pose2& X, const Vec2& low, const Vec2& high, double height_m) {
  return Of(HazardClass::kLevelChange, id, X, low, high, height_m);
}

// A room of 8 m x 4 m within walls of 1 m, its lower left free corner at (1, 1) of the frame X.
HazardMap Room(const Pose2& X = {}) {
  HazardMap map;
  map.frame = {20, 12, 0.5, X};
  map.occupancy = Grid<CellState>(20, 12, CellState::kOccupied);
  for (int iy = 2; iy < 10; ++iy)
    for (int ix = 2; ix < 18; ++ix) map.occupancy(ix, iy) = CellState::kFree;
  return map;
}

HazardMap From(const HazardMap& map, const Pose2& X, const Vec2& p) {
  const Vec2 p_W = X * p;
  return SeenFrom(map, Robot(), {p_W.x(), p_W.y(), X.yaw_rad});
}

Grid<std::uint8_t> Mask(const HazardMap& map) {
  return ObstacleMask(map, kStep_m, FineFrame(map.frame));
}

std::vector<std::string> Ids(const HazardMap& map) {
  std::vector<std::string> ids;
  for (const Hazard& hazard : map.hazards) ids.push_back(hazard.id);
  return ids;
}

const Pose2 kFrames[] = {{}, {3, -2, kPi / 180}, {-1, 4, 0.7}};

TEST(SeenFrom, TheBaseFloorTheMapIsAsItIs) {
  HazardMap map = Room();
  map.hazards = {Level("platform", {}, {2, 2}, {5, 4}, 0.05),
                 Level("pit", {}, {4, 3}, {6, 4}, -0.2)};
  const HazardMap dut = From(map, {}, {7.5, 2});
  EXPECT_THAT(Ids(dut), ElementsAre("platform", "pit"));
  EXPECT_EQ(dut.hazards[0].footprint, map.hazards[0].footprint);
  EXPECT_EQ(dut.hazards[0].height_m, 0.05);
}

// With all of the floor so much higher or lower, a map looks as with none of it so.
TEST(SeenFrom, ARaisedRoomLooksLikeARoom) {
  for (const Pose2& X : kFrames)
    for (const double by_m : {0.004, 0.05, -0.3})
      for (const double over_m : {0.008, 0.02, -0.02, -0.008, -0.2}) {
        const Pose2 aslant = X * Pose2{5, 3, 0.3};
        HazardMap flat = Room(X), raised = flat;
        flat.hazards = {Level("a", aslant, {-1, -1}, {1, 1}, over_m)};
        raised.hazards = {Level("all", X, {1, 1}, {9, 5}, by_m),
                          Level("a", aslant, {-1, -1}, {1, 1}, over_m + by_m)};
        const HazardMap dut = From(raised, X, {2, 2});
        ASSERT_THAT(Ids(dut), ElementsAre("a")) << by_m << " " << over_m;
        EXPECT_NEAR(dut.hazards[0].height_m, over_m, 1e-9);
        EXPECT_EQ(Mask(dut).cells, Mask(flat).cells) << by_m << " " << over_m;
      }
}

// What is an obstacle from below is the floor from above, and the other way round; the cells of the
// edge are neither's.
TEST(SeenFrom, APlatformAndAPitAreTheOtherWayRoundFromTheirOwnFloor) {
  for (const Pose2& X : kFrames)
    for (const double height_m : {0.05, -0.05}) {
      const Pose2 aslant = X * Pose2{4, 3, 0.4};
      HazardMap map = Room(X);
      map.hazards = {Level("level", aslant, {-1.2, -1.2}, {1.2, 1.2}, height_m)};
      const HazardMap from_base = From(map, X, {7.5, 3}), from_level = From(map, X, {4, 3});
      ASSERT_THAT(Ids(from_level), ElementsAre("base_floor"));
      EXPECT_EQ(from_level.hazards[0].height_m, -height_m);
      const GridFrame fine = FineFrame(map.frame);
      const auto below = Mask(from_base), above = Mask(from_level);
      for (int iy = 0; iy < fine.height; ++iy)
        for (int ix = 0; ix < fine.width; ++ix) {
          const Vec2 p_W = fine.Center(ix, iy);
          const double inside_m = -SignedDistance(map.hazards[0].footprint[0], p_W);
          const Cell cell = map.frame.ToCell(p_W);
          if (map.IsWall(cell)) {
            EXPECT_TRUE(above(ix, iy) && below(ix, iy));
          } else if (std::abs(inside_m) > fine.cell_m) {
            EXPECT_EQ(above(ix, iy), inside_m < 0) << inside_m;
            EXPECT_EQ(below(ix, iy), inside_m > 0) << inside_m;
          } else {
            EXPECT_TRUE(above(ix, iy) || below(ix, iy));
          }
        }
    }
}

TEST(SeenFrom, LaterLevelsHold) {
  HazardMap map = Room();
  map.hazards = {Level("first", {}, {2, 2}, {6, 4}, 0.05), Level("hole", {}, {4, 2}, {5, 4}, -0.1),
                 Level("same", {}, {5.5, 2}, {7, 4}, 0.05),
                 Level("near", {}, {7, 2}, {8, 4}, 0.055)};
  const HazardMap dut = From(map, {}, {3, 3});
  EXPECT_THAT(Ids(dut), ElementsAre("base_floor", "hole", "near"));
  const ClearanceField field = ComputeClearance(dut, kStep_m);
  EXPECT_EQ(field.At({4.5, 3}), 0) << "the hole";
  EXPECT_EQ(field.At({1.5, 3}), 0) << "the base floor";
  EXPECT_GT(field.At({3, 3}), 0.9);
  EXPECT_GT(field.At({5.75, 3}), 0.7) << "where two of one height overlap";
  EXPECT_GT(field.At({7, 3}), 0.9) << "from one level to one that is hardly higher";
}

// From a deep floor one that is less deep rises, and a lidar meets its face.
TEST(SeenFrom, ALessDeepPitIsAStepUp) {
  for (const Pose2& X : kFrames) {
    HazardMap map = Room(X);
    map.hazards = {Level("deep", X, {1, 1}, {5, 5}, -0.5),
                   Level("shallow", X, {5, 1}, {9, 5}, -0.1)};
    const HazardMap dut = From(map, X, {3, 3});
    ASSERT_THAT(Ids(dut), ElementsAre("shallow"));
    EXPECT_NEAR(dut.hazards[0].height_m, 0.4, 1e-12);
    double area_m2 = 0;
    for (const Solid& solid : dut.hazards[0].solids) {
      EXPECT_EQ(solid.kind, Solid::Kind::kPrism);
      EXPECT_TRUE(IsConvex(solid.base));
      EXPECT_EQ(solid.z_low_m, 0);
      EXPECT_NEAR(solid.z_high_m, 0.4, 1e-12);
      area_m2 += SignedArea(solid.base);
    }
    EXPECT_NEAR(area_m2, 16, 1e-9);
    const HazardMap down = From(map, X, {7, 3});
    ASSERT_THAT(Ids(down), ElementsAre("deep"));
    EXPECT_EQ(down.hazards[0].solids[0].kind, Solid::Kind::kCut);
    EXPECT_NEAR(down.hazards[0].solids[0].z_low_m, -0.4, 1e-12);
  }
}

// Wherever the robot starts, terrain is met where it lies.
TEST(SeenFrom, TerrainStaysWhereNoLaterFloorTookIt) {
  HazardMap map = Room();
  map.hazards = {Level("platform", {}, {1, 1}, {3, 5}, 0.05),
                 Of(HazardClass::kTerrain, "mat", {}, {4, 2}, {8, 4}, 0.01),
                 Level("pit", {}, {5, 1}, {6, 5}, -0.3),
                 Of(HazardClass::kTerrain, "groove", {}, {7, 1}, {7.5, 5}, -0.02)};
  const auto area_m2 = [](const std::vector<Polygon>& polygons) {
    double sum_m2 = 0;
    for (const Polygon& polygon : polygons) sum_m2 += SignedArea(polygon);
    return sum_m2;
  };
  EXPECT_NEAR(area_m2(BareFloors(map)[1]), 2 * (4 - 1 - 0.5), 1e-9);
  for (const Vec2& start : {Vec2(2, 3), Vec2(4.5, 4.7)}) {
    const HazardMap dut = From(map, {}, start);
    for (std::size_t i = 0; i < dut.hazards.size(); ++i) {
      if (dut.hazards[i].id == "mat") {
        EXPECT_NEAR(area_m2(BareFloors(dut)[i]), 2 * (4 - 1 - 0.5), 1e-9);
      } else if (dut.hazards[i].id == "pit") {
        EXPECT_NEAR(area_m2(BareFloors(dut)[i]), 4, 1e-9);
      }
    }
    EXPECT_EQ(Mask(dut)(110, 60), 1) << "the pit, at (5.5, 3)";
  }
}

// A cover on the floor below bridges no edge, and one on the robot's own floor is none.
TEST(SeenFrom, TerrainOnAnotherFloorOpensItNot) {
  HazardMap map = Room();
  map.hazards = {Level("platform", {}, {2, 2}, {6, 4}, 0.05),
                 Of(HazardClass::kTerrain, "cover", {}, {3, 2.5}, {8, 3}, 0.01),
                 Of(HazardClass::kBlindObject, "box", {}, {5, 3.5}, {5.5, 4}, 0.5)};
  const HazardMap dut = From(map, {}, {2.5, 3});
  const ClearanceField field = ComputeClearance(dut, kStep_m);
  EXPECT_EQ(field.At({7, 2.75}), 0);
  EXPECT_GT(field.At({4, 2.75}), 0.7);
  EXPECT_EQ(field.At({5.25, 3.75}), 0);
  const auto box = std::ranges::find(dut.hazards, "box", &Hazard::id);
  EXPECT_NEAR(box->solids[0].z_high_m, 0.45, 1e-12);
}

TEST(SeenFrom, TheBaseFloorIsNoWallAndHasAnIdOfItsOwn) {
  HazardMap map = Room();
  map.hazards = {Level("base_floor", {}, {2, 2}, {6, 4}, 0.05),
                 Of(HazardClass::kTerrain, "base_floor_", {}, {3, 2.5}, {4, 3}, 0.01)};
  map.occupancy(15, 5) = CellState::kOccupied;
  const HazardMap dut = From(map, {}, {2.5, 3});
  // The cover lies below the platform, which is written first, and so on it.
  ASSERT_THAT(Ids(dut), ElementsAre("base_floor__", "base_floor_"));
  double area_m2 = 0;
  for (const Polygon& part : dut.hazards[0].footprint) {
    EXPECT_TRUE(IsConvex(part));
    area_m2 += SignedArea(part);
  }
  EXPECT_NEAR(area_m2, 8 * 4 - 4 * 2 - 0.25, 1e-9);
}

TEST(BareFloors, IsWhatLaterLevelChangesLeave) {
  HazardMap map = Room();
  map.hazards = {Level("pit", {}, {2, 2}, {6, 4}, -0.2),
                 Level("bridge", {}, {1, 2.5}, {7, 3.5}, 0.02),
                 Level("whole", {}, {1, 1}, {8, 5}, 0.1)};
  EXPECT_THAT(BareFloors(map)[0], IsEmpty());
  EXPECT_THAT(BareFloors(map)[2], SizeIs(1));
  map.hazards.pop_back();
  double area_m2 = 0;
  const std::vector<Polygon> bare = BareFloors(map)[0];
  for (const Polygon& part : bare) area_m2 += SignedArea(part);
  EXPECT_NEAR(area_m2, 4, 1e-9);

  // Who drives over the bridge does not cross the pit, and keeps off it.
  Path path(2);
  path[0].p_W = {1.5, 3}, path[1].p_W = {6.5, 3};
  const std::vector<std::size_t> on_the_way = LevelChangesOnTheWay(map, path);
  EXPECT_THAT(on_the_way, ElementsAre(1u));
  EXPECT_NEAR(ClearanceOnTheWay(map, on_the_way, kStep_m).At({4, 3}), 0.5, 0.05);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The room, its boundary and its corners, on floors drawn here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>

#include "base/streams.h"
#include "env/map/ros_map.h"
#include "planners/audit/features.h"
#include "planners/search/grid_paths.h"
#include "tests/places.h"
#include "tests/planners/floors.h"

namespace floorproof {
namespace {

constexpr double kCell_m = 0.05, kRadius_m = 0.18;

// Free cells where `inside` says so, all else occupied; the start in the middle.
template <class Inside>
HazardMap MapOf(int width, int height, const Inside& inside) {
  HazardMap map;
  map.frame = {width, height, kCell_m, {}};
  map.occupancy = Grid<CellState>(width, height, CellState::kOccupied);
  for (int iy = 0; iy < height; ++iy)
    for (int ix = 0; ix < width; ++ix)
      if (inside(ix + 0.5, iy + 0.5)) map.occupancy(ix, iy) = CellState::kFree;
  return map;
}

Room RoomOf(const HazardMap& map, const Vec2& start_W) {
  const Shape2 disc{Shape2::Kind::kCircle, kRadius_m, {}};
  return MakeRoom(map, ComputeSweepArea(map, disc, disc, 0.01, start_W), kRadius_m);
}
Vec2 MiddleOf(const HazardMap& map) {
  return 0.5 * kCell_m * Vec2(map.frame.width, map.frame.height);
}

// A rectangle, turned, in cells.
struct Box {
  Vec2 middle, half;
  double yaw_rad = 0;
  Vec2 In(const Vec2& p) const { return Pose2{middle.x(), middle.y(), yaw_rad}.Inverse() * p; }
  bool Holds(const Vec2& p) const {
    const Vec2 q = In(p);
    return std::abs(q.x()) < half.x() && std::abs(q.y()) < half.y();
  }
  std::vector<Vec2> Corners() const {
    std::vector<Vec2> corners;
    for (const double u : {-1.0, 1.0})
      for (const double v : {-1.0, 1.0})
        corners.push_back(Pose2{middle.x(), middle.y(), yaw_rad} *
                          Vec2(u * half.x(), v * half.y()));
    return corners;
  }
};

double NearestCell(const std::vector<Cell>& cells, const Vec2& p) {
  double nearest = 1e9;
  for (const Cell c : cells) nearest = std::min(nearest, (Vec2(c.ix + 0.5, c.iy + 0.5) - p).norm());
  return nearest;
}

TEST(CornersTest, OfARoomAndACupboardAreFoundHoweverTheyAreTurned) {
  for (int deg = 0; deg < 90; deg += 5) {
    SCOPED_TRACE(deg);
    const double yaw_rad = deg * kPi / 180;
    const Box room{{80.2, 79.7}, {45, 35}, yaw_rad};
    const Box cupboard{
        {80.2 + 10 * std::cos(yaw_rad), 79.7 + 10 * std::sin(yaw_rad)}, {10, 8}, yaw_rad};
    const HazardMap map = MapOf(160, 160, [&](double x, double y) {
      return room.Holds({x, y}) && !cupboard.Holds({x, y});
    });
    const Vec2 start = Pose2{80.2, 79.7, yaw_rad} * Vec2(-30, -20);
    const std::vector<Cell> corners = CornersOf(RoomOf(map, kCell_m * start));
    std::vector<Vec2> expected = room.Corners();
    for (const Vec2& p : cupboard.Corners()) expected.push_back(p);
    for (const Vec2& p : expected) EXPECT_LT(NearestCell(corners, p), 2) << p.transpose();
    EXPECT_LE(corners.size(), expected.size() + 2);
    for (const Cell c : corners) {
      const Vec2 p(c.ix + 0.5, c.iy + 0.5);
      const auto off = [&](const Vec2& corner) { return (corner - p).norm(); };
      EXPECT_LT(off(std::ranges::min(expected, {}, off)), 2) << p.transpose();
    }
  }
}

TEST(CornersTest, RaggedWallsHaveFew) {
  Stream random(3, 0, "ragged");
  Grid<std::uint8_t> rough(160, 160);
  for (std::uint8_t& cell : rough.cells) cell = random.Uniform() < 0.3;
  const HazardMap map = MapOf(160, 160, [&](double x, double y) {
    const bool core = x > 21 && y > 21 && x < 139 && y < 139;
    const bool edge = x > 20 && y > 20 && x < 140 && y < 140;
    return core || (edge && rough(static_cast<int>(x), static_cast<int>(y)));
  });
  const std::vector<Cell> corners = CornersOf(RoomOf(map, MiddleOf(map)));
  int along_walls = 0;
  for (const Cell c : corners) along_walls += std::abs(c.ix - 80) < 45 || std::abs(c.iy - 80) < 45;
  EXPECT_LE(along_walls, 12) << "of 472 cells of wall";
  for (const Vec2& p : Box{{80, 80}, {60, 60}}.Corners()) EXPECT_LT(NearestCell(corners, p), 5);
}

TEST(BoundaryTest, IsTheLineOfCellsAroundTheRoom) {
  const HazardMap map =
      MapOf(80, 60, [](double x, double y) { return x > 10 && x < 70 && y > 10 && y < 50; });
  const std::vector<Cell> boundary = BoundaryOf(RoomOf(map, MiddleOf(map)));
  ASSERT_FALSE(boundary.empty());
  for (const Cell c : boundary) {
    const double dx = std::max(std::abs(c.ix + 0.5 - 40) - 30, 0.0);
    const double dy = std::max(std::abs(c.iy + 0.5 - 30) - 20, 0.0);
    EXPECT_NEAR(std::max(dx, dy), 0.5, 1e-9) << c.ix << ", " << c.iy;
  }
  for (int ix = 11; ix < 69; ++ix) {
    EXPECT_LE(NearestCell(boundary, Vec2(ix + 0.5, 9.5)), 1) << ix;
    EXPECT_LE(NearestCell(boundary, Vec2(ix + 0.5, 50.5)), 1) << ix;
  }
}

// What encloses most, not what has most cells: a comb of furniture has a longer contour.
TEST(BoundaryTest, IsTheRoomsAndNotTheFurnitures) {
  const HazardMap map = MapOf(200, 200, [](double x, double y) {
    const bool comb =
        x > 60 && x < 160 && y > 50 && y < 150 && (x < 66 || std::fmod(y - 50, 24) < 12);
    return x > 10 && x < 190 && y > 10 && y < 190 && !comb;
  });
  const std::vector<Cell> boundary = BoundaryOf(RoomOf(map, kCell_m * Vec2(30, 30)));
  for (const Cell c : boundary)
    EXPECT_TRUE(c.ix < 10 || c.iy < 10 || c.ix >= 190 || c.iy >= 190) << c.ix << ", " << c.iy;
}

// Of one cell, it thins to a spur of the line around the room.
TEST(BoundaryTest, GoesAlongBothSidesOfAThinWall) {
  for (const int thick : {1, 2, 3}) {
    const HazardMap map = MapOf(140, 120, [&](double x, double y) {
      const bool partition = x > 60 && x < 60 + thick && y < 70;
      return x > 10 && x < 130 && y > 10 && y < 110 && !partition;
    });
    const std::vector<Cell> boundary = BoundaryOf(RoomOf(map, kCell_m * Vec2(30, 30)));
    for (int iy = 12; iy < 68; ++iy)
      EXPECT_LE(NearestCell(boundary, Vec2(60.5, iy + 0.5)), 1.5) << thick << " " << iy;
  }
}

// Beams that left the room through a gap draw free cells among unknown ones.
TEST(BoundaryTest, DoesNotFollowFansOfBeams) {
  const auto room = [](double x, double y) { return x > 20 && x < 80 && y > 20 && y < 80; };
  HazardMap map = MapOf(160, 100, room);
  const std::vector<Cell> before = BoundaryOf(RoomOf(map, kCell_m * Vec2(50, 50)));
  for (CellState& cell : map.occupancy.cells)
    if (cell != CellState::kFree) cell = CellState::kUnknown;  // walls that were not seen, too
  for (int beam = -20; beam <= 20; ++beam)
    for (double s = 0; s < 70; s += 0.25) {
      const double bearing = 0.02 * beam;
      const int ix = static_cast<int>(78 + s * std::cos(bearing));
      const int iy = static_cast<int>(50 + s * std::sin(bearing));
      if (ix < 160) map.occupancy(ix, iy) = CellState::kFree;
    }
  for (int iy = 20; iy < 80; ++iy)  // of the wall, all but a gap narrower than the robot is known
    if (std::abs(iy - 50) > 2) map.occupancy(80, iy) = CellState::kOccupied;
  const std::vector<Cell> after = BoundaryOf(RoomOf(map, kCell_m * Vec2(50, 50)));
  ASSERT_FALSE(after.empty());
  for (const Cell c : after)
    EXPECT_LT(NearestCell(before, Vec2(c.ix + 0.5, c.iy + 0.5)), 7) << c.ix << ", " << c.iy;
  for (const Cell c : before)
    EXPECT_LT(NearestCell(after, Vec2(c.ix + 0.5, c.iy + 0.5)), 7) << c.ix << ", " << c.iy;
}

TEST(BoundaryTest, MayLieOnTheMapsOwnEdge) {
  const HazardMap map = MapOf(
      40, 40, [](double x, double y) { return std::abs(x - 20) > 3 || std::abs(y - 20) > 3; });
  const std::vector<Cell> boundary = BoundaryOf(RoomOf(map, kCell_m * Vec2(8, 8)));
  ASSERT_FALSE(boundary.empty());
  for (const Cell c : boundary)
    EXPECT_TRUE(c.ix == -1 || c.iy == -1 || c.ix == 40 || c.iy == 40) << c.ix << ", " << c.iy;
}

class SharedMap : public ::testing::TestWithParam<std::string> {
 protected:
  // Around the widest place; none without the shared maps.
  static std::optional<Room> Widest() {
    const std::filesystem::path yaml = SharedFile("maps") / GetParam() / "map.yaml";
    if (!std::filesystem::exists(yaml)) return std::nullopt;
    const RosMap ros = ReadRosMap(yaml);
    HazardMap map;
    map.frame = ros.frame;
    map.occupancy = ros.occupancy;
    const ClearanceField clearance = ComputeClearance(map, 0.01);
    const auto widest = static_cast<int>(std::ranges::max_element(clearance.distance_m.cells) -
                                         clearance.distance_m.cells.begin());
    return RoomOf(map, clearance.frame.Center(widest % clearance.frame.width,
                                              widest / clearance.frame.width));
  }
};

// FAST's pixels lie up to six cells off.
TEST_P(SharedMap, CornersAreCellsBesideTheRoom) {
  const std::optional<Room> room = Widest();
  if (!room) GTEST_SKIP() << "no shared maps here";
  const std::vector<Cell> corners = CornersOf(*room);
  EXPECT_GT(corners.size(), 4u);
  for (const Cell c : corners) {
    const auto inside = [&](const Cell& n) { return room->inside.Inside(n) && room->inside(n); };
    EXPECT_FALSE(inside(c)) << c.ix << ", " << c.iy;
    bool beside = false;
    for (int k = 0; k < 9; ++k) beside |= inside({c.ix + k % 3 - 1, c.iy + k / 3 - 1});
    EXPECT_TRUE(beside) << c.ix << ", " << c.iy;
  }
}

// Scanned maps, ragged and with fans of beams: the boundary goes once around all of the room.
TEST_P(SharedMap, TheBoundaryEnclosesTheRoom) {
  const std::optional<Room> widest = Widest();
  if (!widest) GTEST_SKIP() << "no shared maps here";
  const Room& room = *widest;
  const std::vector<Cell> boundary = BoundaryOf(room);
  ASSERT_FALSE(boundary.empty());
  // Each step of it goes to a neighbour, beside the room, and the last leads to the first.
  Grid<std::uint8_t> line(room.inside.width + 4, room.inside.height + 4);
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    const Cell a = boundary[i], b = boundary[(i + 1) % boundary.size()];
    ASSERT_LE(std::max(std::abs(a.ix - b.ix), std::abs(a.iy - b.iy)), 1) << i;
    line(a.ix + 2, a.iy + 2) = 1;
    bool beside = false;
    for (int k = 0; k < 9; ++k) {
      const Cell n{a.ix + k % 3 - 1, a.iy + k / 3 - 1};
      beside = beside || (room.inside.Inside(n) && room.inside(n));
    }
    ASSERT_TRUE(beside) << a.ix << ", " << a.iy;
  }
  // What cannot be come to from outside without crossing it holds the room.
  Grid<std::uint8_t> open = line;
  for (std::uint8_t& cell : open.cells) cell = !cell;
  const Grid<std::int32_t> outside = StepsFrom(open, {0, 0});
  int come_to = 0;
  for (int iy = 0; iy < room.inside.height; ++iy)
    for (int ix = 0; ix < room.inside.width; ++ix)
      come_to += room.inside(ix, iy) && outside(ix + 2, iy + 2) >= 0;
  EXPECT_EQ(come_to, 0) << "cells of the room";
}

INSTANTIATE_TEST_SUITE_P(All, SharedMap,
                         ::testing::Values("apartment", "depot", "fetch_hq_2015", "lab_small",
                                           "office_plan", "office_scan", "small_house",
                                           "willow_2010"),
                         [](const auto& param_info) { return param_info.param; });

}  // namespace
}  // namespace floorproof

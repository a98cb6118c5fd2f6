// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/map_along_walls.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/planners/floors.h"

namespace floorproof {
namespace {

// A room of 4 m x 3 m at this yaw to the map's cells of 5 cm, with a pillar.
HazardMap RoomAt(double yaw_rad) {
  const Pose2 X_WR = Pose2{3, 3, yaw_rad} * Pose2{-2, -1.5, 0};
  return testing::RoomOnFloor(120, 120, 0.05, X_WR, [](const Vec2& p) {
    const bool is_inside = p.x() > 0 && p.x() < 4 && p.y() > 0 && p.y() < 3;
    const bool is_pillar = (p - Vec2(3, 2)).cwiseAbs().maxCoeff() < 0.15;
    return is_inside && !is_pillar;
  });
}

const Shape2 kSquare{Shape2::Kind::kFootprint, 0, Rectangle({-0.25, -0.25}, {0.25, 0.25})};

TEST(MapAlongWalls, TurnsWithTheWalls) {
  for (const double yaw_deg : {-40.0, -12.0, 5.0, 25.0}) {
    const auto dut = MapAlongWalls(RoomAt(yaw_deg * kPi / 180), kSquare);
    ASSERT_TRUE(dut) << yaw_deg;
    EXPECT_NEAR(dut->frame.X_WG.yaw_rad * 180 / kPi, yaw_deg,
                0.7);  // a room this small has few border cells
  }
  EXPECT_FALSE(MapAlongWalls(RoomAt(0), kSquare));
  EXPECT_FALSE(MapAlongWalls(RoomAt(kPi / 2), kSquare));
}

// Nothing free there is a wall here, and little that is free here is lost.
TEST(MapAlongWalls, IsFreeOnlyWhereTheMapIs) {
  const HazardMap map = RoomAt(0.4);
  const auto dut = MapAlongWalls(map, kSquare);
  ASSERT_TRUE(dut);
  const GridFrame& frame = dut->frame;
  double free_m2 = 0;
  for (int iy = 0; iy < frame.height; ++iy)
    for (int ix = 0; ix < frame.width; ++ix) {
      if (dut->IsWall(ix, iy)) continue;
      free_m2 += frame.cell_m * frame.cell_m;
      for (const Vec2& offset : {Vec2(0.01, 0.01), Vec2(0.99, 0.01), Vec2(0.01, 0.99),
                                 Vec2(0.99, 0.99), Vec2(0.5, 0.5)}) {
        const Vec2 p_W = frame.X_WG * Vec2((Vec2(ix, iy) + offset) * frame.cell_m);
        ASSERT_FALSE(map.IsWall(map.frame.ToCell(p_W))) << p_W.transpose();
      }
    }
  EXPECT_GT(free_m2, 0.95 * (4 * 3 - 0.3 * 0.3));
}

// It fills a whole number of cells, with the one that its centre is in: so it takes up no more room
// than it has.
TEST(MapAlongWalls, TheFootprintFillsItsCells) {
  const auto dut = MapAlongWalls(RoomAt(0.4), kSquare);
  ASSERT_TRUE(dut);
  const double cells = 0.25 / dut->frame.cell_m;
  EXPECT_NEAR(cells - std::floor(cells), 0.5, 0.01);
  EXPECT_LT(cells, std::floor(cells) + 0.5);
}

}  // namespace
}  // namespace floorproof

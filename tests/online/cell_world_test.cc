// SPDX-License-Identifier: Apache-2.0
#include "run/episode/cell_world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/online/cell_floor.h"

namespace floorproof {
namespace {

using testing::CellFloor;
using testing::kCell_m;

TEST(CellWorld, SeesExactlyWhatLiesWithinItsRadius) {
  std::vector<std::string> rows(15, std::string(15, '.'));
  rows[7][7] = 'S';
  rows[5][7] = rows[7][11] = rows[0][0] = '#';
  const CellFloor floor(rows);
  for (const double radius : {1.0, 1.5, 2.0, 4.0}) {
    const CellWorld dut(floor.frame, floor.blocked, floor.start, radius * kCell_m);
    KnownMap known(floor.frame);
    dut.Sense(known);
    for (int iy = 0; iy < 15; ++iy)
      for (int ix = 0; ix < 15; ++ix) {
        const bool seen = std::hypot(ix - 7, iy - 7) <= radius;
        const CellState is = floor.blocked(ix, iy) ? CellState::kOccupied : CellState::kFree;
        EXPECT_EQ(known.At(ix, iy), seen ? is : CellState::kUnknown) << ix << ", " << iy;
      }
  }
}

TEST(CellWorld, StepsToTheEightAroundItWithoutCuttingCorners) {
  const CellFloor floor({"...",  //
                         ".S#",  //
                         "..."});
  for (int iy = 0; iy < 3; ++iy)
    for (int ix = 0; ix < 3; ++ix) {
      CellWorld dut(floor.frame, floor.blocked, floor.start, kCell_m);
      EXPECT_EQ(dut.Step({ix, iy}), ix < 2) << ix << ", " << iy;
    }
  CellWorld dut(floor.frame, floor.blocked, {0, 0}, kCell_m);
  EXPECT_FALSE(dut.Step({0, 2})) << "two cells on";
  EXPECT_FALSE(dut.Step({-1, 0})) << "off the map";
  EXPECT_EQ(dut.moves(), 0);
}

// Eqs. 13 and 14, counted by hand: seven cells can be reached, the one behind the corners cannot.
TEST(CellWorld, CountsWhatIsCoveredAndCoveredAgain) {
  const CellFloor floor({"S..#",  //
                         "...#",  //
                         ".###",  //
                         "###."});
  CellWorld dut(floor.frame, floor.blocked, floor.start, kCell_m);
  EXPECT_EQ(dut.reachable_cells(), 7);
  EXPECT_DOUBLE_EQ(dut.coverage(), 1.0 / 7);
  for (const Cell to : {Cell{1, 3}, Cell{0, 3}, Cell{1, 3}, Cell{2, 3}}) EXPECT_TRUE(dut.Step(to));
  EXPECT_DOUBLE_EQ(dut.coverage(), 3.0 / 7);
  EXPECT_DOUBLE_EQ(dut.revisited_share(), 2.0 / 7);
  EXPECT_EQ(dut.visited(), 3);
  EXPECT_EQ(dut.moves(), 4);
}

}  // namespace
}  // namespace floorproof

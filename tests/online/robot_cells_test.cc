// SPDX-License-Identifier: Apache-2.0
#include "planners/online/robot_cells.h"

#include <gtest/gtest.h>

#include "planners/online/nearest_uncovered.h"
#include "tests/online/cell_floor.h"

namespace floorproof {
namespace {

constexpr double kMost = 4;

// Takes over what the map has become.
void Take(KnownMap& known, RobotCells& dut) {
  dut.Update(known, *known.changed);
  known.changed->clear();
}

KnownMap AllFree(const GridFrame& frame) {
  KnownMap known(frame);
  known.changed.emplace();
  for (int iy = 0; iy < frame.height; ++iy)
    for (int ix = 0; ix < frame.width; ++ix) known.Add(ix, iy, -kMost, kMost);
  return known;
}

TEST(RobotCells, OfTheMapsOwnSizeAreTheMap) {
  const GridFrame frame = {6, 4, 0.5, {1, 2, 0.3}};
  KnownMap known = AllFree(frame);
  known.Add(2, 1, 2 * kMost, kMost);
  RobotCells dut(frame, frame.Center(1, 1), 0.5, 0);
  EXPECT_EQ(dut.frame().width, 6);
  EXPECT_EQ(dut.frame().height, 4);
  EXPECT_FALSE(dut.IsFree({0, 0})) << "nothing is known yet";
  EXPECT_TRUE(dut.MayBeFree({0, 0}));
  Take(known, dut);
  for (int iy = -1; iy <= 4; ++iy)
    for (int ix = -1; ix <= 6; ++ix) {
      const Cell c = {ix, iy};
      const bool free = frame.Inside(c) && c != Cell{2, 1};
      EXPECT_EQ(dut.IsFree(c), free) << ix << ", " << iy;
      EXPECT_EQ(dut.MayBeFree(c), free) << ix << ", " << iy;
      if (frame.Inside(c)) {
        EXPECT_EQ(dut.At(frame.Center(c)), c);
      }
    }
}

TEST(RobotCells, TheStartIsTheMiddleOfOneAndAllGroundLiesInThem) {
  const GridFrame frame = {100, 60, 0.05, {-1, 2, 0.7}};
  for (const Vec2& at : {Vec2(0.31, 1.234), Vec2(2.5, 0.05), Vec2(4.99, 2.99)}) {
    const Vec2 start_W = frame.X_WG * at;
    const RobotCells dut(frame, start_W, 0.33, 0.1);
    EXPECT_LT((dut.frame().Center(dut.At(start_W)) - start_W).norm(), 1e-9);
    for (const Cell corner : {Cell{0, 0}, Cell{99, 0}, Cell{0, 59}, Cell{99, 59}})
      EXPECT_TRUE(dut.frame().Inside(dut.At(frame.Center(corner))));
  }
}

// A cell is free where nothing within the clearance of its middle is anything but known to be free.
TEST(RobotCells, KeepClearOfWhatIsOccupiedUnknownOrBeyondTheMap) {
  const GridFrame frame = {80, 80, 0.05, {}};
  const double step_m = 0.3, clear_m = 0.21;
  KnownMap known = AllFree(frame);
  const Cell wall = {41, 37};
  known.Add(wall.ix, wall.iy, 2 * kMost, kMost);
  known.Add(10, 60, kMost, kMost);  // unknown again
  RobotCells dut(frame, {2.0, 2.0}, step_m, clear_m);
  Take(known, dut);
  const auto to = [&](const Vec2& p, Cell c) {
    const Vec2 low = frame.cell_m * Vec2(c.ix, c.iy);
    return (p.cwiseMax(low).cwiseMin(low + Vec2(0.05, 0.05)) - p).norm();
  };
  int kept_off = 0;
  for (int iy = 0; iy < dut.frame().height; ++iy)
    for (int ix = 0; ix < dut.frame().width; ++ix) {
      const Vec2 p = dut.frame().Center(ix, iy);
      const double to_border_m = std::min({p.x(), p.y(), 4 - p.x(), 4 - p.y()});
      const bool off_wall = to(p, wall) >= clear_m - 1e-9 && to_border_m >= clear_m - 1e-9;
      const bool off_unknown = to(p, {10, 60}) >= clear_m - 1e-9;
      EXPECT_EQ(dut.IsFree({ix, iy}), off_wall && off_unknown) << p.transpose();
      EXPECT_EQ(dut.MayBeFree({ix, iy}), off_wall) << p.transpose();
      kept_off += !off_wall && to_border_m > 0.5;
    }
  EXPECT_GE(kept_off, 1);
}

TEST(RobotCells, WhatIsSeenOtherwiseLaterIsTakenOver) {
  const GridFrame frame = {20, 20, 0.1, {}};
  KnownMap known = AllFree(frame);
  RobotCells dut(frame, frame.Center(10, 10), 0.3, 0.1);
  Take(known, dut);
  const Cell c = dut.At(frame.Center(10, 10));
  ASSERT_TRUE(dut.IsFree(c));
  known.Add(10, 10, 2 * kMost, kMost);
  Take(known, dut);
  EXPECT_FALSE(dut.MayBeFree(c));
  EXPECT_FALSE(dut.changed().empty());
  known.Add(10, 10, -2 * kMost, kMost);
  Take(known, dut);
  EXPECT_TRUE(dut.IsFree(c));
  known.Mark(FloorMark::Kind::kDrop, frame.Center(10, 10), 0.05);
  Take(known, dut);
  EXPECT_FALSE(dut.IsFree(c));
}

TEST(NearestUncovered, IsTheNearestByTheWayThere) {
  // The cell beyond the wall is nearer as the crow flies.
  const testing::CellFloor floor({".....",  //
                                  "####.",  //
                                  "S...."});
  RobotCells cells(floor.frame, floor.frame.Center(floor.start), testing::kCell_m, 0);
  KnownMap known(floor.frame);
  known.changed.emplace();
  for (int iy = 0; iy < 3; ++iy)
    for (int ix = 0; ix < 5; ++ix) known.Add(ix, iy, floor.blocked(ix, iy) ? kMost : -kMost, kMost);
  Take(known, cells);
  for (int ix = 0; ix < 4; ++ix) cells.Visit({ix, 0});
  NearestUncovered dut(cells.frame());
  EXPECT_EQ(dut.PathFrom({0, 0}, cells), (std::vector<Cell>{{1, 0}, {2, 0}, {3, 0}, {4, 0}}));
  cells.Visit({4, 0});
  EXPECT_EQ(dut.PathFrom({0, 0}, cells).back(), (Cell{4, 1}));
  for (int ix = 0; ix < 5; ++ix) cells.Visit({ix, 2});
  cells.Visit({4, 1});
  EXPECT_TRUE(dut.PathFrom({0, 0}, cells).empty());
}

}  // namespace
}  // namespace floorproof

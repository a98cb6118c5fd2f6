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

Extent Round(double radius_m) { return {Vec2::Constant(radius_m), true}; }

TEST(RobotCells, OfTheMapsOwnSizeAreTheMap) {
  const GridFrame frame = {6, 4, 0.5, {1, 2, 0.3}};
  KnownMap known = AllFree(frame);
  known.Add(2, 1, 2 * kMost, kMost);
  RobotCells dut(frame, frame.Center(1, 1), 0.5, {});
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
    const RobotCells dut(frame, start_W, 0.33, Round(0.1));
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
  RobotCells dut(frame, {2.0, 2.0}, step_m, Round(clear_m));
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

// A footprint that is kept upright clears a rectangle, wherever the map's axes point.
TEST(RobotCells, ARectangleIsExtentInTheGroundsAxes) {
  const GridFrame frame = {60, 60, 0.1, {3, -2, 0.8}};
  const Vec2 half_m(0.5, 0.2);
  const double step_m = 0.1;
  KnownMap known = AllFree(frame);
  known.Add(30, 30, 2 * kMost, kMost);
  RobotCells dut(frame, frame.Center(30, 30), step_m, {half_m, false});
  Take(known, dut);
  for (int iy = 10; iy < 50; ++iy)
    for (int ix = 10; ix < 50; ++ix) {
      const Vec2 p_W = dut.frame().Center(ix, iy);
      const Vec2 by = (frame.X_WG.Inverse() * p_W - Vec2(3.05, 3.05)).cwiseAbs();
      const bool meets = by.x() < 0.55 - 1e-6 && by.y() < 0.25 - 1e-6;
      EXPECT_EQ(dut.IsFree({ix, iy}), !meets) << by.transpose();
    }
}

// Pushed into a cell that is not free, the robot goes on from the nearest that is.
TEST(RobotCells, BesideAMarkTheNearestFreeCellStandsForTheRobots) {
  const GridFrame frame = {40, 40, 0.1, {}};
  KnownMap known = AllFree(frame);
  RobotCells dut(frame, frame.Center(20, 20), 0.3, Round(0.2));
  known.Mark(FloorMark::Kind::kBump, {2.25, 2.05}, 0.05);
  Take(known, dut);
  const Vec2 here_W(2.0, 2.05);
  ASSERT_FALSE(dut.IsFree(dut.At(here_W)));
  const Cell nearest = dut.FreeAt(here_W);
  EXPECT_EQ(nearest, dut.At(here_W) + (Cell{-1, 0}));
  EXPECT_EQ(dut.FreeAt(dut.frame().Center(nearest)), nearest);
  EXPECT_EQ(dut.FreeAt({-5, -5}), dut.At({-5, -5})) << "there is none near";
}

// Of another extent: a thin robot fits where the clearance does not.
TEST(RobotCells, AreFreeForAnExtentThatFits) {
  const GridFrame frame = {40, 40, 0.05, {}};
  KnownMap known = AllFree(frame);
  known.Add(20, 20, 2 * kMost, kMost);
  RobotCells dut(frame, frame.Center(20, 20), 0.05, Round(0.3));
  Take(known, dut);
  EXPECT_FALSE(dut.IsFree({24, 20}));
  EXPECT_TRUE(dut.IsFreeFor(Round(0.17) / 0.05, {24, 20})) << "0.175 m from its face";
  EXPECT_FALSE(dut.IsFreeFor(Round(0.18) / 0.05, {24, 20}));
  EXPECT_FALSE(dut.IsFreeFor(Round(0.001) / 0.05, {20, 20})) << "in it";
}

TEST(RobotCells, WhatIsSeenOtherwiseLaterIsTakenOver) {
  const GridFrame frame = {20, 20, 0.1, {}};
  KnownMap known = AllFree(frame);
  RobotCells dut(frame, frame.Center(10, 10), 0.3, Round(0.1));
  dut.TellChanges();
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
  RobotCells cells(floor.frame, floor.frame.Center(floor.start), testing::kCell_m, {});
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

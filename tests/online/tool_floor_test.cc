// SPDX-License-Identifier: Apache-2.0
#include "planners/online/tool_floor.h"

#include <gmock/gmock.h>

namespace floorproof {
namespace {

constexpr double kMost = 4;

// A room of 4 m x 3 m: walls of one cell.
class ToolFloorTest : public ::testing::Test {
 protected:
  ToolFloorTest() : known_(kFrame) {
    known_.changed.emplace();
    for (int iy = 0; iy < kFrame.height; ++iy)
      for (int ix = 0; ix < kFrame.width; ++ix) {
        const bool wall = ix == 0 || iy == 0 || ix == kFrame.width - 1 || iy == kFrame.height - 1;
        known_.Add(ix, iy, wall ? kMost : -kMost, kMost);
      }
  }
  ToolFloor Floor(const Extent& clear, const Extent& tool) {
    ToolFloor floor(kFrame, kBody, clear, tool);
    Take(floor);
    return floor;
  }
  void Take(ToolFloor& floor) {
    floor.Update(known_, *known_.changed);
    known_.changed->clear();
  }
  // Of the room, what is open, m2.
  static double Open_m2(const ToolFloor& floor) {
    double open = 0;
    for (int iy = 0; iy < floor.frame().height; ++iy)
      for (int ix = 0; ix < floor.frame().width; ++ix) open += floor.IsOpen({ix, iy});
    return open * floor.frame().cell_m * floor.frame().cell_m;
  }
  static Vec2 At(double x_m, double y_m) { return kFrame.X_WG * Vec2(x_m, y_m); }

  static constexpr double kCell_m = 0.05;
  inline static const GridFrame kFrame = {80, 60, kCell_m, {1, 2, 0.4}};
  inline static const Extent kDisc = {Vec2::Constant(0.15), true};
  inline static const Extent kSquare = {Vec2::Constant(0.25), false};
  inline static const Extent kBody = {Vec2::Constant(0.17), true};
  static constexpr ToolFloor::Worth kAny = {20, 20, 0};
  KnownMap known_;
};

TEST_F(ToolFloorTest, TheRobotMayBeWhereItKeepsClearOfTheWalls) {
  for (const double clear_m : {0.18, 0.2, 0.21, 0.265}) {
    const ToolFloor dut = Floor({Vec2::Constant(clear_m), true}, kDisc);
    double least_m = 1;
    for (int iy = 0; iy < dut.frame().height; ++iy)
      for (int ix = 0; ix < dut.frame().width; ++ix) {
        const Vec2 p = kFrame.X_WG.Inverse() * dut.frame().Center(ix, iy);
        const double away_m = std::min({p.x(), p.y(), 4 - p.x(), 3 - p.y()}) - kCell_m;
        EXPECT_EQ(dut.IsFree({ix, iy}), away_m >= clear_m - 1e-9) << away_m;
        if (dut.IsFree({ix, iy})) least_m = std::min(least_m, away_m);
      }
    EXPECT_LT(least_m, clear_m + 0.0126) << "poses come as near to walls as the grid allows";
    known_.changed->clear();
    for (int i = 0; i < 80 * 60; ++i) known_.changed->push_back({i % 80, i / 80});
  }
}

TEST_F(ToolFloorTest, WhatTheToolPassesOverIsSweptUntilItIsTakenBack) {
  for (const auto& [tool, width_m, end_m2] :
       {std::tuple{kDisc, 0.3, kPi * 0.15 * 0.15}, std::tuple{kSquare, 0.5, 0.25}}) {
    known_.changed->clear();
    for (int i = 0; i < 80 * 60; ++i) known_.changed->push_back({i % 80, i / 80});
    ToolFloor dut = Floor({Vec2::Constant(0.2), true}, tool);
    const double all_m2 = Open_m2(dut);
    EXPECT_NEAR(all_m2, 3.9 * 2.9, 0.3);
    dut.Sweep(At(1, 1), At(3, 1));
    EXPECT_NEAR(all_m2 - Open_m2(dut), 2 * width_m + end_m2, 0.15);
    dut.Sweep(At(2, 1), At(2, 2));
    dut.TakeBack(At(1, 1), At(3, 1));
    EXPECT_NEAR(all_m2 - Open_m2(dut), width_m + end_m2, 0.1);
  }
}

// A square that goes along a diagonal sweeps a band as wide as its own diagonal.
TEST_F(ToolFloorTest, ASquareSweepsMoreAlongADiagonal) {
  ToolFloor dut = Floor({Vec2::Constant(0.3), false}, kSquare);
  const double all_m2 = Open_m2(dut);
  dut.Sweep(At(1, 1), At(2, 2));
  EXPECT_NEAR(all_m2 - Open_m2(dut), 2 * 1 * 0.5 + 0.25, 0.1);
}

TEST_F(ToolFloorTest, TheWayLeadsAroundToTheNearestOpenPlace) {
  // A wall between two halves, with a gap at the far end.
  for (int iy = 0; iy < 45; ++iy) known_.Add(40, iy, 2 * kMost, kMost);
  ToolFloor dut = Floor({Vec2::Constant(0.18), true}, kDisc);
  for (double y_m = 0.1; y_m < 3; y_m += 0.1) dut.Sweep(At(0.1, y_m), At(2.2, y_m));
  const Cell here = dut.FreeAt(At(1, 0.5), 0.1);
  const std::vector<ToolFloor::Leg> way = dut.WayToOpen(here, kAny);
  ASSERT_GE(way.size(), 2u);
  const Vec2 end = kFrame.X_WG.Inverse() * way.back().to_W;
  EXPECT_GT(end.x(), 2.05) << "beyond the wall";
  const Vec2 corner = kFrame.X_WG.Inverse() * way.front().to_W;
  EXPECT_GT(corner.y(), 2.25 + 0.1) << "through the gap";
  // Nothing is worth a way where all is swept.
  for (double y_m = 0.1; y_m < 3; y_m += 0.1) dut.Sweep(At(0.1, y_m), At(3.9, y_m));
  EXPECT_TRUE(dut.WayToOpen(here, kAny).empty());
}

// A patch at the far end of the room: near enough for a robot that goes far for it.
TEST_F(ToolFloorTest, APlaceFarAwayMustHaveMore) {
  ToolFloor dut = Floor({Vec2::Constant(0.18), true}, kDisc);
  for (double y_m = 0.1; y_m < 3; y_m += 0.1) dut.Sweep(At(0.1, y_m), At(3.3, y_m));
  const Cell here = dut.FreeAt(At(0.5, 1.5), 0.1);
  const double tool = static_cast<double>(dut.tool().size());
  const double way = 2.9 / dut.frame().cell_m;  // about
  EXPECT_FALSE(dut.WayToOpen(here, {0.1 * tool, tool, 0}).empty());
  EXPECT_FALSE(dut.WayToOpen(here, {0.1 * tool, 0.5 * tool, 9 * tool / way}).empty());
  EXPECT_TRUE(dut.WayToOpen(here, {0.1 * tool, 2 * tool, 2 * tool / way}).empty());
}

// Of two lanes that lie as far apart as beside() tells, the second leaves nothing between; and its
// tool reaches less than a cell into the first.
TEST_F(ToolFloorTest, LanesLieSideBySide) {
  for (const double cell_m : {0.05, 0.0506424, 0.068, 0.1})
    for (const Extent& tool : {kDisc, kSquare}) {
      const GridFrame frame = {60, 60, cell_m, {}};
      known_ = KnownMap(frame);
      known_.changed.emplace();
      for (int i = 0; i < 60 * 60; ++i) known_.Add(i % 60, i / 60, -kMost, kMost);
      ToolFloor dut(frame, kBody, {Vec2::Constant(0.2), true}, tool);
      Take(dut);
      const double width = 2 * tool.half_m.x() / dut.frame().cell_m;
      int under = 0;
      for (const Cell& c : dut.tool()) under = std::max(under, c.iy);
      const int apart = dut.beside(0).iy + under;
      EXPECT_GT(apart, 0.94 * width) << cell_m;
      EXPECT_LE(apart, width + 0.06) << cell_m;
      const Cell a = dut.frame().ToCell({1, 1.5}), b = dut.frame().ToCell({2, 1.5});
      for (const int up : {0, apart})
        dut.Sweep(dut.frame().Center(a + Cell{0, up}), dut.frame().Center(b + Cell{0, up}));
      const int middle = (a.ix + b.ix) / 2;
      int left_open = 0;
      for (int iy = a.iy; iy <= a.iy + apart; ++iy) left_open += dut.IsOpen({middle, iy});
      // Where the tool is whole cells wide, the middles of those on both borders count as
      // neither's.
      EXPECT_LE(left_open, std::abs(width - std::round(width)) < 1e-6 ? 1 : 0) << cell_m;
    }
}

// What is seen later may close the door through which it came: it was there, so it may go back.
TEST_F(ToolFloorTest, ARobotThatIsWalledInByNoiseGoesBackTheWayItCame) {
  ToolFloor dut = Floor({Vec2::Constant(0.18), true}, kDisc);
  dut.Stand(At(0.5, 1.5), At(3, 1.5));
  for (int iy = 0; iy < 60; ++iy)
    if (iy < 27 || iy > 32) known_.Add(40, iy, 2 * kMost, kMost);
  Take(dut);
  for (double y_m = 0.1; y_m < 3; y_m += 0.1) dut.Sweep(At(2.0, y_m), At(3.9, y_m));
  const std::vector<ToolFloor::Leg> way = dut.WayToOpen(dut.FreeAt(At(3, 1.5), 0.1), kAny);
  ASSERT_FALSE(way.empty());
  EXPECT_LT((kFrame.X_WG.Inverse() * way.back().to_W).x(), 2);
  // Not where it was touched since.
  known_.Mark(FloorMark::Kind::kBump, At(2.025, 1.5), 0.05);
  Take(dut);
  EXPECT_TRUE(dut.WayToOpen(dut.FreeAt(At(3, 1.5), 0.1), kAny).empty());
}

}  // namespace
}  // namespace floorproof

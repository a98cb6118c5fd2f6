// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/turn_curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "planners/lines/dubins.h"
#include "planners/lines/leg_choice.h"
#include "planners/lines/legs.h"
#include "tests/planners/curvature.h"
#include "tests/planners/floors.h"

namespace floorproof {
namespace {

using testing::Draw;
using testing::EmptyFloor;
using testing::TightestTurn;

constexpr double kR_m = 0.25, kBody_m = 0.3;

Path PathOf(const std::vector<Vec2>& points) {
  Path path;
  for (const Vec2& p : points) path.emplace_back().p_W = p;
  return path;
}

TurnedPath Turned(const HazardMap& map, const Path& path, const Pose2& start) {
  const ClearanceField clearance = ComputeClearance(map, 0.01);
  TurnedPath out = WithTurns(path, {clearance, kBody_m, 0, kR_m, 0, start});
  // Whatever the plan: no turn tighter than asked for, and nowhere nearer to a wall than the body.
  EXPECT_GE(TightestTurn(out.path), 0.99 * kR_m);
  for (std::size_t i = 0; i + 1 < out.path.size(); ++i) {
    const Vec2 a = out.path[i].p_W, way = out.path[i + 1].p_W - a;
    for (double s = 0; s <= 1; s += 0.05)
      EXPECT_GE(clearance.At(a + s * way), kBody_m - 0.01) << a.transpose();
  }
  if (out.path.size() > 1) {
    const Vec2 off = out.path[1].p_W - out.path[0].p_W;
    EXPECT_LT(std::abs(WrapAngle(std::atan2(off.y(), off.x()) - start.yaw_rad)), 0.1)
        << "it sets out as it faces";
  }
  return out;
}

TEST(TurnCurves, AStraightPlanStaysAsItIs) {
  const Path path = PathOf({{1, 2}, {2, 2}, {5, 2}});
  const TurnedPath dut = Turned(EmptyFloor(30, 20, 0.2), path, {1, 2, 0});
  ASSERT_EQ(dut.path.size(), 2u);
  EXPECT_EQ(dut.path.back().p_W, path.back().p_W);
  EXPECT_EQ(dut.left_out, 0);
}

//   |        |
//   |   ->   (   the corner is rounded: 2 R shorter, a quarter circle longer
// --+      --
TEST(TurnCurves, ACornerInTheOpenIsRounded) {
  const Path path = PathOf({{1, 1}, {3, 1}, {3, 3}});
  const TurnedPath dut = Turned(EmptyFloor(30, 20, 0.2), path, {1, 1, 0});
  EXPECT_EQ(dut.left_out, 0);
  EXPECT_NEAR(Length(dut.path), 4 - 2 * kR_m + kPi / 2 * kR_m, 0.01);
  EXPECT_EQ(dut.path.back().p_W, path.back().p_W);
}

// Rows two radii apart and more are joined by half circles.
TEST(TurnCurves, RowsAreJoinedByUTurns) {
  const Path path =
      PathOf({{1, 1}, {5, 1}, {5, 1.5}, {1, 1.5}, {1, 2}, {5, 2}, {5, 2.5}, {1, 2.5}});
  const TurnedPath dut = Turned(EmptyFloor(30, 20, 0.2), path, {1, 1, 0});
  EXPECT_EQ(dut.path.back().p_W, path.back().p_W);
  double swept_m = 0;  // of the rows
  for (std::size_t i = 0; i + 1 < dut.path.size(); ++i) {
    const Vec2 way = dut.path[i + 1].p_W - dut.path[i].p_W;
    if (std::abs(way.y()) < 1e-9) swept_m += std::abs(way.x());
  }
  EXPECT_GT(swept_m, 4 * (4 - 2 * kR_m) - 1e-6) << "each keeps what its turns leave";
}

constexpr const char* kRoomWithCorridor = R"(
      ############################
      #................###########
      #................###########
      #................###########
      #................###########
      #...........................
      #...........................
      #...........................
      #................###########
      #................###########
      #................###########
      #................###########
      ############################)";

// Nobody turns in a corridor that is narrower than a turn: the row into it is left out, and the
// rest is driven.
TEST(TurnCurves, ADeadEndIsLeftOut) {
  const HazardMap map = Draw(kRoomWithCorridor, 0.25);
  const Path path = PathOf({{0.8, 1.6},
                            {6.4, 1.6},
                            {3.4, 1.6},
                            {3.4, 2.2},
                            {0.8, 2.2},
                            {0.8, 1.0},
                            {3.4, 1.0},
                            {3.4, 1.6},
                            {0.8, 1.6}});
  const TurnedPath dut = Turned(map, path, {0.8, 1.6, 0});
  EXPECT_GT(dut.left_out, 0);
  EXPECT_GT(dut.left_out_m, 1);
  ASSERT_FALSE(dut.path.empty());
  EXPECT_EQ(dut.path.back().p_W, path.back().p_W);
  for (const Waypoint& w : dut.path) EXPECT_LT(w.p_W.x(), 4);
}

// However long the dead end is.
TEST(TurnCurves, WhatComesAfterALongDeadEndIsDriven) {
  const HazardMap map = Draw(kRoomWithCorridor, 0.25);
  std::vector<Vec2> points = {{0.8, 1.6}, {4.6, 1.6}};
  constexpr int kLegs = 450;  // across the corridor, where nobody can turn across
  for (int k = 1; k <= kLegs; ++k)
    points.emplace_back(4.6 + 1.5 * k / kLegs, 1.6 + (k % 2 == 0 ? 0.04 : -0.04));
  for (const Vec2& p : {Vec2(3.4, 1.6), Vec2(3.4, 2.2), Vec2(0.8, 2.2), Vec2(0.8, 1), Vec2(3.4, 1)})
    points.push_back(p);
  const Path path = PathOf(points);
  const TurnedPath dut = Turned(map, path, {0.8, 1.6, 0});
  ASSERT_FALSE(dut.path.empty());
  EXPECT_EQ(dut.path.back().p_W, path.back().p_W);
  EXPECT_GE(dut.left_out, kLegs);
}

// The clearance of the plan within a radius of a place on it, on one side.
double LeastAlong(const ClearanceField& clearance, const std::vector<Leg>& legs, std::size_t leg,
                  double s_m, int side) {
  double least_m = std::numeric_limits<double>::infinity();
  for (double way_m = 0; way_m <= kR_m; way_m += 0.01, s_m += 0.01 * side) {
    while (side > 0 && s_m > legs[leg].length_m && leg + 1 < legs.size())
      s_m -= legs[leg++].length_m;
    while (side < 0 && s_m < 0 && leg > 1) s_m += legs[--leg].length_m;
    least_m =
        std::min(least_m, clearance.At(legs[leg].At(std::clamp(s_m, 0.0, legs[leg].length_m)).p()));
  }
  return least_m;
}

// Wherever else the plan comes near a wall, and wherever it starts: plans of chance in a room.
TEST(TurnCurves, ATurnIsAsClearAsTheLegsThatItJoins) {
  constexpr double kMargin_m = 0.2, kCells_m = 0.05;
  const HazardMap map = EmptyFloor(16, 12, 0.25);  // 4 m x 3 m
  const ClearanceField clearance = ComputeClearance(map, 0.01);
  std::mt19937 random(7);
  const auto share = [&] { return static_cast<double>(random()) / 4294967296.0; };
  const auto place = [&] { return Vec2(0.32 + 3.36 * share(), 0.32 + 2.36 * share()); };
  int near_walls = 0;
  for (int plan = 0; plan < 30; ++plan) {
    std::vector<Vec2> points;
    for (int i = 0; i < 12; ++i) points.push_back(place());
    const Pose2 start{points[0].x(), points[0].y(), 2 * kPi * share()};
    const TurnRequest request{clearance, kBody_m, kMargin_m, kR_m, 0, start};
    const std::vector<Leg> legs = LegsOf(PathOf(points), start);
    std::size_t before = 0;
    double left_m = 0;
    for (const JoinedLeg& dut : ChooseLegs(legs, request)) {
      const Leg& leg = legs[dut.leg];
      const double wanted_m = kBody_m + kMargin_m;
      const double end_m = clearance.At(leg.At(dut.begin_m).p());
      double least_m = std::min(wanted_m, end_m), first_m = least_m;
      if (before > 0)
        first_m = least_m =
            std::min({wanted_m, LeastAlong(clearance, legs, dut.leg, dut.begin_m, -1),
                      LeastAlong(clearance, legs, before, left_m, 1)});
      else
        first_m = std::min(least_m, clearance.At(start.p()));
      bool has_left = false;
      for (double s_m = 0; s_m < dut.curve.Length(); s_m += 0.01) {
        const double here_m = clearance.At(dut.curve.At(s_m).p());
        EXPECT_GE(here_m, (has_left ? least_m : first_m) - kCells_m) << plan << ", leg " << dut.leg;
        has_left |= here_m > least_m + kCells_m;
        near_walls += here_m < least_m + kCells_m;
      }
      before = dut.leg;
      left_m = dut.end_m;
    }
  }
  EXPECT_GT(near_walls, 100) << "it is put to the test";
}

// It stands 0.1 m too near to the wall on its right, which it must leave, and faces another: from
// 0.5 m and a radius before that one there is room to turn.
TEST(TurnCurves, AStartNearOneWallAllowsNoTurnNearAnother) {
  const ClearanceField clearance = ComputeClearance(EmptyFloor(16, 12, 0.25), 0.01);
  for (const double y_m : {0.95, 1.05}) {
    const Pose2 start{0.4, y_m, -kPi / 2};
    const TurnedPath dut = WithTurns(PathOf({{3, 2}}), {clearance, 0.3, 0.2, 0.5, 0, start});
    EXPECT_EQ(dut.path.empty(), y_m < 1) << y_m;
  }
}

TEST(TurnCurves, WhereItCannotLeaveTheStartThereIsNoPlan) {
  const HazardMap map = Draw(R"(
      ##########
      #........#
      #........#
      #........#
      ##########)",
                             0.25);
  const TurnedPath dut =
      Turned(map, PathOf({{1.25, 0.62}, {1.25, 0.62}, {0.7, 0.62}}), {1.25, 0.62, 0});
  EXPECT_TRUE(dut.path.empty());
  EXPECT_EQ(dut.left_out, dut.lanes);
}

// A robot that faces away turns round first, and is then on its row.
TEST(TurnCurves, TheFirstLegIsReachedFromTheRobotsHeading) {
  const Path path = PathOf({{3, 2}, {5, 2}});
  for (const double yaw_rad : {0.5, 2.0, kPi, -2.5}) {
    const TurnedPath dut = Turned(EmptyFloor(40, 30, 0.2), path, {3, 2, yaw_rad});
    EXPECT_EQ(dut.left_out, 0) << yaw_rad;
    EXPECT_EQ(dut.path.back().p_W, path.back().p_W);
  }
}

TEST(TurnCurves, DwellsTasksAndSpeedsAreKept) {
  Path path = PathOf({{1, 1}, {3, 1}, {3, 3}, {1, 3}});
  path[1].dwell_s = 2;
  path[1].task = WaypointTask{.id = 4};
  path[2].dwell_s = 1;
  path[2].speed_mps = 0.15;
  const TurnedPath dut = Turned(EmptyFloor(30, 30, 0.2), path, {1, 1, 0});
  EXPECT_EQ(dut.left_out, 0);
  std::vector<Waypoint> dwells;
  for (const Waypoint& w : dut.path) {
    if (w.dwell_s > 0) dwells.push_back(w);
    if (dwells.size() == 1 && w.dwell_s == 0) {
      EXPECT_EQ(w.speed_mps, 0.15);
    }
  }
  ASSERT_EQ(dwells.size(), 2u);
  EXPECT_EQ(dwells[0].p_W, path[1].p_W);
  EXPECT_EQ(dwells[0].task->id, 4);
  EXPECT_EQ(dwells[1].p_W, path[2].p_W);
}

TEST(TurnCurves, AMirroredPlanTurnsTheOtherWay) {
  const auto rows = [](double side) {
    return PathOf({{1, 3}, {4, 3}, {4, 3 + 0.4 * side}, {1, 3 + 0.4 * side}, {2, 3 + side}});
  };
  const HazardMap map = EmptyFloor(30, 30, 0.2);
  const TurnedPath left = Turned(map, rows(1), {1, 3, 0}), right = Turned(map, rows(-1), {1, 3, 0});
  ASSERT_EQ(left.path.size(), right.path.size());
  for (std::size_t i = 0; i < left.path.size(); ++i) {
    EXPECT_NEAR(left.path[i].p_W.x(), right.path[i].p_W.x(), 1e-9);
    EXPECT_NEAR(left.path[i].p_W.y() - 3, 3 - right.path[i].p_W.y(), 1e-9);
  }
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/rejoin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/streams.h"
#include "tests/planners/floors.h"

namespace floorproof {
namespace {

using testing::DiscRobot;
using testing::Draw;
using testing::EmptyFloor;
using testing::LeastClearance;

constexpr double kRadius_m = 0.18;

FloorMark Mark(const Vec2& p_W, double radius_m = 0.05) {
  return {FloorMark::Kind::kBump, p_W, radius_m};
}

Path Through(const std::vector<Vec2>& points) {
  Path path;
  for (const Vec2& p : points) path.emplace_back().p_W = p;
  return path;
}

// A floor, what was met on it, and a plan half driven.
struct Scene {
  HazardMap known = EmptyFloor(100, 60, 0.05);  // 5 m x 3 m
  RobotSpec robot = DiscRobot(kRadius_m, 0.3);
  std::vector<FloorMark> marks;
  Path path;
  std::size_t segment = 0;
  Pose2 X_WB;
  bool around = true;

  Path Rest() const {
    return Rejoin({known, marks, robot, robot.clear, path, segment, X_WB, around});
  }
};

// The least way from the robot's middle, driven along the path from waypoint `from` on, to a mark.
double LeastToMarks(const Path& path, const std::vector<FloorMark>& marks, std::size_t from = 0) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = from; i + 1 < path.size(); ++i)
    for (const FloorMark& mark : marks)
      least_m = std::min(least_m,
                         DistanceToSegment(path[i].p_W, path[i + 1].p_W, mark.p_W) - mark.radius_m);
  return least_m;
}

double LeastTo(const Path& path, const Vec2& p) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    least_m = std::min(least_m, DistanceToSegment(path[i].p_W, path[i + 1].p_W, p));
  return least_m;
}

// Every centimetre of the way, at the yaw of the waypoint ahead: from the footprint to the marks.
double LeastOfFootprint(const Path& path, const Polygon& footprint_B,
                        const std::vector<FloorMark>& marks, double yaw_rad) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vec2 a = path[i].p_W, b = path[i + 1].p_W;
    const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / 0.01)));
    for (int s = 0; s <= steps; ++s) {
      const Vec2 p = a + (b - a) * s / steps;
      const Pose2 X_WB{p.x(), p.y(), path[i + 1].yaw_rad.value_or(yaw_rad)};
      for (const FloorMark& mark : marks)
        least_m = std::min(least_m,
                           SignedDistance(footprint_B, X_WB.Inverse() * mark.p_W) - mark.radius_m);
    }
  }
  return least_m;
}

// Rows from wall to wall.
Path Rows(double x0, double x1, const std::vector<double>& ys) {
  Path path;
  for (std::size_t i = 0; i < ys.size(); ++i) {
    path.emplace_back().p_W = {i % 2 ? x1 : x0, ys[i]};
    path.emplace_back().p_W = {i % 2 ? x0 : x1, ys[i]};
  }
  return path;
}

TEST(Rejoin, WithoutMarksTheRestComesBackFromTheRobotsPlaceOn) {
  Scene scene;
  scene.path = Through({{0.5, 0.5}, {4.5, 0.5}, {4.5, 1.5}, {0.5, 1.5}, {0.5, 2.5}});
  scene.segment = 1;
  scene.X_WB = {4.47, 0.9, kPi / 2};
  for (const bool around : {true, false}) {
    scene.around = around;
    const Path rest = scene.Rest();
    ASSERT_FALSE(rest.empty());
    EXPECT_EQ(rest.front().p_W, scene.X_WB.p());
    EXPECT_EQ(rest.back().p_W, scene.path.back().p_W);
    EXPECT_NEAR(Length(rest), 0.6 + 4 + 1, 0.05);
    for (std::size_t i = 2; i < scene.path.size(); ++i)
      EXPECT_LT(LeastTo(rest, scene.path[i].p_W), 1e-9);
    EXPECT_GT(LeastTo(rest, {4.5, 0.5}), 0.3) << "what was driven is not driven again";
  }
}

TEST(Rejoin, GoesAroundWhatWasMetAndOnBehindIt) {
  Scene scene;
  scene.path = Through({{0.5, 1.5}, {4.5, 1.5}});
  scene.marks = {Mark({2.53, 1.5})};
  scene.X_WB = {2.13, 1.5, 0};
  const Path rest = scene.Rest();
  EXPECT_EQ(rest.front().p_W, scene.X_WB.p());
  EXPECT_LT((rest.back().p_W - Vec2(4.5, 1.5)).norm(), 1e-9);
  EXPECT_GE(LeastToMarks(rest, scene.marks), kRadius_m);
  // Half around a circle that holds what is kept clear, at the longest; a straight line would do
  // with 2.37 m.
  EXPECT_GT(Length(rest), 2.37);
  EXPECT_LT(Length(rest), 2.37 + (kPi - 2) * 0.6);
  // Back on the plan no farther behind the mark than what is kept clear of it.
  EXPECT_LT(LeastTo(rest, {3.0, 1.5}), 1e-9);
}

TEST(Rejoin, RoundAMarkOnTheSideWhereThereIsRoom) {
  Scene scene;
  scene.path = Through({{0.5, 0.4}, {4.5, 0.4}});  // along the map's border, beyond which is wall
  scene.marks = {Mark({2.5, 0.4})};
  scene.X_WB = {2.1, 0.4, 0};
  const Path rest = scene.Rest();
  EXPECT_GE(LeastToMarks(rest, scene.marks), kRadius_m);
  for (const Waypoint& w : rest) EXPECT_GE(w.p_W.y(), 0.4 - 1e-9);
  EXPECT_LT((rest.back().p_W - Vec2(4.5, 0.4)).norm(), 1e-9);
}

// All of a plan of rows, with marks strewn over it: clear of marks and walls, the rest as planned.
TEST(Rejoin, IsClearOfMarksAndWallsWhereverTheyAre) {
  Stream random(3, 0, "marks");
  for (int round = 0; round < 25; ++round) {
    Scene scene;
    scene.around = round % 3 != 0;
    std::string row(50, '.'), rows;
    for (int iy = 0; iy < 30; ++iy) {
      std::string drawn = iy == 0 || iy == 29 ? std::string(50, '#') : "#" + row.substr(2) + "#";
      if (iy > 10 && iy < 14) drawn.replace(20, 4, "####");
      rows += drawn + "\n";
    }
    scene.known = Draw(rows, 0.1);
    scene.path = Rows(0.35, 4.65, {0.35, 0.65, 0.95, 1.25, 2.15, 2.4, 2.65});
    scene.segment = random.Below(8);
    const Vec2 a = scene.path[scene.segment].p_W, b = scene.path[scene.segment + 1].p_W;
    const Vec2 p = a + random.Uniform() * (b - a);
    scene.X_WB = {p.x(), p.y(), 0};
    for (int i = 0; i < 4; ++i) {
      const FloorMark mark =
          Mark({random.Uniform(0, 5), random.Uniform(0, 3)}, random.Uniform(0.02, 0.12));
      if ((mark.p_W - p).norm() > mark.radius_m + kRadius_m + 0.15) scene.marks.push_back(mark);
    }
    SCOPED_TRACE(round);
    const Path rest = scene.Rest();
    ASSERT_GE(rest.size(), 2u);
    EXPECT_EQ(rest.front().p_W, p);
    EXPECT_GE(LeastToMarks(rest, scene.marks), kRadius_m);
    EXPECT_GE(LeastClearance(scene.known, rest, 0.3), kRadius_m - 0.026);
    if (!scene.around) continue;
    // Each place of what was left to drive that has room is driven over.
    std::vector<FloorMark> wide = scene.marks;
    for (FloorMark& mark : wide) mark.radius_m += 0.3;
    const ClearanceField room = ComputeClearance(WithMarks(scene.known, wide), 0.01);
    for (std::size_t i = scene.segment + 1; i + 1 < scene.path.size(); ++i)
      for (double s = 0; s <= 1; s += 0.05) {
        const Vec2 q = scene.path[i].p_W + s * (scene.path[i + 1].p_W - scene.path[i].p_W);
        if (room.At(q) > kRadius_m + 0.05) {
          EXPECT_LT(LeastTo(rest, q), 1e-6) << q.transpose();
        }
      }
  }
}

TEST(Rejoin, WaypointsKeepWhatThePlanSaysOfThem) {
  Scene scene;
  scene.path = Through({{0.5, 0.5}, {2.5, 0.5}, {4.5, 0.5}, {4.5, 2.5}});
  for (std::size_t i = 0; i < scene.path.size(); ++i) {
    scene.path[i].yaw_rad = 0.1 * static_cast<double>(i);
    scene.path[i].speed_mps = 0.1 + 0.1 * static_cast<double>(i);
    scene.path[i].dwell_s = 10 + static_cast<double>(i);
    scene.path[i].shape = std::string(1, static_cast<char>('A' + i));
    scene.path[i].task = WaypointTask{.id = static_cast<int>(i)};
  }
  scene.marks = {Mark({3.5, 0.5})};
  scene.X_WB = {1, 0.5, 0};
  const Path rest = scene.Rest();
  const auto at = [&](const Vec2& p) {
    const auto found =
        std::ranges::find_if(rest, [&](const Waypoint& w) { return (w.p_W - p).norm() < 1e-9; });
    return found == rest.end() ? nullptr : &*found;
  };
  for (std::size_t i = 1; i < scene.path.size(); ++i) {
    const Waypoint* w = at(scene.path[i].p_W);
    ASSERT_NE(w, nullptr) << i;
    EXPECT_EQ(w->yaw_rad, scene.path[i].yaw_rad);
    EXPECT_EQ(w->speed_mps, scene.path[i].speed_mps);
    EXPECT_EQ(w->shape, scene.path[i].shape);
    EXPECT_EQ(w->dwell_s, scene.path[i].dwell_s);
    EXPECT_EQ(w->task, scene.path[i].task);
  }
  // What was cut in two, and the way between, belongs to the segment that was cut; nobody dwells
  // there, nor does anything.
  int between = 0;
  double dwell_s = 0;
  for (const Waypoint& w : rest) {
    dwell_s += w.dwell_s;
    if (w.p_W.x() < 2.5 + 1e-9 || w.p_W.x() > 4.5 - 1e-9) continue;
    ++between;
    EXPECT_EQ(w.yaw_rad, scene.path[2].yaw_rad);
    EXPECT_EQ(w.speed_mps, scene.path[2].speed_mps);
    EXPECT_EQ(w.dwell_s, 0);
    EXPECT_FALSE(w.task);
  }
  EXPECT_GE(between, 3);
  EXPECT_EQ(dwell_s, 11 + 12 + 13);
}

// An audit's sample is taken however near it the robot already is, or the marks are.
TEST(Rejoin, APlaceToDwellAtIsNotLostForBeingNear) {
  Scene scene;
  scene.path = Through({{0.5, 1.5}, {2.5, 1.5}});
  scene.path[1].dwell_s = 8;
  scene.X_WB = {2.44, 1.5, 0};
  const Path rest = scene.Rest();
  EXPECT_EQ(rest.back().dwell_s, 8);
  EXPECT_LT((rest.back().p_W - Vec2(2.5, 1.5)).norm(), 1e-9);
  // And as a turn on the spot, a segment of no length.
  scene.path.push_back(scene.path[1]);
  scene.path[2].yaw_rad = 1;
  scene.path[2].dwell_s = 3;
  scene.segment = 1;
  scene.X_WB = {2.5, 1.5, 0};
  const Path turned = scene.Rest();
  EXPECT_EQ(turned.back().dwell_s, 3);
  EXPECT_EQ(turned.back().yaw_rad, 1);
}

TEST(Rejoin, ATaskIsNotLostForBeingNear) {
  Scene scene;
  scene.path = Through({{0.5, 1.5}, {2.5, 1.5}});
  scene.path[1].task = WaypointTask{.id = 4};
  scene.X_WB = {2.44, 1.5, 0};
  const Path rest = scene.Rest();
  EXPECT_EQ(rest.back().task, scene.path[1].task);
}

TEST(Rejoin, AMarkOnAPlaceToDwellAtLeavesItOut) {
  Scene scene;
  scene.path = Through({{0.5, 1.5}, {2.5, 1.5}, {4.5, 1.5}});
  scene.path[1].dwell_s = 8;
  scene.marks = {Mark({2.5, 1.55})};
  scene.X_WB = {1.5, 1.5, 0};
  const Path rest = scene.Rest();
  for (const Waypoint& w : rest) EXPECT_EQ(w.dwell_s, 0);
  EXPECT_GE(LeastToMarks(rest, scene.marks), kRadius_m);
  EXPECT_LT((rest.back().p_W - Vec2(4.5, 1.5)).norm(), 1e-9);
}

// Straight to where it can go on: less way than around, more of the plan left out.
TEST(Rejoin, GoOnGoesStraightToTheNextPlaceInSight) {
  Scene scene;
  scene.path = Rows(0.5, 4.5, {0.5, 1.1, 1.7, 2.3});
  scene.marks = {Mark({2.5, 0.5})};
  scene.X_WB = {2.1, 0.5, 0};
  const Path around = scene.Rest();
  scene.around = false;
  const Path on = scene.Rest();
  EXPECT_GE(LeastToMarks(on, scene.marks), kRadius_m);
  EXPECT_EQ(on.back().p_W, scene.path.back().p_W);
  EXPECT_LT(Length(on), Length(around));
  // The next waypoint that it sees is planned, and it goes there in one.
  ASSERT_GE(on.size(), 2u);
  const std::size_t k = on[1].p_W == on[0].p_W ? 2 : 1;
  EXPECT_TRUE(std::ranges::any_of(scene.path, [&](const Waypoint& w) {
    return (w.p_W - on[k].p_W).norm() < 1e-9;
  })) << on[k].p_W.transpose();
  for (const double y : {1.7, 2.3}) EXPECT_LT(LeastTo(on, {2.5, y}), 1e-9) << y;
}

TEST(Rejoin, GoOnGoesAroundWhereNothingIsInSight) {
  Scene scene;
  scene.path = Through({{0.5, 1.5}, {4.5, 1.5}});
  scene.marks = {Mark({2.5, 1.5}, 0.2)};
  scene.X_WB = {1.9, 1.5, 0};
  scene.around = false;
  const Path rest = scene.Rest();
  EXPECT_GE(LeastToMarks(rest, scene.marks), kRadius_m);
  EXPECT_LT((rest.back().p_W - Vec2(4.5, 1.5)).norm(), 1e-9);
}

// Two rooms and a passage between them, which turns out to be closed.
constexpr const char* kTwoRooms =
    "########################################\n"
    "#..................#...................#\n"
    "#..................#...................#\n"
    "#..................#...................#\n"
    "#..................#...................#\n"
    "#..................#...................#\n"
    "#......................................#\n"
    "#......................................#\n"
    "#......................................#\n"
    "#......................................#\n"
    "#......................................#\n"
    "#......................................#\n"
    "#..................#...................#\n"
    "#..................#...................#\n"
    "#..................#...................#\n"
    "#..................#...................#\n"
    "#..................#...................#\n"
    "########################################\n";

TEST(Rejoin, WhatIsCutOffIsLeftOut) {
  Scene scene;
  scene.known = Draw(kTwoRooms, 0.1);  // a passage of 0.6 m at (1.95, 0.6 .. 1.2)
  scene.path = Through({{0.5, 0.9}, {3.5, 0.9}, {3.5, 1.4}});
  scene.X_WB = {1.5, 0.9, 0};
  ASSERT_EQ(scene.Rest().back().p_W, Vec2(3.5, 1.4)) << "while it is open";
  scene.marks = {Mark({1.95, 0.9})};
  for (const bool around : {true, false}) {
    scene.around = around;
    const Path rest = scene.Rest();
    EXPECT_EQ(rest.front().p_W, scene.X_WB.p());
    for (const Waypoint& w : rest) EXPECT_LT(w.p_W.x(), 1.9);
    EXPECT_GE(LeastToMarks(rest, scene.marks), kRadius_m);
  }
}

TEST(Rejoin, WhatIsPlannedOnThisSideAfterwardsIsDriven) {
  Scene scene;
  scene.known = Draw(kTwoRooms, 0.1);
  scene.path = Through({{0.5, 0.9}, {3.5, 0.9}, {3.5, 1.1}, {0.5, 1.1}, {0.5, 1.5}, {1.5, 1.5}});
  scene.X_WB = {1.5, 0.9, 0};
  scene.marks = {Mark({1.95, 0.9})};
  const Path rest = scene.Rest();
  for (const Waypoint& w : rest) EXPECT_LT(w.p_W.x(), 1.9);
  EXPECT_LT((rest.back().p_W - Vec2(1.5, 1.5)).norm(), 1e-9);
  for (const Vec2& p : {Vec2(0.5, 1.1), Vec2(0.5, 1.5)}) EXPECT_LT(LeastTo(rest, p), 1e-9);
}

// The mark has grown over the robot, or the estimate has moved: it goes out of it and then on.
TEST(Rejoin, ARobotWithinAMarkStillFindsAWayOut) {
  for (const double radius_m : {0.05, 0.15, 0.25}) {
    Scene scene;
    scene.path = Through({{0.5, 1.5}, {4.5, 1.5}});
    scene.marks = {Mark({2.5, 1.5}, radius_m)};
    scene.X_WB = {2.35, 1.5, 0};
    const Path rest = scene.Rest();
    EXPECT_EQ(rest.front().p_W, scene.X_WB.p());
    EXPECT_LT((rest.back().p_W - Vec2(4.5, 1.5)).norm(), 1e-9) << radius_m;
    EXPECT_GE(LeastToMarks(rest, scene.marks, 1), 0.9 * kRadius_m) << "once it is out";
    EXPECT_GT(LeastTo(rest, {2.5, 1.5}), 0.149) << "not over the middle of what it met";
  }
}

// A blind alley beside a thin wall, the robot wedged in it: the floor behind the wall has room, but
// no way leads there.
TEST(Rejoin, TheWayOutOfAMarkDoesNotLeadThroughAWall) {
  Scene scene;
  std::string rows;
  for (int i = 0; i < 20; ++i) rows += std::string(60, '.') + "\n";  // floor
  rows += std::string(60, '#') + "\n";                               // a wall of 5 cm
  for (int i = 0; i < 9; ++i) rows += "##########" + std::string(50, '.') + "\n";
  rows += std::string(60, '#') + "\n";
  scene.known = Draw(rows, 0.05);  // an alley of 0.45 m below y = 0.5, from x = 0.5 on
  const double y = 0.05 + 0.225;
  scene.path = Through({{0.75, y}, {2.75, y}});
  scene.X_WB = {0.75, y, 0};
  scene.marks = {Mark({0.98, y})};
  const Path rest = scene.Rest();
  for (const Waypoint& w : rest) EXPECT_LT(w.p_W.y(), 0.5);
}

// The map says that the robot cannot be where it is: it is not believed, and the plan is driven.
TEST(Rejoin, ARobotWalledInByMarksDrivesThePlanAsItWas) {
  Scene scene;
  scene.path = Through({{0.5, 1.5}, {2.5, 1.5}, {4.5, 1.5}, {4.5, 2.5}});
  scene.segment = 1;
  scene.X_WB = {2.6, 1.5, 0};
  scene.marks = {Mark({2.6, 1.5}, 1.2)};
  const Path rest = scene.Rest();
  ASSERT_EQ(rest.size(), 3u);
  EXPECT_EQ(rest[0].p_W, scene.X_WB.p());
  EXPECT_EQ(rest[1].p_W, scene.path[2].p_W);
  EXPECT_EQ(rest[2].p_W, scene.path[3].p_W);
}

TEST(Rejoin, AtThePlansEndOnlyTheRobotsPlaceIsLeft) {
  Scene scene;
  scene.path = Through({{0.5, 1.5}, {2.5, 1.5}});
  scene.segment = 1;
  scene.X_WB = {2.5, 1.5, 0};
  ASSERT_EQ(scene.Rest().size(), 1u);
  EXPECT_EQ(scene.Rest()[0].p_W, Vec2(2.5, 1.5));
  scene.path = Through({{2.5, 1.5}});
  scene.segment = 0;
  EXPECT_EQ(scene.Rest().size(), 1u);
}

Scene WithFootprint(double length_m, double width_m, double yaw_rad) {
  Scene scene;
  scene.robot.clear = {Shape2::Kind::kFootprint, 0,
                       Rectangle({-length_m / 2, -width_m / 2}, {length_m / 2, width_m / 2})};
  scene.robot.tool = scene.robot.clear;
  scene.path = Through({{0.6, 1.5}, {4.4, 1.5}});
  for (Waypoint& w : scene.path) w.yaw_rad = yaw_rad;
  return scene;
}

TEST(Rejoin, AFootprintIsKeptClearOfMarks) {
  for (const double yaw_rad : {0.0, kPi / 2}) {
    Scene scene = WithFootprint(0.5, 0.5, yaw_rad);
    scene.marks = {Mark({2.5, 1.6}), Mark({3.4, 1.3})};
    scene.X_WB = {2.0, 1.5, yaw_rad};
    const Path rest = scene.Rest();
    EXPECT_LT((rest.back().p_W - Vec2(4.4, 1.5)).norm(), 1e-9);
    EXPECT_GE(LeastOfFootprint(rest, scene.robot.clear.footprint_B, scene.marks, yaw_rad), 0);
    for (std::size_t i = 1; i < rest.size(); ++i) EXPECT_EQ(rest[i].yaw_rad, yaw_rad);
  }
}

// A robot of 0.9 m x 0.3 m that holds its yaw: between two marks there is room for it lengthwise,
// and none across; nor is there between them and the borders of the map.
TEST(Rejoin, AFootprintThatIsNotTurnedIsNotTurnedToFit) {
  for (const double turned_rad : {0.0, 1.2})  // the map as well
    for (const double yaw_rad : {0.0, kPi / 2, kPi / 4}) {
      Scene scene = WithFootprint(0.9, 0.3, yaw_rad + turned_rad);
      const Pose2 X_WG{1, 2, turned_rad};
      scene.known.frame.X_WG = X_WG;
      for (Waypoint& w : scene.path) w.p_W = X_WG * w.p_W;
      scene.marks = {Mark(X_WG * Vec2(2.5, 1.0)), Mark(X_WG * Vec2(2.5, 2.0))};
      scene.X_WB = X_WG * Pose2{1.3, 1.5, yaw_rad};
      const Path rest = scene.Rest();
      EXPECT_GE(
          LeastOfFootprint(rest, scene.robot.clear.footprint_B, scene.marks, yaw_rad + turned_rad),
          0)
          << yaw_rad;
      const double end_x = (X_WG.Inverse() * rest.back().p_W).x();
      if (yaw_rad == 0) {
        EXPECT_LT(LeastTo(rest, X_WG * Vec2(2.5, 1.5)), 1e-6) << "through";
        EXPECT_NEAR(end_x, 4.4, 1e-9);
      } else if (yaw_rad == kPi / 2) {
        EXPECT_LT(end_x, 2.5) << "cut off";
      }
    }
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The margin of a coverage plan: kept all over the floor, centred in narrower places, and honoured
// if the user sets it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/planners/floors.h"

namespace floorproof {
namespace {

using testing::Coverage;
using testing::DiscRobot;
using testing::EmptyFloor;
using testing::ExpectSound;
using ::testing::HasSubstr;
using testing::LeastClearance;
using testing::MakePlanner;

constexpr double kCell_m = 0.02;

// The margin of a plan: 30 mm, or less if 30 mm would take much of the floor.
double MarginOf(const PlanResult& plan) {
  for (const auto& [name, value] : plan.figures)
    if (name == "margin_m") {
      EXPECT_GE(value, 0.01);
      EXPECT_LE(value, 0.03);
      return value;
    }
  ADD_FAILURE() << "no margin_m";
  return 0;
}

// Two rooms of 6 m x 5 m, and a door of this many cells in the wall between, whose middle lies at
// `door_y_m`.
struct TwoRooms {
  int door_cells;
  double door_y_m = 0;

  HazardMap Map() {
    HazardMap map = EmptyFloor(610, 250, kCell_m);
    const int first = 125 - door_cells / 2;
    for (int ix = 300; ix < 310; ++ix)
      for (int iy = 0; iy < 250; ++iy)
        if (iy < first || iy >= first + door_cells) map.occupancy(ix, iy) = CellState::kOccupied;
    door_y_m = (first + door_cells / 2.0) * kCell_m;
    return map;
  }
};

// The part of a path within this distance of the door, along x, and all else of it.
bool IsAtDoor(const Vec2& p_W, double within_m) { return std::abs(p_W.x() - 6.1) < within_m; }

// Least clearance of the disc on the path's parts for which `holds` is true, sampled each 5 mm.
template <class Holds>
double LeastOver(const HazardMap& map, const Path& path, double radius_m, const Holds& holds) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec2 a = path[i - 1].p_W, way = path[i].p_W - a;
    const int steps = std::max(1, static_cast<int>(std::ceil(way.norm() / 0.005)));
    for (int k = 0; k <= steps; ++k) {
      const Vec2 p_W = a + way * k / steps;
      if (!holds(p_W)) continue;
      Waypoint w;
      w.p_W = p_W;
      least_m = std::min(least_m, LeastClearance(map, {w}, 0.4) - radius_m);
    }
  }
  return least_m;
}

PlanResult Plan(const HazardMap& map, const RobotSpec& robot, const Pose2& start,
                const std::string& yaml = "{}") {
  return MakePlanner("boustrophedon", yaml)->Plan({map, robot, start, std::nullopt, 1});
}

// Doors of an odd and an even number of cells: the middle is that of the door, not of a cell.
TEST(KeptMargin, ADoorIsPassedInItsMiddleAndTheMarginKeptElsewhere) {
  const Pose2 start{1, 1, 0};
  for (const int door_cells : {26, 27}) {
    TwoRooms rooms{door_cells};
    const HazardMap map = rooms.Map();
    const RobotSpec robot = DiscRobot(0.25, 0.4);
    const PlanResult plan = Plan(map, robot, start);
    ExpectSound(map, start, plan);
    const double half_free_m = (door_cells * kCell_m - 0.5) / 2;
    EXPECT_GE(Coverage(map, robot, start, plan), 0.95) << door_cells;
    EXPECT_GE(LeastOver(map, plan.path, 0.25, [](const Vec2& p_W) { return !IsAtDoor(p_W, 0.35); }),
              MarginOf(plan) - kCell_m / 4)
        << door_cells;
    EXPECT_GE(LeastOver(map, plan.path, 0.25, [](const Vec2& p_W) { return IsAtDoor(p_W, 0.1); }),
              half_free_m - 0.002)
        << door_cells;
    EXPECT_THAT(plan.message, HasSubstr("less room than its margin of ")) << door_cells;
  }
}

// The cells are nearly as large as the free width of the door. The room behind it is still reached.
TEST(KeptMargin, RoomsBehindADoorAreReachedOnCoarseCells) {
  const Pose2 start{1, 1, 0};
  HazardMap map = EmptyFloor(164, 80, 0.05);
  map.inset_m = 0;
  for (int ix = 80; ix < 84; ++ix)
    for (int iy = 0; iy < 80; ++iy)
      if (iy < 35 || iy >= 46) map.occupancy(ix, iy) = CellState::kOccupied;  // 0.55 m free
  for (const double radius_m : {0.24, 0.25, 0.26, 0.265, 0.27}) {
    const RobotSpec robot = DiscRobot(radius_m, 0.4);
    const PlanResult plan = Plan(map, robot, start);
    ExpectSound(map, start, plan);
    EXPECT_GE(Coverage(map, robot, start, plan), 0.9) << radius_m;
    EXPECT_GE(LeastOver(map, plan.path, radius_m,
                        [](const Vec2& p_W) { return std::abs(p_W.x() - 4.1) < 0.1; }),
              std::min(0.275 - radius_m, MarginOf(plan)) - 0.05 / 4)
        << radius_m;
  }
}

// A passage askew to the cells: its middle is no staircase.
TEST(KeptMargin, AnAislesMiddleIsStraightHoweverItLies) {
  HazardMap map = EmptyFloor(480, 400, 0.025);
  const Pose2 X_WR{6, 5, 0.5};  // of the wall's middle; the aisle leads along its x
  for (int iy = 0; iy < 400; ++iy)
    for (int ix = 0; ix < 480; ++ix) {
      const Vec2 p = X_WR.Inverse() * map.frame.Center(ix, iy);
      if (std::abs(p.x()) < 1 && std::abs(p.y()) > 0.275)
        map.occupancy(ix, iy) = CellState::kOccupied;
    }
  const RobotSpec robot = DiscRobot(0.25, 0.4);
  const Pose2 start{1.5, 1, 0};
  const PlanResult plan = Plan(map, robot, start);
  ExpectSound(map, start, plan);
  EXPECT_GE(Coverage(map, robot, start, plan), 0.85);
  int corners = 0, passages = 0;
  bool was_inside = false;
  for (const Waypoint& w : plan.path) {
    const Vec2 p = X_WR.Inverse() * w.p_W;
    const bool is_inside = std::abs(p.x()) < 0.9;
    corners += is_inside;
    passages += is_inside && !was_inside;
    was_inside = is_inside;
  }
  EXPECT_LE(corners, 4 * std::max(1, passages));
  EXPECT_GE(LeastOver(map, plan.path, 0.25,
                      [&](const Vec2& p_W) { return std::abs((X_WR.Inverse() * p_W).x()) < 0.7; }),
            0.005);
}

// The planner joins a dead-end aisle that is too narrow for the margin.
TEST(KeptMargin, ADeadEndIsSweptInItsMiddle) {
  HazardMap map = EmptyFloor(450, 250, kCell_m);
  for (int ix = 300; ix < 450; ++ix)
    for (int iy = 0; iy < 250; ++iy)
      if (iy < 110 || iy >= 136) map.occupancy(ix, iy) = CellState::kOccupied;
  const RobotSpec robot = DiscRobot(0.25, 0.4);
  const Pose2 start{1, 1, 0};
  const PlanResult plan = Plan(map, robot, start);
  ExpectSound(map, start, plan);
  EXPECT_GE(Coverage(map, robot, start, plan), 0.94);
  double farthest_m = 0;
  for (const Waypoint& w : plan.path) farthest_m = std::max(farthest_m, w.p_W.x());
  EXPECT_GT(farthest_m, 8.5) << "the aisle's end lies at 9 m";
  EXPECT_GE(LeastOver(map, plan.path, 0.25, [](const Vec2& p_W) { return p_W.x() > 6.4; }), 0.008);
  EXPECT_GE(LeastOver(map, plan.path, 0.25, [](const Vec2& p_W) { return p_W.x() < 5.6; }),
            MarginOf(plan) - kCell_m / 4);
}

// A margin that the user sets is kept, and the message reports the share of the floor left out.
TEST(KeptMargin, AMarginThatWasAskedForIsHonoured) {
  TwoRooms rooms{26};
  const HazardMap map = rooms.Map();
  const RobotSpec robot = DiscRobot(0.25, 0.4);
  const Pose2 start{1, 1, 0};
  const PlanResult plan = Plan(map, robot, start, "{margin_m: 0.03}");
  EXPECT_EQ(plan.status, PlanStatus::kSuccess);
  EXPECT_GE(LeastClearance(map, plan.path, 0.4) - 0.25, 0.03 - kCell_m / 4);
  for (const Waypoint& w : plan.path) EXPECT_LT(w.p_W.x(), 6);
  EXPECT_THAT(plan.message, HasSubstr("with margin_m = 30 mm, the plan leaves out"));
  const PlanResult none = Plan(map, robot, {0.26, 1, 0}, "{margin_m: 0.4}");
  EXPECT_EQ(none.status, PlanStatus::kStartBlocked);
  EXPECT_THAT(none.message, HasSubstr("less than margin_m = 400 mm"));
}

// If the start is beside a wall, within the margin, the path leads out of it.
TEST(KeptMargin, AStartByAWallIsNoReasonToDropIt) {
  const HazardMap map = EmptyFloor(200, 150, kCell_m);
  const RobotSpec robot = DiscRobot(0.25, 0.4);
  const Pose2 start{0.255, 1, 0};
  const PlanResult plan = Plan(map, robot, start);
  EXPECT_EQ(plan.status, PlanStatus::kSuccess);
  EXPECT_GE(Coverage(map, robot, start, plan), 0.95);
  EXPECT_GE(LeastOver(map, plan.path, 0.25,
                      [&](const Vec2& p_W) { return (p_W - start.p()).norm() > 0.2; }),
            MarginOf(plan) - kCell_m / 4);
}

// A footprint that holds its yaw: a square of 0.5 m, which needs as much everywhere.
TEST(KeptMargin, AFootprintPassesInTheMiddleToo) {
  TwoRooms rooms{26};
  const HazardMap map = rooms.Map();
  RobotSpec robot = DiscRobot(0.25, 0.4);
  robot.clear = {
      Shape2::Kind::kFootprint, 0, {{-0.25, -0.25}, {0.25, -0.25}, {0.25, 0.25}, {-0.25, 0.25}}};
  robot.circumscribed_radius_m = 0.25 * std::sqrt(2.0);
  const Pose2 start{1, 1, 0};
  const PlanResult plan = Plan(map, robot, start);
  EXPECT_EQ(plan.status, PlanStatus::kSuccess);
  double farthest_m = 0;
  for (std::size_t i = 1; i < plan.path.size(); ++i) {
    const Vec2 a = plan.path[i - 1].p_W, b = plan.path[i].p_W;
    farthest_m = std::max(farthest_m, b.x());
    // While the body is in the door it is in its middle.
    for (int k = 0; k <= 100; ++k) {
      const Vec2 p_W = a + (b - a) * k / 100;
      if (IsAtDoor(p_W, 0.1 + 0.25 - kCell_m)) {
        EXPECT_NEAR(p_W.y(), rooms.door_y_m, 0.002);
      }
    }
  }
  EXPECT_GT(farthest_m, 11);
}

}  // namespace
}  // namespace floorproof

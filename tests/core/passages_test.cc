// SPDX-License-Identifier: Apache-2.0
#include "env/core/passages.h"

#include <gmock/gmock.h>

#include "env/core/path_walk.h"
#include "env/core/wall_gap.h"

namespace floorproof {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kHalf_m = 0.25;                     // of the square robot
constexpr double kStep_m = 2.5 * PathWalk::kStep_m;  // to which a place along the way is found

RobotSpec SquareRobot() {
  RobotSpec robot;
  robot.clear = {Shape2::Kind::kFootprint, 0, Rectangle({-kHalf_m, -kHalf_m}, {kHalf_m, kHalf_m})};
  robot.mass_kg = 11;
  robot.clearance_m = 0.025;
  robot.cruise_mps = 0.25;
  return robot;
}
RobotSpec RoundRobot() {
  RobotSpec robot = SquareRobot();
  robot.clear = {Shape2::Kind::kCircle, kHalf_m, {}};
  robot.circumscribed_radius_m = kHalf_m;
  return robot;
}

// 20 m x 20 m about the world's origin, walls but at its border none.
HazardMap Floor(std::initializer_list<Polygon> hazards) {
  HazardMap map;
  map.frame = {40, 40, 0.5, {-10, -10, 0}};
  map.occupancy = Grid<CellState>(40, 40, CellState::kFree);
  map.floor_friction = 0.7;
  for (const Polygon& polygon : hazards) {
    Hazard hazard;
    hazard.id = "h" + std::to_string(map.hazards.size());
    hazard.hazard_class = HazardClass::kTerrain;
    hazard.footprint = {polygon};
    map.hazards.push_back(std::move(hazard));
  }
  return map;
}

Path Through(std::initializer_list<Vec2> points) {
  Path path;
  for (const Vec2& p : points) path.emplace_back().p_W = p;
  return path;
}

std::vector<PlannedPassage> Find(const HazardMap& map, const RobotSpec& robot, const Path& path,
                                 double yaw_rad = 0, bool holds_yaw = false) {
  return FindPassages(map, robot, {path[0].p_W.x(), path[0].p_W.y(), yaw_rad}, path, holds_yaw);
}

class Heading : public ::testing::TestWithParam<double> {};

// A strip across the way, 0.2 m wide: the way over it follows from the footprint's extent.
TEST_P(Heading, OverAStripIsWhatTheGeometrySays) {
  const double angle_rad = GetParam() * kPi / 180;
  const HazardMap map = Floor({Rectangle({0, -9}, {0.2, 9})});
  const Vec2 way(std::cos(angle_rad), std::sin(angle_rad));
  const Path path = Through({-2 * way, 3 * way});
  for (const bool round : {false, true}) {
    const auto dut = Find(map, round ? RoundRobot() : SquareRobot(), path, angle_rad);
    ASSERT_THAT(dut, SizeIs(1)) << round;
    const double ahead_m =
        kHalf_m * (round ? 1 : std::cos(angle_rad) + std::abs(std::sin(angle_rad)));
    EXPECT_EQ(dut[0].passage, Passage::kOver);
    EXPECT_NEAR(dut[0].at.heading_rad, angle_rad, 1e-9);
    EXPECT_NEAR(dut[0].at.lead_rad, 0, 1e-9);
    EXPECT_NEAR(dut[0].from_m, 2 - ahead_m / std::cos(angle_rad), kStep_m);
    EXPECT_NEAR(dut[0].at.over_m, (0.2 + 2 * ahead_m) / std::cos(angle_rad), 2 * kStep_m);
    EXPECT_NEAR(dut[0].at.width_share, 1, 0.02);
    EXPECT_EQ(dut[0].at.gap_m, 0);
    EXPECT_EQ(dut[0].at.turn_rad, 0);
    EXPECT_EQ(dut[0].at.friction, 0.7);
    EXPECT_EQ(dut[0].at.speed_mps, 0.25);
    EXPECT_EQ(dut[0].at.wall_m, kFarWall_m);
  }
}
INSTANTIATE_TEST_SUITE_P(Angles, Heading, ::testing::Values(-60, -20, 0, 5, 45, 70));

TEST(Passages, WhichSideLeadsIsSeenFromTheBody) {
  const HazardMap map = Floor({Rectangle({0, -9}, {0.2, 9})});
  Path path = Through({{-2, 0}, {2, 0}});
  path[1].yaw_rad = kPi / 2;  // its right side leads
  const auto dut = Find(map, SquareRobot(), path, 0, true);
  ASSERT_THAT(dut, SizeIs(1));
  EXPECT_NEAR(dut[0].at.lead_rad, -kPi / 2, 1e-9);
  EXPECT_NEAR(dut[0].at.heading_rad, 0, 1e-9);
  EXPECT_EQ(Find(map, SquareRobot(), path, 0, false)[0].at.lead_rad, 0)
      << "who cannot hold a yaw looks along the way";
}

// Past a box at 60 mm: it is beside, and nothing farther off than the reach is met at all.
TEST(Passages, BesideIsWhatComesWithinReach) {
  const HazardMap map = Floor({Rectangle({0, kHalf_m + 0.06}, {1, 2})});
  const auto dut = Find(map, SquareRobot(), Through({{-2, 0}, {3, 0}}));
  ASSERT_THAT(dut, SizeIs(1));
  EXPECT_EQ(dut[0].passage, Passage::kBeside);
  EXPECT_NEAR(dut[0].at.gap_m, 0.06, 1e-9);
  EXPECT_EQ(dut[0].at.width_share, 0);
  EXPECT_NEAR(dut[0].at.heading_rad, -kPi / 2, 1e-9) << "along the edge on its left";
  EXPECT_NEAR(dut[0].at.over_m, 1 + 2 * kHalf_m + 2 * std::sqrt(0.01 - 0.0036), 2 * kStep_m);
  EXPECT_THAT(Find(map, SquareRobot(), Through({{-2, -0.05}, {3, -0.05}})), IsEmpty());
}

// A strip that ends under the robot is met by a part of its width.
TEST(Passages, TheShareOfTheWidthIsThatOverTheHazard) {
  for (const double share : {0.2, 0.5, 0.9}) {
    const HazardMap map = Floor({Rectangle({0, kHalf_m - share * 2 * kHalf_m}, {0.2, 9})});
    const auto dut = Find(map, SquareRobot(), Through({{-2, 0}, {3, 0}}));
    ASSERT_THAT(dut, SizeIs(1));
    EXPECT_NEAR(dut[0].at.width_share, share, 1e-6);
  }
}

TEST(Passages, ATurnOnTheHazardIsCountedAndOneBeforeItIsNot) {
  const HazardMap map = Floor({Rectangle({0, -1}, {2, 1})});
  const auto dut = Find(map, RoundRobot(), Through({{-3, 0}, {1, 0}, {1, 3}}), kPi);
  ASSERT_THAT(dut, SizeIs(1));
  EXPECT_NEAR(dut[0].at.turn_rad, kPi / 2, 1e-6) << "it had turned by a half before";
}

// Though it stays within reach: a lane that goes over a strip, turns beside it and comes back.
TEST(Passages, ComingOverItAgainIsAnotherPassage) {
  const HazardMap map = Floor({Rectangle({0, -9}, {0.2, 9})});
  for (const double clear_m : {0.01, 0.05}) {
    const double turn_m = 0.2 + kHalf_m + clear_m;
    const auto dut =
        Find(map, RoundRobot(), Through({{-2, 0}, {turn_m, 0}, {turn_m, 0.3}, {-2, 0.5}}));
    ASSERT_THAT(dut, SizeIs(2)) << clear_m;
    for (const PlannedPassage& passage : dut) {
      EXPECT_EQ(passage.passage, Passage::kOver);
      EXPECT_EQ(passage.at.turn_rad, 0) << "it turns beside it";
      EXPECT_NEAR(passage.at.over_m, 0.2 + 2 * kHalf_m, 0.03);
    }
    EXPECT_NEAR(dut[0].at.heading_rad, 0, 1e-9);
    EXPECT_NEAR(std::abs(dut[1].at.heading_rad), std::atan2(0.2, 2 + turn_m), 1e-6)
        << "by the other edge";
  }
  const auto dut = Find(map, RoundRobot(), Through({{-2, 0}, {0.4, 0}, {0.4, 0.3}, {-2, 0.3}}));
  ASSERT_THAT(dut, SizeIs(1)) << "with its rear still on it";
  EXPECT_NEAR(dut[0].at.turn_rad, kPi, 1e-6);
}

TEST(Passages, WhereItTurnsIsMeasuredFromTheHazardsEdge) {
  const Polygon angle = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}};
  const HazardMap square = Floor({Rectangle({0, -1}, {2, 1})}), bent = Floor({angle});
  const auto gap = [](const HazardMap& map, std::initializer_list<Vec2> way) {
    const auto dut = Find(map, RoundRobot(), Through(way));
    return dut.empty() ? std::nan("") : dut[0].at.turn_gap_m;
  };
  EXPECT_NEAR(gap(square, {{-3, 0}, {0.15, 0}, {0.15, 3}}), -0.15, kStep_m) << "on it";
  EXPECT_NEAR(gap(square, {{-3, 0}, {1, 0}, {1, 3}}), -kHalf_m, kStep_m) << "its edge is far away";
  EXPECT_NEAR(gap(square, {{-3, 0}, {-0.2, 0}, {-0.2, 3}}), 0.2, kStep_m) << "with its front on it";
  EXPECT_NEAR(gap(bent, {{-3, 0.9}, {0.5, 0.9}, {0.5, 6}}), -kHalf_m, kStep_m)
      << "of all its parts";
  EXPECT_NEAR(gap(square, {{-3, 0}, {-0.2, 0}, {-0.2, 0.1}, {0.8, 0.1}, {0.8, 3}}),
              (0.2 + 0.2 - kHalf_m) / 3, kStep_m)
      << "mean over three right angles";
  EXPECT_EQ(gap(square, {{-3, 0}, {5, 0}}), 0) << "it does not turn";
}

TEST(Passages, ComingBackIsAnotherPassage) {
  const HazardMap map = Floor({Rectangle({0, -9}, {0.2, 9}), Rectangle({3, -9}, {3.2, 9})});
  const auto dut = Find(map, RoundRobot(), Through({{-2, 0}, {2, 0}, {-2, 0}}));
  std::vector<int> hazards;
  for (const PlannedPassage& passage : dut) hazards.push_back(passage.hazard);
  EXPECT_THAT(hazards, ElementsAre(0, 0)) << "and the second strip is never met";
  ASSERT_THAT(dut, SizeIs(2));
  EXPECT_NEAR(dut[0].from_m, 2 - kHalf_m, kStep_m);
  EXPECT_NEAR(dut[1].from_m, 6 - 0.2 - kHalf_m, kStep_m);
  EXPECT_NEAR(std::abs(WrapAngle(dut[1].X_WB.yaw_rad)), kPi, 1e-9);
}

// What is covered by a later floor is not there.
TEST(Passages, ThePartOfALevelThatALaterOneCoversIsNotMet) {
  HazardMap map = Floor({Rectangle({0, -2}, {4, 2}), Rectangle({-1, -3}, {5, 3})});
  for (Hazard& hazard : map.hazards) hazard.hazard_class = HazardClass::kLevelChange;
  map.hazards[1].height_m = 0.01;
  const auto dut = Find(map, RoundRobot(), Through({{-3, 0}, {7, 0}}));
  ASSERT_THAT(dut, SizeIs(1));
  EXPECT_EQ(dut[0].hazard, 1);
}

// What a robot asks on its way is what was said of its plan.
TEST(Passages, TheNextOneIsTheSameAsInTheWholePlan) {
  const HazardMap map = Floor({Rectangle({0, -9}, {0.2, 9}), Rectangle({3, -9}, {3.2, 0.1})});
  const Path path = Through({{-2, 0}, {1, 0}, {5, 0.2}});
  const RobotSpec robot = RoundRobot();
  const auto whole = Find(map, robot, path);
  ASSERT_THAT(whole, SizeIs(2));
  HazardParts parts(map);
  const auto next = [&](double x_m, std::size_t segment, int hazard) {
    return NextPassage(parts, map, robot, {x_m, 0, 0}, path, segment, false, hazard);
  };
  const auto first = next(-0.4, 0, 0), second = next(2.5, 1, 1);
  ASSERT_TRUE(first && second);
  for (const auto& [dut, want] : {std::pair(*first, whole[0]), {*second, whole[1]}})
    for (const ApproachColumn& column : kApproach)
      EXPECT_NEAR(dut.at.*column.member, want.at.*column.member, kStep_m) << column.name;
  EXPECT_FALSE(next(-1.9, 0, 1)) << "farther than two metres ahead";
  EXPECT_FALSE(next(1.5, 1, 0)) << "behind it";
}

TEST(WallGap, IsFromTheRobotsEdgeToTheWallsCell) {
  HazardMap map = Floor({});
  for (const RobotSpec& robot : {SquareRobot(), RoundRobot()}) {
    EXPECT_EQ(WallGap(map, robot.clear, {0, 0, 0}, 1), 1) << "nothing is near";
    EXPECT_NEAR(WallGap(map, robot.clear, {10 - kHalf_m - 0.3, 0, 0}, 1), 0.3, 1e-9)
        << "beyond the map is wall";
    EXPECT_EQ(WallGap(map, robot.clear, {10, 0, 0}, 1), 0);
  }
  map.occupancy(20, 20) = CellState::kOccupied;  // 0 to 0.5 m in both
  EXPECT_NEAR(WallGap(map, SquareRobot().clear, {-0.4, 0.2, 0}, 1), 0.4 - kHalf_m, 1e-9);
  EXPECT_NEAR(WallGap(map, SquareRobot().clear, {-0.4, 0.2, kPi / 4}, 1),
              0.4 - kHalf_m * std::sqrt(2), 1e-9)
      << "its corner is nearer";
  map.occupancy(20, 20) = CellState::kFree;
  map.occupancy(20, 22) = CellState::kOccupied;  // from (0, 1): ahead of it, to its left
  const Vec2 apart = Vec2(0, 1) - Vec2(-0.3 + kHalf_m, 0.6 + kHalf_m);
  EXPECT_NEAR(WallGap(map, SquareRobot().clear, {-0.3, 0.6, 0}, 1), apart.norm(), 1e-9)
      << "from corner to corner";
}

}  // namespace
}  // namespace floorproof

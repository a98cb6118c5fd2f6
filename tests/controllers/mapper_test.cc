// SPDX-License-Identifier: Apache-2.0
// The mapper on scans of a square room, their ranges from its geometry.
#include "controllers/mapper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/controllers/allocation_guard.h"
#include "tests/controllers/driving.h"

namespace floorproof {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();
constexpr double kLow_m = 1, kHigh_m = 5;  // the room's walls, both axes, in the site's frame G

// 6 m x 6 m, its cells 0.1 m.
GridFrame Site(const Pose2& X_WG = {}) { return {60, 60, 0.1, X_WG}; }

double RangeInRoom(const Vec2& p_G, double bearing_rad) {
  const Vec2 way(std::cos(bearing_rad), std::sin(bearing_rad));
  double range_m = kNothing;
  for (int k = 0; k < 2; ++k) {
    if (way[k] == 0) continue;
    range_m = std::min(range_m, ((way[k] > 0 ? kHigh_m : kLow_m) - p_G[k]) / way[k]);
  }
  return range_m;
}

// A lidar behind the robot's middle and turned, as they are mounted.
LidarScan ScanFrom(const Pose2& X_GB, int beams = 3600) {
  LidarScan scan;
  scan.fresh = true;
  scan.X_BL = {-0.05, 0.02, kPi};
  const Pose2 X_GL = X_GB * scan.X_BL;
  for (int i = 0; i < beams; ++i) {
    scan.angle_rad.push_back(WrapAngle(2 * kPi * i / beams));
    scan.range_m.push_back(RangeInRoom(X_GL.p(), X_GL.yaw_rad + scan.angle_rad.back()));
  }
  return scan;
}

Estimate At(const Pose2& X_WB) { return {X_WB, {}, {}}; }

// One beam straight ahead of the robot's middle.
Observation OneBeam(double range_m) {
  Observation sensed;
  sensed.scan.fresh = true;
  sensed.scan.angle_rad = {0};
  sensed.scan.range_m = {range_m};
  return sensed;
}

Observation Bumped(double bearing_rad) {
  Observation sensed;
  sensed.bump = {true, bearing_rad};
  return sensed;
}

void Read(Mapper& mapper, const std::string& yaml) {
  ReadParams(ParseYaml(yaml, "test"), "mapper.", mapper);
}

CellState StateAt(const KnownMap& map, const Vec2& p_W) {
  const Cell c = map.frame.ToCell(p_W);
  return map.At(c.ix, c.iy);
}

class MapperTest : public ::testing::Test {
 protected:
  void Start(const std::string& yaml = "{}", const Pose2& X_WG = {}) {
    Read(dut_, yaml);
    dut_.Start(Site(X_WG), robot_);
  }
  RobotSpec robot_ = RoundRobot();
  Mapper dut_;
};

// Free inside, wall where the walls are, nothing known beyond; whichever way the site lies.
TEST_F(MapperTest, AScanOfARoomIsItsMap) {
  for (const Pose2& X_WG : {Pose2{}, Pose2{-2, 1, 0}, Pose2{3, -7, 0.3}}) {
    Start("{}", X_WG);
    const Pose2 X_GB{2.63, 3.31, 0.4};
    Observation sensed;
    sensed.scan = ScanFrom(X_GB);
    for (int i = 0; i < 3; ++i) dut_.Update(sensed, At(X_WG * X_GB));
    const KnownMap& map = dut_.map();
    const double cell_m = map.frame.cell_m;
    EXPECT_EQ(cell_m, 0.05);
    for (int iy = 0; iy < map.frame.height; ++iy)
      for (int ix = 0; ix < map.frame.width; ++ix) {
        const Vec2 p((ix + 0.5) * cell_m, (iy + 0.5) * cell_m);
        // Beyond a wall: positive; both, near a corner that no beam tells from either wall.
        const double beyond_x = std::max(kLow_m - p.x(), p.x() - kHigh_m);
        const double beyond_y = std::max(kLow_m - p.y(), p.y() - kHigh_m);
        const double beyond_m = std::max(beyond_x, beyond_y);
        if (beyond_m < -cell_m) {
          EXPECT_EQ(map.At(ix, iy), CellState::kFree) << p.transpose();
        } else if (beyond_m > cell_m) {
          EXPECT_EQ(map.log_odds(ix, iy), 0) << p.transpose();
        } else if (beyond_m > 0 && std::min(beyond_x, beyond_y) < -2 * cell_m) {
          EXPECT_EQ(map.At(ix, iy), CellState::kOccupied) << p.transpose();
        }
      }
  }
}

TEST_F(MapperTest, AnOldScanSaysNothingNew) {
  Start();
  Observation sensed;
  sensed.scan = ScanFrom({3, 3, 0}, 90);
  sensed.scan.fresh = false;
  dut_.Update(sensed, At({3, 3, 0}));
  EXPECT_EQ(StateAt(dut_.map(), {5.02, 3.02}), CellState::kUnknown);
  EXPECT_EQ(StateAt(dut_.map(), {4.02, 3.02}), CellState::kUnknown);
}

// It may have met black cloth, or gone through glass.
TEST_F(MapperTest, BeamsThatDoNotComeBackChangeNothing) {
  Start();
  Observation sensed;
  sensed.scan = ScanFrom({3, 3, 0}, 90);
  dut_.Update(sensed, At({3, 3, 0}));
  const auto before = dut_.map().log_odds.cells;
  std::ranges::fill(sensed.scan.range_m, kNothing);
  for (int i = 0; i < 20; ++i) dut_.Update(sensed, At({3, 3, 0}));
  EXPECT_EQ(dut_.map().log_odds.cells, before);
}

TEST_F(MapperTest, OfLongBeamsOnlySoMuchIsUsed) {
  Start("{range_m: 1.5}");
  for (int i = 0; i < 5; ++i) {
    dut_.Update(OneBeam(2.02), At({2.02, 3.02, 0}));      // a wall too far off
    dut_.Update(OneBeam(1.0), At({2.02, 3.0, kPi / 2}));  // and one near enough
  }
  EXPECT_EQ(StateAt(dut_.map(), {3.42, 3.02}), CellState::kFree);
  EXPECT_EQ(StateAt(dut_.map(), {3.62, 3.02}), CellState::kUnknown);
  for (int ix = 0; ix < dut_.map().frame.width; ++ix)
    EXPECT_NE(dut_.map().At(ix, 60), CellState::kOccupied) << ix;
  EXPECT_EQ(StateAt(dut_.map(), {2.02, 4.02}), CellState::kOccupied);
}

// The robot believes to stand half a metre beside its place: so does its map.
TEST_F(MapperTest, TheMapLiesWhereTheRobotThinksItIs) {
  Start();
  Observation sensed;
  sensed.scan = ScanFrom({3.02, 3.02, 0});
  for (int i = 0; i < 3; ++i) dut_.Update(sensed, At({3.52, 3.02, 0}));
  EXPECT_EQ(StateAt(dut_.map(), {kHigh_m + 0.52, 3.02}), CellState::kOccupied);
  EXPECT_EQ(StateAt(dut_.map(), {kHigh_m + 0.02, 3.02}), CellState::kFree);
  EXPECT_EQ(StateAt(dut_.map(), {kLow_m + 0.48, 3.02}), CellState::kOccupied);
  EXPECT_EQ(StateAt(dut_.map(), {kLow_m - 0.02, 3.02}), CellState::kUnknown);
}

TEST_F(MapperTest, TheFloorUnderTheRobotIsFree) {
  Start();
  for (int i = 0; i <= 40; ++i) dut_.Update({}, At({2 + i * 0.05, 3, 0}));
  const KnownMap& map = dut_.map();
  for (int iy = 0; iy < map.frame.height; ++iy)
    for (int ix = 0; ix < map.frame.width; ++ix) {
      const double off_m = DistanceToSegment({2, 3}, {4, 3}, map.frame.Center(ix, iy));
      if (off_m < robot_.inscribed_radius_m - 2 * map.frame.cell_m) {
        EXPECT_EQ(map.At(ix, iy), CellState::kFree);
      } else if (off_m > robot_.inscribed_radius_m) {
        EXPECT_EQ(map.At(ix, iy), CellState::kUnknown);
      }
    }
}

// So that what changes is believed after a few scans, however long it was otherwise.
TEST_F(MapperTest, LogOddsStayWithinTheirBound) {
  Start("{most: 3}");
  const Pose2 here{2.02, 3.02, 0};
  const Vec2 door(4.04, 3.02);
  for (int i = 0; i < 500; ++i) dut_.Update(OneBeam(2.0), At(here));
  const auto [low, high] = std::ranges::minmax(dut_.map().log_odds.cells);
  EXPECT_EQ(low, -3);
  EXPECT_EQ(high, 3);
  EXPECT_EQ(StateAt(dut_.map(), door), CellState::kOccupied);
  int scans = 0;
  for (; StateAt(dut_.map(), door) != CellState::kFree && scans < 100; ++scans)
    dut_.Update(OneBeam(3.0), At(here));
  EXPECT_LE(scans, 10);
  EXPECT_GE(scans, 2);
}

// Sure is more than one beam: a dropout's neighbour, or one wrong range, frees nothing.
TEST_F(MapperTest, OneBeamAloneDoesNotFreeTheFloor) {
  Start();
  dut_.Update(OneBeam(2.0), At({2.02, 3.02, 0}));
  EXPECT_EQ(StateAt(dut_.map(), {3.02, 3.02}), CellState::kUnknown);
  dut_.Update(OneBeam(2.0), At({2.02, 3.02, 0}));
  EXPECT_EQ(StateAt(dut_.map(), {3.02, 3.02}), CellState::kFree);
}

TEST_F(MapperTest, CellsDivideTheSitesCells) {
  struct Case {
    double site_m, cell_m, expected_m;
  };
  for (const Case& c : {Case{0.1, 0.05, 0.05}, Case{0.1, 0.04, 0.1 / 3}, Case{0.1, 1, 0.1},
                        Case{0.02, 0.05, 0.02}, Case{0.5, 0.05, 0.05}}) {
    Read(dut_, "{cell_m: " + std::to_string(c.cell_m) + "}");
    const GridFrame site{30, 20, c.site_m, {1, 2, 0.3}};
    dut_.Start(site, robot_);
    const GridFrame& frame = dut_.map().frame;
    EXPECT_NEAR(frame.cell_m, c.expected_m, 1e-12);
    EXPECT_NEAR(frame.width * frame.cell_m, 30 * c.site_m, 1e-9);
    EXPECT_NEAR(frame.height * frame.cell_m, 20 * c.site_m, 1e-9);
    EXPECT_EQ(frame.X_WG.x_m, 1);
    EXPECT_EQ(frame.X_WG.yaw_rad, 0.3);
    EXPECT_EQ(dut_.map().log_odds.width, frame.width);
    EXPECT_EQ(dut_.map().marked.height, frame.height);
  }
}

TEST_F(MapperTest, ABumpIsMarkedAtTheEdgeThatWasPressed) {
  for (const double bearing_rad : {0.0, kPi / 2, -2.0, kPi}) {
    Start("{mark_m: 0.08}");
    const Pose2 here{3.1, 2.9, kPi / 2};
    dut_.Update(Bumped(bearing_rad), At(here));
    ASSERT_EQ(dut_.map().marks.size(), 1u);
    const FloorMark& mark = dut_.map().marks[0];
    EXPECT_EQ(mark.kind, FloorMark::Kind::kBump);
    EXPECT_NEAR(mark.radius_m, 0.04, 1e-12);
    const Vec2 from_robot = here.Inverse() * mark.p_W;
    EXPECT_NEAR(from_robot.norm(), 0.18 + 0.04, 1e-9) << "just outside the shell";
    EXPECT_NEAR(WrapAngle(std::atan2(from_robot.y(), from_robot.x()) - bearing_rad), 0, 1e-9);
    EXPECT_EQ(StateAt(dut_.map(), mark.p_W), CellState::kOccupied);
    EXPECT_EQ(StateAt(dut_.map(), here.p()), CellState::kFree);
  }
}

TEST_F(MapperTest, AFootprintsEdgeIsItsOwn) {
  robot_.clear = {Shape2::Kind::kFootprint, 0, Rectangle({-0.3, -0.2}, {0.3, 0.2})};
  Start();
  dut_.Update(Bumped(0), At({3, 3, 0}));
  dut_.Update({}, At({3, 3, 0}));
  dut_.Update(Bumped(kPi / 2), At({3, 3, 0}));
  ASSERT_EQ(dut_.map().marks.size(), 2u);
  EXPECT_LT((dut_.map().marks[0].p_W - Vec2(3.35, 3)).norm(), 1e-9);
  EXPECT_LT((dut_.map().marks[1].p_W - Vec2(3, 3.25)).norm(), 1e-9);
}

TEST_F(MapperTest, ADropIsMarkedBeyondTheSensorThatSawIt) {
  Start();
  Observation sensed;
  sensed.cliffs.n = 3;
  sensed.cliffs.p_B = {Vec2(0.17, 0), Vec2(0, 0.17), Vec2(-0.17, 0)};
  sensed.cliffs.drop[1] = true;
  const Pose2 here{3, 3, kPi};
  dut_.Update(sensed, At(here));
  ASSERT_EQ(dut_.map().marks.size(), 1u);
  EXPECT_EQ(dut_.map().marks[0].kind, FloorMark::Kind::kDrop);
  EXPECT_LT((here.Inverse() * dut_.map().marks[0].p_W - Vec2(0, 0.22)).norm(), 1e-9);
  // Another sensor's drop is news, its own is not until it has seen floor again.
  sensed.cliffs.drop[0] = true;
  dut_.Update(sensed, At(here));
  ASSERT_EQ(dut_.map().marks.size(), 2u);
  EXPECT_NEAR(dut_.map().marks[0].radius_m, 0.05, 1e-12);
  sensed.cliffs.drop[1] = false;
  dut_.Update(sensed, At(here));
  sensed.cliffs.drop[1] = true;
  dut_.Update(sensed, At(here));
  ASSERT_EQ(dut_.map().marks.size(), 2u);
  EXPECT_GT(dut_.map().marks[0].radius_m, 0.06);
  EXPECT_LT((here.Inverse() * dut_.map().marks[1].p_W - Vec2(0.22, 0)).norm(), 1e-9);
}

// A cliff sensor set in as far as the robot's middle has no outward direction.
TEST_F(MapperTest, ADropBelowTheRobotsMiddleIsMarkedThere) {
  Start();
  Observation sensed;
  sensed.cliffs.n = 1;
  sensed.cliffs.drop[0] = true;
  dut_.Update(sensed, At({3, 3, 0}));
  ASSERT_EQ(dut_.map().marks.size(), 1u);
  EXPECT_EQ(dut_.map().marks[0].p_W, Vec2(3, 3));
}

// Glass, a chair's crossbar: beams go over what the shell has met.
TEST_F(MapperTest, NoScanTakesAMarkBack) {
  Start();
  const Pose2 here{3, 3.02, 0};
  dut_.Update(Bumped(0), At(here));
  const Vec2 met = dut_.map().marks[0].p_W;
  for (int i = 0; i < 50; ++i) dut_.Update(OneBeam(2), At(here));
  const Cell c = dut_.map().frame.ToCell(met);
  EXPECT_LT(dut_.map().log_odds(c), -KnownMap::kSure);
  EXPECT_EQ(dut_.map().At(c.ix, c.iy), CellState::kOccupied);
  dut_.Update({}, At({met.x(), met.y(), 0}));  // nor does standing on it
  EXPECT_EQ(dut_.map().At(c.ix, c.iy), CellState::kOccupied);
  EXPECT_EQ(dut_.map().marks.size(), 1u);
}

// A pane along the robot's way: seen while it is abeam, passed by beams before and after; from one
// side and from the other, by few beams and by many.
TEST_F(MapperTest, GlassIsKeptThoughBeamsPassItAskew) {
  const Vec2 pane(3.02, 4.02);
  for (const bool glass : {false, true})
    for (const double step_m : {0.02, 0.01, 0.005, 0.002}) {
      Start(glass ? "{glass: true}" : "{}");
      for (const double side : {-1, -1, 1, -1}) {
        for (double x_m = -1; x_m <= 1; x_m += step_m) {
          const Vec2 here(pane.x() + x_m, pane.y() + side), way = pane - here;
          const bool head_on = std::abs(way.x() / way.y()) < std::tan(5 * kPi / 180);
          dut_.Update(OneBeam(head_on ? way.norm() - 0.02 : way.norm() + 0.7),
                      At({here.x(), here.y(), std::atan2(way.y(), way.x())}));
        }
        EXPECT_EQ(StateAt(dut_.map(), pane), glass ? CellState::kOccupied : CellState::kFree)
            << step_m << " " << side;
      }
      // What was seen from far away says nothing else.
      dut_.Update(OneBeam(3.5 - 0.02), At({pane.x() - 3.5, pane.y(), 0}));
      for (int i = 0; i < 30; ++i) dut_.Update(OneBeam(1.7), At({2.02, 3.02, kPi / 4}));
      EXPECT_EQ(StateAt(dut_.map(), pane), glass ? CellState::kOccupied : CellState::kFree);
      // A door that opens: beams pass along where it was seen.
      for (int i = 0; i < 30; ++i) dut_.Update(OneBeam(1.7), At({3.02, 3.02, kPi / 2}));
      EXPECT_EQ(StateAt(dut_.map(), pane), CellState::kFree);
      // And comes to stand across: what is seen now counts, not how it was seen before.
      for (int i = 0; i < 10; ++i) dut_.Update(OneBeam(1 - 0.02), At({2.02, 4.02, 0}));
      for (int i = 0; i < 30; ++i) dut_.Update(OneBeam(1.7), At({3.02, 3.02, kPi / 2}));
      EXPECT_EQ(StateAt(dut_.map(), pane), glass ? CellState::kOccupied : CellState::kFree);
    }
}

// There noise alone puts ends of beams into cells that are free.
TEST_F(MapperTest, WhatIsSeenFromFarIsFreedFromAnywhere) {
  Start("{glass: true}");
  const Vec2 cell(5.52, 3.02);
  for (int i = 0; i < 10; ++i) dut_.Update(OneBeam(3.5 - 0.02), At({2.02, 3.02, 0}));
  EXPECT_EQ(StateAt(dut_.map(), cell), CellState::kOccupied);
  for (int i = 0; i < 30; ++i) dut_.Update(OneBeam(2), At({5.52, 2.02, kPi / 2}));
  EXPECT_EQ(StateAt(dut_.map(), cell), CellState::kFree);
}

TEST_F(MapperTest, WhatStaysPressedIsMarkedOnce) {
  Start();
  for (int i = 0; i < 30; ++i) dut_.Update(Bumped(0), At({3 - 0.002 * i, 3, 0}));
  ASSERT_EQ(dut_.map().marks.size(), 1u);
  EXPECT_NEAR(dut_.map().marks[0].radius_m, 0.05, 1e-12);
}

TEST_F(MapperTest, WhatIsMetAgainGrowsAndWhatIsMetElsewhereIsNew) {
  Start();
  std::size_t marked = 0;
  double radius_m = 0;
  for (int meeting = 0; meeting < 4; ++meeting) {
    dut_.Update(Bumped(0), At({3, 3 + 0.01 * meeting, 0}));
    dut_.Update({}, At({2.8, 3, 0}));
    ASSERT_EQ(dut_.map().marks.size(), 1u);
    EXPECT_GT(dut_.map().marks[0].radius_m, radius_m);
    radius_m = dut_.map().marks[0].radius_m;
    const auto cells = static_cast<std::size_t>(std::ranges::count(dut_.map().marked.cells, 1));
    EXPECT_GT(cells, marked);
    marked = cells;
  }
  dut_.Update(Bumped(0), At({3, 3.5, 0}));
  EXPECT_EQ(dut_.map().marks.size(), 2u);
  EXPECT_NEAR(dut_.map().marks[1].radius_m, 0.05, 1e-12);
  // Each marked cell lies in one of the marks (or holds the middle of one).
  for (int iy = 0; iy < dut_.map().frame.height; ++iy)
    for (int ix = 0; ix < dut_.map().frame.width; ++ix)
      if (dut_.map().marked(ix, iy)) {
        const Vec2 p = dut_.map().frame.Center(ix, iy);
        EXPECT_TRUE(std::ranges::any_of(dut_.map().marks, [&](const FloorMark& m) {
          return (m.p_W - p).norm() <= std::max(m.radius_m, 0.036);
        })) << p.transpose();
      }
}

// A lost robot may believe to be anywhere.
TEST_F(MapperTest, BeyondTheSiteNothingIsDrawn) {
  Start();
  Observation sensed = Bumped(0);
  sensed.scan = ScanFrom({3, 3, 0}, 360);
  for (const Pose2& far : {Pose2{20, 3, 0}, Pose2{-7, -9, 1}, Pose2{3, 1e6, 2}}) {
    dut_.Update(sensed, At(far));
    sensed.bump.pressed = !sensed.bump.pressed;
  }
  EXPECT_EQ(std::ranges::count(dut_.map().log_odds.cells, 0.0f), 120 * 120);
  EXPECT_EQ(std::ranges::count(dut_.map().marked.cells, 1), 0);
  // Half on it: the half that lies on it is drawn.
  dut_.Update(sensed, At({0, 3, 0}));
  EXPECT_EQ(StateAt(dut_.map(), {0.02, 3.02}), CellState::kFree);
}

TEST_F(MapperTest, AnotherEpisodeBeginsWithNothingKnown) {
  Start();
  Observation sensed = Bumped(0);
  sensed.scan = ScanFrom({3, 3, 0}, 360);
  sensed.cliffs.n = 1;
  sensed.cliffs.p_B[0] = {-0.17, 0};
  sensed.cliffs.drop[0] = true;
  dut_.Update(sensed, At({3, 3, 0}));
  ASSERT_FALSE(dut_.map().marks.empty());
  dut_.Start(Site(), robot_);
  EXPECT_EQ(std::ranges::count(dut_.map().log_odds.cells, 0.0f), 120 * 120);
  EXPECT_EQ(std::ranges::count(dut_.map().marked.cells, 1), 0);
  EXPECT_TRUE(dut_.map().marks.empty());
  sensed.scan.fresh = false;
  dut_.Update(sensed, At({3, 3, 0}));  // pressed, and over the drop, since the last one ended
  EXPECT_EQ(dut_.map().marks.size(), 2u);
  EXPECT_EQ(StateAt(dut_.map(), {3, 3}), CellState::kFree);
}

TEST_F(MapperTest, AllocatesNothingWithoutNewMarks) {
  Start();
  Observation sensed = Bumped(0.3);
  sensed.scan = ScanFrom({3, 3, 0}, 360);
  sensed.cliffs.n = 1;
  sensed.cliffs.p_B[0] = {0.17, 0};
  sensed.cliffs.drop[0] = true;
  dut_.Update(sensed, At({3, 3, 0}));
  const std::int64_t before = AllocationCount();
  for (int i = 0; i < 50; ++i) dut_.Update(sensed, At({3 - 0.02 * i, 3, 0.1 * i}));
  EXPECT_EQ(AllocationCount(), before);
}

}  // namespace
}  // namespace floorproof

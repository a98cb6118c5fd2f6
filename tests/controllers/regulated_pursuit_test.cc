// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "base/streams.h"
#include "tests/controllers/driving.h"

namespace floorproof {
namespace {

std::unique_ptr<Tracker> MakeDut(const std::string& yaml = "") {
  auto dut = MakePlugin(Trackers(), "regulated_pursuit", "controller");
  if (!yaml.empty()) ReadParams(ParseYaml(yaml, "test.yaml"), "controller.", *dut);
  return dut;
}

Driven Follow(const Path& path, const DriveOptions& options = {},
              const RobotSpec& robot = RoundRobot()) {
  return DriveAlong(*MakeDut(), path, options, nullptr, robot);
}

RobotSpec Cruising(double speed_mps) {
  RobotSpec robot = RoundRobot();
  robot.cruise_mps = speed_mps;
  return robot;
}

// Rows along x joined at alternate ends.
Path Rows(int count, double length_m, double spacing_m) {
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const double y_m = i * spacing_m;
    points.emplace_back(i % 2 == 0 ? 0 : length_m, y_m);
    points.emplace_back(i % 2 == 0 ? length_m : 0, y_m);
  }
  return MakePath(points);
}

Path Circle(double radius_m, double piece_m) {
  std::vector<Vec2> points;
  const int n = static_cast<int>(std::ceil(2 * kPi * radius_m / piece_m));
  for (int i = 0; i <= n; ++i) {
    const double a = 2 * kPi * i / n;
    points.emplace_back(radius_m * std::sin(a), radius_m - radius_m * std::cos(a));
  }
  return MakePath(points);
}

// Pieces of random length, each turned from the last by up to max_turn_rad.
Path Wander(int pieces, double low_m, double high_m, double max_turn_rad) {
  Stream random(1, 0, "wander");
  std::vector<Vec2> points = {{0, 0}};
  double yaw_rad = 0;
  for (int i = 0; i < pieces; ++i) {
    yaw_rad += random.Uniform(-max_turn_rad, max_turn_rad);
    points.push_back(points.back() +
                     random.Uniform(low_m, high_m) * Vec2(std::cos(yaw_rad), std::sin(yaw_rad)));
  }
  return MakePath(points);
}

double MeanSpeed(const Driven& driven, double from_x_m, double to_x_m) {
  double sum = 0;
  int n = 0;
  for (const auto& step : driven.steps) {
    if (step.X_WB.x_m < from_x_m || step.X_WB.x_m > to_x_m) continue;
    sum += step.twist.vx_mps;
    ++n;
  }
  return sum / std::max(1, n);
}

struct Case {
  const char* name;
  Path path;
  double cross_track_m, ideal_share;  // bounds
};

void PrintTo(const Case& shape, std::ostream* os) { *os << shape.name; }

class Shapes : public testing::TestWithParam<Case> {};

// Plans as coverage planners draw them, at the speeds they are driven. The time bound on tight
// circles allows for the yaw rate, which the ideal time does not know.
TEST_P(Shapes, AreFollowedCloselyAndInGoodTime) {
  for (const double speed_mps : {0.2, 0.25, 0.3}) {
    const Driven driven = Follow(GetParam().path, {}, Cruising(speed_mps));
    ASSERT_TRUE(driven.done) << speed_mps;
    EXPECT_LT(driven.max_cross_track_m, GetParam().cross_track_m) << speed_mps;
    EXPECT_LT(driven.time_s,
              GetParam().ideal_share * IdealTime(GetParam().path, Cruising(speed_mps)))
        << speed_mps;
    EXPECT_TRUE(driven.SegmentsNeverDecrease());
    EXPECT_LT((driven.steps.back().X_WB.p() - GetParam().path.back().p_W).norm(), 0.02);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Shapes,
    testing::Values(Case{"straight", MakePath({{0, 0}, {5, 0}}), 1e-6, 1.02},
                    Case{"square", MakePath({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}}), 0.015, 1.02},
                    Case{"rows", Rows(8, 4, 0.28), 0.015, 1.02},
                    Case{"rows_joined_by_2_cm", Rows(4, 1, 0.02), 0.015, 1.05},
                    Case{"out_and_back", MakePath({{0, 0}, {1, 0}, {0, 0}, {1, 0}}), 0.015, 1.02},
                    Case{"spike", MakePath({{0, 0}, {1, 0}, {1.1, 0}, {1, 0}, {1, 1}}), 0.015,
                         1.02},
                    Case{"sharp", MakePath({{0, 0}, {1, 0}, {0.1, 0.3}, {1, 0.4}}), 0.015, 1.02},
                    Case{"bend_20_deg", MakePath({{0, 0}, {2, 0}, {4, 0.73}}), 0.02, 1.02},
                    Case{"bend_45_deg", MakePath({{0, 0}, {2, 0}, {3, 1}}), 0.03, 1.03},
                    Case{"circle_1_m", Circle(1.0, 0.1), 0.01, 1.03},
                    Case{"circle_40_cm", Circle(0.4, 0.05), 0.02, 1.08},
                    Case{"circle_40_cm_of_20_cm_pieces", Circle(0.4, 0.2), 0.02, 1.08},
                    Case{"circle_25_cm", Circle(0.25, 0.05), 0.02, 1.4},
                    Case{"contour", Wander(300, 0.05, 0.2, 0.6), 0.035, 1.06},
                    Case{"wild", Wander(150, 0.02, 0.3, 3.1), 0.05, 1.06},
                    Case{"tiny_pieces", Wander(400, 0.002, 0.02, 0.3), 0.04, 1.4}),
    [](const auto& suite) { return std::string(suite.param.name); });

TEST(RegulatedPursuit, TurnsOnTheSpotAtCornersAndDrivesThroughBends) {
  const auto least_speed = [](double bend_rad) {
    const Driven driven =
        Follow(MakePath({{0, 0}, {2, 0}, {2 + 2 * std::cos(bend_rad), 2 * std::sin(bend_rad)}}));
    double least_mps = 1;
    for (const auto& step : driven.steps)
      if (step.t_s > 3 && step.t_s < 12) least_mps = std::min(least_mps, step.twist.vx_mps);
    return least_mps;
  };
  EXPECT_NEAR(least_speed(0.0), 0.25, 1e-9);
  EXPECT_GT(least_speed(0.1), 0.24);
  EXPECT_GT(least_speed(0.7), 0.1);
  EXPECT_EQ(least_speed(1.0), 0);
}

TEST(RegulatedPursuit, CutsNoBendWhereAWaypointStops) {
  Path path = MakePath({{0, 0}, {2, 0}, {3, 1}});
  const Driven cut = Follow(path);
  path[1].stops = true;
  const Driven exact = Follow(path);
  EXPECT_TRUE(exact.done);
  EXPECT_GT(cut.max_cross_track_m, 0.015);
  EXPECT_LT(exact.max_cross_track_m, 0.011);
}

TEST(RegulatedPursuit, CollinearAndDuplicatePointsChangeNothing) {
  const Driven plain = Follow(MakePath({{0, 0}, {2, 0}, {2, 1}}));
  const Driven dotted = Follow(MakePath({{0, 0},
                                         {0, 0},
                                         {0.5, 0},
                                         {0.5, 0},
                                         {0.501, 0},
                                         {1.7, 0},
                                         {2, 0},
                                         {2, 0},
                                         {2, 0},
                                         {2, 0.3},
                                         {2, 1},
                                         {2, 1}}));
  ASSERT_EQ(plain.steps.size(), dotted.steps.size());
  for (std::size_t i = 0; i < plain.steps.size(); ++i) {
    EXPECT_NEAR(plain.steps[i].twist.vx_mps, dotted.steps[i].twist.vx_mps, 1e-9);
    EXPECT_NEAR(plain.steps[i].twist.wz_radps, dotted.steps[i].twist.wz_radps, 1e-9);
  }
  EXPECT_LT(dotted.max_cross_track_m, 0.015);
}

TEST(RegulatedPursuit, NeverTracksASegmentOfNoLength) {
  const Path path = MakePath({{0, 0}, {0, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 1}, {1, 1}, {2, 1}});
  for (const auto& step : Follow(path).steps) {
    const double length_m = (path[step.segment + 1].p_W - path[step.segment].p_W).norm();
    EXPECT_GT(length_m, 0) << step.segment;
  }
}

TEST(RegulatedPursuit, MirroredPathGivesMirroredCommands) {
  const Path path = Wander(60, 0.05, 0.5, 2.0);
  Path mirrored = path;
  for (Waypoint& waypoint : mirrored) waypoint.p_W.y() *= -1;
  const Driven one = Follow(path), other = Follow(mirrored);
  ASSERT_EQ(one.steps.size(), other.steps.size());
  for (std::size_t i = 0; i < one.steps.size(); ++i) {
    ASSERT_NEAR(one.steps[i].twist.vx_mps, other.steps[i].twist.vx_mps, 1e-9);
    ASSERT_NEAR(one.steps[i].twist.wz_radps, -other.steps[i].twist.wz_radps, 1e-9);
  }
}

TEST(RegulatedPursuit, HalvingTheControlPeriodConverges) {
  // A straight into a circle: no turn on the spot, whose end falls on a control period.
  Path path = MakePath({{-0.5, 0}});
  for (const Waypoint& waypoint : Circle(0.6, 0.08)) path.push_back(waypoint);
  const auto drive = [&](double control_s) {
    DriveOptions options;
    options.control_s = control_s;
    return Follow(path, options);
  };
  const Driven exact = drive(0.0025);
  double last_m = 1;
  for (const int factor : {16, 8, 4, 2}) {
    const Driven driven = drive(0.0025 * factor);
    double apart_m = 0;
    for (std::size_t i = 0; i + 50 < driven.steps.size(); ++i) {
      const std::size_t j = i * static_cast<std::size_t>(factor);
      if (j >= exact.steps.size()) break;
      apart_m = std::max(apart_m, (driven.steps[i].X_WB.p() - exact.steps[j].X_WB.p()).norm());
    }
    EXPECT_LT(apart_m, last_m) << factor;
    last_m = apart_m;
  }
  EXPECT_LT(last_m, 0.005);
}

TEST(RegulatedPursuit, ComesBackAfterAPush) {
  //  pushed 0.3 m to the left of a 4 m row, 1.5 m before its end
  DriveOptions options;
  bool pushed = false;
  options.push = [&](double t_s, Pose2& X_WB) {
    if (pushed || t_s < 10) return;
    pushed = true;
    X_WB = X_WB * Pose2{0, 0.3, 0.8};
  };
  const Driven driven = Follow(MakePath({{0, 0}, {4, 0}, {4, 1}}), options);
  ASSERT_TRUE(driven.done);
  EXPECT_GT(driven.max_cross_track_m, 0.29);
  EXPECT_LT(driven.CrossTrackAfter(15), 0.02);
}

TEST(RegulatedPursuit, RecoversWhereverItIsPutDown) {
  const Path path = MakePath({{0, 0}, {2, 0}, {2, 0.3}, {0, 0.3}});
  for (const double at_s : {2.0, 7.8, 8.5, 9.5, 11.0, 15.0}) {
    for (const Vec2& shift : {Vec2(0.4, 0), Vec2(-0.4, 0), Vec2(0, 0.4), Vec2(0, -0.4)}) {
      for (const double turn_rad : {0.0, 2.0, kPi}) {
        DriveOptions options;
        options.time_limit_s = 100;
        bool pushed = false;
        options.push = [&](double t_s, Pose2& X_WB) {
          if (pushed || t_s < at_s) return;
          pushed = true;
          X_WB = {X_WB.x_m + shift.x(), X_WB.y_m + shift.y(), WrapAngle(X_WB.yaw_rad + turn_rad)};
        };
        const Driven driven = Follow(path, options);
        ASSERT_TRUE(driven.done) << at_s << " " << shift.transpose() << " " << turn_rad;
        EXPECT_TRUE(driven.SegmentsNeverDecrease());
        EXPECT_LT(driven.time_s, 60);
        EXPECT_LT((driven.steps.back().X_WB.p() - path.back().p_W).norm(), 0.045);
      }
    }
  }
}

TEST(RegulatedPursuit, StartsFromBesideThePathAndFacingAway) {
  for (const Pose2& start : {Pose2{0, 0.5, 0}, Pose2{-0.3, -0.2, 2}, Pose2{0, 0, kPi}}) {
    DriveOptions options;
    options.start = start;
    const Driven driven = Follow(MakePath({{0, 0}, {2, 0}}), options);
    ASSERT_TRUE(driven.done);
    EXPECT_LT(driven.CrossTrackAfter(8), 0.02);
  }
}

TEST(RegulatedPursuit, DwellsInSimulatedTime) {
  Path path = MakePath({{0, 0}, {1, 0}, {2, 0}});
  path[0].dwell_s = 1;
  path[1].dwell_s = 3;
  path[2].dwell_s = 2;
  for (const double control_s : {0.02, 0.01}) {
    DriveOptions options;
    options.control_s = control_s;
    const Driven driven = Follow(path, options);
    ASSERT_TRUE(driven.done);
    const auto dwelling = std::ranges::count_if(driven.steps, &Driven::Step::dwelling);
    EXPECT_NEAR(static_cast<double>(dwelling) * control_s, 6, 0.1);
    EXPECT_TRUE(driven.steps.front().dwelling);
    for (const auto& step : driven.steps) {
      if (!step.dwelling) continue;
      EXPECT_LT(step.twist.vx_mps, 0.08);
    }
  }
}

// As an audit robot turns its sensor to the wall.
TEST(RegulatedPursuit, FacesThePlansYawWhereItDwellsAndOnlyThere) {
  for (const double yaw_rad : {0.0, 2.0, -3.0, kPi}) {
    Path path = MakePath({{0, 0}, {1, 0}, {2, 0.5}});
    path[1].dwell_s = 3;
    path[1].yaw_rad = yaw_rad;
    path[2].yaw_rad = 1.5;  // nothing is done there
    const Driven driven = Follow(path);
    ASSERT_TRUE(driven.done) << yaw_rad;
    int dwelling = 0;
    for (const auto& step : driven.steps) {
      if (!step.dwelling) continue;
      ++dwelling;
      EXPECT_LT(std::abs(WrapAngle(step.X_WB.yaw_rad - yaw_rad)), 0.04) << yaw_rad;
      EXPECT_LT((step.X_WB.p() - path[1].p_W).norm(), 0.03) << yaw_rad;
    }
    EXPECT_NEAR(dwelling * 0.02, 3, 0.05) << yaw_rad;
    EXPECT_LT(std::abs(WrapAngle(driven.steps.back().X_WB.yaw_rad - std::atan2(0.5, 1))), 0.1);
  }
}

TEST(RegulatedPursuit, OnePointIsDwelledAtAndDone) {
  Path path = MakePath({{1, 1}});
  path[0].dwell_s = 2;
  const Driven driven = Follow(path);
  EXPECT_TRUE(driven.done);
  EXPECT_NEAR(driven.time_s, 2, 0.021);
  EXPECT_EQ(driven.steps.back().segment, 0u);

  DriveOptions options;
  options.start = Pose2{0, 0, 0};
  const Driven from_afar = Follow(path, options);
  EXPECT_TRUE(from_afar.done);
  EXPECT_LT((from_afar.steps.back().X_WB.p() - Vec2(1, 1)).norm(), 0.03);

  EXPECT_TRUE(Follow({}).done);
  EXPECT_EQ(Follow({}).time_s, 0);
  EXPECT_TRUE(Follow(MakePath({{1, 1}, {1, 1}})).done);
}

TEST(RegulatedPursuit, KeepsEachSegmentsSpeed) {
  Path path = MakePath({{0, 0}, {2, 0}, {4, 0}, {6, 0}});
  path[1].speed_mps = 0.3;
  path[2].speed_mps = 0.1;
  path[3].speed_mps = 9;  // more than the robot manages
  const Driven driven = Follow(path);
  EXPECT_NEAR(MeanSpeed(driven, 0.5, 1.5), 0.3, 1e-6);
  EXPECT_NEAR(MeanSpeed(driven, 2.05, 3.9), 0.1, 1e-3);
  EXPECT_NEAR(MeanSpeed(driven, 4.7, 5.5), 0.4, 1e-6);
}

TEST(RegulatedPursuit, SlowsDownNearObstacles) {
  //  free | wall 0.20 m beside the path, from x = 2 to 4 (gap 0.02 m to the body) | free
  ClearanceField clearance;
  clearance.frame = {120, 40, 0.05, {0, -1, 0}};
  clearance.distance_m = Grid<float>(120, 40, 1.0f);
  for (int iy = 0; iy < 40; ++iy)
    for (int ix = 40; ix < 80; ++ix) clearance.distance_m(ix, iy) = 0.20f;
  const Path path = MakePath({{0, 0}, {6, 0}});
  const Driven driven = DriveAlong(*MakeDut(), path, {}, &clearance);
  const double open_mps = MeanSpeed(driven, 0.5, 1.5), near_mps = MeanSpeed(driven, 2.2, 3.6);
  EXPECT_NEAR(open_mps, 0.25, 1e-9);
  EXPECT_LT(near_mps, 0.8 * open_mps);
  EXPECT_GT(near_mps, 0.5 * open_mps);
  const Driven careless = DriveAlong(*MakeDut("{obstacle_speed_share: 1}"), path, {}, &clearance);
  EXPECT_LT(careless.time_s, driven.time_s);
}

TEST(RegulatedPursuit, ArrivesSlowlyAtTheEndOfAStraight) {
  const Driven driven = Follow(MakePath({{0, 0}, {2, 0}, {2, 2}}));
  double last_mps = 1;
  for (const auto& step : driven.steps) {
    if (step.segment > 0 || step.X_WB.x_m < 1.5) continue;
    EXPECT_LE(step.twist.vx_mps, last_mps + 1e-12);
    last_mps = step.twist.vx_mps;
  }
  EXPECT_LT(last_mps, 0.1);
  double overshoot_m = 0;
  for (const auto& step : driven.steps) overshoot_m = std::max(overshoot_m, step.X_WB.x_m - 2);
  EXPECT_LT(overshoot_m, 0.01);
}

TEST(RegulatedPursuit, NeighbouringRowsAreNotMixedUp) {
  // 5 cm apart, pushed half way towards the next row: every row is still driven.
  const Path path = Rows(4, 2, 0.05);
  DriveOptions options;
  options.push = [](double t_s, Pose2& X_WB) {
    if (std::fmod(t_s + 0.01, 6.0) < 0.02) X_WB.y_m += 0.03;
  };
  const Driven driven = Follow(path, options);
  ASSERT_TRUE(driven.done);
  double way_m = 0;
  for (std::size_t i = 1; i < driven.steps.size(); ++i)
    way_m += (driven.steps[i].X_WB.p() - driven.steps[i - 1].X_WB.p()).norm();
  EXPECT_GT(way_m, 0.98 * Length(path));
}

TEST(RegulatedPursuit, ManyWaypoints) {
  std::vector<Vec2> points;
  for (int i = 0; i < 100000; ++i) points.emplace_back(0.0002 * i, 0.05 * std::sin(0.001 * i));
  const Driven driven = Follow(MakePath(points));
  ASSERT_TRUE(driven.done);
  EXPECT_EQ(driven.steps.back().segment, points.size() - 2);
  EXPECT_LT(driven.max_cross_track_m, 0.02);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "controllers/reference_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/controllers/driving.h"

namespace floorproof {
namespace {

const ReferenceLimits kLimits;

std::vector<Vec2> Points(const ReferencePath& reference) {
  std::vector<Vec2> points;
  for (const auto& vertex : reference.vertices) points.push_back(vertex.p_W);
  return points;
}

TEST(ReferencePath, PassesOverPointsOnAStraightAndDuplicates) {
  //  0---1===2-3-----4     1 and 2 are one place twice
  //                  |
  //                  5
  const auto reference =
      MakeReference(MakePath({{0, 0}, {1, 0}, {1, 0}, {1.5, 0}, {2, 0}, {2, -1}}), kLimits);
  EXPECT_EQ(Points(reference), (std::vector<Vec2>{{0, 0}, {2, 0}, {2, -1}}));
  EXPECT_EQ(reference.waypoint_s_m, (std::vector<double>{0, 1, 1, 1.5, 2, 3}));
}

TEST(ReferencePath, EveryPointStaysWithinTheTolerance) {
  std::vector<Vec2> points;
  for (int i = 0; i < 400; ++i) {  // a slowly closing spiral with a fine ripple
    const double a = 0.05 * i, r = 2 - 0.003 * i + 0.002 * std::sin(7.0 * i);
    points.emplace_back(r * std::cos(a), r * std::sin(a));
  }
  const Path path = MakePath(points);
  const auto reference = MakeReference(path, kLimits);
  EXPECT_LT(reference.vertices.size(), path.size());
  EXPECT_GT(reference.vertices.size(), 10u);
  std::size_t k = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    while (k + 2 < reference.vertices.size() &&
           reference.vertices[k + 1].s_m <= reference.waypoint_s_m[i])
      ++k;
    EXPECT_LE(
        DistanceToSegment(reference.vertices[k].p_W, reference.vertices[k + 1].p_W, path[i].p_W),
        kLimits.straight_m + 1e-12);
  }
  EXPECT_TRUE(std::ranges::is_sorted(reference.waypoint_s_m));
}

TEST(ReferencePath, GoingBackIsACorner) {
  const auto reference = MakeReference(MakePath({{0, 0}, {1, 0}, {0.5, 0}, {0, 0}}), kLimits);
  ASSERT_EQ(Points(reference), (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 0}}));
  EXPECT_TRUE(reference.vertices[1].stop);
}

TEST(ReferencePath, StopsAtSharpCornersAndDwellsOnly) {
  Path path = MakePath({{0, 0}, {1, 0}, {2, 0.3}, {2, 1}, {2, 2}});
  path[3].dwell_s = 2;
  const auto reference = MakeReference(path, kLimits);
  ASSERT_EQ(reference.vertices.size(), 5u);
  EXPECT_FALSE(reference.vertices[1].stop);  // 17 deg
  EXPECT_TRUE(reference.vertices[2].stop);   // 73 deg
  EXPECT_TRUE(reference.vertices[3].stop);   // straight on, but it stands there
  EXPECT_TRUE(reference.vertices[4].stop);
  for (const auto& vertex : reference.vertices) {
    if (vertex.stop) {
      EXPECT_EQ(vertex.passing_mps, 0);
    } else {
      EXPECT_GT(vertex.passing_mps, 0.05);
    }
  }
}

TEST(ReferencePath, WhereAWaypointStopsABendIsAStopAStraightIsNone) {
  Path path = MakePath({{0, 0}, {1, 0}, {2, 0}, {3, 0.3}, {4, 0.6}, {5, 0.6}});
  path[1].stops = path[2].stops = path[3].stops = true;
  const auto reference = MakeReference(path, kLimits);
  ASSERT_EQ(Points(reference),
            (std::vector<Vec2>{{0, 0}, {1, 0}, {2, 0}, {3, 0.3}, {4, 0.6}, {5, 0.6}}));
  EXPECT_FALSE(reference.vertices[1].stop) << "straight on";
  EXPECT_TRUE(reference.vertices[2].stop);
  EXPECT_FALSE(reference.vertices[3].stop) << "straight on, too";
  EXPECT_FALSE(reference.vertices[4].stop) << "a bend that may be cut";
  EXPECT_GT(reference.vertices[1].passing_mps, 0.05);
}

TEST(ReferencePath, DwellsAtOnePlaceAddUp) {
  Path path = MakePath({{0, 0}, {0, 0}, {1, 0}, {1, 0}});
  path[0].dwell_s = 1;
  path[1].dwell_s = 2;
  path[3].dwell_s = 4;
  const auto reference = MakeReference(path, kLimits);
  ASSERT_EQ(reference.vertices.size(), 2u);
  ASSERT_EQ(reference.vertices[0].dwells.size(), 1u);
  EXPECT_EQ(reference.vertices[0].dwells[0].time_s, 3);
  ASSERT_EQ(reference.vertices[1].dwells.size(), 1u);
  EXPECT_EQ(reference.vertices[1].dwells[0].time_s, 4);
}

TEST(ReferencePath, DwellsAtOnePlaceThatFaceApartAreTwo) {
  Path path = MakePath({{0, 0}, {1, 0}, {1, 0}, {1, 0}, {2, 0}});
  for (std::size_t i = 1; i <= 3; ++i) {
    path[i].dwell_s = static_cast<double>(i);
    path[i].yaw_rad = i < 3 ? 0.5 : -2;
    path[i].task = WaypointTask{.id = static_cast<int>(i)};
  }
  ReferenceLimits limits = kLimits;
  EXPECT_EQ(MakeReference(path, limits).vertices[1].dwells.size(), 1u) << "it faces nowhere";
  limits.faces = true;
  const auto reference = MakeReference(path, limits);
  const auto& dwells = reference.vertices[1].dwells;
  ASSERT_EQ(dwells.size(), 2u);
  EXPECT_EQ(dwells[0].time_s, 3);
  EXPECT_EQ(dwells[0].face_rad, 0.5);
  EXPECT_EQ(dwells[0].tasks, (std::vector{*path[1].task, *path[2].task}));
  EXPECT_EQ(dwells[1].time_s, 3);
  EXPECT_EQ(dwells[1].face_rad, -2);
  EXPECT_EQ(dwells[1].tasks, std::vector{*path[3].task});
}

TEST(ReferencePath, ADwellCountsOnceHoweverThePathGoesOn) {
  Path path = MakePath({{0, 0}, {1, 0}, {1, 0}, {2, 0}});
  path[1].dwell_s = 1;
  path[2].dwell_s = 5;
  path[3].speed_mps = 0.1;
  const auto reference = MakeReference(path, kLimits);
  ASSERT_EQ(reference.vertices.size(), 3u);
  ASSERT_EQ(reference.vertices[1].dwells.size(), 1u);
  EXPECT_EQ(reference.vertices[1].dwells[0].time_s, 6);
}

TEST(ReferencePath, CarriesTheTasksOfItsWaypoints) {
  Path path = MakePath({{0, 0}, {1, 0}, {2, 0}, {2, 0}, {3, 0}});
  path[0].task = WaypointTask{.id = 7};
  path[1].task = WaypointTask{.id = 1};
  path[2].task = WaypointTask{.id = 2};
  path[3].task = WaypointTask{.id = 3};
  const auto reference = MakeReference(path, kLimits);
  ASSERT_EQ(Points(reference), (std::vector<Vec2>{{0, 0}, {1, 0}, {2, 0}, {3, 0}}))
      << "a waypoint with a task is no point to pass over";
  const auto tasks = [&](std::size_t k) { return reference.vertices[k].dwells.at(0).tasks; };
  EXPECT_EQ(tasks(0), std::vector{*path[0].task});
  EXPECT_EQ(tasks(1), std::vector{*path[1].task});
  EXPECT_EQ(tasks(2), (std::vector{*path[2].task, *path[3].task}));
  EXPECT_TRUE(reference.vertices[3].dwells.empty());
  EXPECT_FALSE(reference.vertices[1].stop) << "carrying a task is no reason to stop";
}

TEST(ReferencePath, SharperBendsAreSlower) {
  double last_mps = 1e9;
  for (const double bend_rad : {0.05, 0.3, 0.5, 0.8}) {
    ReferenceLimits limits = kLimits;
    limits.cruise_mps = limits.max_speed_mps = 5;
    const auto reference = MakeReference(
        MakePath({{-99, 0}, {0, 0}, {99 * std::cos(bend_rad), 99 * std::sin(bend_rad)}}), limits);
    EXPECT_LT(reference.vertices[1].passing_mps, last_mps);
    last_mps = reference.vertices[1].passing_mps;
  }
}

TEST(ReferencePath, SpeedsAreReachableWithTheDeceleration) {
  Path path = MakePath({{0, 0}, {1, 0.01}, {1.2, 0}, {1.3, 0.02}, {1.35, 0.03}, {1.4, 0.06}});
  for (Waypoint& waypoint : path) waypoint.speed_mps = 0.5;
  const auto v = MakeReference(path, kLimits).vertices;
  for (std::size_t i = 0; i + 1 < v.size(); ++i) {
    const double drop =
        v[i].passing_mps * v[i].passing_mps - v[i + 1].passing_mps * v[i + 1].passing_mps;
    EXPECT_LE(drop, 2 * kLimits.decel_mps2 * (v[i + 1].s_m - v[i].s_m) + 1e-12);
  }
}

TEST(ReferencePath, ASpeedChangeIsAVertexThatDoesNotStop) {
  Path path = MakePath({{0, 0}, {1, 0}, {2, 0}});
  path[1].speed_mps = 0.3;
  path[2].speed_mps = 0.1;
  const auto v = MakeReference(path, kLimits).vertices;
  ASSERT_EQ(v.size(), 3u);
  EXPECT_FALSE(v[1].stop);
  EXPECT_EQ(v[0].speed_mps, 0.3);
  EXPECT_EQ(v[1].speed_mps, 0.1);
  EXPECT_NEAR(v[1].passing_mps, 0.1, 1e-12);
}

TEST(ReferencePath, OfNothingAndOfOnePoint) {
  EXPECT_TRUE(MakeReference({}, kLimits).vertices.empty());
  const auto one = MakeReference(MakePath({{1, 2}}), kLimits);
  ASSERT_EQ(one.vertices.size(), 1u);
  EXPECT_TRUE(one.vertices[0].stop);
  EXPECT_EQ(MakeReference(MakePath({{1, 2}, {1, 2}}), kLimits).vertices.size(), 1u);
}

TEST(ApproachSpeed, FallsToTheEndSpeedAndNeverAsksMoreThanTheDeceleration) {
  EXPECT_DOUBLE_EQ(ApproachSpeed(0.1, 0, kLimits), 0.1);
  EXPECT_DOUBLE_EQ(ApproachSpeed(0.1, -1, kLimits), 0.1);
  double last_mps = 0;
  for (double way_m = 0.001; way_m < 1; way_m *= 1.5) {
    const double speed_mps = ApproachSpeed(0, way_m, kLimits);
    EXPECT_GT(speed_mps, last_mps);
    EXPECT_LE(speed_mps, std::sqrt(2 * kLimits.decel_mps2 * way_m));
    EXPECT_LE(speed_mps, way_m / kLimits.lag_s);
    last_mps = speed_mps;
  }
}

}  // namespace
}  // namespace floorproof

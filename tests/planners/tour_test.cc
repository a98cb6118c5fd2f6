// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/tour.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/streams.h"
#include "tests/planners/floors.h"

namespace floorproof {
namespace {

using testing::DiscRobot;
using testing::Draw;

Floor MakeFloor(const HazardMap& map, const Vec2& start_W) {
  const RobotSpec robot = DiscRobot(0.2, 0.3);
  return CropFloor(ComputeSweepArea(map, robot.clear, robot.tool, 0.01, start_W), robot.clear,
                   robot.tool, 0.3);
}

TEST(ShortestPaths, ARouteRoundACornerIsTaut) {
  // A wall from the lower edge up to y = 2 m, 0.5 m thick.
  const HazardMap map = Draw(R"(
    ..............
    ..............
    ......#.......
    ......#.......
    ......#.......
    ......#.......)",
                             0.5);
  const Floor floor = MakeFloor(map, {1, 1});
  ShortestPaths dut(floor);
  const Vec2 a(1, 1), b(5.5, 1);
  const Polyline route = dut.Route(floor.ToCells(a), floor.ToCells(b));
  ASSERT_GE(route.size(), 3u);
  EXPECT_LE(route.size(), 8u);
  for (std::size_t i = 1; i < route.size(); ++i) EXPECT_TRUE(floor.Sees(route[i - 1], route[i]));
  // A string round two corners of radius 0.2 m: between the chords' length and a few per cent more.
  const double chords = std::hypot(2, 1) + std::hypot(2, 1) + 0.5;
  EXPECT_GT(PolylineLength(route) * 0.05, chords);
  EXPECT_LT(PolylineLength(route) * 0.05, 1.12 * chords);
  EXPECT_NEAR(dut.Distance(route.front(), route.back()), PolylineLength(route),
              0.15 * PolylineLength(route));
}

TEST(ShortestPaths, InPlainSightTheWayIsStraight) {
  const Floor floor = MakeFloor(testing::EmptyFloor(100, 100, 0.05), {1, 1});
  ShortestPaths dut(floor);
  EXPECT_EQ(dut.Route({20, 20}, {70, 35}).size(), 2u);
  EXPECT_DOUBLE_EQ(dut.Distance({20, 20}, {30, 20}), 10);
}

TEST(ShortestPaths, NearPlacesAreNearByWayNotThroughWalls) {
  const HazardMap map = Draw(R"(
    ..........
    #########.
    ..........)",
                             0.6);
  const Floor floor = MakeFloor(map, {1, 0.3});
  ShortestPaths dut(floor);
  const std::vector<Vec2> places = {floor.ToCells(Vec2(1, 0.3)), floor.ToCells(Vec2(1, 1.5)),
                                    floor.ToCells(Vec2(4, 0.3))};
  dut.IndexPlaces(places);
  ASSERT_FALSE(dut.NearestPlaces(0, 1).empty());
  EXPECT_EQ(dut.NearestPlaces(0, 1)[0].place, 2);  // 3 m off; the one across the wall is 1.2 m off
  EXPECT_EQ(dut.NearestPlaces(0, 2).size(), 2u);
}

// Places on both sides of a wall with a door, seen and hidden ones: the nearest by a search that
// stands for itself, the length of every path.
TEST(ShortestPaths, FindsTheNearestPlacesAmongMany) {
  for (const bool wall : {false, true}) {
    HazardMap map = testing::EmptyFloor(160, 160, 0.05);
    for (int iy = 0; wall && iy < 120; ++iy) map.occupancy(80, iy) = CellState::kOccupied;
    const Floor floor = MakeFloor(map, {1, 1});
    ShortestPaths dut(floor);
    Stream random(2, 0, "places");
    std::vector<Vec2> places;
    while (places.size() < 120) {
      const Cell c{static_cast<int>(random.Below(160)), static_cast<int>(random.Below(160))};
      if (floor.pose.Inside(c) && floor.pose(c)) places.push_back(Floor::CentreOf(c));
    }
    dut.IndexPlaces(places);
    constexpr std::size_t kCount = 8;
    for (int place = 0; place < 120; place += 10) {
      std::vector<double> ways;
      for (int other = 0; other < 120; ++other)
        if (other != place)
          ways.push_back(PolylineLength(dut.Route(places[Z(place)], places[Z(other)])));
      std::sort(ways.begin(), ways.end());
      const auto found = dut.NearestPlaces(place, kCount);
      ASSERT_GE(found.size(), kCount);
      // To within the coarse cells that hidden places are found over.
      for (const auto& near : found) {
        const double way = PolylineLength(dut.Route(places[Z(place)], places[Z(near.place)]));
        EXPECT_LE(way, 1.1 * ways[kCount - 1] + 4) << place << " wall " << wall;
        EXPECT_NEAR(near.distance, way, 0.1 * way + 4);
      }
    }
  }
}

double TourLength(ShortestPaths& paths, const Vec2& start, const std::vector<Polyline>& lines,
                  const std::vector<Stop>& tour) {
  double links = 0;
  Vec2 at = start;
  for (const Stop& stop : tour) {
    const Polyline& line = lines[stop.line];
    links += paths.Distance(at, stop.reversed ? line.back() : line.front());
    at = stop.reversed ? line.front() : line.back();
  }
  return links;
}

TEST(OrderLines, RowsAreDrivenBackAndForth) {
  const Floor floor = MakeFloor(testing::EmptyFloor(100, 100, 0.05), {1, 1});
  ShortestPaths paths(floor);
  std::vector<Polyline> rows;
  for (int i = 0; i < 14; ++i) rows.push_back({Vec2(8, 8 + 6.0 * i), Vec2(92, 8 + 6.0 * i)});
  Stream random(1, 0, "shuffle");
  for (std::size_t i = rows.size() - 1; i > 0; --i) std::swap(rows[i], rows[random.Below(i + 1)]);
  const Vec2 start(8, 8);
  const auto dut = OrderLines(paths, start, rows);
  ASSERT_EQ(dut.size(), rows.size());
  EXPECT_NEAR(TourLength(paths, start, rows, dut), 13 * 6, 1e-3);
}

TEST(OrderLines, EveryLineIsDrivenOnceAndFarCheaperThanAsGiven) {
  const Floor floor = MakeFloor(testing::EmptyFloor(200, 200, 0.05), {1, 1});
  ShortestPaths paths(floor);
  Stream random(2, 0, "lines");
  std::vector<Polyline> lines;
  for (int i = 0; i < 200; ++i) {
    const Vec2 p(random.Uniform(10, 190), random.Uniform(10, 190));
    lines.push_back({p, p + Vec2(random.Uniform(-5, 5), random.Uniform(-5, 5))});
  }
  const Vec2 start(100, 100);
  const auto dut = OrderLines(paths, start, lines);
  std::vector<std::size_t> driven;
  std::vector<Stop> as_given;
  for (std::size_t i = 0; i < lines.size(); ++i) as_given.push_back({i, false});
  for (const Stop& stop : dut) driven.push_back(stop.line);
  std::sort(driven.begin(), driven.end());
  for (std::size_t i = 0; i < lines.size(); ++i) ASSERT_EQ(driven[i], i);
  EXPECT_LT(TourLength(paths, start, lines, dut), 0.15 * TourLength(paths, start, lines, as_given));
  // Random points in a square of side a: a good tour is about 0.7124 sqrt(n) a (Beardwood 1959);
  // lines of 4 cells shorten the links.
  EXPECT_LT(TourLength(paths, start, lines, dut), 1.1 * 0.7124 * std::sqrt(200.0) * 180);
}

TEST(OrderLines, NothingToVisitIsNoTour) {
  const Floor floor = MakeFloor(testing::EmptyFloor(40, 40, 0.05), {1, 1});
  ShortestPaths paths(floor);
  EXPECT_TRUE(OrderLines(paths, {20, 20}, {}).empty());
  EXPECT_EQ(OrderLines(paths, {20, 20}, {{Vec2(20, 20)}}).size(), 1u);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The two path transforms: path_transform, and the FMEA paper's.
#include <gtest/gtest.h>

#include <set>

#include "base/streams.h"
#include "planners/risk/terrain_wave.h"
#include "planners/walk/transform_tour.h"
#include "tests/planners/cell_site.h"

namespace floorproof {
namespace {

using testing::Figure;
using testing::Site;

// The cells of a tour as the path's points, those on straight lines left out.
std::vector<Vec2> Corners(const std::vector<Cell>& cells, const GridFrame& frame) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool straight = i > 0 && i + 1 < cells.size() &&
                          cells[i + 1].ix - cells[i].ix == cells[i].ix - cells[i - 1].ix &&
                          cells[i + 1].iy - cells[i].iy == cells[i].iy - cells[i - 1].iy;
    if (!straight) points.push_back(frame.Center(cells[i]));
  }
  return points;
}

std::vector<Vec2> Points(const PlanResult& plan) {
  std::vector<Vec2> points;
  for (const Waypoint& waypoint : plan.path) points.push_back(waypoint.p_W);
  return points;
}

void ExpectPath(const PlanResult& plan, const std::vector<Vec2>& points) {
  ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
  EXPECT_EQ(Points(plan), points);
}

const char kHall[] = R"(
    ############
    #..........#
    #.G........#
    #.......v..#
    #....#..v..#
    #..........#
    ############)";

const char kStrips[] = R"(
    .....=...
    .....=...
    .==..=...
    .....=...)";

// Floors of 16 x 12 cells with hazards of all classes, a start and an end on free cells.
struct RandomSite {
  explicit RandomSite(Stream& random) : site(Rows(random)) {
    Grid<std::uint8_t> drivable(16, 12);
    for (std::size_t i = 0; i < drivable.cells.size(); ++i)
      drivable.cells[i] = !site.risk.grid.contents.cells[i].solid;
    const auto free = [&] {
      for (;;) {
        const Cell cell = CellAt(drivable, random.Below(drivable.cells.size()));
        if (site.risk.grid.contents(cell).free()) return cell;
      }
    };
    Grid<std::int32_t> steps;
    do {
      start = free(), end = free();
      steps = StepsFrom(drivable, start);
    } while (steps(end) < 10);
    reached = Grid<std::uint8_t>(16, 12);
    for (std::size_t i = 0; i < steps.cells.size(); ++i) reached.cells[i] = steps.cells[i] >= 0;
  }
  static std::string Rows(Stream& random) {
    std::string rows;
    for (int iy = 0; iy < 12; ++iy) {
      for (int ix = 0; ix < 16; ++ix) {
        const std::uint64_t u = random.Below(60);
        rows += u < 8 ? "####GGvv"[u] : '.';
      }
      rows += '\n';
    }
    return rows;
  }
  Site site;
  Cell start, end;
  Grid<std::uint8_t> reached;
};

// The score of a cell is the wave's, with 15 for a cell beside a solid and half for the next.
TEST(PathTransform, IsTheTourByDistanceFromTheEndAndFromObstacles) {
  Stream random(3, 0, "halls");
  int by_distance_alone = 0;
  for (int round = 0; round < 20; ++round) {
    const RandomSite floor(random);
    const Site& site = floor.site;
    const auto near_solid = [&](Cell c) {
      // From the cell's centre to the nearest solid's area, and to what lies beyond the map.
      double distance = std::min({c.ix, c.iy, 15 - c.ix, 11 - c.iy}) + 0.5;
      for (std::size_t i = 0; i < site.risk.rf.cells.size(); ++i) {
        const Cell other = CellAt(site.risk.rf, i);
        if (site.risk.grid.contents(other).solid)
          distance = std::min(distance, std::hypot(std::max(0.0, std::abs(c.ix - other.ix) - 0.5),
                                                   std::max(0.0, std::abs(c.iy - other.iy) - 0.5)));
      }
      return 15 * std::max(0.0, 1 - (distance - 0.5) / 2);
    };
    const CellTour tour = TransformTour(
        floor.reached, WaveFront(floor.reached, floor.end, near_solid), floor.start, floor.end);
    const auto plan = [&](const std::string& more) {
      return site.Plan("path_transform", floor.start, floor.end,
                       "{unreachable_share: 1" + more + "}");
    };
    ExpectPath(plan(""), Corners(tour.cells, site.risk.grid.frame));
    EXPECT_EQ(Figure(plan(""), "dead_ends"), tour.dead_ends);
    EXPECT_EQ(Figure(plan(""), "cell_m"), 0.5);
    by_distance_alone += Points(plan(", obstacle_weight: 0")) == Points(plan(""));
  }
  EXPECT_LT(by_distance_alone, 5) << "obstacles do have a say";
}

TEST(PathTransform, DrivesTerrainLikeFloor) {
  const Site site(kStrips);
  const PlanResult plan = site.Plan("path_transform", Cell{0, 0});
  const RiskOfPath measured = site.Measure(plan);
  EXPECT_EQ(measured.cells, 36) << "terrain too";
  EXPECT_EQ(measured.coverage, 1);
  EXPECT_GT(measured.terrain_crossings, 1);
}

TEST(PathTransform, CanKeepToTheCellsOfTheOther) {
  const Site site(kHall);
  const PlanResult fmea = site.Plan("fmea_path_transform", Cell{1, 1}, Cell{10, 5});
  const PlanResult dut = site.Plan("path_transform", Cell{1, 1}, Cell{10, 5}, "{cells: fmea}");
  ASSERT_EQ(dut.status, PlanStatus::kSuccess);
  const auto visited = [&](const PlanResult& plan) {
    std::set<std::size_t> cells;
    const Grid<std::int32_t> visits = site.Measure(plan).visits_of;
    for (std::size_t i = 0; i < visits.cells.size(); ++i)
      if (visits.cells[i] > 0) cells.insert(i);
    return cells;
  };
  EXPECT_EQ(visited(dut), visited(fmea));
  EXPECT_LT(visited(dut).size(), visited(site.Plan("path_transform", Cell{1, 1})).size());
}

TEST(PathTransform, CanKeepToFreeCellsAndCrossTerrainOnlyWhereItMust) {
  const Site site(kStrips);
  const PlanResult dut = site.Plan("path_transform", Cell{0, 0}, Cell{8, 0}, "{cells: free}");
  ASSERT_EQ(dut.status, PlanStatus::kSuccess);
  const RiskOfPath measured = site.Measure(dut);
  EXPECT_EQ(measured.coverage, 1);
  EXPECT_EQ(measured.cells, 36 - 6 + 1) << "of the terrain one cell, where the floor is split";
}

// Eq. 5 with K = 50 on the wave's scores of 15 and 20, RF_min and RF_max those of all cells.
TEST(FmeaPathTransform, IsTheTourByEquation5) {
  Stream random(4, 0, "halls");
  int by_distance_alone = 0, by_range_of_driven = 0;
  constexpr int kRounds = 60;
  for (int round = 0; round < kRounds; ++round) {
    const RandomSite floor(random);
    const auto& rf = floor.site.risk.rf.cells;
    const auto tour_by = [&](const auto& counts) {
      double low = 1e9, high = 0;
      for (std::size_t i = 0; i < rf.size(); ++i)
        if (counts(i)) low = std::min(low, rf[i]), high = std::max(high, rf[i]);
      Grid<double> total = WaveFront(floor.reached, floor.end);
      for (std::size_t i = 0; i < rf.size(); ++i)
        total.cells[i] -= 50 * (rf[i] - low) / (high - low);
      return TransformTour(floor.reached, total, floor.start, floor.end);
    };
    const CellTour tour = tour_by([](std::size_t) { return true; });
    const auto plan = [&](const std::string& more) {
      return floor.site.Plan("fmea_path_transform", floor.start, floor.end,
                             "{unreachable_share: 1, high_risk_share: 0" + more + "}");
    };
    ExpectPath(plan(""), Corners(tour.cells, floor.site.risk.grid.frame));
    EXPECT_EQ(Figure(plan(""), "dead_ends"), tour.dead_ends);
    by_distance_alone += Points(plan(", risk_weight: 0")) == Points(plan(""));
    const CellTour other = tour_by([&](std::size_t i) { return floor.reached.cells[i] != 0; });
    by_range_of_driven += Corners(other.cells, floor.site.risk.grid.frame) == Points(plan(""));
  }
  EXPECT_LT(by_distance_alone, kRounds / 4) << "risk does have a say";
  EXPECT_LT(by_range_of_driven, kRounds) << "so does the risk of cells that nobody drives";
}

TEST(FmeaPathTransform, VisitsAllButTheCellsOfHighRisk) {
  const Site site(kHall);
  // 50 cells within the walls: seven of the highest RF are 15 % of them, hazards included.
  std::vector<std::pair<double, std::size_t>> by_risk;
  for (std::size_t i = 0; i < site.risk.rf.cells.size(); ++i)
    if (!site.risk.grid.contents.cells[i].outer_wall())
      by_risk.push_back({site.risk.rf.cells[i], i});
  ASSERT_EQ(by_risk.size(), 50u);
  std::ranges::sort(by_risk, std::greater<>());
  ASSERT_GT(by_risk[6].first, by_risk[7].first);
  const PlanResult plan = site.Plan("fmea_path_transform", Cell{1, 1}, Cell{10, 5});
  const RiskOfPath measured = site.Measure(plan);
  for (std::size_t i = 0; i < by_risk.size(); ++i) {
    const std::size_t cell = by_risk[i].second;
    EXPECT_EQ(measured.visits_of.cells[cell] > 0,
              i >= 7 && site.risk.grid.contents.cells[cell].free())
        << cell;
  }
  EXPECT_EQ(Figure(plan, "high_risk_cells"), 7 - 2);  // the drop's two cells are of them
  EXPECT_NE(plan.message.find("left out for their risk: 5 of 46 free cells"), std::string::npos)
      << plan.message;
  EXPECT_EQ(Figure(plan, "cut_off_cells"), 0);
  EXPECT_EQ(Figure(plan, "opened_cells"), 0);
}

TEST(FmeaPathTransform, NeverEntersACellOfHighRisk) {
  const Site site(R"(
      ...............
      ..v........G...
      ..v............
      ........#......
      ........#....v.
      ...............
      ...............)");
  const PlanResult plan = site.Plan("fmea_path_transform", Cell{0, 0}, Cell{14, 0});
  ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
  std::vector<double> rf = site.risk.rf.cells;
  std::ranges::sort(rf, std::greater<>());
  const double least = rf[static_cast<std::size_t>(0.15 * 105) - 1];
  const RiskOfPath measured = site.Measure(plan);
  int high = 0;
  for (std::size_t i = 0; i < site.risk.rf.cells.size(); ++i) {
    if (site.risk.rf.cells[i] < least) continue;
    high += site.risk.grid.contents.cells[i].free();
    EXPECT_EQ(measured.visits_of.cells[i], 0) << i;
  }
  EXPECT_EQ(Figure(plan, "high_risk_cells"), high);
  EXPECT_GT(high, 5);
  const RiskOfPath all = site.Measure(site.Plan("path_transform", Cell{0, 0}, Cell{14, 0}));
  EXPECT_LT(measured.cumulative_risk, all.cumulative_risk);
  EXPECT_LT(measured.coverage, all.coverage);
}

TEST(FmeaPathTransform, CrossesAStripThatSplitsTheFloorOnce) {
  const std::string rows = R"(
      #############
      #.....=.....#
      #.....=...#.#
      #.....=.....#
      #..#..=.....#
      #.....=.....#
      #############)";
  const Site site(rows);
  const PlanResult across = site.Plan("fmea_path_transform", Cell{1, 1}, Cell{11, 5});
  const RiskOfPath once = site.Measure(across);
  EXPECT_EQ(Figure(across, "opened_cells"), 1);
  EXPECT_EQ(once.terrain_crossings, 1);
  // At the strip's cell of the least RF.
  Cell crossed, least{6, 1};
  for (int iy = 1; iy <= 5; ++iy) {
    if (once.visits_of(6, iy) > 0) crossed = {6, iy};
    if (site.risk.rf(6, iy) < site.risk.rf(least)) least = {6, iy};
  }
  EXPECT_EQ(crossed, least);
  // Start and goal on one side: there and back.
  const RiskOfPath twice = site.Measure(site.Plan("fmea_path_transform", Cell{1, 1}, Cell{5, 5}));
  EXPECT_EQ(twice.terrain_crossings, 2);
  EXPECT_GT(site.Measure(site.Plan("path_transform", Cell{1, 1}, Cell{11, 5})).terrain_crossings,
            1);
}

TEST(FmeaPathTransform, LeavesTerrainAloneThatItNeedNotCross) {
  const Site site(R"(
      ..........
      ..==......
      ..==...=..
      .......=..)");
  const PlanResult plan = site.Plan("fmea_path_transform", Cell{0, 0});
  ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
  EXPECT_EQ(site.Measure(plan).terrain_crossings, 0);
  EXPECT_EQ(Figure(plan, "opened_cells"), 0);
}

}  // namespace
}  // namespace floorproof

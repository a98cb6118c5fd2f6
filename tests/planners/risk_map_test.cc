// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/risk_map.h"

#include <gtest/gtest.h>

#include "base/streams.h"
#include "tests/planners/risk_floors.h"

namespace floorproof {
namespace {

using testing::DiscRobot;
using testing::Draw;
using testing::DrawHazards;
using testing::Mirrored;
using testing::PaperTables;

struct Source {
  int ix = 0, iy = 0;
  HazardClass hazard_class = HazardClass::kBlindObject;
};

// Eqs. 1 to 4 term by term, with the paper's indices: i hazards, j modes, k effects.
double ByEquations(const FmeaTables& t, const std::vector<Source>& hazards, int x_r, int y_r,
                   double distance_scale = 1) {
  std::array<double, 4> I_F = {};
  for (const Source& h : hazards) {
    const auto C = static_cast<std::size_t>(h.hazard_class);
    const double D = t.detectability[C];
    const double distance = std::hypot(h.ix - x_r, h.iy - y_r);
    const double I_H = 2 * D / (20 + distance_scale * distance);                // Eq. 1
    for (std::size_t j = 0; j < 4; ++j) I_F[j] += t.mode_of_class[C][j] * I_H;  // Eq. 2
  }
  double RF = 0;
  for (std::size_t k = 0; k < 5; ++k) {
    double I_E = 0;
    for (std::size_t j = 0; j < 4; ++j) I_E += t.effect_of_mode[j][k] * I_F[j];  // Eq. 3
    RF += t.severity[k] * I_E;                                                   // Eq. 4
  }
  return RF;
}

RiskMap Risk(const HazardMap& map, const RiskParams& params = {}) {
  return ComputeRisk(map, DiscRobot(0.25, 0.5), PaperTables(), params);
}
RiskMap Risk(const std::string& rows, const RiskParams& params = {}) {
  return Risk(DrawHazards(rows, 0.5), params);
}

void ExpectEqual(const RiskMap& dut, const FmeaTables& tables, const std::vector<Source>& hazards,
                 double distance_scale = 1) {
  for (int iy = 0; iy < dut.rf.height; ++iy)
    for (int ix = 0; ix < dut.rf.width; ++ix)
      ASSERT_NEAR(dut.rf(ix, iy), ByEquations(tables, hazards, ix, iy, distance_scale), 1e-9)
          << ix << ", " << iy;
}

// A floor of that size with single cells of all classes, and what they are. None stands in the
// outermost ring, and the ring is free.
struct RandomFloor {
  RandomFloor(Stream& random, int width, int height, double share) {
    std::string rows;
    for (int iy = height - 1; iy >= 0; --iy) {
      for (int ix = 0; ix < width; ++ix) {
        const bool inner = ix > 0 && iy > 0 && ix < width - 1 && iy < height - 1;
        if (!inner || random.Uniform() >= share) {
          rows += '.';
          continue;
        }
        const std::uint64_t c = random.Below(4);
        rows += "#Gv="[c];
        hazards.push_back({ix, iy, static_cast<HazardClass>(c)});
      }
      rows += '\n';
    }
    map = DrawHazards(rows, 0.5);
  }
  HazardMap map;
  std::vector<Source> hazards;
};

TEST(RiskMap, OneHazardAloneAtDistanceZeroIsThePapersNumber) {
  for (const auto& [hazard, rf] : {std::pair('#', 0.186), std::pair('G', 0.372),
                                   std::pair('v', 1.1895), std::pair('=', 0.958)}) {
    const RiskMap dut = Risk(std::string(".......\n.......\n...") + hazard + "...\n.......\n");
    EXPECT_NEAR(dut.rf(3, 1), rf, 1e-12) << hazard;
    // 2 / 20 there and 2 / (20 + d) elsewhere.
    EXPECT_NEAR(dut.rf(0, 1), rf * 20 / 23, 1e-9) << hazard;
    EXPECT_NEAR(dut.rf(6, 3), rf * 20 / (20 + std::sqrt(13.0)), 1e-9) << hazard;
  }
}

TEST(RiskMap, IsEquations1To4OnAnyFloorWithAnyTables) {
  Stream random(1, 0, "tables");
  const std::pair<int, int> sizes[] = {{3, 3}, {3, 17}, {31, 4}, {23, 23}, {40, 29}, {64, 37}};
  for (const auto& [width, height] : sizes) {
    const RandomFloor floor(random, width, height, 0.3);
    FmeaTables tables;
    for (double& d : tables.detectability) d = random.Uniform(0.5, 5);
    for (auto& row : tables.mode_of_class)
      for (double& p : row) p = random.Uniform();
    for (auto& row : tables.effect_of_mode)
      for (double& p : row) p = random.Uniform();
    for (double& s : tables.severity) s = random.Uniform(0.5, 6);
    for (const double scale : {0.0, 1.0, random.Uniform(0, 30)}) {
      RiskParams params;
      params.distance_scale = scale;
      ExpectEqual(ComputeRisk(floor.map, DiscRobot(0.25, 0.5), tables, params), tables,
                  floor.hazards, scale);
    }
  }
}

TEST(RiskMap, ASumOverHazards) {
  Stream random(2, 0, "linear");
  const RandomFloor both(random, 20, 13, 0.2);
  HazardMap parts[2] = {both.map, both.map};
  for (HazardMap& part : parts) part.hazards.clear();
  for (std::size_t i = 0; i < both.map.hazards.size(); ++i)
    parts[i % 2].hazards.push_back(both.map.hazards[i]);
  std::ranges::fill(parts[1].occupancy.cells, CellState::kFree);
  const RiskMap dut = Risk(both.map), a = Risk(parts[0]), b = Risk(parts[1]);
  for (std::size_t i = 0; i < dut.rf.cells.size(); ++i)
    ASSERT_NEAR(dut.rf.cells[i], a.rf.cells[i] + b.rf.cells[i], 2e-9) << i;
}

TEST(RiskMap, DistanceScaleSaysHowSoonRiskFalls) {
  const auto at = [](double scale) {
    RiskParams params;
    params.distance_scale = scale;
    return Risk("...........\n.....v.....\n...........\n", params);
  };
  const RiskMap flat = at(0), paper = at(1), steep = at(20);
  for (const double rf : flat.rf.cells) EXPECT_NEAR(rf, 1.1895, 1e-9);
  EXPECT_NEAR(paper.rf(0, 1), 1.1895 * 20 / 25, 1e-9);
  EXPECT_NEAR(steep.rf(0, 1), 1.1895 * 20 / 120, 1e-9);
  for (const RiskMap* risk : {&paper, &steep})
    for (int ix = 0; ix < 5; ++ix) {
      EXPECT_LT(risk->rf(ix, 1), risk->rf(ix + 1, 1));
      EXPECT_EQ(risk->rf(ix, 1), risk->rf(10 - ix, 1)) << "places that are alike, to the bit";
    }
}

TEST(RiskMap, WhatIsAlikeHasTheSameRiskToTheBit) {
  const RiskMap dut = Risk(R"(
      .........
      .#..v..#.
      ..G...G..
      .........
      .v..=..v.
      .........
      ..G...G..
      .#..v..#.
      .........)");
  for (int iy = 0; iy < 9; ++iy)
    for (int ix = 0; ix < 9; ++ix) {
      EXPECT_EQ(dut.rf(ix, iy), dut.rf(8 - ix, iy));
      EXPECT_EQ(dut.rf(ix, iy), dut.rf(ix, 8 - iy));
      EXPECT_EQ(dut.rf(ix, iy), dut.rf(iy, ix));
    }
}

// Hazards but for the walls of the ring: none of them counts unless asked for.
const char kWalled[] = R"(
    #######
    #..G..#
    #..#..#
    #.....#
    #######)";

TEST(RiskMap, OuterWallsCountOnlyWhenAskedFor) {
  const std::vector<Source> inner = {{3, 3, HazardClass::kGlass},
                                     {3, 2, HazardClass::kBlindObject}};
  ExpectEqual(Risk(kWalled), PaperTables(), inner);
  std::vector<Source> all = inner;
  for (int iy = 0; iy < 5; ++iy)
    for (int ix = 0; ix < 7; ++ix)
      if (ix == 0 || iy == 0 || ix == 6 || iy == 4)
        all.push_back({ix, iy, HazardClass::kBlindObject});
  ASSERT_EQ(all.size(), 22u);
  RiskParams params;
  params.walls_are_hazards = true;
  ExpectEqual(Risk(kWalled, params), PaperTables(), all);
}

TEST(RiskMap, AroundAnOpenBorderStandsARingOfWalls) {
  const std::string rows = "...#\n....\n.G..\n";
  const std::vector<Source> inner = {{3, 2, HazardClass::kBlindObject},
                                     {1, 0, HazardClass::kGlass}};
  ExpectEqual(Risk(rows), PaperTables(), inner);
  std::vector<Source> all = inner;
  for (int iy = -1; iy <= 3; ++iy)
    for (int ix = -1; ix <= 4; ++ix)
      if (ix < 0 || iy < 0 || ix > 3 || iy > 2) all.push_back({ix, iy, HazardClass::kBlindObject});
  ASSERT_EQ(all.size(), 2u + 2 * (4 + 3) + 4);
  RiskParams params;
  params.walls_are_hazards = true;
  params.distance_scale = 3;
  ExpectEqual(Risk(rows, params), PaperTables(), all, 3);
}

TEST(RiskMap, ADoorwayInTheBorderMakesItsWallsHazards) {
  std::string rows = kWalled;
  rows[rows.rfind("#.....#")] = '.';  // in the left wall
  std::vector<Source> hazards = {{3, 3, HazardClass::kGlass}, {3, 2, HazardClass::kBlindObject}};
  for (int iy = 0; iy < 5; ++iy)
    for (int ix = 0; ix < 7; ++ix)
      if ((ix == 0 || iy == 0 || ix == 6 || iy == 4) && !(ix == 0 && iy == 1))
        hazards.push_back({ix, iy, HazardClass::kBlindObject});
  ASSERT_EQ(hazards.size(), 21u);
  ExpectEqual(Risk(rows), PaperTables(), hazards);
}

TEST(RiskMap, TurnsAndMirrorsWithTheFloor) {
  Stream random(3, 0, "turned");
  const RandomFloor floor(random, 19, 11, 0.2);
  const RiskMap dut = Risk(floor.map);
  for (const Pose2& X_WN : {Pose2{4, -7, 0.6}, Pose2{-3, 2, -2.9}, Pose2{0, 0, kPi / 2}}) {
    HazardMap turned = floor.map;
    turned.frame.X_WG = X_WN * floor.map.frame.X_WG;
    for (Hazard& hazard : turned.hazards)
      for (Vec2& p : hazard.footprint[0]) p = X_WN * p;
    const RiskMap there = Risk(turned);
    EXPECT_EQ(there.rf.cells, dut.rf.cells);
    EXPECT_LT((there.grid.frame.Center(7, 3) - X_WN * dut.grid.frame.Center(7, 3)).norm(), 1e-9);
  }
  HazardMap mirrored = Mirrored(floor.map);
  for (Hazard& hazard : mirrored.hazards) {
    for (Vec2& p : hazard.footprint[0]) p.x() = 19 * 0.5 - p.x();
    std::ranges::reverse(hazard.footprint[0]);
  }
  const RiskMap there = Risk(mirrored);
  for (int iy = 0; iy < 11; ++iy)
    for (int ix = 0; ix < 19; ++ix) EXPECT_EQ(there.rf(18 - ix, iy), dut.rf(ix, iy));
}

TEST(RiskMap, OneCellIsAFloorToo) {
  RiskParams walls;
  walls.walls_are_hazards = true;
  EXPECT_EQ(Risk(".").rf.cells, std::vector<double>{0});
  EXPECT_NEAR(Risk(".", walls).rf(0, 0), 1.86 * 2 * (4 / 21.0 + 4 / (20 + std::sqrt(2.0))), 1e-9);
  EXPECT_EQ(Risk("#").rf.cells, std::vector<double>{0});  // all of it is outer wall
  EXPECT_NEAR(Risk("#", walls).rf(0, 0), 0.186, 1e-9);
  EXPECT_NEAR(Risk("=").rf(0, 0), 0.958, 1e-9);
  ExpectEqual(Risk("..v.."), PaperTables(), {{2, 0, HazardClass::kLevelChange}});
  ExpectEqual(Risk(".\nG\n.\n"), PaperTables(), {{0, 1, HazardClass::kGlass}});
}

TEST(RiskMap, AMillionCellsWithTenThousandHazards) {
  Stream random(4, 0, "large");
  HazardMap map = testing::EmptyFloor(1000, 1000, 0.5);
  std::vector<Source> hazards;
  Grid<std::uint8_t> taken(1000, 1000);
  while (hazards.size() < 10'000) {
    const Source h{static_cast<int>(random.Below(1000)), static_cast<int>(random.Below(1000)),
                   static_cast<HazardClass>(random.Below(4))};
    if (taken(h.ix, h.iy)++) continue;
    hazards.push_back(h);
    if (h.hazard_class == HazardClass::kBlindObject) {
      map.occupancy(h.ix, h.iy) = CellState::kOccupied;
      continue;
    }
    Hazard& hazard = map.hazards.emplace_back();
    hazard.hazard_class = h.hazard_class;
    hazard.footprint = {
        Rectangle(Vec2(h.ix * 0.5, h.iy * 0.5), Vec2(h.ix * 0.5 + 0.5, h.iy * 0.5 + 0.5))};
  }
  const RiskMap dut = Risk(map);
  for (int i = 0; i < 30; ++i) {
    const int ix = i == 0 ? 0 : i == 1 ? 999 : static_cast<int>(random.Below(1000));
    const int iy = i == 0 ? 0 : i == 1 ? 999 : static_cast<int>(random.Below(1000));
    ASSERT_NEAR(dut.rf(ix, iy), ByEquations(PaperTables(), hazards, ix, iy), 1e-9);
  }
}

}  // namespace
}  // namespace floorproof

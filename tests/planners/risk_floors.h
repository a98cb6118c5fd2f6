// SPDX-License-Identifier: Apache-2.0
// Floors with hazards drawn in characters, and the FMEA paper's tables, for tests of risk.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "planners/risk/risk_meter.h"
#include "planners/search/grid_paths.h"
#include "tests/planners/floors.h"

namespace floorproof::testing {

// Tables 1 to 3 of the FMEA paper, typed from it (models/fmea/htetro.yaml must agree:
// tests/run/fmea_file_test.cc).
inline FmeaTables PaperTables() {
  FmeaTables tables;
  tables.detectability = {1, 2, 3, 4};
  tables.mode_of_class = {{{0.1, 0.2, 0, 0.7}, {0.1, 0.2, 0, 0.7}, {0, 0.1, 0.8, 0.1}, {0.3, 0.7}}};
  tables.effect_of_mode = {{{0.75, 0.1, 0.1, 0.05, 0},
                            {0.1, 0, 0.9, 0, 0},
                            {0, 0, 0.3, 0, 0.7},
                            {0.55, 0.3, 0.1, 0.05, 0}}};
  tables.severity = {1, 2, 3, 4, 5};
  return tables;
}

// Draw() with a hazard of a whole cell for each 'G' (glass), 'v' (level change) and '='
// (terrain).
inline HazardMap DrawHazards(const std::string& text, double cell_m, const Pose2& X_WG = {}) {
  HazardMap map = Draw(text, cell_m, X_WG);
  std::istringstream in(text);
  std::vector<std::string> rows;
  for (std::string row; in >> row;) rows.push_back(row);
  for (int iy = 0; iy < map.frame.height; ++iy)
    for (int ix = 0; ix < map.frame.width; ++ix) {
      Hazard hazard;
      switch (
          rows[static_cast<std::size_t>(map.frame.height - 1 - iy)][static_cast<std::size_t>(ix)]) {
        case 'G':
          hazard.hazard_class = HazardClass::kGlass;
          break;
        case 'v':
          hazard.hazard_class = HazardClass::kLevelChange;
          hazard.height_m = -0.2;
          break;
        case '=':
          hazard.hazard_class = HazardClass::kTerrain;
          break;
        default:
          continue;
      }
      for (const Vec2& corner : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
        if (hazard.footprint.empty()) hazard.footprint.emplace_back();
        hazard.footprint[0].push_back(X_WG * Vec2(cell_m * (Vec2(ix, iy) + corner)));
      }
      map.hazards.push_back(std::move(hazard));
    }
  return map;
}

// A square robot that moves every way, as hTetro in its shape O.
inline RobotSpec SquareRobot(double side_m) {
  RobotSpec robot = DiscRobot(side_m / 2, side_m);
  robot.name = "square";
  robot.clear.kind = robot.tool.kind = Shape2::Kind::kFootprint;
  robot.wheels.emplace_back();
  robot.wheels.back().roller_angle_rad = kPi / 4;  // it drives every way
  robot.clear.footprint_B = robot.tool.footprint_B =
      Rectangle(Vec2(-side_m / 2, -side_m / 2), Vec2(side_m / 2, side_m / 2));
  robot.circumscribed_radius_m = side_m / std::sqrt(2.0);
  return robot;
}

// Cells by what they hold, the top row first: '.' free, 'W' outer wall, '#' C1, 'G' C2, 'v' C3, '='
// C4; 'T' what is solid, though its hazard is terrain.
inline std::string Text(const RiskGrid& grid) {
  std::string text;
  for (int iy = grid.contents.height - 1; iy >= 0; --iy) {
    for (int ix = 0; ix < grid.contents.width; ++ix) {
      const RiskCell& cell = grid.contents(ix, iy);
      if (!cell.hazard) {
        text += cell.solid ? 'W' : '.';
      } else {
        const char c = "#Gv="[static_cast<std::size_t>(*cell.hazard)];
        text += c == '=' && cell.solid ? 'T' : c;
      }
    }
    text += '\n';
  }
  return text;
}

// A grid from numbers or characters written the top row first, words apart.
template <class T>
Grid<T> Rows(const std::vector<std::vector<T>>& rows) {
  Grid<T> grid(static_cast<int>(rows.front().size()), static_cast<int>(rows.size()));
  for (int iy = 0; iy < grid.height; ++iy)
    for (int ix = 0; ix < grid.width; ++ix)
      grid(ix, iy) =
          rows[static_cast<std::size_t>(grid.height - 1 - iy)][static_cast<std::size_t>(ix)];
  return grid;
}

// 1 where the drawing has '.'.
inline Grid<std::uint8_t> OpenCells(const std::string& text) {
  const HazardMap map = Draw(text, 1);
  Grid<std::uint8_t> open(map.occupancy.width, map.occupancy.height);
  for (std::size_t i = 0; i < open.cells.size(); ++i)
    open.cells[i] = map.occupancy.cells[i] == CellState::kFree;
  return open;
}

// A risk map whose cells are those of the drawing, 1 m wide, with these RF.
inline RiskMap DrawRisk(const std::string& text, const std::function<double(Cell)>& rf = nullptr) {
  RiskMap risk = ComputeRisk(DrawHazards(text, 1), DiscRobot(0.5, 1), PaperTables());
  if (rf)
    for (std::size_t i = 0; i < risk.rf.cells.size(); ++i)
      risk.rf.cells[i] = rf(CellAt(risk.rf, i));
  return risk;
}

inline Path PathOf(const std::vector<Vec2>& points) {
  Path path;
  for (const Vec2& p : points) path.emplace_back().p_W = p;
  return path;
}

// Each cell of the way is open and a neighbour of the last.
inline void ExpectWay(const Grid<std::uint8_t>& open, const std::vector<Cell>& way) {
  for (std::size_t i = 0; i < way.size(); ++i) {
    ASSERT_TRUE(open.Inside(way[i]) && open(way[i])) << i << ": " << way[i].ix << ", " << way[i].iy;
    if (i == 0) continue;
    ASSERT_EQ(std::abs(way[i].ix - way[i - 1].ix) + std::abs(way[i].iy - way[i - 1].iy), 1) << i;
  }
}

}  // namespace floorproof::testing

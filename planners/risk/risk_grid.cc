// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/risk_grid.h"

#include <algorithm>
#include <cmath>

#include "env/core/coverage.h"
#include "env/geometry/box.h"
#include "env/geometry/rasterise.h"

namespace floorproof {
namespace {

constexpr double kSame_m = 1e-3;  // lengths that are written the same may differ by so much

// Where the lattice lies on the map's cells, whole or cut: cell (0, 0) begins at (x0, y0) of them,
// never above 0, and is `side` of them wide.
struct Lattice {
  GridFrame fine;
  int side = 1, x0 = 0, y0 = 0;
  int width() const { return (fine.width - x0 + side - 1) / side; }
  int height() const { return (fine.height - y0 + side - 1) / side; }
};

// Number of wall cells below and left of each corner.
Grid<std::int32_t> WallSums(const HazardMap& map, const GridFrame& fine) {
  const int cut = fine.width / map.frame.width;
  Grid<std::int32_t> sums(fine.width + 1, fine.height + 1);
  for (int iy = 0; iy < fine.height; ++iy) {
    std::int32_t row = 0;
    for (int ix = 0; ix < fine.width; ++ix) {
      row += map.IsWall(ix / cut, iy / cut);
      sums(ix + 1, iy + 1) = sums(ix + 1, iy) + row;
    }
  }
  return sums;
}

// Cells of the lattice within the map and without a wall.
std::int64_t CountFree(const Grid<std::int32_t>& sums, const Lattice& at) {
  std::int64_t free = 0;
  const int s = at.side;
  for (int y = at.y0 < 0 ? at.y0 + s : 0; y + s < sums.height; y += s)
    for (int x = at.x0 < 0 ? at.x0 + s : 0; x + s < sums.width; x += s)
      free += sums(x + s, y + s) - sums(x, y + s) - sums(x + s, y) + sums(x, y) == 0;
  return free;
}

Lattice Lay(const HazardMap& map, double width_m) {
  Lattice lattice;
  const double cell_m = map.frame.cell_m;
  if (cell_m >= width_m - kSame_m) {
    lattice.fine = map.frame.Subdivided(static_cast<int>((cell_m + kSame_m) / width_m));
    return lattice;
  }
  lattice.fine = FineFrame(map.frame);
  lattice.side = static_cast<int>(std::ceil((width_m - kSame_m) / lattice.fine.cell_m));
  const Grid<std::int32_t> sums = WallSums(map, lattice.fine);
  Lattice best = lattice;
  std::int64_t most = CountFree(sums, best);
  for (int x = 0; x < lattice.side; ++x)
    for (int y = 0; y < lattice.side; ++y) {
      lattice.x0 = x == 0 ? 0 : x - lattice.side;
      lattice.y0 = y == 0 ? 0 : y - lattice.side;
      const std::int64_t free = CountFree(sums, lattice);
      if (free > most) most = free, best = lattice;
    }
  return best;
}

void AddHazard(HazardClass hazard_class, const FmeaTables& tables, RiskCell& cell) {
  if (hazard_class != HazardClass::kTerrain) cell.solid = true;
  if (!cell.hazard || tables.Weight(*cell.hazard) < tables.Weight(hazard_class))
    cell.hazard = hazard_class;
}

}  // namespace

double LeastCellWidth(const RobotSpec& robot) {
  if (robot.clear.kind == Shape2::Kind::kCircle) return 2 * robot.clear.radius_m;
  const auto [low, high] = BoxAround(robot.clear.footprint_B);
  return 2 * std::max({high.x(), high.y(), -low.x(), -low.y()});
}

RiskGrid MakeRiskGrid(const HazardMap& map, const RobotSpec& robot, const FmeaTables& tables,
                      std::optional<double> cell_m) {
  const Lattice at = Lay(map, cell_m.value_or(LeastCellWidth(robot)));
  RiskGrid grid;
  const double fine_m = at.fine.cell_m, width_m = at.side * fine_m;
  const Vec2 origin_W = map.frame.X_WG * Vec2(at.x0 * fine_m, at.y0 * fine_m);
  grid.frame = {
      at.width(), at.height(), width_m, {origin_W.x(), origin_W.y(), map.frame.X_WG.yaw_rad}};
  grid.contents = Grid<RiskCell>(grid.frame.width, grid.frame.height);

  // What is occupied, and what is no floor for another reason.
  const int cut = at.fine.width / map.frame.width;
  Grid<std::uint8_t> occupied(grid.frame.width, grid.frame.height);
  Grid<std::uint8_t> all_wall(grid.frame.width, grid.frame.height);
  for (int iy = 0; iy < grid.frame.height; ++iy)
    for (int ix = 0; ix < grid.frame.width; ++ix) {
      const int left = at.x0 + ix * at.side, low = at.y0 + iy * at.side;
      const bool beyond =
          left < 0 || low < 0 || left + at.side > at.fine.width || low + at.side > at.fine.height;
      bool wall = beyond, all = true;
      for (int y = std::max(low, 0); y < std::min(low + at.side, at.fine.height); ++y)
        for (int x = std::max(left, 0); x < std::min(left + at.side, at.fine.width); ++x) {
          const CellState state = map.occupancy(x / cut, y / cut);
          occupied(ix, iy) |= state == CellState::kOccupied;
          const bool here = map.IsWall(x / cut, y / cut);
          wall |= here;
          all &= here;
        }
      grid.contents(ix, iy).solid = wall;
      all_wall(ix, iy) = all;
    }

  const int right = grid.frame.width - 1, top = grid.frame.height - 1;
  const auto in_ring = [&](int ix, int iy) {
    return ix == 0 || iy == 0 || ix == right || iy == top;
  };
  grid.walled_all_round = true;
  for (int iy = 0; iy <= top; ++iy)
    for (int ix = 0; ix <= right; ++ix)
      if (in_ring(ix, iy) && !grid.contents(ix, iy).solid) grid.walled_all_round = false;
  for (int iy = 0; iy <= top; ++iy)
    for (int ix = 0; ix <= right; ++ix)
      if (occupied(ix, iy) && !(grid.walled_all_round && in_ring(ix, iy)))
        AddHazard(HazardClass::kBlindObject, tables, grid.contents(ix, iy));

  const Pose2 X_GW = grid.frame.X_WG.Inverse();
  for (const Hazard& hazard : map.hazards)
    for (const Polygon& footprint : hazard.footprint) {
      Polygon p_G;
      for (const Vec2& p_W : footprint) p_G.push_back(X_GW * p_W / width_m);
      const bool of_floor = hazard.hazard_class == HazardClass::kTerrain ||
                            hazard.hazard_class == HazardClass::kLevelChange;
      Rasterise(p_G, grid.frame.width, grid.frame.height, [&](int ix, int iy) {
        if (of_floor && all_wall(ix, iy)) return;  // a strip that ends in it
        RiskCell& cell = grid.contents(ix, iy);
        AddHazard(hazard.hazard_class, tables, cell);
        cell.solid = cell.solid || hazard.crossable == false;
      });
    }
  return grid;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/map_along_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "env/core/coverage.h"
#include "env/geometry/distance.h"
#include "env/geometry/rasterise.h"
#include "planners/lines/wall_directions.h"

namespace floorproof {
namespace {

constexpr double kAlong_rad = 3 * kPi / 180;  // rows cross few steps at smaller angles
constexpr double kMaxCells = 1e7;             // a plan takes some 50 bytes a cell

// The box around all that is no wall, in axes turned by this much from the grid's, m.
std::pair<Vec2, Vec2> TurnedBox(const Grid<std::uint8_t>& wall, double cell_m, double turn_rad) {
  const Pose2 X_TG = Pose2{0, 0, turn_rad}.Inverse();
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (int iy = 0; iy < wall.height; ++iy)
    for (int ix = 0; ix < wall.width; ++ix) {
      if (wall(ix, iy)) continue;
      const Vec2 p_T = X_TG * Vec2(Vec2(ix + 0.5, iy + 0.5) * cell_m);
      low = low.cwiseMin(p_T);
      high = high.cwiseMax(p_T);
    }
  return {low.array() - cell_m, high.array() + cell_m};
}

// The largest cells up to this size that the footprint's farthest side fills to their edges: a
// footprint is taken to fill every cell that it overlaps.
double FittingCell(const Shape2& footprint, double max_m) {
  constexpr double kEps_m = 1e-4, kEps = 1e-2;
  double reach_m = kEps_m;
  for (const Vec2& p : footprint.footprint_B)
    reach_m = std::max(reach_m, p.cwiseAbs().maxCoeff() + kEps_m);
  return reach_m / (std::max(0.0, std::ceil(reach_m / max_m - 0.5 - kEps)) + 0.5);
}

// Small cells lose less floor along walls that the map's cells make stairs of.
std::optional<GridFrame> FrameFor(const Shape2& footprint, const GridFrame& fine,
                                  const Grid<std::uint8_t>& wall, double turn_rad) {
  const auto [low, high] = TurnedBox(wall, fine.cell_m, turn_rad);
  const Vec2 size_m = high - low, origin_G = Pose2{0, 0, turn_rad} * low;
  for (const double share : {0.4, 0.95}) {
    const double cell_m = FittingCell(footprint, share * fine.cell_m);
    const Vec2 cells = (size_m / cell_m).array().ceil();
    if (cells.x() * cells.y() <= kMaxCells)
      return GridFrame{static_cast<int>(cells.x()), static_cast<int>(cells.y()), cell_m,
                       fine.X_WG * Pose2{origin_G.x(), origin_G.y(), turn_rad}};
  }
  return {};
}

}  // namespace

std::optional<HazardMap> MapAlongWalls(const HazardMap& map, const Shape2& footprint) {
  const GridFrame fine = FineFrame(map.frame);
  const Grid<std::uint8_t> wall = WallMask(map, fine);
  const double turn_rad = MainWallDirection(wall);
  if (std::abs(turn_rad) < kAlong_rad) return {};
  const std::optional<GridFrame> turned = FrameFor(footprint, fine, wall, turn_rad);
  if (!turned) return {};

  const GridFrame& frame = *turned;
  HazardMap out = map;
  out.frame = frame;
  out.occupancy = Grid<CellState>(frame.width, frame.height, CellState::kOccupied);
  const Grid<float> to_wall = DistanceToSet(wall, true);
  constexpr float kFar = 1.5f;  // cells, between centres: more than two halves of a diagonal
  const Pose2 X_GT = fine.X_WG.Inverse() * frame.X_WG;
  const auto to_map = [&](const Vec2& p) -> Vec2 {  // both in cells
    return X_GT * Vec2(p * frame.cell_m) / fine.cell_m;
  };
  for (int iy = 0; iy < frame.height; ++iy)
    for (int ix = 0; ix < frame.width; ++ix) {
      const Vec2 centre = to_map({ix + 0.5, iy + 0.5});
      const Cell at{static_cast<int>(std::floor(centre.x())),
                    static_cast<int>(std::floor(centre.y()))};
      if (!wall.Inside(at) || wall(at)) continue;
      bool is_free = true;
      if (to_wall(at) <= kFar) {
        Polygon square;
        for (const Vec2& p : Rectangle(Vec2(ix, iy), Vec2(ix + 1, iy + 1))) {
          square.push_back(to_map(p));
          is_free = is_free && square.back().minCoeff() >= 0 && square.back().x() <= wall.width &&
                    square.back().y() <= wall.height;
        }
        Rasterise(square, wall.width, wall.height,
                  [&](int x, int y) { is_free = is_free && !wall(x, y); });
      }
      if (is_free) out.occupancy(ix, iy) = CellState::kFree;
    }
  return out;
}

}  // namespace floorproof

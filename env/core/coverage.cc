// SPDX-License-Identifier: Apache-2.0
// From a floor to what can be swept of it: obstacle cells -> distances -> poses that are clear and
// connected to the start -> cells that the tool reaches from them.
//
// Everything happens on one grid of fine cells, so clear and swept are exact at cell centres and
// uncertain by half a cell between them. A disc that is wider than the clear shape does not sweep
// what an obstacle separates from its centre.
#include "env/core/coverage.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "env/core/clear_cell.h"
#include "env/geometry/distance.h"
#include "env/geometry/rasterise.h"

namespace floorproof {
namespace {

constexpr double kEps = 1e-6;  // of a cell: borders that coincide do not touch

Vec2 ToCells(const GridFrame& frame, const Vec2& p_W) { return frame.ToGrid(p_W) / frame.cell_m; }

// Adds what robots must keep off. A level change is none where a later one that can be driven
// covers it. Terrain lies on it, and takes nothing away.
bool AddHazards(const HazardMap& map, double step_m, const GridFrame& fine,
                Grid<std::uint8_t>& mask) {
  constexpr std::uint8_t kFloor = 2, kSolid = 1;
  Grid<std::uint8_t> layer(fine.width, fine.height);
  bool any = false;
  for (const Hazard& hazard : map.hazards) {
    const bool obstacle = IsObstacle(hazard, step_m);
    if (!obstacle && !any) continue;
    any = true;
    const bool is_floor = hazard.hazard_class == HazardClass::kLevelChange;
    for (const Polygon& footprint : hazard.footprint) {
      Polygon p_G;
      for (const Vec2& p_W : footprint) p_G.push_back(ToCells(fine, p_W));
      if (obstacle) {
        Rasterise(p_G, fine.width, fine.height, [&](int ix, int iy) {
          if (layer(ix, iy) != kSolid) layer(ix, iy) = is_floor ? kFloor : kSolid;
        });
      } else if (is_floor) {  // only cells that lie in it as a whole
        const auto inside = [&](double x, double y) {
          return Contains(p_G, Vec2(x, y)) || std::abs(SignedDistance(p_G, Vec2(x, y))) < kEps;
        };
        Rasterise(p_G, fine.width, fine.height, [&](int ix, int iy) {
          if (layer(ix, iy) == kFloor && inside(ix, iy) && inside(ix + 1, iy) &&
              inside(ix, iy + 1) && inside(ix + 1, iy + 1))
            layer(ix, iy) = 0;
        });
      }
    }
  }
  if (any)
    for (std::size_t i = 0; i < mask.cells.size(); ++i)
      mask.cells[i] |= static_cast<std::uint8_t>(layer.cells[i] != 0);
  return any;
}

// A cell of a layer of cells.
struct LayerCell {
  Cell cell;
  std::size_t layer;
};

// The cells of `free` that the seeds are connected to, one layer each: cells of a layer with their
// 4 neighbours, or with 8, and layers with one another in each cell. Found run by run of free cells
// in a row.
std::vector<Grid<std::uint8_t>> Connected(const std::vector<Grid<std::uint8_t>>& free,
                                          std::vector<LayerCell> seeds, bool diagonal) {
  std::vector<Grid<std::uint8_t>> out(free.size());
  for (auto& layer : out) layer = Grid<std::uint8_t>(free[0].width, free[0].height);
  std::vector<LayerCell>& stack = seeds;  // a cell of each run that is to be filled
  while (!stack.empty()) {
    const auto [c, layer] = stack.back();
    stack.pop_back();
    const Grid<std::uint8_t>& clear = free[layer];
    if (out[layer](c)) continue;
    int first = c.ix, last = c.ix;
    while (first > 0 && clear(first - 1, c.iy)) --first;
    while (last + 1 < clear.width && clear(last + 1, c.iy)) ++last;
    std::fill_n(out[layer].cells.begin() + static_cast<std::ptrdiff_t>(clear.Index(first, c.iy)),
                last - first + 1, std::uint8_t{1});
    const auto reach = [&](std::size_t to, int iy, int beside) {
      if (iy < 0 || iy >= clear.height) return;
      const int end = std::min(clear.width - 1, last + beside);
      for (int ix = std::max(0, first - beside); ix <= end; ++ix) {
        if (!free[to](ix, iy)) continue;
        if (!out[to](ix, iy)) stack.push_back({{ix, iy}, to});
        while (ix < end && free[to](ix + 1, iy)) ++ix;
      }
    };
    for (const int iy : {c.iy - 1, c.iy + 1}) reach(layer, iy, diagonal);
    for (std::size_t other = 0; other < free.size(); ++other)
      if (other != layer) reach(other, c.iy, 0);
  }
  return out;
}

// Set cells before ix in each row, for ix in 0 .. width.
Grid<int> RowSums(const Grid<std::uint8_t>& mask) {
  Grid<int> sums(mask.width + 1, mask.height);
  for (int iy = 0; iy < mask.height; ++iy)
    for (int ix = 0; ix < mask.width; ++ix)
      sums(ix + 1, iy) = sums(ix, iy) + (mask(ix, iy) ? 1 : 0);
  return sums;
}

bool Fits(const Stencil& stencil, const Grid<int>& sums, int ix, int iy) {
  for (const Stencil::Span& s : stencil.spans) {
    const int y = iy + s.iy, x0 = ix + s.x0, x1 = ix + s.x1;
    if (y < 0 || y >= sums.height || x0 < 0 || x1 + 1 >= sums.width) return false;
    if (sums(x1 + 1, y) != sums(x0, y)) return false;
  }
  return true;
}

// Where the footprint is free: one layer of cells per yaw, the first `turns` multiples of 90 deg.
std::vector<Grid<std::uint8_t>> FreeOfFootprint(const Shape2& clear,
                                                const Grid<std::uint8_t>& walls,
                                                const Grid<std::uint8_t>* hazards,
                                                const Grid<float>& clearance_m, double cell_m,
                                                double inset_m, int turns) {
  const Grid<int> wall_sums = RowSums(walls);
  const Grid<int> hazard_sums = hazards ? RowSums(*hazards) : Grid<int>();
  // With so much room a footprint touches nothing at any yaw: most of a large floor needs no look.
  double reach_m = 0;
  for (const Vec2& p : clear.footprint_B) reach_m = std::max(reach_m, p.norm());
  const auto plenty_m = static_cast<float>(reach_m + inset_m + 2 * cell_m);
  std::vector<Grid<std::uint8_t>> free(static_cast<std::size_t>(turns));
  for (int k = 0; k < turns; ++k) {
    const Stencil built = MakeStencil(clear.footprint_B, cell_m, k, inset_m, StencilOf::kTouched);
    const Stencil whole = MakeStencil(clear.footprint_B, cell_m, k, 0, StencilOf::kTouched);
    auto& layer = free[static_cast<std::size_t>(k)];
    layer = Grid<std::uint8_t>(walls.width, walls.height);
    for (int iy = 0; iy < walls.height; ++iy)
      for (int ix = 0; ix < walls.width; ++ix)
        layer(ix, iy) =
            clearance_m(ix, iy) > plenty_m || (!walls(ix, iy) && Fits(built, wall_sums, ix, iy) &&
                                               (!hazards || Fits(whole, hazard_sums, ix, iy)));
  }
  return free;
}

// Marks what the tool touches when it stands on the set cells at a multiple of 90 deg.
void DilateFootprint(const Grid<std::uint8_t>& set, const Shape2& tool, double cell_m, int yaw,
                     Grid<std::uint8_t>& out) {
  const Stencil stencil = MakeStencil(tool.footprint_B, cell_m, yaw, 0, StencilOf::kCentres);
  Grid<int> edges(set.width + 1, set.height);  // +1 where a swept span begins, -1 behind its end
  for (int iy = 0; iy < set.height; ++iy)
    for (int begin = 0, end; begin < set.width; begin = end) {
      end = begin + 1;
      if (!set(begin, iy)) continue;
      while (end < set.width && set(end, iy)) ++end;
      for (const Stencil::Span& s : stencil.spans) {
        const int y = iy + s.iy, x0 = begin + s.x0, x1 = end - 1 + s.x1;
        if (y < 0 || y >= set.height || x1 < 0 || x0 >= set.width) continue;
        ++edges(std::max(0, x0), y);
        --edges(std::min(set.width, x1 + 1), y);
      }
    }
  for (int iy = 0; iy < set.height; ++iy)
    for (int ix = 0, depth = 0; ix < set.width; ++ix) {
      depth += edges(ix, iy);
      if (depth > 0) out(ix, iy) = 1;
    }
}

int Turns(Yaws yaws) { return yaws == Yaws::kFirst ? 1 : 4; }

}  // namespace

GridFrame FineFrame(const GridFrame& frame, double max_cell_m) {
  const int k = static_cast<int>(std::ceil(frame.cell_m / max_cell_m - 1e-9));
  return frame.Subdivided(std::max(1, k));
}

Grid<std::uint8_t> WallMask(const HazardMap& map, const GridFrame& fine) {
  Grid<std::uint8_t> mask(fine.width, fine.height);
  const double ratio = fine.cell_m / map.frame.cell_m;
  const auto coarse = [ratio](int i) { return static_cast<int>(std::floor((i + 0.5) * ratio)); };
  std::vector<int> column(static_cast<std::size_t>(fine.width));
  for (int ix = 0; ix < fine.width; ++ix) column[static_cast<std::size_t>(ix)] = coarse(ix);
  for (int iy = 0; iy < fine.height; ++iy) {
    const int cy = coarse(iy);
    std::uint8_t* out = &mask.cells[mask.Index(0, iy)];
    for (std::size_t ix = 0; ix < column.size(); ++ix) out[ix] = map.IsWall(column[ix], cy);
  }
  return mask;
}

Grid<std::uint8_t> ObstacleMask(const HazardMap& map, double step_m, const GridFrame& fine) {
  Grid<std::uint8_t> mask = WallMask(map, fine);
  AddHazards(map, step_m, fine, mask);
  return mask;
}

double ClearanceField::At(const Vec2& p_W) const {
  const Cell c = frame.ToCell(p_W);
  return frame.Inside(c) ? static_cast<double>(distance_m(c)) : 0.0;
}

ClearanceField ComputeClearance(const HazardMap& map, double step_m) {
  ClearanceField field;
  field.frame = FineFrame(map.frame);
  field.distance_m = DistanceToSet(ObstacleMask(map, step_m, field.frame), true);
  const auto cell = static_cast<float>(field.frame.cell_m);
  for (float& d : field.distance_m.cells) d *= cell;
  return field;
}

FloorRoom::FloorRoom(const HazardMap& map, double step_m)
    : frame_(FineFrame(map.frame)), inset_m_(map.inset_m) {
  walls_ = WallMask(map, frame_);
  hazards_ = Grid<std::uint8_t>(walls_.width, walls_.height);
  any_hazard_ = AddHazards(map, step_m, frame_, hazards_);
  clearance_m_ = DistanceToSet(walls_, true);
  const auto inset = static_cast<float>(map.inset_m / frame_.cell_m);
  for (float& d : clearance_m_.cells) d = d > 0 ? d + inset : 0;
  if (any_hazard_) {
    const Grid<float> to_hazard = DistanceToSet(hazards_, false);
    for (std::size_t i = 0; i < to_hazard.cells.size(); ++i)
      clearance_m_.cells[i] = std::min(clearance_m_.cells[i], to_hazard.cells[i]);
  }
  for (float& d : clearance_m_.cells) d *= static_cast<float>(frame_.cell_m);
}

std::vector<Grid<std::uint8_t>> FloorRoom::Free(const Shape2& clear, Yaws yaws) const {
  if (clear.kind == Shape2::Kind::kFootprint)
    return FreeOfFootprint(clear, walls_, any_hazard_ ? &hazards_ : nullptr, clearance_m_,
                           frame_.cell_m, inset_m_, Turns(yaws));
  std::vector<Grid<std::uint8_t>> layers(1, Grid<std::uint8_t>(walls_.width, walls_.height));
  const auto least = static_cast<float>(clear.radius_m - kEps * frame_.cell_m);
  for (std::size_t i = 0; i < layers[0].cells.size(); ++i)
    layers[0].cells[i] = clearance_m_.cells[i] >= least && clearance_m_.cells[i] > 0;
  return layers;
}

// A robot passes between neighbouring cells at one yaw, and between yaws where both are free; the
// angles in between are not checked. A footprint does not pass diagonally: between two free cells
// that touch only at a corner it would scrape.
SweepArea FloorRoom::Sweepable(const Shape2& clear, const Shape2& tool, const Vec2& start_W,
                               Yaws yaws) const {
  const bool circle = clear.kind == Shape2::Kind::kCircle;
  const Cell start = frame_.ToCell(start_W);
  std::vector<Grid<std::uint8_t>> layers = Free(clear, yaws);
  // The centre of a clear start's cell may be too close to an obstacle, by up to its distance from
  // the start.
  const double slack_m = std::sqrt(0.5) * frame_.cell_m + kEps;
  const bool fits = !circle || (frame_.Inside(start) && static_cast<double>(clearance_m_(start)) >=
                                                            clear.radius_m - slack_m);
  std::vector<LayerCell> seeds;
  for (std::size_t k = 0; fits && k < layers.size() && seeds.empty(); ++k)
    if (const auto seed = ClearCellAt(layers[k], start, ToCells(frame_, start_W)))
      seeds.push_back({*seed, k});
  return SweptFrom(Connected(layers, std::move(seeds), circle), tool, yaws);
}

SweepArea FloorRoom::SweptFrom(const std::vector<Grid<std::uint8_t>>& poses, const Shape2& tool,
                               Yaws yaws) const {
  SweepArea area;
  area.frame = frame_;
  area.clearance_m = clearance_m_;
  area.reachable = area.sweepable = Grid<std::uint8_t>(frame_.width, frame_.height);
  for (const auto& layer : poses)
    for (std::size_t i = 0; i < layer.cells.size(); ++i) area.reachable.cells[i] |= layer.cells[i];
  if (tool.kind == Shape2::Kind::kCircle)
    SweepInSight(tool.radius_m / frame_.cell_m, area);
  else
    for (int k = 0; k < Turns(yaws); ++k)
      DilateFootprint(poses[std::min(static_cast<std::size_t>(k), poses.size() - 1)], tool,
                      frame_.cell_m, k, area.sweepable);
  for (std::size_t i = 0; i < area.sweepable.cells.size(); ++i) {
    if (walls_.cells[i] || hazards_.cells[i]) area.sweepable.cells[i] = 0;
    area.sweepable_cells += area.sweepable.cells[i];
  }
  return area;
}

SweepArea ComputeSweepArea(const HazardMap& map, const RobotSpec& robot, const Shape2& clear,
                           const Shape2& tool, const Pose2& start) {
  const FloorRoom room(map, robot.step_m);
  SweepArea area = room.Sweepable(clear, tool, start.p());
  if (area.sweepable_cells > 0) return area;
  if (const auto place_W = room.WidePlaceAhead(robot, clear, start))
    area = room.Sweepable(clear, tool, *place_W);
  return area;
}

SweepArea ComputeSweepArea(const HazardMap& map, const Shape2& clear, const Shape2& tool,
                           double step_m, const Vec2& start_W, Yaws yaws) {
  return FloorRoom(map, step_m).Sweepable(clear, tool, start_W, yaws);
}

}  // namespace floorproof

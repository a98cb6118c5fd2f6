// SPDX-License-Identifier: Apache-2.0
// How often each cell of a floor lies under the tool along a set of lines. Lines can be taken back.
//
// Inner ground counts as swept where the narrowed tool passes, so that neighbouring lines overlap
// as they should (Floor::narrow). Ground along walls, which the narrowed tool does not reach,
// counts as swept where the whole tool passes. Ground that an obstacle may hide from the tool
// counts as swept where the tool passes no farther than the clear shape reaches (Floor::hidden).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "planners/lines/floor.h"

namespace floorproof {

class Swept {
 public:
  explicit Swept(const Floor& floor);
  // Both return the ground cells that changed between swept and not.
  int Add(const Vec2& a, const Vec2& b) { return Change(a, b, +1); }
  int Remove(const Vec2& a, const Vec2& b) { return Change(a, b, -1); }
  int Add(const Polyline& line);
  int Remove(const Polyline& line);
  bool IsOpen(int ix, int iy) const {
    for (const Layer& layer : layers_)
      if (layer.count(ix, iy) == 0) return true;
    return false;
  }
  // Share of the tool's width, along the unit vector `across` through p, that is open ground.
  double OpenShareAcross(const Vec2& p, const Vec2& across) const;
  double swept_cells() const { return static_cast<double>(swept_); }
  double share() const {
    return floor_->ground_cells > 0 ? swept_cells() / floor_->ground_cells : 0;
  }

  class Exchange;

 private:
  // Of a row of the grid; none: first > last.
  struct Cells {
    int first = 0, last = -1;
    friend bool operator==(const Cells&, const Cells&) = default;
  };
  class Strip;
  struct Layer {
    double reach = 0;           // cells, of the scaled tool
    Polygon tool;               // footprint tools, scaled, in cells
    Grid<std::uint16_t> count;  // so many too many where this layer has no ground
    Grid<std::uint8_t> tiles;   // 1 where a tile of kTile x kTile holds ground of this layer
  };
  Layer MakeLayer(double scale, const Grid<std::uint8_t>& mask) const;
  static int Change(Layer& layer, const Vec2& from, const Vec2& to, int by);
  static int Span(Layer& layer, int iy, int x0, int x1, int by);
  int Change(const Vec2& from, const Vec2& to, int by);

  const Floor* floor_;
  std::vector<Layer> layers_;
  std::int64_t swept_ = 0;
};

// What would be won if a short part of what was added were replaced. Nothing is changed by asking.
class Swept::Exchange {
 public:
  static constexpr std::size_t kMaxLegs = 3;

  explicit Exchange(const Swept& swept) : swept_(swept), rows_(swept.layers_.size()) {}
  // The part to replace: a chain of up to kMaxLegs legs.
  void Begin(std::span<const Vec2> old);
  // Ground cells more that would be swept with `fresh`, a chain of as many legs, in its place.
  int Won(std::span<const Vec2> fresh) const;

 private:
  using LegCells = std::array<Cells, kMaxLegs>;
  struct Rows {
    int first = 0, last = -1;
    std::vector<LegCells> cells;
  };
  static int OnlyOne(const LegCells& legs);
  static int WonInRow(const std::uint16_t* count, const LegCells& before, const LegCells& after);

  const Swept& swept_;
  std::vector<Rows> rows_;  // of each layer
  std::size_t legs_ = 0;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// How often each cell of a floor lies under the tool along a set of lines; lines can be taken back.
#pragma once

#include <utility>

#include "planners/lib/floor.h"

namespace floorproof {

class Swept {
 public:
  explicit Swept(const Floor& floor);
  // Both return the ground cells that changed between swept and not.
  int Add(const Vec2& a, const Vec2& b) { return Change(a, b, +1); }
  int Remove(const Vec2& a, const Vec2& b) { return Change(a, b, -1); }
  int Add(const Polyline& line);
  int Remove(const Polyline& line);
  // Ground cells that Add(line) would add.
  int Gain(const Polyline& line);
  bool IsOpen(int ix, int iy) const { return count_(ix, iy) == 0; }
  // Share of the tool's width, along the unit vector `across` through p, that is open ground.
  double OpenShareAcross(const Vec2& p, const Vec2& across) const;
  double swept_cells() const { return static_cast<double>(swept_); }
  double share() const {
    return floor_->ground_cells > 0 ? swept_cells() / floor_->ground_cells : 0;
  }

 private:
  int Change(const Vec2& from, const Vec2& to, int by);
  int ChangeDisc(const Vec2& a, const Vec2& b, int by);
  int ChangeFootprint(const Vec2& a, const Vec2& b, int by);
  std::pair<int, int> RowsNear(const Vec2& a, const Vec2& b) const;
  int Span(int iy, double low, double high, int by);

  const Floor* floor_;
  Grid<std::uint16_t> count_;
  Polygon tool_;  // footprint tools, in cells
  std::int64_t swept_ = 0;
};

}  // namespace floorproof

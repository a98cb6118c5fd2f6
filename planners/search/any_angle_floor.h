// SPDX-License-Identifier: Apache-2.0
// A floor of free cells, as searches at any angle look at it: computed once, shared by threads.
//
// Places are the centres of free cells. A robot's centre may go anywhere inside a full square, the
// unit square between four free centres that are neighbours; full squares are open to each other
// along edges and at corners. Between rows iy and iy + 1 of places they lie in runs.
// Where no full square leads, thin steps do: from a place to one of its 8 neighbours, so that
// places are connected as FloorRoom::Sweepable connects them for a circle, without exception.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "planners/search/index.h"
#include "planners/search/neighbours.h"

namespace floorproof {

class AnyAngleFloor {
 public:
  // Squares ix .. ix + 1 wide that are full, side by side: places from `first` to `last`.
  struct Run {
    int first, last;
  };

  explicit AnyAngleFloor(const Grid<std::uint8_t>& free);

  int width() const { return around_.width; }
  int height() const { return around_.height; }
  bool IsFree(Cell c) const { return around_.Inside(c) && (around_(c) & kFree); }
  // Whether the square of a place in the direction (sx, sy), each -1 or 1, is full.
  bool IsFull(Cell c, int sx, int sy) const { return around_(c) & Square(sx, sy); }
  // Whether the edge from a place along a side step borders a full square.
  bool IsOpen(Cell c, Cell step) const {
    const int bits = step.ix != 0 ? Square(step.ix, -1) | Square(step.ix, 1)
                                  : Square(-1, step.iy) | Square(1, step.iy);
    return around_(c) & bits;
  }
  // Of the band between rows iy and iy + 1, from left to right.
  std::span<const Run> Runs(int iy) const { return Part(runs_, first_run_, iy); }
  // Places of a row that thin steps lead from, from left to right.
  std::span<const int> ThinPlaces(int iy) const { return Part(thin_, first_thin_, iy); }
  bool IsThin(Cell c) const { return around_(c) & kThin; }
  // Calls use(neighbour, length) for each thin step from a place.
  template <class Use>
  void ForThinSteps(Cell c, const Use& use) const {
    for (const Cell step : kSideSteps)
      if (IsThinStep(c, step)) use(c + step, 1.0);
    for (const Cell step : kCornerSteps)
      if (IsThinStep(c, step)) use(c + step, std::numbers::sqrt2);
  }

 private:
  static constexpr std::uint8_t kFree = 16, kThin = 32;
  static constexpr std::uint8_t Square(int sx, int sy) {
    return static_cast<std::uint8_t>(1 << ((sx > 0 ? 0 : 1) + (sy > 0 ? 0 : 2)));
  }
  template <class T>
  static std::span<const T> Part(const std::vector<T>& all, const std::vector<int>& first, int i) {
    return std::span(all).subspan(Z(first[Z(i)]), Z(first[Z(i) + 1] - first[Z(i)]));
  }
  bool IsThinStep(Cell c, Cell step) const;

  Grid<std::uint8_t> around_;  // kFree, kThin and the full squares of each place
  std::vector<Run> runs_;
  std::vector<int> thin_;
  std::vector<int> first_run_ = {0}, first_thin_ = {0};  // by row, and the end
};

}  // namespace floorproof

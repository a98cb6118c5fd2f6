// SPDX-License-Identifier: Apache-2.0
// The wave front of the FMEA paper's Algorithm 1: how far each cell is from the end.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>

#include "planners/search/best_first.h"

namespace floorproof {

inline constexpr double kOutOfReach = std::numeric_limits<double>::infinity();
// The most that planners may add to a cell's score: sums over any floor stay exact enough.
inline constexpr double kMaxWeight = 1e6;

// What a cell adds to the score of each step that enters it, >= 0.
using CellScore = std::function<double(Cell)>;

// The least sum of scores from `end` to each cell of `open`: 15 a step in a T direction, 20 in an X
// direction (section 2.3), and what `cell_score` adds (none: nothing). An X step leads between two
// cells that must both be open: a robot as wide as a cell does not pass a corner otherwise. Cells
// that no step leads to are kOutOfReach.
Grid<double> WaveFront(const Grid<std::uint8_t>& open, Cell end,
                       const CellScore& cell_score = nullptr);

// A wave front that goes on when more cells of `open`, which outlives it, are opened.
class Wave {
 public:
  Wave(const Grid<std::uint8_t>& open, Cell end, CellScore cell_score = nullptr);

  // These cells of `open` have been opened since: the wave goes on from around them. Its scores
  // are those of a wave begun anew.
  void GoOnThrough(std::span<const Cell> opened);

  bool Reaches(Cell cell) const { return search_.IsReached(NumberOf(open_, cell)); }
  Grid<double> Scores() const;  // as WaveFront's

 private:
  void Spread();

  const Grid<std::uint8_t>& open_;
  CellScore cell_score_;
  BestFirstSearch<double> search_;
};

}  // namespace floorproof

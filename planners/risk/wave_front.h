// SPDX-License-Identifier: Apache-2.0
// Wave fronts over cells: what each is from the end, the FMEA paper's Algorithm 1.
#pragma once

#include <functional>
#include <limits>

#include "planners/risk/risk_map.h"

namespace floorproof {

inline constexpr double kOutOfReach = std::numeric_limits<double>::infinity();
// Of what planners add to a cell's score: sums over any floor stay exact enough.
inline constexpr double kMaxWeight = 1e6;

// The least sum of scores from `end` to each cell of `open`: 15 a step in a T direction, 20 in an X
// direction, and of each cell entered what `also` says (>= 0; none: nothing). An X step leads
// between two cells that are both open: a robot as wide as a cell does not pass a corner otherwise.
// Cells that no step leads to are kOutOfReach.
Grid<double> WaveFront(const Grid<std::uint8_t>& open, Cell end,
                       const std::function<double(Cell)>& also = nullptr);

// Where the wave from `end` stops before it has reached every free cell, terrain lies across the
// floor: the paper opens the terrain cell of the least RF and begins anew. Literally that may be
// any terrain cell; meant is one where it can be crossed ("will be allowed for crossover", Figure
// 3b). Here: the closed terrain cells of the least sum of RF that join what the wave has reached to
// what it has not, which across a strip one cell wide is one cell.
// `open`: the free cells that are wanted, and terrain opened before; what is opened is added.
// Returns the scores as WaveFront does; what no terrain leads to stays out of reach.
Grid<double> WaveOverTerrain(const RiskMap& risk, Cell end, Grid<std::uint8_t>& open);

}  // namespace floorproof

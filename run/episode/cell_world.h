// SPDX-License-Identifier: Apache-2.0
// A floor of cells, and an ideal robot on it that moves from cell to cell and sees exactly what
// lies within its radius: planners of unknown floors without physics (`drive: cells`).
#pragma once

#include <cstdint>
#include <vector>

#include "env/known/known_map.h"

namespace floorproof {

class CellWorld {
 public:
  // `blocked`: 1 where the robot cannot be. The robot stands in `start`, a cell that is free, and
  // sees cells whose middles lie within radius_m of its own cell's.
  CellWorld(const GridFrame& frame, Grid<std::uint8_t> blocked, Cell start, double radius_m);

  // Sees what is around it: the known map is as the floor there.
  void Sense(KnownMap& known) const;
  // Steps to a cell beside it, a diagonal step without cutting a corner; false: it cannot.
  bool Step(Cell to);

  Cell here() const { return here_; }
  const GridFrame& frame() const { return frame_; }
  const Grid<std::uint8_t>& reachable() const { return reachable_; }  // 1: from the start
  std::int64_t reachable_cells() const { return reachable_cells_; }
  const Grid<std::int32_t>& visits() const { return visits_; }
  std::int64_t visited() const { return visited_; }      // cells, at least once
  std::int64_t revisited() const { return revisited_; }  // cells, twice or more
  std::int64_t moves() const { return moves_; }

  // J_hc and J_cc (Li et al., Eqs. 13 and 14), of the cells that can be reached.
  double coverage() const { return Share(visited_); }
  double revisited_share() const { return Share(revisited_); }

 private:
  bool IsOpen(Cell c) const { return frame_.Inside(c) && !blocked_(c); }
  bool MayStep(Cell from, Cell by) const;
  double Share(std::int64_t cells) const {
    return static_cast<double>(cells) / static_cast<double>(reachable_cells_);
  }
  void Come(Cell to);
  void FindReachable();

  GridFrame frame_;
  Grid<std::uint8_t> blocked_, reachable_;
  Grid<std::int32_t> visits_;
  std::vector<Cell> window_;  // from the robot
  Cell here_;
  std::int64_t reachable_cells_ = 0, visited_ = 0, revisited_ = 0, moves_ = 0;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The known floor in cells of the robot's step, and how often the robot was in each.
//
// After Li et al., "A Complete Coverage Path Planning Algorithm for Mobile Robot Based on FSM and
// Rolling Window Approach in Unknown Environment", section 2: the cells' properties Flag (Eq. 1)
// and Visited (Eq. 2), and their steps to 8 neighbours. A cell is free where the robot, its centre
// in the middle of the cell, keeps clear of all that is known to be occupied, and all of the floor
// there is known. On a known map with the same cells, and nothing to keep clear of, the two are
// one.
//
// What the robot sees is taken over cell by cell as it comes: an update takes time as what is new.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "env/known/known_map.h"
#include "planners/online/extent.h"
#include "planners/online/online_planner.h"
#include "planners/search/neighbours.h"

namespace floorproof {

// The eight steps, counter-clockwise from east; odd ones are diagonal.
inline constexpr std::array<Cell, 8> kSteps = {Cell{1, 0},  Cell{1, 1},   Cell{0, 1},  Cell{-1, 1},
                                               Cell{-1, 0}, Cell{-1, -1}, Cell{0, -1}, Cell{1, -1}};

// Which of them leads by so much; kSteps.size(): none.
inline std::size_t StepOf(Cell by) {
  return static_cast<std::size_t>(std::ranges::find(kSteps, by) - kSteps.begin());
}
// The cell that a straight line from a cell passes after i of n equal parts of `way`, from there.
inline Cell OnLine(Cell way, int i, int n) {
  return {static_cast<int>(std::lround(1.0 * i * way.ix / n)),
          static_cast<int>(std::lround(1.0 * i * way.iy / n))};
}

class RobotCells {
 public:
  RobotCells() = default;
  // Cells of `step_m` over `ground`, the known map's frame, laid such that `start_W` is the middle
  // of one.
  RobotCells(const GridFrame& ground, const Vec2& start_W, double step_m, const Extent& clear);

  void Update(const KnownMap& known, std::span<const Cell> changed);
  // From now on, changed() tells.
  void TellChanges() { changed_.emplace(); }
  // The cells of which IsFree or MayBeFree may have changed in the last update, some of them twice.
  std::span<const Cell> changed() const { return *changed_; }

  const GridFrame& frame() const { return frame_; }
  Cell At(const Vec2& p_W) const { return frame_.ToCell(p_W); }
  bool IsFree(Cell c) const { return frame_.Inside(c) && not_free_(c) == 0; }
  // Free, for all that is known.
  bool MayBeFree(Cell c) const { return frame_.Inside(c) && blocked_(c) == 0; }
  // The same with another extent around the robot's centre, in cells of the ground. Takes time as
  // that is large.
  bool IsFreeFor(const Extent& extent, Cell c) const;
  // Whether the robot may take this of kSteps: to a free cell, without cutting a corner.
  bool MayStep(Cell from, std::size_t step) const {
    const Cell by = kSteps[step];
    if (!IsFree(from + by)) return false;
    return step % 2 == 0 || (IsFree(from + Cell{by.ix, 0}) && IsFree(from + Cell{0, by.iy}));
  }

  // The robot has come into the cell; or has not, though that was said.
  void Visit(Cell c) { Count(c, 1); }
  void TakeBack(Cell c) { Count(c, -1); }
  int visits(Cell c) const { return visits_(c); }
  // The robot's cell; where it is not free, the nearest that is, within `reach` cells. The robot
  // may have been pushed, or what it met may have been marked as larger than it is.
  Cell FreeAt(const Vec2& p_W, int reach = 2) const;
  bool IsUncovered(Cell c) const { return IsFree(c) && visits_(c) == 0; }

 private:
  Vec2 MiddleOnGround(Cell c) const;
  bool Needs(Cell c, Cell ground) const { return Needs(MiddleOnGround(c), clear_, ground); }
  static bool Needs(const Vec2& middle, const Extent& extent, Cell ground);
  template <class See>
  void ForEachNeeded(Cell c, const Extent& extent, const See& see) const;
  // Of the ground's cells that a cell needs to be free: how many there are, and how many of them
  // lie beyond the ground.
  struct Needed {
    int cells = 0, beyond = 0;
  };
  Needed NeededBy(Cell c) const;
  struct Span {
    Cell low, high;  // both included
  };
  Span Near(Cell ground) const;
  void ListNeeding();
  void CountNeeded();
  void Take(Cell ground, CellState was, CellState now);
  void Change(int ix, int iy, int not_free, int blocked);
  void Count(Cell c, int more) {
    if (frame_.Inside(c)) visits_(c) += more;
  }

  GridFrame frame_, ground_;
  // In cells of the ground: where the corner of cell (0, 0) lies, a cell's side, what to keep
  // clear of its middle.
  Vec2 corner_ = Vec2::Zero();
  double side_ = 1;
  Extent clear_;
  Grid<CellState> taken_;  // the ground, as last taken over
  // How many of the ground's cells that a cell needs are not known to be free; and are occupied, or
  // beyond the ground.
  Grid<std::int32_t> not_free_, blocked_;
  Grid<std::int32_t> visits_;
  // Where `division_` cells lie along one of the ground: those that need cell (0, 0) of the ground
  // to be free, by rows; every other cell's lie likewise around it.
  struct Row {
    int iy, first, last;
  };
  int division_ = 0;  // 0: the ground's cells are not divided evenly
  std::vector<Row> needing_;
  std::optional<std::vector<Cell>> changed_;
};

// As wide as the planner's steps: as stated, else as the tool.
RobotCells CellsOf(const OnlineTask& task, const OnlineParams& params);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The known floor as a tool sweeps it: where the robot's centre may be, and what was not swept.
//
// Both on one fine grid, that of the known map divided until the tool is some cells wide: so lanes
// may lie side by side almost without overlap, and walls need not lie on borders of the tool's
// widths. What the robot sees is taken over as it comes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "env/known/known_map.h"
#include "planners/online/extent.h"
#include "planners/online/robot_cells.h"
#include "planners/search/best_first.h"

namespace floorproof {

class ToolFloor {
 public:
  // Over `ground`, the known map's frame.
  ToolFloor(const GridFrame& ground, const Extent& body, const Extent& clear, const Extent& tool);

  void Update(const KnownMap& known, std::span<const Cell> changed);
  // The tool went straight from a to b; taken back: it did not.
  void Sweep(const Vec2& a_W, const Vec2& b_W) { Count(a_W, b_W, 1); }
  // The robot has been all along there: it may be there again, whatever noise says of the walls
  // beside.
  void Stand(const Vec2& a_W, const Vec2& b_W);
  void TakeBack(const Vec2& a_W, const Vec2& b_W) { Count(a_W, b_W, -1); }

  const GridFrame& frame() const { return poses_.frame(); }
  // Whether the robot's centre may be in this cell.
  bool IsFree(Cell c) const { return poses_.IsFree(c); }
  // The nearest such cell, within `reach_m`; else the place's own.
  Cell FreeAt(const Vec2& p_W, double reach_m) const {
    return poses_.FreeAt(p_W, static_cast<int>(reach_m / frame().cell_m));
  }
  // Known to be free, and not swept.
  bool IsOpen(Cell c) const { return open_.Inside(c) && open_(c); }

  // The tool's cells, from its own; and those of them that a step of kSteps adds.
  std::span<const Cell> tool() const { return tool_cells_; }
  std::span<const Cell> added(std::size_t step) const { return added_[step]; }
  // From the tool's middle the nearest cell on its left that is under a tool in the lane beside
  // it, on its way along a step of kSteps.
  Cell beside(std::size_t step) const { return beside_[step]; }

  // The cells of the tool at this place that are open.
  int OpenAt(Cell c) const { return under_.Inside(c) ? under_(c) : 0; }
  // How many a place must have that the robot goes to: more, the farther it is away.
  struct Worth {
    double least = 0, most = 0;  // cells
    double a_cell = 0;           // cells for each of the way
  };
  struct Leg {
    Vec2 to_W;     // straight
    bool is_free;  // else it squeezes past something
  };
  // The way to the nearest place that has as many; empty: there is none. Where there is none else,
  // it may lead past things where the robot went before; and where the robot is pinned, out of
  // there as its body fits: it got in. Takes time as the floor that is nearer.
  std::vector<Leg> WayToOpen(Cell from, const Worth& worth);
  // Whether the robot may go straight from cell to cell.
  bool Sees(Cell a, Cell b) const;

 private:
  void Count(const Vec2& a_W, const Vec2& b_W, int by);
  void Tell(Cell c);
  // The robot was touched there, or met an edge.
  void ForgetStanding(Cell ground);
  // Whether it may come nearer to things than it is to keep clear of them.
  enum class Squeeze { kNot, kWhereItWent, kNearby };
  std::vector<Leg> WayToOpen(Cell from, const Worth& worth, Squeeze squeeze, const Extent& body);
  bool IsPeak(Cell c, int open) const;

  int division_ = 1;     // of the ground's cells
  Extent body_;          // in the ground's cells
  Extent clear_, tool_;  // in cells
  RobotCells poses_;
  Grid<std::uint8_t> known_free_, open_, stood_;
  Grid<std::uint16_t> swept_, under_;  // under_: what is open under the tool
  std::vector<Cell> tool_cells_;
  struct ToolRow {
    int iy, half;  // cells to either side of its middle
  };
  std::vector<ToolRow> tool_rows_;  // the same
  std::array<std::vector<Cell>, kSteps.size()> added_;
  std::array<Cell, kSteps.size()> beside_;
  BestFirstSearch<int, BucketFrontier<23>> search_;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The reachable part of a floor, as coverage planners work on it: cropped, and in cells.
#pragma once

#include <cstdint>
#include <vector>

#include "env/core/coverage.h"
#include "env/geometry/interpolate.h"

namespace floorproof {

// A chain of points, in cells of a Floor's frame (cell (0, 0) spans [0, 1] x [0, 1]).
using Polyline = std::vector<Vec2>;
double PolylineLength(const Polyline& line);
// Leaves out points on straight runs and repeated points.
Polyline MergeStraight(const Polyline& line);

struct Floor {
  GridFrame frame;                // of the crop
  double turned_rad = 0;          // from the map's axes to the frame's (MapAlongWalls)
  Grid<std::uint8_t> pose;        // the robot's centre may be here
  Grid<std::uint8_t> ground;      // the tool can sweep this
  Grid<float> margin;             // room beyond the clear shape at a cell's centre; negative: none
  double tolerance = 0;           // margin that straight lines may lack between cell centres
  bool clears_footprint = false;  // the clear shape is a footprint, `margin` 0 or -1
  Shape2 tool;
  double tool_reach = 0;  // farthest point of the tool from the robot's centre, cells
  // Neighbouring lines are to overlap. So the tool counts as `tool_width` cells wide, `narrow`
  // times its true width, on the ground that it can reach with that width (`inner`). The rest of
  // the ground lies along walls.
  double narrow = 1;
  double tool_width = 0;
  Grid<std::uint8_t> inner;
  // Ground that obstacles hide from some poses and that lies within `near_reach` cells of others:
  // there the tool counts as no wider than that. Empty: there is none.
  Grid<std::uint8_t> hidden;
  double near_reach = 0;
  double ground_cells = 0;

  double ToCells(double length_m) const { return length_m / frame.cell_m; }
  Vec2 ToCells(const Vec2& p_W) const { return frame.ToGrid(p_W) / frame.cell_m; }
  Vec2 ToWorld(const Vec2& p) const { return frame.X_WG * (p * frame.cell_m); }
  static Cell CellAt(const Vec2& p) { return {RoundDown(p.x()), RoundDown(p.y())}; }
  static Vec2 CentreOf(Cell c) { return {c.ix + 0.5, c.iy + 0.5}; }

  // Margin between cell centres, bilinear.
  double MarginAt(const Vec2& p) const;
  // Whether the robot's centre may be at p, to within `slack` cells.
  bool Free(const Vec2& p, double slack = 0) const { return MarginAt(p) >= -slack; }
  // Whether it may drive straight from a to b.
  bool Sees(const Vec2& a, const Vec2& b) const;

 private:
  bool SeesWithFootprint(const Vec2& a, const Vec2& b) const;
};

// The part of `area` around its reachable poses. `clear` and `tool` are those that the area was
// computed with. `overlap`: of neighbouring lines, as a share of the tool's width.
Floor CropFloor(const SweepArea& area, const Shape2& clear, const Shape2& tool, double tool_width_m,
                double overlap = 0);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Shapes of like characters in a grid: joined areas as rectangles, runs as strips.
#pragma once

#include <vector>

#include "env/geometry/grid.h"

namespace floorproof {

// Cells [x0, x1) x [y0, y1).
struct CellBox {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// Cells of one character that are joined by their sides, as rectangles that do not overlap.
struct CellArea {
  Cell first;  // the first of it as the rows are read: from the top, then from the left
  std::vector<CellBox> boxes;
};
std::vector<CellArea> JoinedAreas(const Grid<char>& chars, char kind);

// A straight run one cell wide. `before` and `after` say what goes on beyond its low and high end.
struct CellRun {
  enum class End { kOpen, kWall, kJoin /* another run of the kind */ };
  bool along_x = false;
  CellBox box;
  End before = End::kOpen, after = End::kOpen;
  Cell first;
};
std::vector<CellRun> Runs(const Grid<char>& chars, char kind);

// What a robot may drive on.
inline bool IsDrivable(char c) { return c == '.' || c == '=' || c == 'g' || c == 'r'; }

}  // namespace floorproof

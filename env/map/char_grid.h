// SPDX-License-Identifier: Apache-2.0
// A floor drawn in characters (design: site file): rows from the top, one character a cell.
//
//   . free          # blind object (C1)    ? unknown
//   G glass (C2)    v drop, ^ raised floor (C3)    = cable cover, g groove, r rough (C4)
//
// Glass, drops, raised floor and rough ground: cells joined by their sides are one hazard, made of
// maximal rectangles. Cable covers and grooves: a run of cells is one strip along its run. A cell
// of runs both ways belongs to the longer one; a lone cell, or a tie, goes along y. Where a strip
// meets another of its kind, it reaches to the middle of the other's cell. Ids count in reading
// order. Solids are drawn back by inset_m on faces before which a robot may drive, and meet the
// (drawn back) faces of walls; footprints are whole cells, those of strips end with their cells.
#pragma once

#include <string>
#include <vector>

#include "base/config.h"
#include "env/core/hazard_map.h"

namespace floorproof {

struct CharGrid {
  GridFrame frame;  // its origin is the outer lower-left corner of cell (0, 0)
  Grid<CellState> occupancy;
  double inset_m = 0.03;
  std::vector<Hazard> hazards;  // without ids
  ConfigNode resolved;          // the node with every default stated
};

// `node` is the site's key `grid`, or another that holds the same, whose name refusals then say.
// Throws InputError.
CharGrid ReadCharGrid(const ConfigNode& node, const std::string& key = "grid");
ConfigNode CharGridSchema();
// Of its key `sizes`.
ConfigNode CharSizesSchema();

}  // namespace floorproof

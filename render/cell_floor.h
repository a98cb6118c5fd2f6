// SPDX-License-Identifier: Apache-2.0
// A floor of cells from above, as a picture that changes with them: the properties of cells in
// colours, what the robot has not seen yet under a veil of hatches. Only cells that change are
// painted again.
//
// The map is drawn twice beforehand, over black and over white cells. What lies between the two at
// a pixel is the cell's share in it: none of a wall, all of it where nothing lies over the cell,
// a part at the smooth border of a mark. So marks stay as they are, whatever colour is below them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "env/core/hazard_map.h"
#include "render/cell_property.h"
#include "render/heatmap_panel.h"
#include "render/panel_frame.h"

namespace floorproof {

class CellFloor {
 public:
  // Cells are the map's. `in_reach`: 1 where a cell can be visited. Drawn as large as fits.
  CellFloor(const HazardMap& map, const Grid<std::uint8_t>& in_reach, int most_width,
            int most_height);

  void SetVisits(Cell cell, int visits);  // others than those in reach are passed over
  void See(Cell cell);                    // no veil from now on

  int visits(Cell cell) const { return visits_(cell); }
  // Cells in reach of each property, by its number; of what is out of reach none.
  const std::array<std::int64_t, kNumCellProperties>& counts() const { return counts_; }
  bool any_out_of_reach() const { return any_out_of_reach_; }  // free cells
  const Image& image() const { return image_; }
  const PanelFrame& frame() const { return frame_; }
  // What lies over the cells, for a legend: hazards, the start.
  const std::vector<LegendLine>& marks() const { return marks_; }

 private:
  void Paint(Cell cell);
  Rgb ColourIn(Cell cell) const;

  const HazardMap& map_;
  const Grid<std::uint8_t>& in_reach_;
  Window window_;
  PanelFrame frame_;
  Image black_, white_, image_;
  std::vector<LegendLine> marks_;
  Grid<std::int32_t> visits_;
  Grid<std::uint8_t> seen_;
  std::array<std::int64_t, kNumCellProperties> counts_{};
  bool any_out_of_reach_ = false;
};

// Under the veil, at that pixel of it.
Rgb Veiled(const Rgb& colour, int x, int y);

}  // namespace floorproof

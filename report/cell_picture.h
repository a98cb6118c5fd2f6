// SPDX-License-Identifier: Apache-2.0
// How an unknown floor was covered, as Li et al. show it (Figs. 6 to 9): the properties of its
// cells in colours, and the robot at its last place within its rolling window.
#pragma once

#include <array>
#include <filesystem>

#include "render/cell_property.h"
#include "render/heatmap.h"
#include "run/episode/episode.h"

namespace floorproof {

struct Scenario;

// Of each cell of the record's that the map has free, the number of its CellProperty.
HeatValues CellProperties(const HazardMap& map, const EpisodeRecord& record);
// How many cells in reach have each; of what is out of reach none.
std::array<std::int64_t, kNumCellProperties> CountProperties(const EpisodeRecord& record);

// heatmap_cells.png. The drive's planner is one of unknown floors. Throws InputError when the file
// cannot be written.
void WriteCellPicture(const Scenario& scenario, const EpisodeRecord& record,
                      const std::filesystem::path& png);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A film of a drive from cell to cell, from above and without physics: the properties of cells as
// they change, the robot with its rolling window, what it has not seen yet. The robot is shown in
// cells and not between them, as it sees from there.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "env/core/hazard_map.h"
#include "env/known/known_map.h"
#include "render/film_reel.h"
#include "render/overlay.h"

namespace floorproof {

// The robot came to a cell.
struct CellStep {
  double t_s = 0;
  Vec2 p_W = Vec2::Zero();
  double covered = 0, revisited = 0;  // J_hc, J_cc from then on
};

struct CellFilmScript {
  const HazardMap* map = nullptr;                // the floor as it is; its cells are the drive's
  const Grid<std::uint8_t>* in_reach = nullptr;  // cells that count
  const Grid<std::uint8_t>* visits = nullptr;    // of each cell, at the end
  const KnownMap* known = nullptr;  // at the end, on the map's cells; none: all that was near
  std::vector<CellStep> steps;      // ascending in time, at least one
  double window_m = 0;
  std::string title;              // "beluga on room"
  std::optional<Banner> closing;  // over the last picture
};

// The options' stills have no frame_failure.png: nothing fails. Throws as WriteReel().
FilmResult WriteCellFilm(const CellFilmScript& script, const ReelOptions& options,
                         const std::filesystem::path& path);

}  // namespace floorproof

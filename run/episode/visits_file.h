// SPDX-License-Identifier: Apache-2.0
// visits.pgm: how many times the tool passed over each place, as a picture that any program reads.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "env/geometry/grid.h"
#include "run/episode/episode_record.h"

namespace floorproof {

struct Visits {
  static constexpr std::uint8_t kOutOfReach = 255;
  GridFrame frame;
  Grid<std::uint8_t> passes;  // 254: so many or more
};

// A raw grey PGM (P5), the top row first, with the frame in a comment: the lower left corner's
// place and the rows' heading, as in ROS maps.
std::string VisitsPgm(const EpisodeRecord& record);

// None: the bytes are no whole file of that kind.
std::optional<Visits> ReadVisits(std::string_view bytes);

}  // namespace floorproof

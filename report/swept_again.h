// SPDX-License-Identifier: Apache-2.0
// Where and when a drive swept floor a second time, for its film.
#pragma once

#include <vector>

#include "env/core/robot_spec.h"
#include "render/film.h"
#include "run/episode/episode.h"

namespace floorproof {

// What `revisited` counts, measured again along the trace: the cells that were swept twice in each
// quarter of a metre driven, as few rectangles, from its end on.
std::vector<FloorPatch> SweptAgainPatches(const EpisodeRecord& record, const RobotSpec& robot);

}  // namespace floorproof

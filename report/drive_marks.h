// SPDX-License-Identifier: Apache-2.0
// What a drive adds to every map of it: its failures, numbered as they are listed, and its way.
#pragma once

#include <string>
#include <vector>

#include "render/heatmap.h"
#include "run/episode/episode.h"

namespace floorproof {

// The place of event i, counted from 1, of result.json's list and the terminal's.
std::vector<HeatFailure> ListedFailures(const std::vector<Event>& events);
// What was driven, in as few points as show it to 5 mm; a new stretch where the robot was carried.
std::vector<std::vector<Vec2>> WayDriven(const std::vector<TraceRow>& trace);

// Marks the failures. The way is for maps that lines may lie over.
enum class Way { kShown, kHidden };
void ShowDrive(const EpisodeRecord& record, Way way, HeatMapOptions& options);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// An episode's heat maps and plots.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/console.h"
#include "render/heatmap.h"
#include "run/episode/episode.h"

namespace floorproof {

struct Scenario;
struct World;

// "ROBOT on SITE", how the titles of an episode's pictures begin.
std::string PictureTitle(const World& world);
// The plan's pictures (report/risk_pictures.h); heatmap_visits.png, heatmap_coverage.png,
// heatmap_failures.png and plot_errors.png; of a robot that draws a map, heatmap_known.png; of a
// planner of unknown floors, heatmap_cells.png and plot_coverage.png. Each map has the failures;
// those of the plan and of the failures show what was driven, too.
void WriteHeatMaps(const Scenario& scenario, const PlanResult& plan, const EpisodeRecord& record,
                   const std::filesystem::path& folder, const Console& console);
// Failures over the map, on the share of episodes that failed in each square where that is given.
// `options` holds the failures and what else lies over the map.
void WriteFailurePlaces(const HazardMap& map, const std::string& title, HeatMapOptions options,
                        const HeatValues* rates, const std::filesystem::path& png);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// An episode's film and heat maps.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/film.h"
#include "render/heatmap.h"
#include "run/episode/episode.h"

namespace floorproof {

// "ROBOT on SITE", how the titles of an episode's pictures begin.
std::string PictureTitle(const Scenario& scenario);
// The plan's pictures (report/risk_pictures.h); heatmap_visits.png, heatmap_coverage.png,
// heatmap_failures.png and plot_errors.png; of a robot that draws a map, heatmap_known.png.
void WriteHeatMaps(const Scenario& scenario, const PlanResult& plan, const EpisodeRecord& record,
                   const std::filesystem::path& folder);
// Failures as points over the map, on the share of episodes that failed in each square where that
// is given, and the plan where there is one.
void WriteFailurePlaces(const HazardMap& map, const std::string& title,
                        const std::vector<Event>& events, const HeatValues* rates, const Path* plan,
                        const std::filesystem::path& png);
// video.mp4 and frame_*.png; returns a line that says how it went.
std::string WriteVideo(const Scenario& scenario, const Scene& scene, const PlanResult& plan,
                       const EpisodeRecord& record, const Recording& recording,
                       const std::filesystem::path& folder);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// How an unknown floor was covered, over time and over the way driven.
#pragma once

#include <filesystem>
#include <string>

#include "render/chart.h"
#include "run/episode/episode.h"

namespace floorproof {

// The coverage rate J_hc and the overlapping coverage rate J_cc (Li et al., Eqs. 13 and 14), in
// percent: two curves over time, and over the way in chords as the metric path_length_m counts it.
// All end at the metrics.
Chart CoverageChart(const std::string& title, const EpisodeRecord& record);
// The same into a PNG. Throws InputError when the file cannot be written.
void WriteCoveragePlot(const std::string& title, const EpisodeRecord& record,
                       const std::filesystem::path& png);

}  // namespace floorproof

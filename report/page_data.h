// SPDX-License-Identifier: Apache-2.0
// What a page's scripts draw, as JSON; web/*.js say what they read.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "env/core/event.h"
#include "env/core/hazard_map.h"
#include "env/core/path.h"
#include "run/campaign/campaign_summary.h"
#include "run/episode/visits_file.h"

namespace floorproof {

using PageJson = nlohmann::ordered_json;

// As it stands in a page: texts that files gave may be no UTF-8.
std::string PageText(const PageJson& json);
// To thousandths: millimetres, milliseconds.
double Thousandths(double value);

// The floor: its frame, its cells in runs (a large map in coarser ones: a wall wherever one is),
// the part that is known ([x, y, x, y] in the grid's frame; null: none), its hazards.
PageJson MapData(const HazardMap& map);
// The same frame and runs of how often the tool passed; -1: out of its reach.
PageJson VisitsData(const Visits& visits);
// Squares of the floor with the share of episodes that failed there, and its interval:
// {cell_m, places: [[x, y, failed, n, lower, upper], ..]}; null where none failed.
PageJson RatesData(const VariantSummary& variant);
// [[x, y], ..], m.
PageJson WayData(const Path& plan);
// A failure: {t_s, x, y, label, what, text}. `label`: on the map.
PageJson FailureData(const Event& event, const std::string& label, const std::string& text);
// What video.json of this folder says of its film, where it is there: `film_fps`, `film_t_s`.
void AddFilmTimes(const std::filesystem::path& folder, PageJson& drive);
// trace.csv as columns: t_s, speed_mps, tilt_deg, cross_track_mm, power_w, coverage_percent, of at
// most 1,500 rows; and the way, [[x, y], .., [null, null], ..] where the robot was carried. Both
// null where the text is no trace.
struct TraceData {
  PageJson columns, way;
};
TraceData ReadTraceData(std::string_view csv);
// safety.csv's changes of the mission (empty: it has no name) as a whole: {t_s: [], state: [],
// level: []}; null where the text is none.
PageJson SafetyData(std::string_view csv, const std::string& mission);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "render/episode_maps.h"

#include <algorithm>

#include "render/heatmap.h"

namespace floorproof {
namespace {

std::string Title(const HazardMap& map, const char* what) {
  return map.name.empty() ? what : std::string(what) + ", " + map.name;
}

}  // namespace

void WriteVisitsMap(const HazardMap& map, const SweepArea& area, const Grid<std::uint8_t>& passes,
                    const Path* plan, const std::filesystem::path& png) {
  HeatValues visits{area.frame,
                    Grid<float>(area.frame.width, area.frame.height, HeatValues::kNone)};
  for (std::size_t i = 0; i < visits.values.cells.size(); ++i) {
    if (passes.cells[i] > 0) visits.values.cells[i] = passes.cells[i];
  }
  HeatMapOptions options;
  options.title = Title(map, "Visits");
  options.quantity = "passes of the tool";
  options.unit = "count";
  options.low = 0;
  options.whole_numbers = true;
  options.plan = plan;
  WriteHeatMap(map, &visits, options, png);
}

void WriteCoverageMap(const HazardMap& map, const SweepArea& area, const Grid<std::uint8_t>& passes,
                      const std::filesystem::path& png) {
  HeatValues swept{area.frame, Grid<float>(area.frame.width, area.frame.height, HeatValues::kNone)};
  double count = 0;
  for (std::size_t i = 0; i < swept.values.cells.size(); ++i) {
    if (!area.sweepable.cells[i]) continue;
    const bool done = passes.cells[i] > 0;
    swept.values.cells[i] = done ? 0.0f : 1.0f;
    count += done;
  }
  HeatMapOptions options;
  options.title = Title(map, "Coverage");
  const double whole = std::max(1.0, static_cast<double>(area.sweepable_cells));
  options.quantity = Printf("covered: %.1f %%", 100 * count / whole);
  options.categories = {{"swept", {94, 180, 160}}, {"missed", {240, 150, 60}}};
  WriteHeatMap(map, &swept, options, png);
}

void WriteFailuresMap(const HazardMap& map, std::span<const Event> events, const Path* plan,
                      const std::filesystem::path& png) {
  HeatMapOptions options;
  options.title = Title(map, "Failures");
  options.quantity = events.empty() ? "no failure" : Printf("failures: %zu", events.size());
  options.plan = plan;
  for (const Event& event : events) {
    options.points.push_back({{event.x_m, event.y_m}, std::string(Name(event.mode))});
  }
  WriteHeatMap(map, nullptr, options, png);
}

}  // namespace floorproof

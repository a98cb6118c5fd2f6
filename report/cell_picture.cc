// SPDX-License-Identifier: Apache-2.0
#include "report/cell_picture.h"

#include <fmt/format.h>

#include <numeric>
#include <string>

#include "base/quantity.h"
#include "report/drive_marks.h"
#include "report/pictures.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

float NumberOf(CellProperty property) { return static_cast<float>(property); }

}  // namespace

HeatValues CellProperties(const HazardMap& map, const EpisodeRecord& record) {
  const Grid<std::uint8_t>& passes = record.passes;
  HeatValues heat{record.passes_frame, Grid<float>(passes.width, passes.height, HeatValues::kNone)};
  for (int iy = 0; iy < passes.height; ++iy)
    for (int ix = 0; ix < passes.width; ++ix) {
      if (record.sweepable(ix, iy)) {
        heat.values(ix, iy) = NumberOf(PropertyOf(passes(ix, iy)));
        continue;
      }
      const Cell c = map.frame.ToCell(record.passes_frame.Center(ix, iy));
      if (map.frame.Inside(c) && map.occupancy(c) == CellState::kFree)
        heat.values(ix, iy) = NumberOf(CellProperty::kOutOfReach);
    }
  return heat;
}

std::array<std::int64_t, kNumCellProperties> CountProperties(const EpisodeRecord& record) {
  std::array<std::int64_t, kNumCellProperties> counts{};
  for (std::size_t i = 0; i < record.passes.cells.size(); ++i)
    if (record.sweepable.cells[i])
      ++counts[static_cast<std::size_t>(PropertyOf(record.passes.cells[i]))];
  return counts;
}

void WriteCellPicture(const Scenario& s, const EpisodeRecord& record,
                      const std::filesystem::path& png) {
  const auto counts = CountProperties(record);
  const auto all = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  const bool cells = s.spec.episode.drive == "cells";
  HeatMapOptions options;
  options.title = fmt::format("{}: J_hc {:.1f} %, J_cc {:.1f} %", PictureTitle(s.world),
                              100 * record.metrics.coverage, 100 * record.metrics.revisited);
  const double cell_m = record.passes_frame.cell_m;
  options.quantity =
      cells ? "of " + CountText(all, "cell") + " in reach"
            : "of " + NumberText(static_cast<double>(all) * cell_m * cell_m) + " m2 in reach";
  for (int i = 0; i < kNumCellProperties; ++i) {
    const auto property = static_cast<CellProperty>(i);
    const auto n = counts[static_cast<std::size_t>(i)];
    std::string label(Name(property));
    if (property != CellProperty::kOutOfReach) {
      const std::string share = FixedText(
          100 * static_cast<double>(n) / static_cast<double>(std::max<std::int64_t>(all, 1)), 1);
      label += cells ? fmt::format(": {}, {} %", FixedText(static_cast<double>(n), 0), share)
                     : ": " + share + " %";
    }
    options.categories.push_back({label, ColourOf(property)});
  }
  const double radius_m = s.spec.online.radius_m;
  if (!record.trace.empty())
    options.rings.push_back({{record.trace.back().x_m, record.trace.back().y_m},
                             radius_m,
                             "robot and its window, " + NumberText(radius_m) + " m",
                             kWindowBlue});
  ShowDrive(record, Way::kHidden, options);
  const HeatValues heat = CellProperties(s.world.site.map, record);
  WriteHeatMap(s.world.site.map, &heat, options, png);
}

}  // namespace floorproof

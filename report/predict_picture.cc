// SPDX-License-Identifier: Apache-2.0
#include "report/predict_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/quantity.h"
#include "render/heatmap.h"
#include "report/pictures.h"
#include "run/scenario/world.h"

namespace floorproof {
namespace {

constexpr double kRadius_m = 0.35;   // of what is coloured around a meeting
constexpr std::size_t kListed = 12;  // places
constexpr double kWorthAMark = 5e-4;

HeatValues Around(const HazardMap& map, const Prediction& prediction) {
  HeatValues heat{FineFrame(map.frame, 0.1), {}};
  heat.values = Grid<float>(heat.frame.width, heat.frame.height, HeatValues::kNone);
  const double cell_m = heat.frame.cell_m;
  const int reach = static_cast<int>(std::ceil(kRadius_m / cell_m));
  for (const PredictedMeeting& meeting : prediction.meetings) {
    if (meeting.expected.hazard.empty() || meeting.probability < kWorthAMark) continue;
    const Vec2 p_W(meeting.expected.x_m, meeting.expected.y_m);
    const Cell middle = heat.frame.ToCell(p_W);
    for (int iy = middle.iy - reach; iy <= middle.iy + reach; ++iy)
      for (int ix = middle.ix - reach; ix <= middle.ix + reach; ++ix) {
        if (!heat.values.Inside(ix, iy)) continue;
        if ((heat.frame.Center({ix, iy}) - p_W).norm() > kRadius_m) continue;
        float& value = heat.values(ix, iy);
        value = (std::isnan(value) ? 0 : value) + static_cast<float>(100 * meeting.probability);
      }
  }
  return heat;
}

}  // namespace

void WritePredictPicture(const World& world, const Prediction& prediction,
                         const std::filesystem::path& png) {
  HeatMapOptions options;
  const double fails = 1 - prediction.survival.no_failure.value;
  options.title = fmt::format("{}: {}{} of drives are predicted to fail", PictureTitle(world),
                              prediction.complete() ? "" : "at least ", PercentText(fails));
  options.quantity = "drives that end here";
  options.unit = "%";
  options.colour_map = ColourMap::kInferno;
  options.reversed = true;
  options.low = 0;
  options.plan = &prediction.plan.path;
  std::vector<const PredictedMeeting*> ranked;
  for (const PredictedMeeting& meeting : prediction.meetings)
    if (!meeting.expected.hazard.empty() && meeting.probability >= kWorthAMark)
      ranked.push_back(&meeting);
  std::ranges::stable_sort(ranked, std::ranges::greater(),
                           [](const PredictedMeeting* m) { return m->probability; });
  if (ranked.size() > kListed) ranked.resize(kListed);
  options.failures_by = "likeliest to end here";
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    const Encounter& met = ranked[i]->expected;
    options.failures.push_back({{met.x_m, met.y_m},
                                std::to_string(i + 1),
                                fmt::format("{}, {}: {}", met.hazard, Name(met.passage),
                                            PercentText(ranked[i]->probability))});
  }
  const HeatValues heat = Around(world.site.map, prediction);
  WriteHeatMap(world.site.map, &heat, options, png);
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "report/audit_pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/quantity.h"
#include "render/heatmap.h"
#include "report/curves.h"
#include "report/sample_marks.h"

namespace floorproof {
namespace {

constexpr Rgb kBoundary = {0, 150, 136}, kLength = {0, 114, 178};

}  // namespace

void WriteSamples(const std::string& title, const HazardMap& map, const PlanResult& plan,
                  const std::filesystem::path& png) {
  HeatMapOptions options;
  const auto reached = std::ranges::count_if(plan.samples, &SamplePlace::reachable);
  options.title = fmt::format("{}: {} of {} within reach", title, reached,
                              CountText(plan.samples.size(), "sample"));
  options.plan = &plan.path;
  options.series = SampleSeries();
  for (const std::string& series : options.series)  // those that tell more below the others
    for (const SamplePlace& sample : plan.samples)
      if (SampleSeriesOf(sample) == series) options.points.push_back({sample.p_W, series});
  if (!plan.boundary.empty())
    options.outlines.push_back({plan.boundary, "the room's boundary", kBoundary});
  WriteHeatMap(map, nullptr, options, png);
}

void WriteConvergence(const std::string& title, const PlanResult& plan,
                      const std::filesystem::path& png) {
  const std::vector<double>& best = plan.convergence_m;
  const auto along = [](std::size_t i) { return static_cast<double>(i + 1); };
  ChartPanel panel;
  panel.title = fmt::format("From {} to {} m in {}", FixedText(best.front(), 1),
                            FixedText(best.back(), 1), CountText(best.size(), "iteration"));
  panel.subtitle = "length of the best order so far [m]";
  panel.x_label = "iteration";
  panel.x_ticks = Ticks(static_cast<double>(best.size()));
  panel.series = {Curve(best.size(), kLength, along, [&](std::size_t i) { return best[i]; })};
  Chart chart;
  chart.title = title + ": convergence of the order of visit";
  chart.columns = 1;
  chart.plot_width_px = kCurve_px;
  chart.panels.push_back(std::move(panel));
  chart.legend = {{{"best order so far", LineOf(kLength)}}};
  WriteChart(chart, png);
}

}  // namespace floorproof

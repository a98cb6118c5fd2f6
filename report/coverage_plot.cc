// SPDX-License-Identifier: Apache-2.0
#include "report/coverage_plot.h"

#include <fmt/format.h>

#include <vector>

#include "base/quantity.h"
#include "report/carried.h"
#include "report/curves.h"
#include "run/episode/driven_way.h"

namespace floorproof {
namespace {

constexpr Rgb kCovered = {0, 114, 178}, kTwice = {213, 94, 0};

// The way driven up to each row. A trace has fewer places than the drive: its way, a little
// shorter, is stretched to the whole.
std::vector<double> WayAlong(const EpisodeRecord& record) {
  std::vector<double> way_m;
  DrivenWay way;
  Carried carried(record.interventions);
  for (const TraceRow& row : record.trace) {
    if (carried.Before(row)) way.Lift();
    way.Add({row.x_m, row.y_m});
    way_m.push_back(way.length_m());
  }
  const double stretch = way.length_m() > 0 ? record.metrics.path_length_m / way.length_m() : 1.0;
  for (double& length_m : way_m) length_m *= stretch;
  return way_m;
}

}  // namespace

Chart CoverageChart(const std::string& title, const EpisodeRecord& record) {
  const std::vector<TraceRow>& trace = record.trace;
  const Metrics& m = record.metrics;
  const std::vector<double> way_m = WayAlong(record);
  const auto curve = [&](const Rgb& colour, float TraceRow::*share, const auto& along, double end,
                         double end_share) {
    ChartSeries series = Curve(trace.size(), colour, along, [&](std::size_t i) {
      return 100 * static_cast<double>(trace[i].*share);
    });
    series.points.push_back({end, 100 * end_share, false});
    return series;
  };
  const auto panel_over = [&](const std::string& name, const std::string& x_label,
                              const auto& along, double end) {
    ChartPanel panel;
    panel.title = name;
    panel.subtitle = "share of the floor in reach [%]";
    panel.x_label = x_label;
    panel.x_ticks = Ticks(end);
    panel.series = {curve(kCovered, &TraceRow::coverage, along, end, m.coverage),
                    curve(kTwice, &TraceRow::revisited, along, end, m.revisited)};
    panel.y_end = 100;
    return panel;
  };
  Chart chart;
  chart.title = title + ": how it was covered";
  chart.notes = {
      fmt::format("at the end J_hc {:.1f} %, J_cc {:.1f} %", 100 * m.coverage, 100 * m.revisited)};
  chart.columns = 1;
  chart.plot_width_px = kCurve_px;
  chart.panels = {panel_over(
                      "Over time: " + TimeText(m.duration_s), "time [s]",
                      [&](std::size_t i) { return trace[i].t_s; }, m.duration_s),
                  panel_over(
                      "Over the way driven: " + FixedText(m.path_length_m, 1) + " m",
                      "path length [m]", [&](std::size_t i) { return way_m[i]; }, m.path_length_m)};
  chart.legend = {{{"J_hc, coverage rate: covered once or more", LineOf(kCovered)},
                   {"J_cc, overlapping coverage rate: covered twice or more", LineOf(kTwice)}}};
  return chart;
}

void WriteCoveragePlot(const std::string& title, const EpisodeRecord& record,
                       const std::filesystem::path& png) {
  if (!record.trace.empty()) WriteChart(CoverageChart(title, record), png);
}

}  // namespace floorproof

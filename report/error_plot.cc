// SPDX-License-Identifier: Apache-2.0
#include "report/error_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "render/chart.h"

namespace floorproof {
namespace {

constexpr int kWidth_px = 900;
constexpr Rgb kTrack = {0, 114, 178}, kError = {213, 94, 0}, kSpread = {120, 120, 120};

ChartStyle LineOf(const Rgb& colour) { return {colour, ChartStyle::Stroke::kSolid, false, false}; }

// The trace in as many parts as the plot has pixels, each by its greatest value: no peak is lost.
ChartSeries Curve(const std::vector<TraceRow>& trace, const Rgb& colour,
                  const std::function<double(const TraceRow&)>& value) {
  ChartSeries series;
  series.style = LineOf(colour);
  const std::size_t parts = std::min<std::size_t>(trace.size(), kWidth_px);
  for (std::size_t k = 0; k < parts; ++k) {
    const std::size_t begin = k * trace.size() / parts, end = (k + 1) * trace.size() / parts;
    ChartPoint point{trace[begin].t_s, 0, false};
    for (std::size_t i = begin; i < end; ++i) point.y = std::max(point.y, 1000 * value(trace[i]));
    series.points.push_back(point);
  }
  return series;
}

double EstimateError(const TraceRow& row) {
  return static_cast<double>(std::hypot(row.est_x_m - row.x_m, row.est_y_m - row.y_m));
}

std::vector<double> Ticks(double end_s) {
  double step = 1;
  for (int k = 0; end_s / step > 10; ++k) step *= k % 3 == 1 ? 2.5 : 2;  // 1, 2, 5, 10, ...
  std::vector<double> ticks;
  for (int k = 0; k * step <= end_s + step / 2; ++k) ticks.push_back(k * step);
  return ticks;
}

}  // namespace

void WriteErrorPlot(const std::string& title, const EpisodeRecord& record,
                    const std::filesystem::path& png) {
  const std::vector<TraceRow>& trace = record.trace;
  if (trace.empty()) return;
  const Metrics& m = record.metrics;
  Chart chart;
  chart.title = title + ": errors over time";
  chart.columns = 1;
  chart.plot_width_px = kWidth_px;
  const std::vector<double> ticks = Ticks(trace.back().t_s);
  const auto key = [](const char* label, const Rgb& colour) {
    return ChartKey{label, LineOf(colour)};
  };
  std::vector<ChartKey> keys = {key("true pose to the plan", kTrack)};
  chart.panels.push_back({fmt::format("Beside the plan: {:.0f} mm on the mean, {:.0f} mm at most",
                                      1000 * m.mean_cross_track_m, 1000 * m.max_cross_track_m),
                          "cross-track error [mm]",
                          "time [s]",
                          ticks,
                          {Curve(trace, kTrack, [](const TraceRow& row) {
                            return static_cast<double>(row.cross_track_m);
                          })}});
  if (m.max_estimate_error_m > 0) {
    chart.panels.push_back(
        {fmt::format("Beside where it thinks it is: {:.0f} mm on the mean, {:.0f} mm at most",
                     1000 * m.mean_estimate_error_m, 1000 * m.max_estimate_error_m),
         "error of the estimate, and its own spread [mm]",
         "time [s]",
         ticks,
         {Curve(trace, kSpread,
                [](const TraceRow& row) { return static_cast<double>(row.est_position_std_m); }),
          Curve(trace, kError, EstimateError)}});
    keys.push_back(key("error of the estimate", kError));
    keys.push_back(key("its spread", kSpread));
  }
  chart.legend = {keys};
  WriteChart(chart, png);
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "report/error_plot.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "report/curves.h"

namespace floorproof {
namespace {

constexpr Rgb kTrack = {0, 114, 178}, kError = {213, 94, 0}, kSpread = {120, 120, 120};

// A value in metres over time, in millimetres.
ChartSeries Millimetres(const std::vector<TraceRow>& trace, const Rgb& colour,
                        const std::function<double(const TraceRow&)>& value_m) {
  return Curve(
      trace.size(), colour, [&](std::size_t i) { return trace[i].t_s; },
      [&](std::size_t i) { return 1000 * value_m(trace[i]); });
}

double EstimateError(const TraceRow& row) {
  return static_cast<double>(std::hypot(row.est_x_m - row.x_m, row.est_y_m - row.y_m));
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
  chart.plot_width_px = kCurve_px;
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
                          {Millimetres(trace, kTrack, [](const TraceRow& row) {
                            return static_cast<double>(row.cross_track_m);
                          })}});
  if (m.max_estimate_error_m > 0) {
    chart.panels.push_back(
        {fmt::format("Beside where it thinks it is: {:.0f} mm on the mean, {:.0f} mm at most",
                     1000 * m.mean_estimate_error_m, 1000 * m.max_estimate_error_m),
         "error of the estimate, and its own spread [mm]",
         "time [s]",
         ticks,
         {Millimetres(
              trace, kSpread,
              [](const TraceRow& row) { return static_cast<double>(row.est_position_std_m); }),
          Millimetres(trace, kError, EstimateError)}});
    keys.push_back(key("error of the estimate", kError));
    keys.push_back(key("its spread", kSpread));
  }
  chart.legend = {keys};
  WriteChart(chart, png);
}

}  // namespace floorproof

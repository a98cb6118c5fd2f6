// SPDX-License-Identifier: Apache-2.0
#include "report/curves.h"

#include <algorithm>

namespace floorproof {

ChartSeries Curve(std::size_t rows, const Rgb& colour,
                  const std::function<double(std::size_t row)>& along,
                  const std::function<double(std::size_t row)>& value) {
  ChartSeries series;
  series.style = LineOf(colour);
  const std::size_t parts = std::min<std::size_t>(rows, kCurve_px);
  for (std::size_t k = 0; k < parts; ++k) {
    const std::size_t begin = k * rows / parts, end = (k + 1) * rows / parts;
    ChartPoint point{along(begin), 0, false};
    for (std::size_t i = begin; i < end; ++i) point.y = std::max(point.y, value(i));
    series.points.push_back(point);
  }
  return series;
}

std::vector<double> Ticks(double end) {
  double step = 1;
  for (int k = 0; end / step > 10; ++k) step *= k % 3 == 1 ? 2.5 : 2;  // 1, 2, 5, 10, ...
  std::vector<double> ticks;
  for (int k = 0; k * step <= end + step / 2; ++k) ticks.push_back(k * step);
  return ticks;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What was measured along a drive, as the curves of a chart.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "render/chart.h"

namespace floorproof {

inline constexpr int kCurve_px = 900;  // how wide such plots are

inline ChartStyle LineOf(const Rgb& colour) {
  return {colour, ChartStyle::Stroke::kSolid, false, false};
}

// `rows` values in as many parts as the plot has pixels, each by its greatest value: no peak is
// lost. Each part is at its first row's `along`.
ChartSeries Curve(std::size_t rows, const Rgb& colour,
                  const std::function<double(std::size_t row)>& along,
                  const std::function<double(std::size_t row)>& value);

// From 0 to about `end`, at most some ten, at 1, 2 or 5 times a power of ten.
std::vector<double> Ticks(double end);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Whether what was predicted to happen in a share of cases happens in that share.
#pragma once

#include <array>
#include <optional>
#include <span>

namespace floorproof {

// A predicted probability, and how often it came true.
struct Forecast {
  double p = 0;
  int k = 0, n = 1;
};

struct LogisticLine {
  double intercept = 0, slope = 1;
};
// The logistic regression of what came on the predictions' log odds, log(p / (1 - p)), by maximum
// likelihood (Cox, Biometrika 45 (1958) 562). Right predictions have intercept 0 and slope 1; too
// bold ones a slope below 1. Expects 0 < p < 1. None: fewer than ten of the cases came true, or
// fewer than ten did not, or all predictions are alike: nothing can be said.
std::optional<LogisticLine> CalibrationLine(std::span<const Forecast> forecasts);

// The same, of forecasts that count as one case each, however often they were tried (n 0: as none),
// penalised as if intercept and slope were known to be 0 and 1, to within this deviation.
LogisticLine PenalisedCalibrationLine(std::span<const Forecast> forecasts, double deviation);

// Cases whose predictions lie in one tenth of [0, 1].
struct CalibrationBin {
  double predicted = 0;  // sum over cases of p
  double variance = 0;   // of how many come true, if the predictions are right
  int k = 0, n = 0;
};
inline constexpr std::size_t kCalibrationBins = 10;
std::array<CalibrationBin, kCalibrationBins> BinForecasts(std::span<const Forecast> forecasts);

}  // namespace floorproof

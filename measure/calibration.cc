// SPDX-License-Identifier: Apache-2.0
// Newton's method; a step that lowers the likelihood is halved until it does not.
#include "measure/calibration.h"

#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

double LogLikelihood(std::span<const Forecast> forecasts, const LogisticLine& line) {
  double sum = 0;
  for (const Forecast& f : forecasts) {
    const double eta = line.intercept + line.slope * std::log(f.p / (1 - f.p));
    // -log(1 + exp(eta)), without overflow.
    const double log_not = -std::max(eta, 0.0) - std::log1p(std::exp(-std::abs(eta)));
    sum += f.k * eta + f.n * log_not;
  }
  return sum;
}

struct NewtonStep {
  double intercept = 0, slope = 0;
};
// None: all predictions are alike.
std::optional<NewtonStep> StepFrom(std::span<const Forecast> forecasts, const LogisticLine& line) {
  double g0 = 0, g1 = 0, h00 = 0, h01 = 0, h11 = 0;
  for (const Forecast& f : forecasts) {
    const double x = std::log(f.p / (1 - f.p));
    const double p = 1 / (1 + std::exp(-line.intercept - line.slope * x));
    const double w = f.n * p * (1 - p), missed = f.k - f.n * p;
    g0 += missed;
    g1 += missed * x;
    h00 += w;
    h01 += w * x;
    h11 += w * x * x;
  }
  const double det = h00 * h11 - h01 * h01;
  if (!(det > 1e-9 * h00 * h11)) return std::nullopt;
  return NewtonStep{(g0 * h11 - g1 * h01) / det, (g1 * h00 - g0 * h01) / det};
}

bool SaysEnough(std::span<const Forecast> forecasts) {
  constexpr int kLeastOfEach = 10;
  int k = 0, n = 0;
  for (const Forecast& f : forecasts) {
    k += f.k;
    n += f.n;
  }
  return std::min(k, n - k) >= kLeastOfEach;
}

}  // namespace

std::optional<LogisticLine> CalibrationLine(std::span<const Forecast> forecasts) {
  if (!SaysEnough(forecasts)) return std::nullopt;
  LogisticLine line{0, 0};
  double likelihood = LogLikelihood(forecasts, line);
  constexpr int kMostSteps = 50;
  for (int i = 0; i < kMostSteps; ++i) {
    const std::optional<NewtonStep> step = StepFrom(forecasts, line);
    if (!step) return i == 0 ? std::nullopt : std::optional(line);
    double share = 1, gained = 0;
    for (; share > 1e-6; share /= 2) {
      const LogisticLine next{line.intercept + share * step->intercept,
                              line.slope + share * step->slope};
      gained = LogLikelihood(forecasts, next) - likelihood;
      if (gained >= 0) {
        line = next;
        likelihood += gained;
        break;
      }
    }
    if (!(gained > 1e-12)) break;
  }
  return line;
}

std::array<CalibrationBin, kCalibrationBins> BinForecasts(std::span<const Forecast> forecasts) {
  std::array<CalibrationBin, kCalibrationBins> bins;
  for (const Forecast& f : forecasts) {
    const auto tenth = static_cast<std::size_t>(f.p * kCalibrationBins);
    CalibrationBin& bin = bins[std::min(tenth, kCalibrationBins - 1)];
    bin.predicted += f.n * f.p;
    bin.variance += f.n * f.p * (1 - f.p);
    bin.k += f.k;
    bin.n += f.n;
  }
  return bins;
}

}  // namespace floorproof

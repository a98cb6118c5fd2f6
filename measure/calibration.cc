// SPDX-License-Identifier: Apache-2.0
// Newton's method; a step that lowers the likelihood is halved until it does not.
#include "measure/calibration.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace floorproof {
namespace {

// So many cases of one log odds, of which k came true: shares of a case, too.
struct Cases {
  double x = 0, k = 0, n = 0;
};

// What is known of a line beforehand: it is `middle`, to within normal deviations of which these
// are the inverse squares; 0: nothing.
struct Known {
  LogisticLine middle;
  double intercept = 0, slope = 0;
};

double LogLikelihood(std::span<const Cases> all, const Known& known, const LogisticLine& line) {
  const double off0 = line.intercept - known.middle.intercept;
  const double off1 = line.slope - known.middle.slope;
  double sum = -(known.intercept * off0 * off0 + known.slope * off1 * off1) / 2;
  for (const Cases& f : all) {
    const double eta = line.intercept + line.slope * f.x;
    // -log(1 + exp(eta)), without overflow.
    const double log_not = -std::max(eta, 0.0) - std::log1p(std::exp(-std::abs(eta)));
    sum += f.k * eta + f.n * log_not;
  }
  return sum;
}

struct NewtonStep {
  double intercept = 0, slope = 0;
};
// None: all predictions are alike, and nothing is known.
std::optional<NewtonStep> StepFrom(std::span<const Cases> all, const Known& known,
                                   const LogisticLine& line) {
  double g0 = known.intercept * (known.middle.intercept - line.intercept);
  double g1 = known.slope * (known.middle.slope - line.slope);
  double h00 = known.intercept, h01 = 0, h11 = known.slope;
  for (const Cases& f : all) {
    const double p = 1 / (1 + std::exp(-line.intercept - line.slope * f.x));
    const double w = f.n * p * (1 - p), missed = f.k - f.n * p;
    g0 += missed;
    g1 += missed * f.x;
    h00 += w;
    h01 += w * f.x;
    h11 += w * f.x * f.x;
  }
  const double det = h00 * h11 - h01 * h01;
  if (!(det > 1e-9 * h00 * h11)) return std::nullopt;
  return NewtonStep{(g0 * h11 - g1 * h01) / det, (g1 * h00 - g0 * h01) / det};
}

std::optional<LogisticLine> FitLine(std::span<const Cases> all, const Known& known,
                                    LogisticLine line) {
  double likelihood = LogLikelihood(all, known, line);
  constexpr int kMostSteps = 50;
  for (int i = 0; i < kMostSteps; ++i) {
    const std::optional<NewtonStep> step = StepFrom(all, known, line);
    if (!step) return i == 0 ? std::nullopt : std::optional(line);
    double share = 1, gained = 0;
    for (; share > 1e-6; share /= 2) {
      const LogisticLine next{line.intercept + share * step->intercept,
                              line.slope + share * step->slope};
      gained = LogLikelihood(all, known, next) - likelihood;
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
  std::vector<Cases> all;
  for (const Forecast& f : forecasts)
    all.push_back({std::log(f.p / (1 - f.p)), static_cast<double>(f.k), static_cast<double>(f.n)});
  return FitLine(all, {}, {0, 0});
}

LogisticLine PenalisedCalibrationLine(std::span<const Forecast> forecasts, double deviation) {
  const double precision = 1 / (deviation * deviation);
  std::vector<Cases> all;
  for (const Forecast& f : forecasts)
    if (f.n > 0) all.push_back({std::log(f.p / (1 - f.p)), static_cast<double>(f.k) / f.n, 1});
  return *FitLine(all, {{0, 1}, precision, precision}, {0, 1});
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

// SPDX-License-Identifier: Apache-2.0
// How well predictions of plans hold against drives of these plans.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "measure/calibration.h"
#include "stats/interval.h"

namespace floorproof {

// A plan of a site, and how many of its drives failed.
struct JudgedPlan {
  int site = 0;
  Forecast failure;
};

// None: nothing can be said. Drives count alike, those of one plan and those of another.
struct PredictionFigures {
  std::optional<double>
      log_score;  // mean log of what was predicted for what came, a drive, in nats
  // Mean square of prediction - outcome, a drive, and Murphy's three parts of it (J. Appl. Meteor.
  // 12 (1973) 595), in ten equally wide bins of prediction: Brier = reliability - resolution +
  // uncertainty, but for the spread of predictions within a bin.
  std::optional<double> brier, reliability, resolution, uncertainty;
  std::optional<double> slope, intercept;   // CalibrationLine
  std::optional<double> calibration_error;  // mean distance of prediction and share, in these bins
  std::optional<double> mean_error;         // |predicted - share that failed|, mean over plans
};
struct PredictionFigure {
  std::string_view name;
  std::optional<double> PredictionFigures::*member;
};
inline constexpr std::array<PredictionFigure, 9> kPredictionFigures = {{
    {"log score", &PredictionFigures::log_score},
    {"Brier score", &PredictionFigures::brier},
    {"reliability", &PredictionFigures::reliability},
    {"resolution", &PredictionFigures::resolution},
    {"uncertainty", &PredictionFigures::uncertainty},
    {"calibration slope", &PredictionFigures::slope},
    {"calibration intercept", &PredictionFigures::intercept},
    {"calibration error", &PredictionFigures::calibration_error},
    {"mean error", &PredictionFigures::mean_error},
}};
// Predictions count as no surer than 1e-4 and 1 - 1e-4: one surprise does not outweigh all else.
PredictionFigures FiguresOf(std::span<const JudgedPlan> plans);

// Figures with the ends of their 95 % range.
struct RangedFigures {
  PredictionFigures value, lower, upper;
};
struct PredictionJudgement {
  int sites = 0, plans = 0, drives = 0, failures = 0;
  RangedFigures seen;   // the range: bootstrap by site, so that plans of one site stay together
  RangedFigures right;  // what these predictions would show if each were right: mean and range
};
// The same plans give the same figures. Takes `repeats` evaluations of all figures twice.
PredictionJudgement JudgePredictions(std::span<const JudgedPlan> plans, int repeats = 1000);

// A point of the reliability diagram: drives whose prediction lies in one tenth of [0, 1].
struct ReliabilityPoint {
  double predicted = 0;  // mean
  int k = 0, n = 0;
  Interval share;  // that failed: exact, 95 %
};
// Of the bins that hold drives, ascending.
std::vector<ReliabilityPoint> ReliabilityPoints(std::span<const JudgedPlan> plans);

// On how many sites `a` has the better log score than `b`, both of the same plans in the same
// order; a draw counts for neither.
struct SitesWon {
  int a = 0, b = 0, sites = 0;
  Interval share_of_a;  // of all sites: exact, 95 %
};
SitesWon CompareBySite(std::span<const JudgedPlan> a, std::span<const JudgedPlan> b);

}  // namespace floorproof

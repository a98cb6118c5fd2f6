// SPDX-License-Identifier: Apache-2.0
// Rates of exposures are fitted by expectation and maximisation (Dempster et al., J. R. Stat. Soc.
// B 39 (1977) 1): a drive has Poisson many failures of each kind, of which the first ends it. The
// likelihood has one maximum, as log(1 - exp(-x)) is concave; rates stay at least 0.
#include "measure/expert_predictors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace floorproof {
namespace {

double FailuresExpected(std::span<const double> rates, std::span<const double> exposures) {
  return std::inner_product(rates.begin(), rates.end(), exposures.begin(), 0.0);
}

}  // namespace

double FitConstant(std::span<const TrainingPlan> plans) {
  double k = 0, n = 0;
  for (const TrainingPlan& plan : plans) {
    k += plan.k;
    n += plan.n;
  }
  return n > 0 ? k / n : std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> FitRatesOfExposures(std::span<const TrainingPlan> plans) {
  if (plans.empty()) return {};
  const std::size_t kinds = plans[0].exposures.size();
  std::vector<double> exposed(kinds, 0.0), rates(kinds, 0.0);
  for (const TrainingPlan& plan : plans)
    for (std::size_t i = 0; i < kinds; ++i) exposed[i] += plan.n * plan.exposures[i];
  for (std::size_t i = 0; i < kinds; ++i) rates[i] = exposed[i] > 0 ? 1 / exposed[i] : 0;
  constexpr int kMostSteps = 20'000;
  for (int step = 0; step < kMostSteps; ++step) {
    std::vector<double> failures(kinds, 0.0);  // of each kind, as they are expected
    for (const TrainingPlan& plan : plans) {
      const double hazard = FailuresExpected(rates, plan.exposures);
      if (plan.k == 0 || hazard <= 0) continue;
      for (std::size_t i = 0; i < kinds; ++i)
        failures[i] += plan.k * rates[i] * plan.exposures[i] / -std::expm1(-hazard);
    }
    double moved = 0;
    for (std::size_t i = 0; i < kinds; ++i) {
      if (exposed[i] <= 0) continue;
      const double next = failures[i] / exposed[i];
      moved = std::max(moved, std::abs(next - rates[i]) * exposed[i]);
      rates[i] = next;
    }
    constexpr double kStill = 1e-9;  // failures
    if (moved < kStill) break;
  }
  return rates;
}

double FailureOfExposures(std::span<const double> rates, std::span<const double> exposures) {
  return -std::expm1(-FailuresExpected(rates, exposures));
}

ClassNumbers MeetingsOfClasses(std::span<const Encounter> encounters,
                               const std::map<std::string, HazardClass>& class_of_type) {
  ClassNumbers meetings = {};
  for (const Encounter& e : encounters)
    if (const auto at = class_of_type.find(e.type); at != class_of_type.end())
      ++meetings[static_cast<std::size_t>(at->second)];
  return meetings;
}

ClassNumbers OccurrenceOfClasses(std::span<const Encounter> encounters,
                                 const std::map<std::string, HazardClass>& class_of_type) {
  std::vector<Encounter> ended, failed;
  for (const Encounter& e : encounters) {
    if (e.outcome == Encounter::Outcome::kCensored) continue;
    ended.push_back(e);
    if (e.outcome == Encounter::Outcome::kFailed) failed.push_back(e);
  }
  const ClassNumbers met = MeetingsOfClasses(ended, class_of_type);
  ClassNumbers occurrence = MeetingsOfClasses(failed, class_of_type);
  for (std::size_t c = 0; c < occurrence.size(); ++c)
    if (met[c] > 0) occurrence[c] /= met[c];
  return occurrence;
}

ModeNumbers ExpertFailures(const FmeaTables& tables, const ClassNumbers& occurrence,
                           const ClassNumbers& meetings) {
  ModeNumbers rates = {};
  for (std::size_t c = 0; c < occurrence.size(); ++c) {
    if (meetings[c] <= 0 || occurrence[c] <= 0) continue;
    const double rate = -std::log1p(-occurrence[c]) * meetings[c];
    for (std::size_t m = 0; m < rates.size(); ++m) rates[m] += rate * tables.mode_of_class[c][m];
  }
  return FirstFailures(rates);
}

}  // namespace floorproof

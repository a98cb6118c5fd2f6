// SPDX-License-Identifier: Apache-2.0
#include "measure/judge_predictions.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/streams.h"
#include "stats/binomial.h"
#include "stats/quantile.h"

namespace floorproof {
namespace {

constexpr double kSurest = 1e-4;

Forecast Bounded(const Forecast& forecast) {
  return {std::clamp(forecast.p, kSurest, 1 - kSurest), forecast.k, forecast.n};
}

// Summed over its drives.
double LogScore(const Forecast& forecast) {
  const Forecast f = Bounded(forecast);
  return f.k * std::log(f.p) + (f.n - f.k) * std::log1p(-f.p);
}

void SetParts(std::span<const Forecast> forecasts, double drives, double base,
              PredictionFigures& figures) {
  double reliability = 0, resolution = 0, error = 0;
  for (const CalibrationBin& bin : BinForecasts(forecasts)) {
    if (bin.n == 0) continue;
    const double share = static_cast<double>(bin.k) / bin.n, off = bin.predicted / bin.n - share;
    const double weight = bin.n / drives;
    reliability += weight * off * off;
    resolution += weight * (share - base) * (share - base);
    error += weight * std::abs(off);
  }
  figures.reliability = reliability;
  figures.resolution = resolution;
  figures.uncertainty = base * (1 - base);
  figures.calibration_error = error;
}

std::map<int, std::vector<JudgedPlan>> BySite(std::span<const JudgedPlan> plans) {
  std::map<int, std::vector<JudgedPlan>> sites;
  for (const JudgedPlan& plan : plans) sites[plan.site].push_back(plan);
  return sites;
}

std::vector<JudgedPlan> SitesAgain(const std::map<int, std::vector<JudgedPlan>>& by_site,
                                   Stream& random) {
  std::vector<const std::vector<JudgedPlan>*> sites;
  for (const auto& [site, plans] : by_site) sites.push_back(&plans);
  std::vector<JudgedPlan> drawn;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const std::vector<JudgedPlan>& plans = *sites[random.Below(sites.size())];
    drawn.insert(drawn.end(), plans.begin(), plans.end());
  }
  return drawn;
}

// Plans of one site share their drives' conditions, and are taken to fail together.
std::vector<JudgedPlan> DrivenAsPredicted(std::span<const JudgedPlan> plans, Stream& random) {
  std::vector<JudgedPlan> drawn(plans.begin(), plans.end());
  std::map<int, std::vector<double>> conditions;  // by site, by drive
  for (JudgedPlan& plan : drawn) {
    plan.failure.k = 0;
    std::vector<double>& of_site = conditions[plan.site];
    while (static_cast<int>(of_site.size()) < plan.failure.n) of_site.push_back(random.Uniform());
    for (int i = 0; i < plan.failure.n; ++i)
      plan.failure.k += of_site[static_cast<std::size_t>(i)] < plan.failure.p;
  }
  return drawn;
}

// Repeats of which a figure cannot be said do not count for it.
void SetRange(const std::vector<PredictionFigures>& repeats, RangedFigures& of, bool mean) {
  for (const PredictionFigure& figure : kPredictionFigures) {
    std::vector<double> values;
    double sum = 0;
    for (const PredictionFigures& repeat : repeats)
      if (const auto value = repeat.*figure.member) {
        values.push_back(*value);
        sum += *value;
      }
    if (values.empty()) continue;
    std::ranges::sort(values);
    of.lower.*figure.member = Quantile(values, (1 - kReportedConfidence) / 2);
    of.upper.*figure.member = Quantile(values, (1 + kReportedConfidence) / 2);
    if (mean) of.value.*figure.member = sum / static_cast<double>(values.size());
  }
}

}  // namespace

PredictionFigures FiguresOf(std::span<const JudgedPlan> plans) {
  double log_score = 0, brier = 0, error = 0, k = 0, n = 0;
  int driven_plans = 0;
  std::vector<Forecast> forecasts;
  for (const JudgedPlan& plan : plans) {
    const Forecast& f = plan.failure;
    if (f.n == 0) continue;
    ++driven_plans;
    forecasts.push_back(Bounded(f));
    log_score += LogScore(f);
    brier += f.k * (1 - f.p) * (1 - f.p) + (f.n - f.k) * f.p * f.p;
    error += std::abs(f.p - static_cast<double>(f.k) / f.n);
    k += f.k;
    n += f.n;
  }
  PredictionFigures figures;
  if (n == 0) return figures;
  figures.log_score = log_score / n;
  figures.brier = brier / n;
  figures.mean_error = error / driven_plans;
  SetParts(forecasts, n, k / n, figures);
  if (const auto line = CalibrationLine(forecasts)) {
    figures.slope = line->slope;
    figures.intercept = line->intercept;
  }
  return figures;
}

PredictionJudgement JudgePredictions(std::span<const JudgedPlan> plans, int repeats) {
  PredictionJudgement judgement;
  judgement.plans = static_cast<int>(plans.size());
  for (const JudgedPlan& plan : plans) {
    judgement.drives += plan.failure.n;
    judgement.failures += plan.failure.k;
  }
  const std::map<int, std::vector<JudgedPlan>> by_site = BySite(plans);
  judgement.sites = static_cast<int>(by_site.size());
  judgement.seen.value = FiguresOf(plans);
  std::vector<PredictionFigures> again, as_predicted;
  for (int i = 0; i < repeats; ++i) {
    Stream sites(0, static_cast<std::uint64_t>(i), "sites_again");
    again.push_back(FiguresOf(SitesAgain(by_site, sites)));
    Stream drives(0, static_cast<std::uint64_t>(i), "driven_as_predicted");
    as_predicted.push_back(FiguresOf(DrivenAsPredicted(plans, drives)));
  }
  SetRange(again, judgement.seen, false);
  SetRange(as_predicted, judgement.right, true);
  return judgement;
}

std::vector<ReliabilityPoint> ReliabilityPoints(std::span<const JudgedPlan> plans) {
  std::vector<Forecast> forecasts;
  for (const JudgedPlan& plan : plans) forecasts.push_back(plan.failure);
  std::vector<ReliabilityPoint> points;
  for (const CalibrationBin& bin : BinForecasts(forecasts))
    if (bin.n > 0)
      points.push_back(
          {bin.predicted / bin.n, bin.k, bin.n, ClopperPearson(bin.k, bin.n, kReportedConfidence)});
  return points;
}

SitesWon CompareBySite(std::span<const JudgedPlan> a, std::span<const JudgedPlan> b) {
  std::map<int, double> lead;  // of a, by site
  for (std::size_t i = 0; i < a.size(); ++i)
    lead[a[i].site] += LogScore(a[i].failure) - LogScore(b[i].failure);
  SitesWon won;
  won.sites = static_cast<int>(lead.size());
  constexpr double kDraw = 1e-9;  // rounding
  for (const auto& [site, by] : lead) {
    won.a += by > kDraw;
    won.b += by < -kDraw;
  }
  won.share_of_a = ClopperPearson(won.a, won.sites, kReportedConfidence);
  return won;
}

}  // namespace floorproof

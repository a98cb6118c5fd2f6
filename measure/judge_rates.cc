// SPDX-License-Identifier: Apache-2.0
#include "measure/judge_rates.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/streams.h"
#include "planners/risk/rate_evaluator.h"

namespace floorproof {
namespace {

constexpr double kLeast = 1e-12;  // nothing is predicted to be impossible

double FailureOf(const JudgedEncounter& judged) { return Total(judged.first); }

struct Line {
  double intercept = 0, slope = 1;
};

// By Newton's method.
Line LogisticLine(const std::vector<double>& log_odds, const std::vector<bool>& failed) {
  Line line;
  for (int step = 0; step < 50; ++step) {
    double g0 = 0, g1 = 0, h00 = 0, h01 = 0, h11 = 0;
    for (std::size_t i = 0; i < log_odds.size(); ++i) {
      const double x = log_odds[i];
      const double p = 1 / (1 + std::exp(-line.intercept - line.slope * x)), w = p * (1 - p);
      g0 += failed[i] - p;
      g1 += (failed[i] - p) * x;
      h00 += w;
      h01 += w * x;
      h11 += w * x * x;
    }
    const double det = h00 * h11 - h01 * h01;
    if (!(det > 1e-9 * h00 * h11)) break;  // all predictions alike
    line.intercept += (g0 * h11 - g1 * h01) / det;
    line.slope += (g1 * h00 - g0 * h01) / det;
  }
  return line;
}

}  // namespace

RateJudgement Judge(std::span<const JudgedEncounter> judged) {
  RateJudgement of;
  of.encounters = static_cast<int>(judged.size());
  if (judged.empty()) return of;
  const double n = static_cast<double>(judged.size());
  constexpr int kBins = 10;
  struct Bin {
    double predicted = 0, failed = 0, variance = 0;
  };
  std::array<Bin, kBins> bins;
  std::array<double, 1 + kNumFailureModes> outcomes = {};
  std::vector<double> log_odds;
  std::vector<bool> failed;
  for (const JudgedEncounter& each : judged) {
    const double p = std::clamp(FailureOf(each), kLeast, 1 - kLeast);
    const bool failure = each.mode >= 0;
    of.failures += failure;
    of.log_loss -= std::log(failure ? std::max(each.first[each.mode], kLeast) : 1 - p) / n;
    ++outcomes[each.mode + 1];
    Bin& bin = bins[std::min(kBins - 1, static_cast<int>(p * kBins))];
    bin.predicted += p;
    bin.failed += failure;
    bin.variance += p * (1 - p);
    log_odds.push_back(std::log(p / (1 - p)));
    failed.push_back(failure);
  }
  for (const double count : outcomes)
    if (count > 0) of.log_loss_of_constant -= count / n * std::log(count / n);
  for (const Bin& bin : bins) {
    of.calibration_error += std::abs(bin.predicted - bin.failed) / n;
    of.calibration_error_by_chance += std::sqrt(2 / std::acos(-1.0) * bin.variance) / n;
  }
  constexpr int kLeastOfEach = 10;
  if (std::min(of.failures, of.encounters - of.failures) >= kLeastOfEach) {
    const Line line = LogisticLine(log_odds, failed);
    of.slope = line.slope;
    of.intercept = line.intercept;
  }
  return of;
}

std::vector<JudgedEncounter> Predicted(const RiskModel& model,
                                       const std::vector<Encounter>& encounters) {
  std::map<const KindRates*, RateEvaluator> evaluators;
  std::vector<JudgedEncounter> judged;
  for (const Encounter& e : encounters) {
    const KindRates* kind = FindKind(model, e.type, e.passage);
    if (kind == nullptr || kind->per_metre || e.outcome == Encounter::Outcome::kCensored) continue;
    const RateEvaluator& rates = evaluators.try_emplace(kind, *kind).first->second;
    Covariates covariates(kind->axes, model.mirrored, e.size);
    const bool failed = e.outcome == Encounter::Outcome::kFailed;
    judged.push_back(
        {FirstFailures(rates.At(covariates.Of(e.at))), failed ? static_cast<int>(e.mode) : -1});
  }
  return judged;
}

HoldOut JudgeByHoldOut(const std::vector<Encounter>& encounters, const RateFitOptions& options,
                       int parts) {
  Stream random(0, 0, "hold_out");
  std::vector<int> part_of;
  for (std::size_t i = 0; i < encounters.size(); ++i)
    part_of.push_back(static_cast<int>(random.Below(parts)));
  std::map<std::pair<std::string, Passage>, std::vector<JudgedEncounter>> by_kind;
  std::vector<JudgedEncounter> all;
  for (int part = 0; part < parts; ++part) {
    std::vector<Encounter> fitted;
    std::map<std::pair<std::string, Passage>, std::vector<Encounter>> fresh;
    for (std::size_t i = 0; i < encounters.size(); ++i)
      if (part_of[i] == part)
        fresh[{encounters[i].type, encounters[i].passage}].push_back(encounters[i]);
      else
        fitted.push_back(encounters[i]);
    const RiskModel model = FitRates(fitted, {}, options);
    for (const auto& [name, met] : fresh) {
      const std::vector<JudgedEncounter> judged = Predicted(model, met);
      std::vector<JudgedEncounter>& of_kind = by_kind[name];
      of_kind.insert(of_kind.end(), judged.begin(), judged.end());
      all.insert(all.end(), judged.begin(), judged.end());
    }
  }
  HoldOut hold_out;
  hold_out.of_all = Judge(all);
  for (const auto& [name, judged] : by_kind)
    if (!judged.empty()) hold_out.kinds.push_back({name.first, name.second, Judge(judged)});
  return hold_out;
}

}  // namespace floorproof

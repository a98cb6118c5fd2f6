// SPDX-License-Identifier: Apache-2.0
#include "measure/judge_rates.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/streams.h"
#include "measure/calibration.h"
#include "measure/shared_frailty.h"

namespace floorproof {
namespace {

constexpr double kLeast = 1e-12;  // nothing is predicted to be impossible

double FailureOf(const JudgedEncounter& judged) { return Total(judged.first); }

}  // namespace

RateJudgement Judge(std::span<const JudgedEncounter> judged) {
  RateJudgement of;
  of.encounters = static_cast<int>(judged.size());
  if (judged.empty()) return of;
  const double n = static_cast<double>(judged.size());
  std::array<double, 1 + kNumFailureModes> outcomes = {};
  std::vector<Forecast> forecasts;
  for (const JudgedEncounter& each : judged) {
    const double p = std::clamp(FailureOf(each), kLeast, 1 - kLeast);
    const bool failure = each.mode >= 0;
    of.failures += failure;
    of.log_loss -= std::log(failure ? std::max(each.first[each.mode], kLeast) : 1 - p) / n;
    ++outcomes[each.mode + 1];
    forecasts.push_back({p, failure, 1});
  }
  for (const double count : outcomes)
    if (count > 0) of.log_loss_of_constant -= count / n * std::log(count / n);
  for (const CalibrationBin& bin : BinForecasts(forecasts)) {
    of.calibration_error += std::abs(bin.predicted - bin.k) / n;
    of.calibration_error_by_chance += std::sqrt(2 / std::acos(-1.0) * bin.variance) / n;
  }
  if (const auto line = CalibrationLine(forecasts)) {
    of.slope = line->slope;
    of.intercept = line->intercept;
  }
  return of;
}

std::vector<JudgedEncounter> Predicted(const ModelRates& model,
                                       const std::vector<Encounter>& encounters) {
  std::vector<JudgedEncounter> judged;
  for (const Encounter& e : encounters) {
    const RateEvaluator* rates = model.Find(e.type, e.passage, e.at);
    if (rates == nullptr || rates->kind().per_metre || e.outcome == Encounter::Outcome::kCensored)
      continue;
    Covariates covariates(rates->kind().axes, model.model().mirrored, e.size);
    const bool failed = e.outcome == Encounter::Outcome::kFailed;
    judged.push_back(
        {FirstFailures(rates->At(covariates.Of(e.at))), failed ? static_cast<int>(e.mode) : -1});
  }
  return judged;
}

HoldOut JudgeByHoldOut(const std::vector<Encounter>& all_met, const RateFitOptions& options,
                       int parts) {
  const std::vector<Encounter> encounters = FirstMeetings(all_met);
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
    const ModelRates rates(model);
    for (const auto& [name, met] : fresh) {
      const std::vector<JudgedEncounter> judged = Predicted(rates, met);
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

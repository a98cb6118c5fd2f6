// SPDX-License-Identifier: Apache-2.0
#include "measure/shared_frailty.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "base/round.h"
#include "planners/risk/model_rates.h"

namespace floorproof {
namespace {

// The rates of all failures in the meetings with one hazard that are of one kind, and whether the
// last one failed.
struct Repeated {
  std::vector<double> totals;
  bool failed = false;
};

// What of other kinds came between only says how long these went on: of each kind by itself the
// likelihood is as if there were no other.
std::vector<Repeated> RepeatedOf(const ModelRates& model, Manner manner,
                                 const std::vector<std::vector<const Encounter*>>& meetings) {
  std::vector<Repeated> repeated;
  for (const std::vector<const Encounter*>& met : meetings) {
    if (met.size() < 2) continue;
    Repeated each;
    for (const Encounter* e : met) {
      if (e->outcome == Encounter::Outcome::kCensored || each.failed) break;
      const RateEvaluator* rates = model.Find(e->type, e->passage, e->at);
      if (rates == nullptr || rates->kind().manner != manner) continue;
      Covariates covariates(rates->kind().axes, model.model().mirrored, e->size);
      each.totals.push_back(Total(rates->At(covariates.Of(e->at))));
      each.failed = e->outcome == Encounter::Outcome::kFailed;
    }
    if (each.totals.size() > 1) repeated.push_back(std::move(each));
  }
  return repeated;
}

double LogLikelihood(const std::vector<Repeated>& repeated, double theta) {
  constexpr double kLeast = 1e-12;  // of a probability: no single drive decides
  double sum = 0;
  for (const Repeated& each : repeated) {
    double powers = 0, before = 0, after = 0;
    for (const double total : each.totals) {
      before = after;
      powers += std::pow(total, theta);
      after = std::pow(powers, 1 / theta);
    }
    sum += each.failed ? std::log(std::max(kLeast, std::exp(-before) - std::exp(-after))) : -after;
  }
  return sum;
}

double Likeliest(const std::vector<Repeated>& repeated) {
  constexpr std::size_t kFewest = 20;  // hazards that were met again
  constexpr double kMostTheta = 32;
  constexpr double kGain = 1.92;  // of log likelihood: 95 % of chi square with one degree, halved
  constexpr int kSteps = 64, kHalvings = 30;
  if (repeated.size() < kFewest) return 1;
  const auto value = [&](double log_theta) {
    return LogLikelihood(repeated, std::exp(log_theta)) - log_theta;
  };
  // The best of a grid, then between its neighbours.
  const double step = std::log(kMostTheta) / kSteps;
  double best = 0, most = value(0);
  for (int i = 1; i <= kSteps; ++i)
    if (const double here = value(i * step); here > most) best = i * step, most = here;
  double low = std::max(0.0, best - step), high = std::min(std::log(kMostTheta), best + step);
  for (int i = 0; i < kHalvings; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (value(a) < value(b) ? low : high) = value(a) < value(b) ? a : b;
  }
  const double found = (low + high) / 2;
  return value(found) - value(0) > kGain ? RoundedTo6(std::exp(found)) : 1;
}

}  // namespace

std::vector<std::vector<const Encounter*>> MeetingsOfDrives(
    const std::vector<Encounter>& encounters) {
  std::vector<std::vector<const Encounter*>> all;
  std::map<std::tuple<int, std::string, std::string, Passage>, std::size_t> known;
  for (const Encounter& e : encounters) {
    std::size_t at = all.size();
    if (e.drive >= 0 && !e.hazard.empty())
      at = known.try_emplace({e.drive, e.hazard, e.type, e.passage}, at).first->second;
    if (at == all.size()) all.emplace_back();
    all[at].push_back(&e);
  }
  return all;
}

std::vector<Encounter> FirstMeetings(const std::vector<Encounter>& encounters) {
  std::vector<Encounter> first;
  for (const std::vector<const Encounter*>& met : MeetingsOfDrives(encounters))
    first.push_back(*met.front());
  return first;
}

void SetSharedFrailty(const std::vector<Encounter>& encounters, RiskModel& model) {
  const std::vector<std::vector<const Encounter*>> meetings = MeetingsOfDrives(encounters);
  const ModelRates rates(model);
  for (const Manner manner : {Manner::kAny, Manner::kStraight, Manner::kTurning}) {
    const double theta = Likeliest(RepeatedOf(rates, manner, meetings));
    for (KindRates& kind : model.kinds)
      if (kind.manner == manner && !kind.per_metre) kind.theta = theta;
  }
}

}  // namespace floorproof

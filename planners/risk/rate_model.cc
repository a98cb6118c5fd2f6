// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/rate_model.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "env/geometry/geometry.h"

namespace floorproof {
namespace {

// Ends are rounded to 6 digits.
constexpr double kRounding = 1e-5;

// One of a pair of mirror images: the travel comes from the right of the normal, or along it. What
// turns are, both ways added up, they have in common.
Approach Unmirrored(Approach at) {
  if (at.heading_rad >= 0) return at;
  at.heading_rad = -at.heading_rad;
  at.lead_rad = -at.lead_rad;
  return at;
}

double RiseOf(const std::vector<std::pair<std::string, double>>& size) {
  constexpr std::string_view kKeys[] = {"height_m", "depth_m", "amplitude_m", "level_m"};
  double rise_m = 0;
  for (const auto& [key, value] : size)
    if (std::ranges::find(kKeys, key) != std::end(kKeys))
      rise_m = std::max(rise_m, std::abs(value));
  return rise_m;
}

}  // namespace

double AmountOf(const Encounter& encounter) {
  constexpr double kCutShort = 0.5;
  if (IsExposure(encounter.type)) return encounter.way_m;
  return encounter.outcome == Encounter::Outcome::kCensored ? kCutShort : 1;
}

FailureMode LastMode(const KindRates& kind) {
  int last = kNumFailureModes * (kNumFailureModes - 1) / 2;  // all modes' numbers together
  for (const ModeSplit& split : kind.splits) last -= static_cast<int>(split.mode);
  return FailureMode(last);
}

bool IsAbout(const KindRates& kind, std::string_view type, Passage passage, const Approach& at) {
  return kind.type == type && kind.passage == passage &&
         (kind.manner == Manner::kAny || kind.manner == MannerOf(at));
}

std::string TextOf(const KindRates& kind) {
  std::string text = kind.type + " " + std::string(Name(kind.passage));
  if (kind.manner != Manner::kAny) text += " " + std::string(Name(kind.manner));
  return text;
}

Covariates::Covariates(const std::vector<RateAxis>& axes, bool mirrored,
                       const std::vector<std::pair<std::string, double>>& size)
    : mirrored_(mirrored), x_(axes.size()) {
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const auto stated = std::find_if(size.begin(), size.end(), [&](const auto& key) {
      return axes[a].of_hazard && key.first == axes[a].name;
    });
    const auto column = std::find_if(kApproach.begin(), kApproach.end(), [&](const auto& each) {
      return !axes[a].of_hazard && each.name == axes[a].name;
    });
    const auto derived = std::find_if(kDerived.begin(), kDerived.end(), [&](const auto& each) {
      return !axes[a].of_hazard && each.name == axes[a].name;
    });
    if (stated != size.end()) {
      x_[a] = stated->second;
      if (mirrored_ && axes[a].name == "rise_across") across_ = {a, stated->second};
    } else if (axes[a].of_hazard && axes[a].name == kRise)
      x_[a] = RiseOf(size);
    else if (derived != kDerived.end())
      derived_.emplace_back(a, derived->of);
    else if (column != kApproach.end())
      of_approach_.emplace_back(a, column->member);
    else
      throw InputError("the risk model's rates depend on " + axes[a].name +
                       ", which the hazard does not state");
  }
}

std::span<const double> Covariates::Of(const Approach& at) {
  const Approach met = mirrored_ ? Unmirrored(at) : at;
  for (const auto& [axis, member] : of_approach_) x_[axis] = met.*member;
  for (const auto& [axis, of] : derived_) x_[axis] = of(met);
  if (across_) x_[across_->first] = at.heading_rad < 0 ? -across_->second : across_->second;
  return x_;
}

double AskewOf(const Approach& at) {
  return std::abs(std::remainder(at.heading_rad - at.lead_rad, kPi / 2));
}

double Beyond(const RateAxis& axis, double x) {
  if (axis.period > 0) {
    x = axis.lower + std::fmod(x - axis.lower, axis.period);
    if (x < axis.lower) x += axis.period;
  }
  const double range = axis.upper - axis.lower;
  const double out = std::max({0.0, axis.lower - x, x - axis.upper});
  if (out <= kRounding * std::max(1.0, std::abs(axis.lower))) return 0;
  // Within a gap of a period the nearer end counts.
  const double near = axis.period > 0 ? std::min(out, axis.lower + axis.period - x) : out;
  if (near <= kRounding) return 0;
  if (range > 0) return near / range;
  return near / (axis.lower != 0 ? std::abs(axis.lower) : 1);
}

bool IsFarBeyond(const RateAxis& axis, double x) {
  constexpr double kShare = 0.25, kFactor = 1.5;
  constexpr std::string_view kScales[] = {"friction", "mass_kg", "clearance_m"};
  if (Beyond(axis, x) > kShare) return true;
  const bool is_scale =
      axis.of_hazard || std::ranges::find(kScales, axis.name) != std::end(kScales);
  return is_scale && axis.period == 0 && axis.lower > 0 &&
         (x * kFactor < axis.lower || x > kFactor * axis.upper);
}

double RateOf(double eta) { return eta > 30 ? eta : std::log1p(std::exp(eta)); }
double EtaOf(double rate) { return rate > 30 ? rate : std::log(std::expm1(rate)); }

double Total(const ModeNumbers& rates) {
  double sum = 0;
  for (const double rate : rates) sum += rate;
  return sum;
}

ModeNumbers FirstFailures(const ModeNumbers& rates) {
  const double total = Total(rates);
  const double share = total > 0 ? -std::expm1(-total) / total : 0;
  ModeNumbers first = rates;
  for (double& p : first) p *= share;
  return first;
}

}  // namespace floorproof

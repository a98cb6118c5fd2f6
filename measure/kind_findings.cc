// SPDX-License-Identifier: Apache-2.0
#include "measure/kind_findings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "planners/risk/rate_evaluator.h"
#include "stats/equal_bins.h"

namespace floorproof {
namespace {

constexpr int kGroups = 8;
constexpr std::size_t kNearEdge = 50;  // meetings
constexpr double kKnowsItsPlace_m = 0.01;
// By so much means of eight groups lie farther apart than chance would have them only once in
// twenty: the root of chi-squared's 95 % quantile at 7, by 7.
constexpr double kMoreThanChance = 1.42;

bool Failed(const Encounter& met) { return met.outcome == Encounter::Outcome::kFailed; }
bool Censored(const Encounter& met) { return met.outcome == Encounter::Outcome::kCensored; }

// A meeting as one covariate sees it.
struct Case {
  double x = 0;
  const Encounter* met = nullptr;
  double expected = 0;  // failures
};

// To a micrometre: floating point makes thousands of values of "all of its width".
double Rounded(double x) { return std::round(x * 1e6) / 1e6; }

std::vector<AxisGroup> GroupsOf(std::vector<Case> cases) {
  for (Case& each : cases) each.x = Rounded(each.x);
  std::ranges::stable_sort(cases, {}, &Case::x);
  std::vector<double> values;
  for (const Case& each : cases) values.push_back(each.x);
  std::vector<AxisGroup> groups;
  std::size_t begin = 0;
  for (const std::size_t end : EqualBins(values, kGroups)) {
    AxisGroup group{.low = values[begin], .high = values[end - 1]};
    int failed = 0, n = 0;
    for (std::size_t i = begin; i < end; ++i) {
      failed += Failed(*cases[i].met);
      n += !Censored(*cases[i].met);
      group.mean += cases[i].x / static_cast<double>(end - begin);
      group.expected += cases[i].expected;
    }
    begin = end;
    if (n == 0) continue;
    group.expected = std::min(1.0, group.expected / n);
    group.counted = CountedRate("", failed, n);
    groups.push_back(group);
  }
  return groups;
}

double SpreadOf(const std::vector<AxisGroup>& groups) {
  double n = 0, sum = 0, squares = 0;
  for (const AxisGroup& group : groups) {
    n += group.counted.n;
    sum += group.counted.n * group.expected;
    squares += group.counted.n * group.expected * group.expected;
  }
  return std::sqrt(std::max(0.0, squares / n - sum / n * (sum / n)));
}

// How far apart the groups' means would lie if meetings were put into them by chance.
double SpreadByChance(const std::vector<Case>& cases) {
  double sum = 0, squares = 0;
  for (const Case& each : cases) {
    sum += each.expected;
    squares += each.expected * each.expected;
  }
  const auto n = static_cast<double>(cases.size());
  return std::sqrt(std::max(0.0, squares / n - sum / n * (sum / n)) * kGroups / n);
}

// What another axis says better: where a robot is wrong about its place, the gap alone, and the
// error alone, say less than the gap that is left.
bool IsSaidByAnother(const std::vector<RateAxis>& axes, const RateAxis& axis) {
  return !axis.of_hazard && (axis.name == "gap_m" || axis.name == "estimate_error_m") &&
         std::ranges::find(axes, kSureGap, &RateAxis::name) != axes.end();
}

using Met = std::vector<const Encounter*>;

KindFinding FindKind(const RiskModel& model, const KindRates& kind, const Met& met) {
  KindFinding found;
  found.kind = &kind;
  const RateEvaluator rates(kind);
  std::vector<std::vector<Case>> cases(kind.axes.size());  // by axis
  for (const Encounter* each : met) {
    Covariates covariates(kind.axes, model.mirrored, each->size);
    const std::span<const double> x = covariates.Of(each->at);
    const ModeNumbers p = FirstFailures(rates.At(x));
    const double expected = AmountOf(*each) * Total(p);
    found.expected += expected;
    for (std::size_t a = 0; a < x.size(); ++a) cases[a].push_back({x[a], each, expected});
    (Censored(*each) ? found.censored : found.n) += 1;
    if (!Failed(*each)) continue;
    const auto mode = static_cast<std::size_t>(each->mode);
    ++found.failed[mode];
    UnlikelyFailure& least = found.unlikeliest[mode];
    if (least.met == nullptr || p[mode] < least.p) least = {each, p[mode]};
  }
  if (found.n == 0) return found;
  for (std::size_t a = 0; a < kind.axes.size(); ++a) {
    // Without knots it was always the same.
    if (kind.axes[a].knots.empty() || IsSaidByAnother(kind.axes, kind.axes[a])) continue;
    AxisFinding axis{.name = kind.axes[a].name,
                     .of_hazard = kind.axes[a].of_hazard,
                     .groups = GroupsOf(cases[a])};
    if (axis.groups.size() < 2) continue;
    axis.spread = SpreadOf(axis.groups);
    if (axis.spread > kMoreThanChance * SpreadByChance(cases[a]))
      found.axes.push_back(std::move(axis));
  }
  std::ranges::stable_sort(found.axes, std::greater(), &AxisFinding::spread);
  return found;
}

FailureRate NearEdge(const std::vector<DrawnOutcome>& ascending, double edge) {
  const auto end = std::ranges::upper_bound(ascending, edge, {}, &DrawnOutcome::value);
  auto begin = end - std::min<std::ptrdiff_t>(kNearEdge, end - ascending.begin());
  while (begin != ascending.begin() && (begin - 1)->value == begin->value) --begin;
  const auto failed = std::count_if(begin, end, [](const DrawnOutcome& o) { return o.failed; });
  return CountedRate("", static_cast<int>(failed), static_cast<int>(end - begin));
}

// The meetings over a type of hazard by one key: how far up, how far down.
struct KeyOutcomes {
  std::string key;
  std::vector<DrawnOutcome> up, down;
};

std::vector<KeyOutcomes> OutcomesByKey(const Met& met) {
  std::vector<KeyOutcomes> keys;  // in the order in which hazards state them
  for (const Encounter* each : met)
    for (const auto& [key, value] : each->size) {
      // How the way goes over it (env/core/passages.h), not how large it is.
      if (key == "rise_along" || key == "rise_across") continue;
      auto found = std::ranges::find(keys, key, &KeyOutcomes::key);
      if (found == keys.end()) found = keys.insert(keys.end(), {key, {}, {}});
      (value < 0 ? found->down : found->up).push_back({std::abs(value), Failed(*each)});
    }
  return keys;
}

// All of a type, the most telling first.
std::vector<SizeFinding> FindSizes(const std::string& type, const Met& met,
                                   const SafeRangeSettings& limit) {
  std::vector<SizeFinding> sizes;
  for (KeyOutcomes& of : OutcomesByKey(met)) {
    const auto add = [&](std::vector<DrawnOutcome>& outcomes, SizeFinding::Way way) {
      if (outcomes.empty()) return;
      std::ranges::stable_sort(outcomes, {}, &DrawnOutcome::value);
      SizeFinding size{
          type, of.key, way, DependenceOfNumber(type + "." + of.key, outcomes, limit), {}};
      if (!size.of.differs()) return;
      if (size.of.safe->up_to) size.at_edge = NearEdge(outcomes, size.of.safe->up_to->edge);
      sizes.push_back(std::move(size));
    };
    add(of.up, of.down.empty() ? SizeFinding::Way::kOnly : SizeFinding::Way::kUp);
    add(of.down, SizeFinding::Way::kDown);
  }
  std::vector<ValueDependence> values;
  for (const SizeFinding& size : sizes) values.push_back(size.of);
  CorrectByHolm(values);
  std::vector<SizeFinding> ordered;
  for (const std::size_t i : MostTellingFirst(values)) {
    ordered.push_back(std::move(sizes[i]));
    ordered.back().of.p_holm = values[i].p_holm;
  }
  return ordered;
}

// Both directions of a key stand together, or neither: what is not shown to be safe is no less to
// be known.
std::vector<SizeFinding> Shown(const std::vector<SizeFinding>& sizes) {
  std::vector<std::string> keys;
  for (const SizeFinding& size : sizes)
    if (size.of.telling() && size.of.safe->answer == SafeAnswer::kPart &&
        std::ranges::find(keys, size.key) == keys.end())
      keys.push_back(size.key);
  if (keys.empty() && !sizes.empty()) keys.push_back(sizes.front().key);
  std::vector<SizeFinding> shown;
  for (const std::string& key : keys)
    std::ranges::copy_if(sizes, std::back_inserter(shown),
                         [&](const SizeFinding& size) { return size.key == key; });
  return shown;
}

}  // namespace

int KindFinding::failures() const { return std::accumulate(failed.begin(), failed.end(), 0); }

std::vector<KindFinding> FindKinds(const RiskModel& model, const std::vector<Encounter>& first) {
  std::vector<KindFinding> found;
  for (const KindRates& kind : model.kinds) {
    if (kind.per_metre) continue;
    Met met;
    for (const Encounter& each : first)
      if (IsAbout(kind, each.type, each.passage, each.at)) met.push_back(&each);
    found.push_back(FindKind(model, kind, met));
  }
  return found;
}

SafeSizes FindSafeSizes(const std::vector<Encounter>& first, const SafeRangeSettings& limit) {
  std::map<std::string, Met> by_type;
  for (const Encounter& each : first)
    if (each.passage == Passage::kOver && !Censored(each) && !IsExposure(each.type) &&
        each.at.estimate_error_m <= kKnowsItsPlace_m)
      by_type[each.type].push_back(&each);
  SafeSizes sizes;
  for (const auto& [type, met] : by_type) {
    const std::vector<SizeFinding> all = FindSizes(type, met, limit);
    sizes.looked_at += static_cast<int>(all.size());
    for (const SizeFinding& size : Shown(all)) sizes.shown.push_back(size);
  }
  return sizes;
}

}  // namespace floorproof

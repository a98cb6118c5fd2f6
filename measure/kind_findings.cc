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
#include "stats/binomial.h"
#include "stats/equal_bins.h"
#include "stats/holm.h"
#include "stats/influence.h"

namespace floorproof {
namespace {

constexpr int kGroups = 8;
constexpr int kTestGroups = 32;  // as in run/campaign/dependence.cc

FailureRate RateOf(int k, int n) {
  const Interval interval = ClopperPearson(k, n, kReportedConfidence);
  return {"", k, n, static_cast<double>(k) / n, interval.lower, interval.upper};
}

bool Failed(const Encounter& met) { return met.outcome == Encounter::Outcome::kFailed; }

// A meeting as one covariate sees it.
struct Case {
  double x = 0;
  bool failed = false;
  double expected = 0;
};

std::vector<AxisGroup> GroupsOf(std::vector<Case>& cases, int most) {
  std::ranges::stable_sort(cases, {}, &Case::x);
  std::vector<double> values;
  for (const Case& each : cases) values.push_back(each.x);
  std::vector<AxisGroup> groups;
  std::size_t begin = 0;
  for (const std::size_t end : EqualBins(values, most)) {
    AxisGroup group{.low = values[begin], .high = values[end - 1]};
    int failed = 0;
    for (std::size_t i = begin; i < end; ++i) {
      failed += cases[i].failed;
      group.mean += cases[i].x;
      group.expected += cases[i].expected;
    }
    const auto n = static_cast<int>(end - begin);
    group.mean /= n;
    group.expected /= n;
    group.counted = RateOf(failed, n);
    groups.push_back(group);
    begin = end;
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

using Met = std::vector<const Encounter*>;

KindFinding FindKind(const RiskModel& model, const KindRates& kind, const Met& met) {
  KindFinding found;
  found.kind = &kind;
  found.n = static_cast<int>(met.size());
  const RateEvaluator rates(kind);
  std::vector<std::vector<Case>> cases(kind.axes.size());  // by axis
  for (const Encounter* each : met) {
    Covariates covariates(kind.axes, model.mirrored, each->size);
    const std::span<const double> x = covariates.Of(each->at);
    const double p = Total(FirstFailures(rates.At(x)));
    found.expected += p;
    for (std::size_t a = 0; a < x.size(); ++a) cases[a].push_back({x[a], Failed(*each), p});
    if (!Failed(*each)) continue;
    const auto mode = static_cast<std::size_t>(each->mode);
    ++found.failed[mode];
    UnlikelyFailure& least = found.unlikeliest[mode];
    if (least.met == nullptr || p < least.p) least = {each, p};
  }
  for (std::size_t a = 0; a < kind.axes.size() && !met.empty(); ++a) {
    AxisFinding axis{.name = kind.axes[a].name,
                     .of_hazard = kind.axes[a].of_hazard,
                     .groups = GroupsOf(cases[a], kGroups)};
    if (axis.groups.size() < 2) continue;
    axis.spread = SpreadOf(axis.groups);
    found.axes.push_back(std::move(axis));
  }
  std::ranges::stable_sort(found.axes, std::greater(), &AxisFinding::spread);
  return found;
}

// The meetings over a type of hazard, by one key.
struct KeyCases {
  std::vector<Case> up, down;  // by how far, whichever way
};

SizeFinding FindSize(const std::string& type, const std::string& key, SizeFinding::Way way,
                     std::vector<Case>& cases, const SafeRangeSettings& limit) {
  SizeFinding size{.type = type, .key = key, .way = way};
  ValueDependence& of = size.of;
  of.key = type + "." + key;
  of.n = static_cast<int>(cases.size());
  of.k = static_cast<int>(std::ranges::count(cases, true, &Case::failed));
  std::vector<GroupCounts> counts;
  for (const AxisGroup& group : GroupsOf(cases, kTestGroups))
    counts.push_back({group.counted.n, group.counted.k});
  const OrderedInfluence influence = TestOrdered(counts);
  of.p = of.p_holm = influence.p;
  of.shape = influence.shape;
  for (const AxisGroup& group : GroupsOf(cases, kGroups))
    of.bins.push_back({group.low, group.high, group.counted});
  std::vector<DrawnOutcome> outcomes;
  for (const Case& each : cases) outcomes.push_back({each.x, each.failed});
  of.safe = FindSafeRange(outcomes, limit);
  return size;
}

std::vector<SizeFinding> FindSizes(const std::string& type, const Met& met,
                                   const SafeRangeSettings& limit) {
  std::vector<std::pair<std::string, KeyCases>> keys;  // in the order in which hazards state them
  for (const Encounter* each : met)
    for (const auto& [key, value] : each->size) {
      // How the way goes over it (env/core/passages.h), not how large it is.
      if (key == "rise_along" || key == "rise_across") continue;
      auto found = std::ranges::find(keys, key, &std::pair<std::string, KeyCases>::first);
      if (found == keys.end()) found = keys.insert(keys.end(), {key, {}});
      KeyCases& cases = found->second;
      (value < 0 ? cases.down : cases.up).push_back({std::abs(value), Failed(*each), 0});
    }
  std::vector<SizeFinding> sizes;
  for (auto& [key, cases] : keys) {
    const bool both = !cases.up.empty() && !cases.down.empty();
    const auto add = [&](std::vector<Case>& of, SizeFinding::Way way) {
      if (of.empty()) return;
      SizeFinding size = FindSize(type, key, both ? way : SizeFinding::Way::kOnly, of, limit);
      if (size.of.bins.size() > 1) sizes.push_back(std::move(size));
    };
    add(cases.up, SizeFinding::Way::kUp);
    add(cases.down, SizeFinding::Way::kDown);
  }
  std::vector<double> p_values;
  for (const SizeFinding& size : sizes) p_values.push_back(size.of.p);
  const std::vector<double> adjusted = HolmAdjusted(p_values);
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i].of.p_holm = adjusted[i];
  std::ranges::stable_sort(sizes, {}, [](const SizeFinding& size) { return size.of.p_holm; });
  const auto answers = [](const SizeFinding& size) {
    return size.of.telling() && (size.of.safe->answer == SafeAnswer::kPart);
  };
  if (std::ranges::any_of(sizes, answers))
    std::erase_if(sizes, [&](const SizeFinding& size) { return !answers(size); });
  else if (sizes.size() > 1)
    sizes.resize(1);
  return sizes;
}

}  // namespace

int KindFinding::failures() const { return std::accumulate(failed.begin(), failed.end(), 0); }

std::vector<KindFinding> FindKinds(const RiskModel& model, const std::vector<Encounter>& first) {
  std::vector<KindFinding> found;
  for (const KindRates& kind : model.kinds) {
    if (kind.per_metre) continue;
    Met met;
    for (const Encounter& each : first)
      if (each.outcome != Encounter::Outcome::kCensored &&
          IsAbout(kind, each.type, each.passage, each.at))
        met.push_back(&each);
    found.push_back(FindKind(model, kind, met));
  }
  return found;
}

std::vector<SizeFinding> FindSafeSizes(const std::vector<Encounter>& first,
                                       const SafeRangeSettings& limit) {
  std::map<std::string, Met> by_type;
  for (const Encounter& each : first)
    if (each.passage == Passage::kOver && each.outcome != Encounter::Outcome::kCensored &&
        !IsExposure(each.type))
      by_type[each.type].push_back(&each);
  std::vector<SizeFinding> sizes;
  for (const auto& [type, met] : by_type)
    for (SizeFinding& size : FindSizes(type, met, limit)) sizes.push_back(std::move(size));
  return sizes;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "env/run/campaign_comparison.h"

#include <cmath>
#include <limits>
#include <map>

#include "env/core/error.h"
#include "env/stats/paired.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kConfidence = 0.95;

struct Pair {
  EpisodeRow a, b;
};

std::vector<Pair> Pairs(const CampaignStore& a, const std::string& variant_a,
                        const CampaignStore& b, const std::string& variant_b) {
  // A hundred thousand pairs fit where their texts would not.
  const auto brief = [](EpisodeRow row) {
    row.plan.clear();
    row.events.clear();
    return row;
  };
  std::map<std::uint64_t, EpisodeRow> rows;
  a.ForEach(variant_a, [&](const EpisodeRow& row) {
    if (row.counts()) rows.emplace(row.episode, brief(row));
  });
  std::vector<Pair> pairs;
  b.ForEach(variant_b, [&](const EpisodeRow& row) {
    const auto found = rows.find(row.episode);
    if (!row.counts() || found == rows.end()) return;
    if (found->second.drawn != row.drawn)
      throw InputError({}, "episode", std::to_string(row.episode),
                       "has other draws on the two sides, " + found->second.drawn + " and " +
                           row.drawn + ": a paired comparison needs the same");
    pairs.push_back({std::move(found->second), brief(row)});
    pairs.back().a.drawn.clear();
    pairs.back().b.drawn.clear();
  });
  return pairs;
}

template <class Fails>
ComparedFailure CompareFailures(const std::string& mode, const std::vector<Pair>& pairs,
                                Fails&& fails) {
  ComparedFailure out;
  out.mode = mode;
  for (const Pair& pair : pairs) {
    const bool a = fails(pair.a), b = fails(pair.b);
    ++(a && b ? out.both : a ? out.only_a : b ? out.only_b : out.neither);
  }
  const PairedCounts counts{out.both, out.only_b, out.only_a, out.neither};  // b first: b - a
  out.difference = counts.n() > 0 ? static_cast<double>(out.only_b - out.only_a) / counts.n()
                                  : std::numeric_limits<double>::quiet_NaN();
  out.interval = PairedRateDifference(counts, kConfidence);
  out.p = McNemarExact(out.only_a, out.only_b);
  return out;
}

// What an episode that a failure cuts short has less of, for no merit of its own.
bool NeedsSuccess(std::string_view metric) {
  return metric == "duration_s" || metric == "energy_j" || metric == "charge_ah" ||
         metric == "path_length_m";
}

Json Number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json DifferenceJson(const PairedDifference& difference) {
  return {{"estimate", Number(difference.estimate)},
          {"lower", Number(difference.interval.lower)},
          {"upper", Number(difference.interval.upper)}};
}

}  // namespace

Comparison CompareVariants(const CampaignStore& a, const std::string& variant_a,
                           const CampaignStore& b, const std::string& variant_b) {
  const std::vector<Pair> pairs = Pairs(a, variant_a, b, variant_b);
  Comparison out{variant_a, variant_b, static_cast<int>(pairs.size()), {}, {}};
  out.failures.push_back(CompareFailures("any_failure", pairs,
                                         [](const EpisodeRow& row) { return row.any_failure(); }));
  for (std::size_t m = 0; m < kNumFailureModes; ++m)
    out.failures.push_back(
        CompareFailures(std::string(Name(static_cast<FailureMode>(m))), pairs,
                        [m](const EpisodeRow& row) { return row.events_of[m] > 0; }));
  for (std::size_t i = 0; i < kMetricColumns.size(); ++i) {
    ComparedMetric compared{
        std::string(kMetricColumns[i]), NeedsSuccess(kMetricColumns[i]), {}, {}};
    std::vector<double> differences;
    for (const Pair& pair : pairs) {
      const bool succeed = pair.a.outcome == "success" && pair.b.outcome == "success";
      if (pair.a.metrics[i] && pair.b.metrics[i] && (succeed || !compared.successes_only))
        differences.push_back(*pair.b.metrics[i] - *pair.a.metrics[i]);
    }
    if (differences.empty()) continue;
    compared.mean = MeanDifference(differences, kConfidence);
    compared.median = MedianDifference(differences, kConfidence);
    out.metrics.push_back(std::move(compared));
  }
  return out;
}

Json ComparisonJson(const Comparison& c) {
  Json failures = Json::object(), metrics = Json::object();
  for (const ComparedFailure& f : c.failures)
    failures[f.mode] = {{"a", f.both + f.only_a},
                        {"b", f.both + f.only_b},
                        {"only_a", f.only_a},
                        {"only_b", f.only_b},
                        {"difference", Number(f.difference)},
                        {"lower", f.interval.lower},
                        {"upper", f.interval.upper},
                        {"p", f.p}};
  for (const ComparedMetric& m : c.metrics)
    metrics[m.metric] = {{"n", m.mean.n},
                         {"successes_only", m.successes_only},
                         {"mean", DifferenceJson(m.mean)},
                         {"median", DifferenceJson(m.median)}};
  return {{"a", c.a},
          {"b", c.b},
          {"n", c.n},
          {"confidence", kConfidence},
          {"failures", std::move(failures)},
          {"metrics", std::move(metrics)}};
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "env/run/campaign_comparison.h"

#include <cmath>
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
  std::map<std::uint64_t, EpisodeRow> rows;
  a.ForEach(variant_a, [&](const EpisodeRow& row) {
    if (row.counts()) rows.emplace(row.episode, row);
  });
  std::vector<Pair> pairs;
  b.ForEach(variant_b, [&](const EpisodeRow& row) {
    const auto found = rows.find(row.episode);
    if (!row.counts() || found == rows.end()) return;
    if (found->second.drawn != row.drawn)
      throw InputError({}, "episode", std::to_string(row.episode),
                       "has other draws on the two sides, " + found->second.drawn + " and " +
                           row.drawn + ": a paired comparison needs the same");
    pairs.push_back({std::move(found->second), row});
  });
  return pairs;
}

Json Number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

template <class Fails>
Json Failures(const std::vector<Pair>& pairs, Fails&& fails) {
  PairedCounts counts;
  for (const Pair& pair : pairs) {
    const bool a = fails(pair.a), b = fails(pair.b);
    ++(a && b ? counts.both : a ? counts.only_a : b ? counts.only_b : counts.neither);
  }
  const Interval interval = PairedRateDifference(counts, kConfidence);
  return {{"a", counts.both + counts.only_a},
          {"b", counts.both + counts.only_b},
          {"only_a", counts.only_a},
          {"only_b", counts.only_b},
          {"difference", counts.n() > 0
                             ? Json(static_cast<double>(counts.only_a - counts.only_b) / counts.n())
                             : Json(nullptr)},
          {"lower", interval.lower},
          {"upper", interval.upper},
          {"p", McNemarExact(counts.only_a, counts.only_b)}};
}

}  // namespace

Json CompareVariants(const CampaignStore& a, const std::string& variant_a, const CampaignStore& b,
                     const std::string& variant_b) {
  const std::vector<Pair> pairs = Pairs(a, variant_a, b, variant_b);
  Json failures, metrics = Json::object();
  failures["any_failure"] =
      Failures(pairs, [](const EpisodeRow& row) { return row.any_failure(); });
  for (std::size_t m = 0; m < kNumFailureModes; ++m)
    failures[std::string(Name(static_cast<FailureMode>(m)))] =
        Failures(pairs, [m](const EpisodeRow& row) { return row.events_of[m] > 0; });
  for (std::size_t i = 0; i < kMetricColumns.size(); ++i) {
    std::vector<double> differences;
    for (const Pair& pair : pairs)
      if (pair.a.metrics[i] && pair.b.metrics[i])
        differences.push_back(*pair.a.metrics[i] - *pair.b.metrics[i]);
    if (differences.empty()) continue;
    const PairedDifference mean = MeanDifference(differences, kConfidence),
                           median = MedianDifference(differences, kConfidence);
    metrics[std::string(kMetricColumns[i])] = {{"mean", Number(mean.estimate)},
                                               {"lower", Number(mean.interval.lower)},
                                               {"upper", Number(mean.interval.upper)},
                                               {"median", Number(median.estimate)}};
  }
  return {{"a", variant_a},
          {"b", variant_b},
          {"n", pairs.size()},
          {"confidence", kConfidence},
          {"failures", std::move(failures)},
          {"metrics", std::move(metrics)}};
}

}  // namespace floorproof

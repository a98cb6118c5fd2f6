// SPDX-License-Identifier: Apache-2.0
#include "apps/report_pairs.h"

#include <algorithm>
#include <limits>

namespace floorproof {
namespace {

ReportDifference Difference(const std::string& name, const std::string& pairs,
                            const std::vector<EpisodeValue>& a, const std::vector<EpisodeValue>& b,
                            double scale, double confidence) {
  std::vector<double> differences = PairedDifferences(b, a);
  for (double& difference : differences) difference *= scale;
  ReportDifference d{.name = name, .pairs = pairs, .n = static_cast<int>(differences.size())};
  d.mean = d.mean_lower = d.mean_upper = std::numeric_limits<double>::quiet_NaN();
  d.median = d.median_lower = d.median_upper = d.mean;
  if (d.n < 2) return d;  // too few for any interval
  const PairedDifference mean = MeanDifference(differences, confidence);
  d.mean = mean.estimate;
  d.mean_lower = mean.interval.lower;
  d.mean_upper = mean.interval.upper;
  const PairedDifference median = MedianDifference(differences, confidence);
  d.median = median.estimate;
  d.median_lower = median.interval.lower;
  d.median_upper = median.interval.upper;
  return d;
}

}  // namespace

void PairingValues::Add(const EpisodeRow& row) {
  if (!row.counts()) return;
  const auto id = static_cast<std::int64_t>(row.episode);
  failed.push_back({id, row.any_failure() ? 1.0 : 0.0});
  coverage.push_back({id, row.metric("coverage")});
  if (row.outcome != "success") return;
  duration_s.push_back({id, row.metric("duration_s")});
  energy_j.push_back({id, row.metric("energy_j")});
}

ReportPair ComparePair(const std::string& name_a, const PairingValues& a, const std::string& name_b,
                       const PairingValues& b, double confidence) {
  const PairedCounts counts = CountPairs(b.failed, a.failed);  // its first is b
  ReportPair pair{.a = name_a, .b = name_b};
  pair.both = counts.both;
  pair.only_a = counts.only_b;
  pair.only_b = counts.only_a;
  pair.neither = counts.neither;
  if (pair.n() == 0) return pair;
  pair.difference = static_cast<double>(pair.only_b - pair.only_a) / pair.n();
  const Interval interval = PairedRateDifference(counts, confidence);
  pair.lower = interval.lower;
  pair.upper = interval.upper;
  pair.p = McNemarExact(pair.only_a, pair.only_b);
  pair.metrics = {
      Difference("coverage [% points]", "episodes", a.coverage, b.coverage, 100, confidence),
      Difference("time [s]", "where both succeed", a.duration_s, b.duration_s, 1, confidence),
      Difference("energy [kJ]", "where both succeed", a.energy_j, b.energy_j, 1e-3, confidence)};
  return pair;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "report/pairs.h"

namespace floorproof {
namespace {

// What a reader weighs against the failures, in the units of the page.
struct Shown {
  const char *metric, *name;
  double scale;
};
constexpr Shown kShown[] = {{"coverage", "coverage [% points]", 100},
                            {"duration_s", "time [s]", 1},
                            {"energy_j", "energy [kJ]", 1e-3}};

ReportDifference DifferenceIn(const ComparedMetric& metric, const Shown& shown) {
  ReportDifference d{.name = shown.name,
                     .pairs = metric.successes_only ? "where both succeed" : "episodes",
                     .n = metric.mean.n};
  d.mean = shown.scale * metric.mean.estimate;
  d.mean_lower = shown.scale * metric.mean.interval.lower;
  d.mean_upper = shown.scale * metric.mean.interval.upper;
  d.median = shown.scale * metric.median.estimate;
  d.median_lower = shown.scale * metric.median.interval.lower;
  d.median_upper = shown.scale * metric.median.interval.upper;
  return d;
}

}  // namespace

ReportPair ShownPair(const Comparison& comparison) {
  const ComparedFailure& any = comparison.failures.front();
  ReportPair pair{.a = comparison.a, .b = comparison.b};
  pair.repeats = comparison.repeats;
  pair.both = any.both;
  pair.only_a = any.only_a;
  pair.only_b = any.only_b;
  pair.neither = any.neither;
  if (pair.n() == 0) return pair;
  pair.difference = any.difference;
  pair.lower = any.interval.lower;
  pair.upper = any.interval.upper;
  pair.p = any.p;
  for (const Shown& shown : kShown)
    for (const ComparedMetric& metric : comparison.metrics)
      if (metric.metric == shown.metric) pair.metrics.push_back(DifferenceIn(metric, shown));
  return pair;
}

}  // namespace floorproof

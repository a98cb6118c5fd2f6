// SPDX-License-Identifier: Apache-2.0
// Two variants on the same episodes, which have the same draws in both: a paired comparison.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "run/campaign/campaign_store.h"
#include "stats/paired.h"
#include "stats/quantile.h"

namespace floorproof {

// Differences are b - a, at 95 %.
struct ComparedFailure {
  std::string mode;  // or any_failure, not_success
  int both = 0, only_a = 0, only_b = 0, neither = 0;
  double difference = 0;  // of the rates; NaN without pairs
  Interval interval;      // Tango's score interval
  double p = 1;           // exact McNemar test
};
struct ComparedMetric {
  std::string metric;
  bool successes_only = false;  // of pairs where both succeed; else of all that count
  PairedDifference mean, median;
};
// A figure of the plans, which an episode has driven or not.
struct ComparedPlanFigure {
  std::string figure;
  int n = 0;                            // pairs that both have it
  Quartiles a, b;                       // of its values
  std::optional<Quartiles> change;      // (b - a) / a; none: some a is 0, but for rounding
  int lower = 0, same = 0, higher = 0;  // b against a, to 1e-9 of a
};
// Risk and length of the plans together: a plan may buy the one with the other.
struct ComparedPlans {
  int n = 0;            // pairs that both have the two figures
  int both_lower = 0;   // b against a
  int none_higher = 0;  // those included, and those where both are the same
  int same = 0;         // both
};
struct Comparison {
  std::string a, b;
  // Pairs of episodes that count in both: no errors, none without a plan; `not_success` is of these
  // and of those without a plan.
  int n = 0;
  int repeats = 0;  // pairs that came out the same, to the last bit, and count as one: n is 1
  int only_a = 0, only_b = 0;             // episodes that count on one side alone
  std::vector<ComparedFailure> failures;  // any_failure, each mode, not_success
  std::vector<ComparedMetric> metrics;
  std::vector<ComparedPlanFigure> plans;
  ComparedPlans risk_and_length;  // cumulative_risk and length_m
};

// Throws InputError when the two drew different values for the same episode (other seeds, or other
// keys randomised).
Comparison CompareVariants(const CampaignStore& a, const std::string& variant_a,
                           const CampaignStore& b, const std::string& variant_b);

// Infinite and missing numbers are null.
nlohmann::ordered_json ComparisonJson(const Comparison& comparison);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Two variants on the same episodes, which have the same draws in both: a paired comparison.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "env/run/campaign_store.h"
#include "env/stats/paired.h"

namespace floorproof {

// Differences are b - a, at 95 %.
struct ComparedFailure {
  std::string mode;  // or any_failure
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
struct Comparison {
  std::string a, b;
  int n = 0;  // pairs of episodes that count in both: no errors, none without a plan
  std::vector<ComparedFailure> failures;
  std::vector<ComparedMetric> metrics;
};

// Throws InputError when the two drew different values for the same episode (other seeds, or other
// keys randomised).
Comparison CompareVariants(const CampaignStore& a, const std::string& variant_a,
                           const CampaignStore& b, const std::string& variant_b);

// Infinite and missing numbers are null.
nlohmann::ordered_json ComparisonJson(const Comparison& comparison);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What a campaign's rows amount to: the numbers of summary.json, junit.xml, the terminal's lines
// and the report. summary_json.h writes and reads them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "env/geometry/geometry.h"
#include "run/campaign/campaign_gate.h"
#include "run/campaign/campaign_store.h"
#include "run/scenario/matrix.h"

namespace floorproof {

// k of n episodes, with Clopper and Pearson's two-sided bounds. `rate` is NaN at n = 0.
struct FailureRate {
  std::string name{};  // a mode, kind or hazard
  int k = 0, n = 0;
  double rate = 0, lower = 0, upper = 1;
};
// k of n, with Clopper and Pearson's interval at kReportedConfidence; of none the rate is NaN.
FailureRate CountedRate(const std::string& name, int k, int n);

// k events over an exposure, with Garwood's bounds. Where the exposure says nothing the rate is NaN
// and the upper bound infinite.
struct FailureRatePer {
  std::string name{};  // a mode
  int k = 0;
  double exposure = 0, rate = 0, lower = 0, upper = 0;
};

struct FailurePlace {
  Vec2 p_W = Vec2::Zero();  // the middle of a square
  FailureRate rate{};
};

// A metric's values over the driven episodes.
struct MetricSpread {
  double mean = 0, median = 0, lower_quartile = 0, upper_quartile = 0, min = 0, max = 0;
};
struct MetricSummary {
  std::string name{};
  std::optional<MetricSpread> spread{};  // none: no episode has it
};

// Rates are of the episodes that physics drove, but `not_success`, which counts those without a
// plan too. Where all came out the same they are of that one episode.
struct VariantSummary {
  std::string name{};
  bool repeated = false;  // all episodes that are no error came out the same, to the last bit
  int n = 0;  // episodes with an outcome that counts: success, failure, timeout, aborted
  int errors = 0, not_planned = 0;
  std::string first_error{};  // empty: there is none
  int success = 0, failure = 0, timeout = 0, aborted = 0;
  std::vector<FailureRate> failures{};                 // any_failure, each mode, not_success
  std::vector<FailureRatePer> per_km{}, per_1000_h{};  // any_failure and each mode
  std::vector<FailureRate> kinds{}, hazards{};         // too little covered has the kind `coverage`
  double place_m = 0;                                  // side of the squares
  std::vector<FailurePlace> places{};  // squares of the world in which an episode failed
  std::vector<MetricSummary> metrics{};
  std::vector<std::pair<std::string, std::uint64_t>> first_episode{};  // by mode, in its alphabet
};

// What the gate says of the prefix of a variant.
struct VariantGate {
  std::string variant{};
  GateReport report{};
  int aborted = 0;  // of all its episodes: a robot that does not drive passes a gate on failures
};
struct GateSummary {
  std::string metric{};
  double max_rate = 0, confidence = 0;
  std::string mode{};
  GateVerdict verdict = GateVerdict::kUndecided;  // of all: failed when one is
  std::vector<VariantGate> variants{};
};

struct CampaignSummary {
  std::string campaign{};      // its id
  std::uint64_t episodes = 0;  // asked for, a variant
  std::string unfinished{};    // why not all of them were driven, in words; empty: they were
  std::vector<VariantSummary> variants{};
  std::optional<GateSummary> gate{};
  std::vector<std::pair<std::string, std::string>> versions{};

  // What its variants' episodes say of its gate beyond the metric.
  void TellGate();
};

// Adds up the rows of the campaign by variant. `gate`: what the gate says of each variant's prefix,
// in the order of `variants`; empty without a gate.
CampaignSummary Summarise(const CampaignStore& store, const std::vector<Variant>& variants,
                          const std::vector<GateState>& gate, const std::string& unfinished);

// What is to be said of a variant whose episodes are one, repeated; empty of any other.
std::string RepetitionText(const VariantSummary& variant);
// ", 3 stopped by themselves", behind the outcomes; empty where there are none.
std::string AbortedText(const VariantSummary& variant);
// "any_failure < 5 % at 95 %"
std::string Criterion(const GateSummary& gate);
// The gate's verdict on one variant, in a sentence.
std::string GateText(const GateSummary& gate, const VariantGate& variant);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What failures depend on: a variant's failure rate against each value that its episodes drew, and
// against pairs of them; how clearly it depends; and up to which value it is shown to be low.
//
// Of the episodes that rates are of: those that physics drove and that count. A failure is what the
// gate's metric says; without a gate, whatever is no success: a drive that runs out of time is not
// safe.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "run/campaign/campaign_summary.h"
#include "stats/influence.h"
#include "stats/safe_range.h"

namespace floorproof {

// Episodes of neighbouring values, or of one choice; `rate` has the choice as its name.
struct ValueBin {
  double low = 0, high = 0;  // the least and the greatest value in it; NaN of choices
  FailureRate rate{};
};

// One key of `randomise`.
struct ValueDependence {
  std::string key{};
  bool is_number = true;         // else its values are choices: texts, truth values, lists
  int n = 0, k = 0;              // episodes that drew it, those that failed
  std::vector<ValueBin> bins{};  // ascending; choices in alphabetical order
  // Whether failures go with it: the p-value by itself, and by Holm for all that were looked at.
  double p = 1, p_holm = 1;
  double z = 0;                                  // orders those whose p is the same
  InfluenceShape shape = InfluenceShape::kNone;  // of numbers: where failures are more frequent
  std::string choice{};                          // of choices: the one that stands out
  bool choice_fails_more = false;
  std::optional<SafeRange> safe{};  // of numbers

  bool telling() const { return p_holm <= 1 - kReportedConfidence; }
  bool differs() const { return bins.size() > 1; }  // else it was not looked at
};

// Of a number, whatever else was drawn; p_holm is left to CorrectByHolm. Values finite, ascending.
// Throws InputError unless `limit` is a gate's (stats/gate.h).
ValueDependence DependenceOfNumber(const std::string& key,
                                   const std::vector<DrawnOutcome>& ascending,
                                   const SafeRangeSettings& limit);
// Which stands first, and so on; what does not differ was not looked at, and comes last.
std::vector<std::size_t> MostTellingFirst(const std::vector<ValueDependence>& values);
// Sets p_holm of those that differ, and returns how many these are.
int CorrectByHolm(std::vector<ValueDependence>& values);

struct PairCell {
  std::size_t x = 0, y = 0;  // which bin
  FailureRate rate{};
};

// Two numbers: a cell for each two bins, x fastest; n may be 0.
struct PairDependence {
  std::string x_key{}, y_key{};
  std::vector<ValueBin> x_bins{}, y_bins{};  // with the rates of the pair's episodes
  std::vector<PairCell> cells{};
};

struct VariantDependence {
  std::string variant{};
  std::string metric = "not_success";  // what counts as a failure
  int n = 0, k = 0;
  // Why rates by value say nothing, in words; then there are no bins, no evidence and no pairs, but
  // the safe range still is. Empty: there are.
  std::string note{};
  int looked_at = 0;  // values that differ, of which Holm's p-values are
  SafeRangeSettings limit{};
  std::vector<ValueDependence> values{};  // the most telling first; empty: nothing was drawn
  std::vector<PairDependence> pairs{};
};

inline constexpr int kFewestToDepend = 20;  // episodes below which rates by value say nothing

// By the rows of the summary's variants, in their order. The limit is the gate's, else 5 % at 95 %.
std::vector<VariantDependence> DependenceOf(const CampaignStore& store,
                                            const CampaignSummary& summary);

}  // namespace floorproof

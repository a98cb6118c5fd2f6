// SPDX-License-Identifier: Apache-2.0
#include "report/campaign_tables.h"

#include <algorithm>
#include <utility>

#include "base/quantity.h"
#include "base/words.h"
#include "stats/binomial.h"
#include "stats/outward.h"

namespace floorproof {
namespace {

std::string Number(int n) { return FixedText(n, 0); }

std::string RateText(const FailureRate& rate) {
  if (rate.n == 0) return "";
  return rate.k == 0 ? "none" : PercentText(rate.rate);
}

std::string IntervalText(const FailureRate& rate) {
  if (rate.n == 0) return "";
  const Interval percent = RoundedOutward({100 * rate.lower, 100 * rate.upper});
  const std::string upper = PercentText(percent.upper / 100);
  return rate.k == 0 ? "at most " + upper : NumberText(percent.lower) + " to " + upper;
}

std::string IntervalHeading() { return PercentText(kReportedConfidence) + " interval"; }

const FailureRate* Find(const VariantSummary& variant, std::string_view name) {
  const auto rate = std::ranges::find(variant.failures, name, &FailureRate::name);
  return rate == variant.failures.end() ? nullptr : &*rate;
}

// Whether some drives neither succeeded nor failed: they ran out of time, or stopped themselves.
bool EndsOtherwise(const VariantSummary& variant) {
  const FailureRate* any = Find(variant, "any_failure");
  const FailureRate* not_success = Find(variant, "not_success");
  return any != nullptr && not_success != nullptr && not_success->k != any->k;
}

// The modes of which any variant has a failure, and not_success where it is more than these.
std::vector<std::string_view> ModesSeen(const CampaignSummary& summary) {
  std::vector<std::string_view> seen;
  for (int mode = 0; mode < kNumFailureModes; ++mode) {
    const std::string_view name = Name(static_cast<FailureMode>(mode));
    if (std::ranges::any_of(summary.variants, [&](const VariantSummary& v) {
          const FailureRate* rate = Find(v, name);
          return rate != nullptr && rate->k > 0;
        }))
      seen.push_back(name);
  }
  if (std::ranges::any_of(summary.variants, EndsOtherwise)) seen.push_back("not_success");
  return seen;
}

TextTable ModesOfOne(const VariantSummary& variant) {
  TextTable table({{.heading = "Failure", .wraps = true},
                   {.heading = "Drives", .right = true},
                   {.heading = "Rate", .right = true},
                   {.heading = IntervalHeading()}});
  const FailureRate* any = Find(variant, "any_failure");
  const FailureRate* not_success = Find(variant, "not_success");
  if (any == nullptr || (any->k == 0 && (not_success == nullptr || not_success->k == 0)))
    return table;
  std::string none;  // they have the same bound
  const FailureRate* first_none = nullptr;
  for (const FailureRate& rate : variant.failures) {
    if (rate.name == any->name || (rate.name == "not_success" && !EndsOtherwise(variant))) continue;
    if (rate.k > 0) {
      table.Add({Words(rate.name), Number(rate.k), RateText(rate), IntervalText(rate)});
      continue;
    }
    none += (none.empty() ? "" : ", ") + Words(rate.name);
    first_none = &rate;
  }
  if (first_none != nullptr)
    table.Add({none, "0", RateText(*first_none), IntervalText(*first_none)});
  return table;
}

}  // namespace

TextTable OutcomesTable(const CampaignSummary& summary) {
  // What happened to no episode has no column.
  const std::pair<const char*, int VariantSummary::*> rare[] = {
      {"Timeout", &VariantSummary::timeout},
      {"Stopped itself", &VariantSummary::aborted},
      {"No plan", &VariantSummary::not_planned},
      {"Error", &VariantSummary::errors}};
  std::vector<int VariantSummary::*> counts = {&VariantSummary::n, &VariantSummary::success,
                                               &VariantSummary::failure};
  std::vector<TextColumn> columns = {{.heading = "Variant", .wraps = true},
                                     {.heading = "Episodes", .right = true},
                                     {.heading = "Success", .right = true},
                                     {.heading = "Failure", .right = true}};
  for (const auto& [heading, count] : rare) {
    if (std::ranges::none_of(summary.variants,
                             [counted = count](const auto& v) { return v.*counted > 0; }))
      continue;
    columns.push_back({.heading = heading, .right = true});
    counts.push_back(count);
  }
  columns.push_back({.heading = "Fail", .right = true});
  columns.push_back({.heading = IntervalHeading()});
  TextTable table(std::move(columns));
  for (const VariantSummary& v : summary.variants) {
    std::vector<TextCell> row = {v.name};
    for (const auto& count : counts) row.emplace_back(Number(v.*count));
    if (const FailureRate* any = Find(v, "any_failure")) {
      row.emplace_back(RateText(*any), any->k > 0 ? Tone::kBad : Tone::kPlain);
      row.emplace_back(IntervalText(*any));
    }
    table.Add(std::move(row));
  }
  return table;
}

TextTable ModesTable(const CampaignSummary& summary) {
  if (summary.variants.size() == 1) return ModesOfOne(summary.variants.front());
  const std::vector<std::string_view> modes = ModesSeen(summary);
  std::vector<TextColumn> columns = {{.heading = "Drives that failed", .wraps = true}};
  for (const std::string_view mode : modes)
    columns.push_back({.heading = Words(mode), .right = true});
  TextTable table(std::move(columns));
  if (modes.empty()) return table;
  for (const VariantSummary& v : summary.variants) {
    std::vector<TextCell> row = {v.name};
    for (const std::string_view mode : modes) {
      const FailureRate* rate = Find(v, mode);
      row.emplace_back(rate == nullptr ? "" : RateText(*rate));
    }
    table.Add(std::move(row));
  }
  return table;
}

}  // namespace floorproof

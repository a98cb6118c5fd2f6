// SPDX-License-Identifier: Apache-2.0
#include "apps/campaign_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/quantity.h"
#include "report/failing_episodes.h"
#include "run/campaign/summary_json.h"
#include "stats/outward.h"

namespace floorproof {
namespace {

void SayRates(const CampaignSummary& summary, const Globals& globals) {
  for (const VariantSummary& v : summary.variants) {
    globals.Say(
        fmt::format("{}: {}, {} success, {} failure, {} timeout{}; {}, {} without "
                    "a plan",
                    v.name, CountText(v.n, "episode"), v.success, v.failure, v.timeout,
                    AbortedText(v), CountText(v.errors, "error"), v.not_planned));
    if (v.repeated) globals.Say("  " + RepetitionText(v));
    if (!v.first_error.empty()) globals.Say("  the first error: " + v.first_error);
    for (const FailureRate& rate : v.failures) {
      if (rate.n == 0) continue;
      const Interval percent = RoundedOutward({100 * rate.lower, 100 * rate.upper});
      const std::string text =
          rate.k == 0 ? "none; at most " + PercentText(percent.upper / 100)
                      : fmt::format("{} = {} ({} to {})", rate.k, PercentText(rate.rate),
                                    NumberText(percent.lower), PercentText(percent.upper / 100));
      globals.Say(fmt::format("  {:<12} {}", rate.name, text));
    }
  }
}

}  // namespace

void SayResults(const CampaignOutcome& outcome, const std::filesystem::path& folder,
                const Globals& globals) {
  const CampaignSummary& summary = outcome.summary;
  globals.Result(SummaryJson(summary));
  globals.Say(std::string(WhyEnded(outcome.run.end)) + "; results are in " + folder.string());
  SayRates(summary, globals);
  if (ListFailingEpisodes(outcome.store, outcome.variants, folder, globals) > 0 ||
      outcome.variants.size() > 1)
    globals.Say(fmt::format("`floorproof report {}` shows them on a page", folder.string()));
  if (!summary.gate) return;
  for (const VariantGate& variant : summary.gate->variants)
    globals.Say(fmt::format("gate{}: {}",
                            summary.gate->variants.size() > 1 ? " " + variant.variant : "",
                            GateText(*summary.gate, variant)));
}

int ExitStatus(const CampaignOutcome& outcome) {
  const CampaignRun& run = outcome.run;
  const bool broken = std::ranges::any_of(run.variants, [](const auto& v) { return v.errors > 0; });
  if (broken) return kBroken;
  if (run.end == CampaignEnd::kFailFast) return kNotSuccess;
  const auto& gate = outcome.summary.gate;
  if (!gate) return kDone;
  if (gate->verdict == GateVerdict::kUndecided) return kGateUndecided;
  return gate->verdict == GateVerdict::kPassed ? kDone : kNotSuccess;
}

}  // namespace floorproof

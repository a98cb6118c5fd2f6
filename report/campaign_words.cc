// SPDX-License-Identifier: Apache-2.0
#include "report/campaign_words.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/exit_status.h"
#include "base/file_output.h"
#include "base/quantity.h"
#include "report/failing_episodes.h"
#include "run/campaign/dependence_text.h"
#include "stats/outward.h"

namespace floorproof {
namespace {

void SayRates(const CampaignSummary& summary, const std::vector<VariantDependence>& dependence,
              const Console& console) {
  for (std::size_t i = 0; i < summary.variants.size(); ++i) {
    const VariantSummary& v = summary.variants[i];
    console.Say(
        fmt::format("{}: {}, {} success, {} failure, {} timeout{}; {}, {} without "
                    "a plan",
                    v.name, CountText(v.n, "episode"), v.success, v.failure, v.timeout,
                    AbortedText(v), CountText(v.errors, "error"), v.not_planned));
    if (v.repeated) console.Say("  " + RepetitionText(v));
    if (!v.first_error.empty()) console.Say("  the first error: " + v.first_error);
    for (const FailureRate& rate : v.failures) {
      if (rate.n == 0) continue;
      const Interval percent = RoundedOutward({100 * rate.lower, 100 * rate.upper});
      const std::string text =
          rate.k == 0 ? "none; at most " + PercentText(percent.upper / 100)
                      : fmt::format("{} = {} ({} to {})", rate.k, PercentText(rate.rate),
                                    NumberText(percent.lower), PercentText(percent.upper / 100));
      console.Say(fmt::format("  {:<12} {}", rate.name, text));
    }
    for (const std::string& line : DependenceText(dependence[i])) console.Say("  " + line);
  }
}

}  // namespace

void SayCampaign(const CampaignOutcome& outcome, const std::filesystem::path& folder,
                 const Console& console) {
  const CampaignSummary& summary = outcome.summary;
  console.Say(std::string(WhyEnded(outcome.run.end)) + "; results are in " + folder.string());
  const std::vector<VariantDependence> dependence = DependenceOf(outcome.store, summary);
  WriteFileWhole(folder / "dependence.csv", DependenceCsv(dependence));
  SayRates(summary, dependence, console);
  if (ListFailingEpisodes(outcome.store, outcome.variants, folder, console) > 0 ||
      outcome.variants.size() > 1)
    console.Say(fmt::format("`floorproof report {}` shows them on a page", folder.string()));
  if (!summary.gate) return;
  for (const VariantGate& variant : summary.gate->variants)
    console.Say(fmt::format("gate{}: {}",
                            summary.gate->variants.size() > 1 ? " " + variant.variant : "",
                            GateText(*summary.gate, variant)));
}

int CampaignExitStatus(const CampaignOutcome& outcome) {
  const CampaignRun& run = outcome.run;
  const bool broken = std::ranges::any_of(run.variants, [](const auto& v) { return v.errors > 0; });
  if (broken) return kExitBroken;
  if (run.end == CampaignEnd::kFailFast) return kExitNotSuccess;
  const auto& gate = outcome.summary.gate;
  if (!gate) return kExitDone;
  if (gate->verdict == GateVerdict::kUndecided) return kExitUndecided;
  return gate->verdict == GateVerdict::kPassed ? kExitDone : kExitNotSuccess;
}

}  // namespace floorproof

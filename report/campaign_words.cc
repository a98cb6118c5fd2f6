// SPDX-License-Identifier: Apache-2.0
#include "report/campaign_words.h"

#include <algorithm>
#include <cstdio>

#include "base/error.h"
#include "base/exit_status.h"
#include "base/file_output.h"
#include "base/printable.h"
#include "base/quantity.h"
#include "base/shell_word.h"
#include "report/campaign_tables.h"
#include "report/failing_episodes.h"
#include "run/campaign/dependence_text.h"

namespace floorproof {
namespace {

Tone ToneOf(GateVerdict verdict) {
  switch (verdict) {
    case GateVerdict::kPassed:
      return Tone::kGood;
    case GateVerdict::kFailed:
      return Tone::kBad;
    case GateVerdict::kUndecided:
      break;
  }
  return Tone::kPlain;
}

}  // namespace

std::string ErrorsText(const CampaignSummary& summary) {
  int errors = 0, episodes = 0;
  std::string first;
  for (const VariantSummary& v : summary.variants) {
    errors += v.errors;
    episodes += v.n + v.errors + v.not_planned;
    if (first.empty() && !v.first_error.empty())
      first = (summary.variants.size() > 1 ? v.name + ", " : "") + v.first_error;
  }
  if (errors == 0) return "";
  return ErrorLine(FixedText(errors, 0) + " of " + CountText(episodes, "episode") +
                   " ended in an error, the first: " + first);
}

void SayCampaign(const CampaignOutcome& outcome, const std::filesystem::path& folder,
                 const Console& console, bool page_follows) {
  const CampaignSummary& summary = outcome.summary;
  const bool several = summary.variants.size() > 1;
  if (const std::string errors = ErrorsText(summary); !errors.empty()) console.Say(errors);
  console.Say(std::string(WhyEnded(outcome.run.end)));
  console.Say(OutcomesTable(summary));
  if (const TextTable modes = ModesTable(summary); !modes.empty()) console.Say(modes);
  for (const VariantSummary& v : summary.variants) {
    const std::string of = several ? v.name + ": " : "";
    if (v.repeated) console.Say(of + RepetitionText(v));
    if (several && !v.first_error.empty()) console.Say(of + "the first error: " + v.first_error);
  }
  const std::vector<VariantDependence> dependence = DependenceOf(outcome.store, summary);
  WriteFileWhole(folder / "dependence.csv", DependenceCsv(dependence));
  for (std::size_t v = 0; v < dependence.size(); ++v)
    for (const std::string& line : DependenceText(dependence[v]))
      console.Say((several ? summary.variants[v].name + ": " : "") + line);
  FactTable facts;
  const std::uint64_t failing =
      ListFailingEpisodes(outcome.store, outcome.variants, folder, console);
  if (failing > 0)
    facts.Add({"Failing episodes", FixedText(static_cast<double>(failing), 0) +
                                       ", with the command that films each: " +
                                       (folder / "failing_episodes.csv").string()});
  if (summary.gate)
    for (const VariantGate& variant : summary.gate->variants)
      facts.Add({"Gate",
                 {(several ? variant.variant + ": " : "") + GateText(*summary.gate, variant),
                  ToneOf(variant.report.verdict)}});
  if (!page_follows && (failing > 0 || several))
    facts.Add({"Page", "`floorproof report " + ShellWord(folder.string()) + "` makes one"});
  facts.Add({"Results", folder.string()});
  console.Say(facts);
}

void SayQuietErrors(const CampaignSummary& summary, const Console& console) {
  if (const std::string errors = ErrorsText(summary); console.quiet && !errors.empty())
    std::fprintf(stderr, "floorproof: %s\n", errors.c_str());
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

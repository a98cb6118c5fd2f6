// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/campaign_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/file_output.h"
#include "base/quantity.h"
#include "run/campaign/campaign_junit.h"
#include "run/campaign/episodes_csv.h"
#include "run/campaign/summary_json.h"
#include "run/episode/records.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

// Why not all episodes that were asked for were driven, of the variant that has least; empty: they
// were, or the gate was decided before.
std::string Unfinished(const CampaignRun& run, std::uint64_t asked) {
  if (run.end == CampaignEnd::kComplete || run.end == CampaignEnd::kGateDecided) return "";
  std::uint64_t least = asked;
  for (const VariantProgress& variant : run.variants) least = std::min(least, variant.prefix);
  return fmt::format("{} of {} stand without a gap: {}", least, CountText(asked, "episode"),
                     WhyEnded(run.end));
}

}  // namespace

ResultNames CampaignResults() {
  return {"campaign", [](std::string_view name) {
            return name == "scenario.resolved.yaml" || name == "episodes.csv" ||
                   name == "junit.xml" || name == "summary.json" ||
                   name == "failing_episodes.csv" || name == "dependence.csv";
          }};
}

CampaignSummary WriteSummaryFiles(const CampaignStore& store, const ScenarioFile& file,
                                  const CampaignRun& run, const std::filesystem::path& folder) {
  std::vector<GateState> gate;
  for (const VariantProgress& variant : run.variants)
    if (variant.gate) gate.push_back(*variant.gate);
  CampaignSummary summary = Summarise(store, file.variants(), gate, Unfinished(run, store.asked()));
  WriteFileWhole(folder / "episodes.csv", EpisodesCsv(store, file.variants()));
  WriteFileWhole(folder / "junit.xml",
                 JunitXml(summary, run.end == CampaignEnd::kFailFast, file.name()));
  WriteFileWhole(folder / "summary.json", JsonText(SummaryJson(summary)) + "\n");
  return summary;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/campaign_files.h"

#include <nlohmann/json.hpp>

#include "base/file_output.h"
#include "run/campaign/campaign_junit.h"
#include "run/campaign/episodes_csv.h"
#include "run/campaign/summary_json.h"

namespace floorproof {

CampaignSummary WriteSummaryFiles(const CampaignStore& store, const std::vector<Variant>& variants,
                                  const std::vector<GateState>& gate, const CampaignEnding& ending,
                                  const std::string& scenario_name,
                                  const std::filesystem::path& folder) {
  CampaignSummary summary = Summarise(store, variants, gate, ending.unfinished);
  WriteFileWhole(folder / "episodes.csv", EpisodesCsv(store, variants));
  WriteFileWhole(folder / "junit.xml", JunitXml(summary, ending.failed_fast, scenario_name));
  WriteFileWhole(folder / "summary.json", SummaryJson(summary).dump(2) + "\n");
  return summary;
}

}  // namespace floorproof

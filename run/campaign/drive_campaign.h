// SPDX-License-Identifier: Apache-2.0
// A campaign in its folder: begun or taken up again, driven, and its files written. What the
// command line calls, and whoever else drives campaigns.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "base/interrupt.h"
#include "base/result_folder.h"
#include "run/campaign/campaign.h"
#include "run/campaign/campaign_summary.h"

namespace floorproof {

class ScenarioFile;

struct EpisodeRange {
  std::uint64_t begin = 0, end = 0;  // ids, half-open
};

inline constexpr int kMostJobs = 1024;
inline constexpr int kMostEpisodes = 100'000'000;  // as the key `episode`

struct CampaignRequest {
  std::uint64_t episodes = 0;  // a variant, of the whole campaign; kMostEpisodes at most
  std::optional<EpisodeRange> shard = {};   // these alone are driven, and the gate is not judged
  int jobs = 1;                             // worker processes
  WorkerPool pool = {};                     // in place of them
  bool replays = false;                     // keeps those of failing episodes (replay_shelf.h)
  bool resume = false;                      // goes on with the campaign that the folder holds
  bool retry_errors = false;                // drives again what ended in an error
  bool fail_fast = false;                   // ends at the first episode that fails
  std::optional<double> time_limit_s = {};  // wall time
};

struct CampaignOutcome {
  // As long as it lives Ctrl-C is only remembered, so that what is made of the outcome is whole.
  std::unique_ptr<HoldInterrupts> hold;
  std::unique_ptr<ResultFolder> folder;  // further results are listed when it goes
  CampaignStore store;
  std::vector<Variant> variants;
  CampaignRun run;
  CampaignSummary summary;
};

// Reads and checks all variants before there is a folder, then drives what the folder's database
// lacks and writes scenario.resolved.yaml and the files of WriteSummaryFiles. The process must not
// have threads, unless a pool is given. Throws InputError where the scenario, its gate or the
// request makes no sense, where the folder holds a campaign (with `resume`: another one), where a
// fixed gate would be judged twice, and where the folder cannot be written to; InternalError, with
// what is missing, where the disk is full or results cannot be written. Interrupted it returns,
// with run.end saying so.
CampaignOutcome DriveCampaign(const ScenarioFile& file, const CampaignRequest& request,
                              const std::filesystem::path& folder,
                              CampaignObserver* observer = nullptr);

}  // namespace floorproof

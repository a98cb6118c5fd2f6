// SPDX-License-Identifier: Apache-2.0
// A campaign: the episodes of a scenario and its variants, driven on all cores and kept.
//
// Episode 0 of every variant is driven first, then episode 1 and so on, each by the next worker
// that is free. What is judged is the prefix of ids that is whole, never the order of arrival:
// failures end early and would be overcounted. Rows go into the database in batches.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "run/campaign/campaign_gate.h"
#include "run/campaign/campaign_store.h"
#include "run/campaign/replay_shelf.h"
#include "run/campaign/worker_pool.h"

namespace floorproof {

class ScenarioFile;

struct CampaignOptions {
  std::uint64_t begin = 0, end = 0;  // episode ids, half-open
  std::optional<CampaignGate> gate;  // none of a shard: it is judged on the whole campaign
  int jobs = 1;
  WorkerPool pool = {};                     // none: `jobs` processes of this machine
  ReplayShelf* replays = nullptr;           // where replays of failing episodes go; none: nowhere
  bool fail_fast = false;                   // ends at the first episode that fails
  std::optional<double> time_limit_s = {};  // wall time; what is in hand then is given up
};

enum class CampaignEnd { kComplete, kGateDecided, kFailFast, kTimeLimit, kInterrupted, kMissing };

// Where a variant stands: its prefix alone counts.
struct VariantProgress {
  std::uint64_t prefix = 0;  // ids before this one are all done
  std::uint64_t n = 0;       // of those, with an outcome that counts
  std::array<std::uint64_t, kNumFailureModes> failures{};
  std::uint64_t any_failure = 0, errors = 0;
  Repetition repetition;
  std::optional<GateState> gate;
};

struct CampaignProgress {
  std::span<const VariantProgress> variants;
  std::uint64_t done = 0, total = 0;  // rows, those of earlier runs too
  std::uint64_t done_now = 0;
  double elapsed_s = 0;
};

class CampaignObserver {
 public:
  virtual ~CampaignObserver() = default;
  virtual void OnWarning(const std::string&) {}  // before anything is driven
  virtual void OnProgress(const CampaignProgress&) {}
};

// "all episodes are done", or why they are not.
std::string_view WhyEnded(CampaignEnd end);

struct CampaignRun {
  CampaignEnd end = CampaignEnd::kComplete;
  std::vector<VariantProgress> variants;
};

// Drives what `store` does not hold yet. The caller holds interrupts (base/interrupt.h); the
// process must not have threads, unless a pool is given. Throws InputError when rows cannot be
// written: those before are.
CampaignRun RunCampaign(const ScenarioFile& file, CampaignStore& store,
                        const CampaignOptions& options, CampaignObserver* observer = nullptr);

}  // namespace floorproof

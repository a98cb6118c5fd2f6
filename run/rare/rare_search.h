// SPDX-License-Identifier: Apache-2.0
// A search for rare failures in its folder: begun or taken up again, driven, and its answer
// written. What the command line calls.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/interrupt.h"
#include "base/result_folder.h"
#include "run/rare/rare_gate.h"
#include "run/rare/rare_trials.h"

namespace floorproof {

class ScenarioFile;

struct RareRequest {
  std::string mode = "any_failure";
  RareSettings settings = {};  // its seed is not read: it is the scenario's
  int jobs = 1;                // worker processes
  bool resume = false;         // goes on with the search that the folder holds
  // Drives again what ended in an error, and all that was driven after it: where a search goes
  // hangs on each result before.
  bool retry_errors = false;
};

// A region's likeliest failure, as it was driven.
struct LikelyFailure {
  std::size_t region = 0;  // of the estimate's
  Drawn set;               // what makes it, key by key (RareCoordinates::AsSet)
  EpisodeRow row;
};

struct RareOutcome {
  // As long as it lives Ctrl-C is only remembered, so that what is made of the outcome is whole.
  std::unique_ptr<HoldInterrupts> hold;
  std::unique_ptr<ResultFolder> folder;
  std::string name, mode;  // the scenario's
  RareSettings settings;
  std::vector<std::string> coordinates;
  bool noisy = false;
  RareEstimate estimate;
  std::vector<LikelyFailure> failures;  // of the regions that were searched, in their order
  std::uint64_t errors = 0;             // trials that are no episode; they count as no failure
  std::string first_error;
  std::optional<RareVerdict> verdict;  // none: the scenario has no gate of mode rare
};

// Of a region; nullptr: none was looked for.
const LikelyFailure* FailureOf(const RareOutcome& outcome, std::size_t region);

class RareObserver {
 public:
  virtual ~RareObserver() = default;
  virtual void OnWarning(const std::string&) {}
  virtual void OnProgress(const std::string& /*stage*/, const RareProgress&) {}
};

// Files that it leaves: rare.json and scenario.resolved.yaml, beside trials.sqlite.
ResultNames RareResults();

// Reads and checks all before there is a folder, then drives what trials.sqlite lacks. A matrix is
// passed over. The process must not have threads. Throws InputError where scenario or request make
// no sense, where the folder holds a search (with `resume`: another one), and where more than a
// fifth of the first trials are errors; InternalError where results cannot be written; Interruption
// once what was driven is kept.
RareOutcome SearchRare(const ScenarioFile& file, const RareRequest& request,
                       const std::filesystem::path& folder, RareObserver* observer = nullptr);

}  // namespace floorproof

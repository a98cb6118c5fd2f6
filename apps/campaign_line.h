// SPDX-License-Identifier: Apache-2.0
// What commands that drive campaigns share: their options, and the line that says how it goes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/command.h"
#include "base/progress_line.h"
#include "run/campaign/drive_campaign.h"
#include "run/scenario/override.h"

namespace floorproof {

struct CampaignArguments {
  std::string out, episodes;  // A:B, half-open; empty: all of them
  std::uint64_t n = 0;
  int seed = -1;  // -1: the scenario's
  int jobs = 0;   // 0: one a core
  bool resume = false;
};
// Throws InputError where `episodes` is no range.
CampaignRequest RequestOf(const CampaignArguments& arguments);
// The globals' and the seed.
std::vector<Override> OverridesOf(const Globals& globals, const CampaignArguments& arguments);

// Warnings, then how it goes: what is done, the rates so far, time to go.
class CampaignLine final : public CampaignObserver {
 public:
  CampaignLine(const Globals& globals, const std::vector<Variant>& variants)
      : globals_(globals), line_(globals), variants_(variants) {}
  void OnWarning(const std::string& line) override { globals_.Say(line); }
  void OnProgress(const CampaignProgress& progress) override;
  void Clear() { line_.Clear(); }

 private:
  const Globals& globals_;
  ProgressLine line_;
  const std::vector<Variant>& variants_;
};

}  // namespace floorproof

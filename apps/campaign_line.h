// SPDX-License-Identifier: Apache-2.0
// What commands that drive campaigns share: the option --episodes, and the line that says how it
// goes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/command.h"
#include "base/progress_line.h"
#include "run/campaign/drive_campaign.h"

namespace floorproof {

// A:B, half-open; none: all of them. Throws InputError.
std::optional<EpisodeRange> ReadEpisodes(const std::string& text);

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

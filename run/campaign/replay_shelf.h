// SPDX-License-Identifier: Apache-2.0
// Replays of a campaign's failing episodes, in its folder: the page shows them without a second
// drive. Of each variant those of the lowest numbers are kept, so that which ones they are does not
// depend on the order in which episodes end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "run/campaign/episode_row.h"

namespace floorproof {

// Where a campaign's episode is written when it is driven again, and where its replay lies.
// Throws InputError if the variant's name would lead out of the campaign's folder.
std::filesystem::path VariantFolder(const std::filesystem::path& campaign,
                                    const std::string& variant);
std::filesystem::path EpisodeFolder(const std::filesystem::path& campaign,
                                    const std::string& variant, std::uint64_t episode);

// Whether it is shown as one that did not succeed.
bool IsListed(const EpisodeRow& row);

class ReplayShelf {
 public:
  static constexpr std::size_t kMost = 100;  // of each variant

  // Goes on with what lies in the campaign's folder.
  explicit ReplayShelf(std::filesystem::path campaign) : campaign_(std::move(campaign)) {}

  // Writes the row's replay, if it has one and is among the first that failed, and takes away what
  // it displaces. A folder that holds more than a replay is left as it is. Throws as
  // WriteFileWhole does.
  void Take(const EpisodeRow& row);

 private:
  std::set<std::uint64_t>& Of(const std::string& variant);

  std::filesystem::path campaign_;
  std::map<std::string, std::set<std::uint64_t>> kept_;  // by variant
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Two variants of a campaign compared over the episodes that they share.
#pragma once

#include <string>
#include <vector>

#include "env/run/episode_row.h"
#include "env/stats/paired.h"
#include "render/report.h"

namespace floorproof {

// What a comparison needs of a variant's episodes that count, ascending.
struct PairingValues {
  std::vector<EpisodeValue> failed;  // any failure
  std::vector<EpisodeValue> coverage;
  // Of successes only: an episode that a failure ends is short and cheap for no merit of its own.
  std::vector<EpisodeValue> duration_s, energy_j;
  void Add(const EpisodeRow& row);
};

// b less a, at this confidence.
ReportPair ComparePair(const std::string& name_a, const PairingValues& a, const std::string& name_b,
                       const PairingValues& b, double confidence);

}  // namespace floorproof

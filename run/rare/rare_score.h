// SPDX-License-Identifier: Apache-2.0
// What a search for rare failures makes of an episode: whether it failed, and how near it came.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "env/failures/detector.h"
#include "run/campaign/episode_row.h"
#include "stats/rare/rare_problem.h"

namespace floorproof {

class RareScore {
 public:
  // `mode`: a failure mode, or any_failure. Throws InputError where it is neither, or none of the
  // scenario's detectors tells how far from it a drive was.
  RareScore(const std::string& mode, std::span<const NamedDetector> detectors);

  // Failed: by an event, of any mode where that is asked, whatever the margins say. An episode that
  // is an error or without a plan is no failure, and far from one.
  //
  // The score is the detector's margin as a share of its threshold, the least where there are
  // several. Many drives share one: 1, where nothing came nearer, and 0, where what was beyond did
  // not last. So there is a second score: stuck, the way lost; bounced back, the force of contact,
  // then the way off the plan; veered off and rolled over, which seldom tie, the same as stuck; of
  // any failure the sum of all margins, too. It must not follow what is drawn by itself: time
  // would, by the speed, and would lead away from failures.
  TrialResult Of(const EpisodeRow& row) const;

 private:
  std::optional<FailureMode> mode_;  // none: any
};

}  // namespace floorproof

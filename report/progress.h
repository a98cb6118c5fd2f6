// SPDX-License-Identifier: Apache-2.0
// The progress line of an episode, and the recording that a film is made from.
#pragma once

#include <optional>

#include "base/interrupt.h"
#include "base/progress_line.h"
#include "render/film.h"
#include "run/episode/episode.h"

namespace floorproof {

// Simulated time, coverage, real-time factor and time to go. Ends the episode when the user
// interrupts: from the first control period on it holds interrupts, as long as it lives.
class ProgressObserver : public EpisodeObserver {
 public:
  // `recording` may be nullptr. `control_hz` as in the scenario.
  ProgressObserver(const Console& console, const RobotSpec& robot, int control_hz,
                   Recording* recording);
  void EndLine() { line_.Clear(); }  // for what is said next
  bool OnControl(const EpisodeView& now) override;

 private:
  std::optional<HoldInterrupts> hold_;
  ProgressLine line_;
  const RobotSpec& robot_;
  Recording* recording_;
  int record_every_;
  long count_ = 0;
  bool scan_ = false;  // there is one that is not recorded yet
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The progress line of an episode, and the recording that a film is made from.
#pragma once

#include <optional>

#include "base/interrupt.h"
#include "base/progress_line.h"
#include "render/film.h"
#include "run/episode/episode.h"

namespace floorproof {

// Keeps the states that a film is made from, often enough for one.
class StateRecorder {
 public:
  // Both outlive it. `control_hz` as in the scenario.
  StateRecorder(const RobotSpec& robot, int control_hz, Recording& recording);
  // Once a control period.
  void OnControl(const EpisodeView& now);
  // The present state, unless it is kept already.
  void Keep(const EpisodeView& now);

 private:
  const RobotSpec& robot_;
  Recording& recording_;
  int every_;
  long count_ = 0;
  bool scan_ = false;  // there is one that is not recorded yet
};

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
  std::optional<StateRecorder> recorder_;
  long count_ = 0;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The progress line of an episode, and the recording that a film is made from.
#pragma once

#include <chrono>
#include <optional>

#include "apps/command.h"
#include "env/core/interrupt.h"
#include "env/run/episode.h"
#include "render/film.h"

namespace floorproof {

// Simulated time, coverage, real-time factor and time to go: rewritten in place on a terminal, a
// plain line every ten seconds elsewhere. Ends the episode when the user interrupts: from the first
// control period on it holds interrupts, as long as it lives.
class ProgressObserver : public EpisodeObserver {
 public:
  // `recording` may be nullptr. `control_hz` as in the scenario.
  ProgressObserver(const Globals& globals, const RobotSpec& robot, int control_hz,
                   Recording* recording);
  ~ProgressObserver() override { EndLine(); }
  void EndLine();  // clears the progress line for what is said next
  bool OnControl(Simulation& simulation, double coverage, double plan_fraction) override;

 private:
  void Print(double t_s, double coverage, double plan_fraction, double wall_s);

  std::optional<HoldInterrupts> hold_;
  const Globals& globals_;
  const RobotSpec& robot_;
  Recording* recording_;
  int record_every_;
  long count_ = 0;
  bool terminal_, shown_ = false;
  std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace floorproof

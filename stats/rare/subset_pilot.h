// SPDX-License-Identifier: Apache-2.0
// One pilot: adaptive subset simulation (Au and Beck 2001) that goes from nominal draws to failures
// level by level. Each level holds the tenth that came nearest to failing.
//
// Chains move by preconditioned Crank-Nicolson steps (Papaioannou et al. 2015), which leave the
// standard normal density as it is; how far is set so that 44 % of the steps are taken. A pilot
// finds failures. Its own estimate of how likely they are varies a lot, and is only used to see
// whether pilots agree.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "base/streams.h"
#include "stats/rare/rare_problem.h"

namespace floorproof {

struct PilotFailure {
  Trial trial;
  // In independent draws: of a chain, whose states resemble each other, a quarter.
  double weight = 1;
};

class SubsetPilot {
 public:
  static constexpr int kDraws = 250;  // a level
  static constexpr int kSeeds = 25;   // of them go on
  enum class End { kGoesOn, kFoundFailures, kStalled, kCutOff };

  SubsetPilot(const RareProblem& problem, std::uint64_t seed, int number);

  // Adds the trials that it needs now, those with noise of their own numbered by their place from
  // `first`. Each call is followed by Take, with their results.
  void Propose(std::uint64_t first, std::vector<Trial>& trials);
  void Take(std::span<const TrialResult> results);
  // It gets no more trials. What failed in the level that it is in is its estimate.
  void CutOff();

  End end() const { return end_; }
  bool goes_on() const { return end_ == End::kGoesOn; }
  int levels() const { return level_ + 1; }
  // How likely a draw is in the level that it came to.
  double reached() const { return above_; }
  // Its estimate; 0 where it found no failure.
  double probability() const { return probability_; }
  // All that it met: each is a draw from the nominal density among failures, whatever its level.
  const std::vector<PilotFailure>& failures() const { return failures_; }
  // Among its first kDraws: failures, and trials that count.
  int nominal_failures() const { return nominal_failures_; }
  int nominal_draws() const { return nominal_draws_; }

 private:
  struct State {
    Trial trial;
    TrialResult result;
  };
  void Keep(const State& state);
  void EndLevel();

  const RareProblem& problem_;
  Stream stream_;
  End end_ = End::kGoesOn;
  int level_ = 0, step_ = 0, steps_ = 1;
  double above_ = 1;         // how likely a draw is in this level
  TrialResult threshold_{};  // of the level
  double width_ = 0.6;       // of a step
  std::vector<State> states_, chains_;
  std::vector<Trial> proposed_;
  std::vector<PilotFailure> failures_;
  int nominal_failures_ = 0, nominal_draws_ = 0;
  double probability_ = 0;
};

// "found failures", or why it did not.
std::string_view Name(SubsetPilot::End end);

// A standard normal vector.
Eigen::VectorXd NormalVector(Stream& stream, Eigen::Index dimensions);

}  // namespace floorproof

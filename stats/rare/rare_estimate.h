// SPDX-License-Identifier: Apache-2.0
// How likely a rare failure is, and how it comes about.
//
// Five independent pilots (subset_pilot.h) look for failures. A density is fitted to what they
// found (failure_mixture.h), and fitted again after draws from it that serve nothing else. Then the
// density stays as it is, and fresh draws from it, weighted by how much likelier they are nominally
// (defensive_density.h), give the estimate: it is unbiased whatever the pilots did, but for what
// comes of looking at the first 2,000 draws to say how many more there are (about the square of the
// target: a hundredth of it at 0.1). What they did not
// find it may still miss, together with its interval; so the answer holds bounds that rest on no
// sampler, and where the draws or the pilots do not agree there is no estimate at all.
//
// All of it follows from the seed and from the trials' results alone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stats/interval.h"
#include "stats/rare/rare_problem.h"
#include "stats/rare/subset_pilot.h"

namespace floorproof {

struct RareSettings {
  double target_cov = 0.1;  // coefficient of variation that the estimate should have
  std::uint64_t max_trials = 15'000;
  std::uint64_t seed = 0;
  double confidence = kReportedConfidence;  // of the interval and of each bound
};

inline constexpr int kPilots = 5;
inline constexpr Eigen::Index kMostCoordinates = 40;

// Fewer cannot reach the target, even if every draw failed that the fitted density is for.
std::uint64_t FewestTrials(double target_cov);
// Throws InputError unless 0.01 <= target_cov <= 1, 0 < confidence < 1 and FewestTrials(target_cov)
// <= max_trials <= 1e7.
void CheckRareSettings(const RareSettings& settings);

struct PilotReport {
  SubsetPilot::End end = SubsetPilot::End::kGoesOn;
  int levels = 0, failures = 0;
  double probability = 0;
  double reached = 1;  // how likely a draw is in the level that it came to
};

// Failures that look alike.
struct FailureRegion {
  double share = 0;  // of the probability
  int draws = 0;     // failures among the fresh draws
  int pilots = 0;    // that came upon it
  Trial likeliest = {};
  double distance = 0;    // of it from the origin, in standard deviations
  bool searched = false;  // for it; else it is the nearest that was met
};

enum class RareAnswer { kEstimate, kNothingFound, kNoEstimate };

struct RareEstimate {
  RareAnswer answer = RareAnswer::kNoEstimate;
  std::string why;  // there is none, in a clause
  double probability = 0, cov = 0;
  Interval interval;  // rests on the sampler: it knows what it has found
  bool reached_target = false;
  // One-sided, at the confidence. The lower one holds for any distribution of the weights, the
  // upper one is that of nominal draws alone, which need no sampler.
  double lower_bound = 0, upper_bound = 1;
  double confidence = kReportedConfidence;  // theirs, and the interval's
  int nominal_draws = 0, nominal_failures = 0;
  int fresh_draws = 0, fresh_failures = 0;
  double largest_share = 0;       // of the estimate, that one draw makes
  double effective_failures = 0;  // as many of equal weight would be as sure
  double freedom = 1;             // degrees of, with which `cov` is known
  std::vector<PilotReport> pilots;
  std::vector<FailureRegion> regions;  // the largest share first
  std::uint64_t trials = 0;
};

// What the search is about to do, in words for people, said before its trials.
using RareStage = std::function<void(const std::string&)>;

// Throws as CheckRareSettings, and InputError unless 1 <= dimensions <= kMostCoordinates.
RareEstimate EstimateRare(const RareProblem& problem, const RareSettings& settings,
                          const RareStage& stage = {});

// The interval of an estimate: Student's, of its logarithm, as a probability is positive and its
// error is proportional to it. Its degrees of freedom are those with which the weights' own squares
// say how far they spread, 2 (sum w^2)^2 / sum w^4 (Satterthwaite 1946): few large weights know it
// badly. Throws InputError unless 0 < confidence < 1, and `estimate` is one.
Interval IntervalOf(const RareEstimate& estimate, double confidence);

// Nominal draws without a failure that show that it is rarer than `probability`.
double CleanDrawsNeeded(double probability, double confidence);

}  // namespace floorproof

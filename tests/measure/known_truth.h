// SPDX-License-Identifier: Apache-2.0
// A plan with ten crossings whose probability of failure is known, predicted from encounters drawn
// with the same rates.
#pragma once

#include "measure/fit_rates.h"
#include "planners/risk/survival.h"
#include "tests/measure/planted_rates.h"

namespace floorproof {

// A robot that fails at steps, the more the higher and the more slippery, and with its kinetic
// energy; at high speeds it rather veers off, at low ones it is held; one failure in two hundred
// overturns it.
inline ModeNumbers StepRates(const Encounter& e) {
  const double total =
      RateOf(-1.2 + 240 * (e.size[0].second - 0.01) + 3 * (1 / e.at.friction - 1 / 0.6) +
             25 * (std::pow(e.at.speed_mps, 2) - 0.04));
  const double veer = Step(-1.5 + 15 * (e.at.speed_mps - 0.2));
  return {0.995 * total * veer, 0.995 * total * (1 - veer), 0.005 * total, 0};
}

// Crossing i of the plan, on a floor of this friction.
inline Encounter PlannedStep(int i, double friction) {
  Encounter e;
  e.type = "step";
  e.size = {{"height_m", 0.005 + 0.0008 * i}};
  e.at.speed_mps = 0.12 + 0.016 * i;
  e.at.friction = friction;
  return e;
}
inline constexpr int kPlannedSteps = 10;
inline constexpr double kLeastFriction = 0.45, kMostFriction = 0.85;  // an episode's

inline double TrueSurvival() {
  constexpr int kFrictions = 2000;
  double mean = 0;
  for (int k = 0; k < kFrictions; ++k) {
    const double friction =
        kLeastFriction + (kMostFriction - kLeastFriction) * (k + 0.5) / kFrictions;
    double sum = 0;
    for (int i = 0; i < kPlannedSteps; ++i) sum += Total(StepRates(PlannedStep(i, friction)));
    mean += std::exp(-sum) / kFrictions;
  }
  return mean;
}

// Encounters are drawn and fitted, conditions drawn, the plan predicted. All by this stream.
inline Survival PredictedSurvival(int encounters, int conditions, Stream& random) {
  const RiskModel model = FitRates(DrawEncounters(encounters, StepRates, DrawStep, random), {}, {});
  const RateEvaluator rates(model.kinds.at(0));
  std::vector<std::vector<PlannedMeeting>> drawn(conditions);
  for (std::vector<PlannedMeeting>& condition : drawn) {
    const double friction = random.Uniform(kLeastFriction, kMostFriction);
    for (int i = 0; i < kPlannedSteps; ++i) {
      const Encounter step = PlannedStep(i, friction);
      condition.push_back({&rates, step.size, step.at, 1, static_cast<std::size_t>(i)});
    }
  }
  return PredictSurvival(drawn, kPlannedSteps, model);
}

// The share of repeats whose interval holds the truth.
inline double Coverage(int repeats, int encounters, int conditions) {
  const double truth = TrueSurvival();
  int covers = 0;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    Stream random(2, repeat, "known_truth");
    const Probability p = PredictedSurvival(encounters, conditions, random).no_failure;
    covers += p.lower <= truth && truth <= p.upper;
  }
  return static_cast<double>(covers) / repeats;
}

}  // namespace floorproof

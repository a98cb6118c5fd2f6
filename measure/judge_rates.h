// SPDX-License-Identifier: Apache-2.0
// How well a risk model predicts encounters that it was not fitted to.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "env/core/encounter.h"
#include "measure/fit_rates.h"
#include "planners/risk/model_rates.h"

namespace floorproof {

// What was predicted of one encounter, and what came of it: a mode, or -1, cleared.
struct JudgedEncounter {
  ModeNumbers first = {};  // by mode: that it is what ends it
  int mode = -1;
};

struct RateJudgement {
  int encounters = 0, failures = 0;
  // Mean of -log of what was predicted for what came (cleared, or a mode), in nats. `constant`: of
  // the shares that these very encounters had, whatever they were met with.
  double log_loss = 0, log_loss_of_constant = 0;
  // Of the logistic regression of failures on the predictions' log odds. 1 and 0 are right; a slope
  // below 1 says that predictions are too bold. None: nothing can be said (CalibrationLine).
  std::optional<double> slope, intercept;
  // Expected calibration error: in ten equally wide bins of predicted P(failure), the mean distance
  // of predictions from outcomes. `by_chance`: what predictions that are right would show here.
  double calibration_error = 0, calibration_error_by_chance = 0;
};
RateJudgement Judge(std::span<const JudgedEncounter> judged);

// Of the encounters with an outcome, of kinds that the model has; in the same order. Exposures are
// left out: of one that failed nobody knows how long it would have been.
std::vector<JudgedEncounter> Predicted(const ModelRates& model,
                                       const std::vector<Encounter>& encounters);

struct JudgedKind {
  std::string type;
  Passage passage = Passage::kOver;
  RateJudgement of;
};
struct HoldOut {
  RateJudgement of_all;
  std::vector<JudgedKind> kinds;
};
// Of a drive's meetings with one hazard the first counts. They are cut at random into so many parts
// (at least 2), each predicted by the model of the others. The same encounters give the same
// figures.
HoldOut JudgeByHoldOut(const std::vector<Encounter>& encounters, const RateFitOptions& options,
                       int parts = 5);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What a risk model says of a path over a floor that is known: which hazards it meets, at which
// expected rates, and how probable it is that all of it is driven without a failure.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "env/core/passages.h"
#include "planners/planner.h"
#include "planners/risk/model_rates.h"
#include "planners/risk/survival.h"

namespace floorproof {

// Of a robot's top speed: the least that its meetings are driven at where rates are measured.
// Slower entries are in the data, but of robots that were held, or came out of a turn.
inline constexpr double kLeastMeasuredSpeed = 0.3;

// How a path fares. Walls beside it are left out: they are the same for plans of one floor, but for
// how long they are.
struct PathSurvival {
  std::vector<PlannedPassage> passages;
  Survival survival;   // by_meeting: by passage, then the free floor
  int crossings = 0;   // passages over hazards
  int unmeasured = 0;  // of these, of kinds of which the model knows nothing
  double p_failure() const { return 1 - survival.no_failure.value; }
};

class PathRates {
 public:
  // `request` has a model; it and all that it names outlive this. Without conditions: the map's
  // friction and the robot's own mass and clearance.
  explicit PathRates(const PlanRequest& request);

  // Mean over the conditions of the rate of all failures of one meeting, in this direction (unit);
  // none: not measured.
  std::optional<double> Expected(const Hazard& hazard, Passage passage, Approach at,
                                 const Vec2& travel_W) const;
  // The speeds that are worth trying for this robot where it meets a hazard, ascending, m/s: within
  // what was measured of that kind.
  std::vector<double> Speeds(const Hazard& hazard, Passage passage) const;

  std::vector<PlannedPassage> Passages(const Path& path) const;
  // Throws InputError as Covariates does.
  PathSurvival Of(const Path& path) const;

 private:
  const PlanRequest& request_;
  std::vector<DriveConditions> conditions_;
  ModelRates rates_;
};

}  // namespace floorproof

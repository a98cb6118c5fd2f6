// SPDX-License-Identifier: Apache-2.0
// How probable it is that a plan fails, before it is driven: by mode, by hazard and by place.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "planners/planner.h"
#include "planners/risk/survival.h"
#include "run/scenario/matrix.h"

namespace floorproof {

class ScenarioFile;
struct Scenario;

// A meeting of the plan, as it is expected in the first condition; or its way along walls, or on
// free floor.
struct PredictedMeeting {
  Encounter expected;
  double probability = 0;  // that it is what ends the drive
  double beyond = 0;       // how far it lies beyond what was measured, a share of that range
};

struct Prediction {
  PlanResult plan;  // of the first condition
  int conditions = 0;
  Survival survival;
  std::vector<PredictedMeeting> meetings;
  // Kinds that the plan meets and of which nothing was measured: a meeting of them counts as one
  // that cannot fail.
  struct Unmeasured {
    std::string type;
    Passage passage = Passage::kOver;
    int meetings = 0;
    std::string why;
  };
  std::vector<Unmeasured> unmeasured;

  // Where meetings lie beyond what was measured: the farthest, as a share of the measured range.
  struct Beyond {
    std::string type, axis;
    double share = 0;
    std::size_t meeting = 0;
  };
  std::vector<Beyond> beyond;
  // The first value, in any drawn condition, that is so far beyond the measured range that the
  // rates do not apply (IsFarBeyond).
  struct FarBeyond {
    std::string type, axis;
    double value = 0, lower = 0, upper = 0;  // and the measured range
    std::size_t meeting = 0;
  };
  std::optional<FarBeyond> far_beyond;

  // What the scenario has that rates know nothing of, in words.
  std::vector<std::string> left_out;
  int held_against_plans = 0;  // that were driven: the rates
  // Hazards lie elsewhere in other draws; places and sizes are those of the first.
  bool floors_differ = false;

  // If false, the failure probability is a lower bound, with a value far beyond the range a guess.
  // The interval ends at 1 if the kind of an encounter was not measured, a value is far beyond the
  // range, a ramp does not lead to a floor, or the plan crosses the edge of the floor on which it
  // starts.
  bool complete() const { return unmeasured.empty() && left_out.empty() && !far_beyond; }
};

// Of the scenario's plan in the conditions that its first `draws` episodes draw; one condition
// where it draws nothing. Where draws change more than friction, mass and clearance each is planned
// anew. `progress`: told after each condition. Throws InputError where the scenario names no risk
// model, plans on the way, or has no plan.
Prediction Predict(const ScenarioFile& file, const Variant& variant, int draws,
                   const std::function<void(int done)>& progress = {});

// A line each, with units; what needs a look begins with "warning: ".
std::vector<std::string> PredictionLines(const Prediction& prediction);
// predict.json's content. `plan`: its plan's PlanJson.
nlohmann::ordered_json PredictionJson(const Scenario& scenario, const Prediction& prediction,
                                      const nlohmann::ordered_json& plan);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A scenario from plan to record: what commands, campaigns, benches and tests all do.
#pragma once

#include <optional>

#include "env/scene/scene.h"
#include "run/episode/episode.h"
#include "run/episode/make_plan.h"

namespace floorproof {

struct Scenario;

struct Execution {
  PlanResult plan;
  std::optional<Scene> scene;  // none: there was no plan, or no physics
  EpisodeRecord record;
};

// Plans, builds the scene, drives. Without a plan the outcome is kNotPlanned; with `drive: none` it
// is kSuccess, and nothing is driven; with `drive: cells` there is no scene. Throws InputError,
// InternalError.
Execution Execute(const Scenario& scenario, EpisodeObserver* observer = nullptr);

// The rest of it, the plan made before.
EpisodeRecord ExecutePlan(const Scenario& scenario, const PlanResult& plan,
                          std::optional<Scene>& scene, EpisodeObserver* observer = nullptr);

}  // namespace floorproof

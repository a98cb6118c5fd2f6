// SPDX-License-Identifier: Apache-2.0
// The parts of the module, each in a file of its own.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "env/scene/scene.h"
#include "python/bindings/host.h"
#include "render/film.h"
#include "run/episode/episode.h"
#include "run/scenario/scenario.h"

namespace floorproof {

// An episode with all that pictures of it need.
struct Driven {
  std::shared_ptr<Scenario> scenario;
  PlanResult plan;
  EpisodeRecord record;
  std::optional<Scene> scene;          // none: there was no plan, or no physics
  std::optional<Recording> recording;  // none: nobody asked for frames
};

// A plan, and the scenario that it is of.
struct Planned {
  std::shared_ptr<Scenario> scenario;
  PlanResult plan;
};

void BindScenario(nb::module_& m);
void BindEpisode(nb::module_& m);
void BindPictures(nb::module_& m);
void BindPlannerPlugins(nb::module_& m);
void BindOnlinePlugins(nb::module_& m);
void BindTrackerPlugins(nb::module_& m);
void BindCampaign(nb::module_& m);
void BindStepped(nb::module_& m);

}  // namespace floorproof

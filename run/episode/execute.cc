// SPDX-License-Identifier: Apache-2.0
#include "run/episode/execute.h"

#include "run/episode/cell_drive.h"

namespace floorproof {

Execution Execute(Scenario& scenario, EpisodeObserver* observer) {
  Execution out;
  out.plan = MakePlan(scenario);
  if (observer) observer->OnPlan(out.plan);
  out.record = ExecutePlan(scenario, out.plan, out.scene, observer);
  return out;
}

EpisodeRecord ExecutePlan(Scenario& s, const PlanResult& plan, std::optional<Scene>& scene,
                          EpisodeObserver* observer) {
  if (plan.status == PlanStatus::kOnline && s.episode.drive == "cells")
    return DriveCells(s, observer);
  EpisodeRecord record;
  const bool on_the_way = plan.status == PlanStatus::kOnline && s.episode.drive == "physics";
  if (plan.status != PlanStatus::kSuccess && !on_the_way) {
    record.outcome = Outcome::kNotPlanned;
    record.message = plan.message;
    return record;
  }
  if (s.episode.drive == "none") {
    record.outcome = Outcome::kSuccess;
    return record;
  }
  scene = BuildScene(s.site.map, s.robot, s.physics, s.start);
  if (observer) observer->OnScene(*scene);
  return RunEpisode(s, *scene, plan, observer);
}

}  // namespace floorproof

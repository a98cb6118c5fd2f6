// SPDX-License-Identifier: Apache-2.0
#include "run/episode/execute.h"

#include <algorithm>
#include <utility>

#include "run/episode/cell_drive.h"
#include "run/scenario/agents.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

void MeasureSamples(const RobotSpec& robot, const PlanResult& plan, EpisodeRecord& record) {
  if (plan.samples.empty()) return;
  Metrics& m = record.metrics;
  m.samples_taken = static_cast<double>(record.sample_stops.size());
  for (const SampleStop& stop : record.sample_stops)
    m.max_sample_off_m = std::max(m.max_sample_off_m.value_or(0), OffPlace(robot, plan, stop));
  if (!record.audit) return;
  m.dirt_gathering = record.audit->gathering.Efficiency();
  m.audit_score = record.audit->region.score.mean;
}

}  // namespace

Execution Execute(const Scenario& scenario, EpisodeObserver* observer) {
  Execution out;
  out.plan = MakePlan(scenario);
  if (observer) observer->OnPlan(out.plan);
  out.record = ExecutePlan(scenario, out.plan, out.scene, observer);
  return out;
}

EpisodeRecord ExecutePlan(const Scenario& s, const PlanResult& plan, std::optional<Scene>& scene,
                          EpisodeObserver* observer) {
  if (plan.status == PlanStatus::kOnline && s.spec.episode.drive == "cells")
    return DriveCells(s, observer);
  EpisodeRecord record;
  const bool on_the_way = plan.status == PlanStatus::kOnline && s.spec.episode.drive == "physics";
  if (plan.status != PlanStatus::kSuccess && !on_the_way) {
    record.outcome = Outcome::kNotPlanned;
    record.message = plan.message;
    return record;
  }
  if (s.spec.episode.drive == "none") {
    record.outcome = Outcome::kSuccess;
    return record;
  }
  std::optional<DirtField> dirt;  // laid before the drive: what is wrong with it costs no drive
  if (s.world.dirt && !plan.samples.empty()) dirt = DirtyFloor(s, *plan.risk);
  scene = BuildScene(s.world.site.map, s.world.robot, s.world.physics, s.world.start);
  if (observer) observer->OnScene(*scene);
  Agents agents = MakeAgents(s.spec);
  record = RunEpisode(s, agents, *scene, plan, observer);
  if (dirt) record.audit = AuditFloor(s, plan, record.sample_stops, std::move(*dirt));
  MeasureSamples(s.world.robot.spec, plan, record);
  return record;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What the samples of a drive say of the floor, beside what truly lay there.
#pragma once

#include <optional>
#include <vector>

#include "env/audit/audit_sample.h"
#include "env/audit/dirt_field.h"
#include "env/audit/gathering.h"
#include "env/audit/space_score.h"
#include "planners/planner.h"
#include "run/episode/sample_log.h"
#include "stats/interval.h"

namespace floorproof {

struct Scenario;

// The tape's middle, below the robot's sensor.
Pose2 TapePose(const RobotSpec& robot, const SampleStop& stop);
// From the place where it was to be taken, m.
double OffPlace(const RobotSpec& robot, const PlanResult& plan, const SampleStop& stop);

struct AuditedSample {
  SampleStop stop;
  Pose2 X_WT;
  AuditSample sample;
};

struct RegionScore {
  SpaceScore score;
  // Of the mean, at kReportedConfidence. None: too few samples, or places that keep to a lattice.
  std::optional<Interval> interval;
};

struct FloorAudit {
  // Particles a square metre of floor before the first sample; NaN on cells without floor.
  GridFrame dirt_frame;
  Grid<float> dirt_per_m2;
  double mean_dirt_per_m2 = 0;
  std::vector<AuditedSample> samples;  // in the order of visit
  Gathering gathering;
  int unreadable = 0;  // samples whose images let nothing be read; they count for nothing else
  // Of the floor near walls and corners; of the rest, where a few places were drawn; of both, each
  // by its share of the room. Places that the user gave are a region without parts, and are taken
  // for drawn by chance.
  RegionScore region;
  std::optional<RegionScore> near_walls, elsewhere;
};

// A round of the cleaner; the scenario has the key `dirt`. Throws InputError where it finds none.
// `risk`: of the floor, for cleaners that need it.
PlanResult CleanerPlan(const Scenario& scenario, const RiskMap& risk);

// The floor of this episode as the robot finds it: the scenario's dirt is laid, and cleaned as it
// says. Throws as CleanerPlan does.
DirtField DirtyFloor(const Scenario& scenario, const RiskMap& risk);

// Takes the samples where the robot truly stood, in order. The scenario has the key `dirt`.
FloorAudit AuditFloor(const Scenario& scenario, const PlanResult& plan,
                      const std::vector<SampleStop>& stops, DirtField field);

}  // namespace floorproof

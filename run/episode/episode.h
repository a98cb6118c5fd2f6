// SPDX-License-Identifier: Apache-2.0
// One episode: a plan driven through physics.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "controllers/navigator.h"
#include "env/core/coverage.h"
#include "env/sim/plant.h"
#include "env/sim/simulation.h"
#include "planners/planner.h"
#include "run/episode/episode_record.h"

namespace floorproof {

class RobotSide;
struct Agents;
struct Scenario;

// An episode as it stands at a control period.
struct EpisodeView {
  const Sample& sample;
  const Observation& sensed;
  const Estimate& estimate;
  Simulation* simulation;  // nullptr: driven without physics
  double coverage = 0, plan_fraction = 0;
};

// Looks on: progress lines, films, Ctrl-C.
class EpisodeObserver {
 public:
  virtual ~EpisodeObserver() = default;
  // Of Execute(): the plan is made, whatever its status; the scene is built.
  virtual void OnPlan(const PlanResult&) {}
  virtual void OnScene(const Scene&) {}
  // Once a control period.
  // Returns false to end the episode here (outcome kInterrupted).
  virtual bool OnControl(const EpisodeView& now) = 0;
};

// An episode a control period at a time, for who commands the robot from outside. All that it is
// given outlives it, but for the agents, which are its own.
class SteppedEpisode {
 public:
  // `navigator`: none: the scenario's own. Throws InputError.
  SteppedEpisode(const Scenario& scenario, Agents agents, const Scene& scene,
                 const PlanResult& plan, std::unique_ptr<Navigator> navigator = nullptr);
  ~SteppedEpisode();

  // Commands, drives one period and senses what came of it; the outcome where that ended the
  // episode. The time limit, enough coverage and the end of a path whose tracker can tell it end
  // the period that reaches them, the tracker being asked once more. Not after it has ended.
  std::optional<Outcome> Advance();
  // As it stands now: what was sensed last, and what the robot thinks of it, is of this moment;
  // where a failure broke a period off, once Finish() has been called.
  EpisodeView view();
  const std::vector<Event>& events() const;
  const CoverageMeter& swept() const;
  const SweepArea& area() const;
  const RobotSide& robot() const;
  // Once it has ended, or to end it.
  EpisodeRecord Finish(Outcome outcome);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Drives the plan. `agents`: made for it (MakeAgents); what they have become is of no use to
// another episode.
EpisodeRecord RunEpisode(const Scenario& scenario, Agents& agents, const Scene& scene,
                         const PlanResult& plan, EpisodeObserver* observer = nullptr);
// The same on any plant; `simulation`: for observers, nullptr where there is none.
EpisodeRecord RunEpisode(const Scenario& scenario, Agents& agents, Plant& plant,
                         Simulation* simulation, const PlanResult& plan, EpisodeObserver* observer);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// One episode: a plan driven through physics, and everything that is recorded of it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "controllers/missed_stops.h"
#include "controllers/navigator.h"
#include "controllers/supervision/supervisor.h"
#include "env/core/coverage.h"
#include "env/core/drawn_map.h"
#include "env/core/event.h"
#include "env/sim/plant.h"
#include "env/sim/simulation.h"
#include "planners/planner.h"
#include "run/episode/floor_audit.h"
#include "run/episode/metrics.h"
#include "run/episode/sample_log.h"
#include "run/episode/timeout.h"
#include "run/episode/trace.h"
#include "run/scenario/scenario.h"

namespace floorproof {

class RobotSide;

// Aborted: the robot has stopped for good, by its own decision (controllers/supervision).
enum class Outcome { kSuccess, kFailure, kTimeout, kAborted, kNotPlanned, kError, kInterrupted };
std::string_view Name(Outcome outcome);

struct Margin {
  std::string detector;
  double value = 0;  // least distance from failing, in the threshold's unit; positive is safe
};

// A person's help: the robot taken up where it had failed, and set down upright at a waypoint.
struct Intervention {
  double t_s = 0;      // of setting down
  Vec2 from_W, to_W;   // taken up, and the waypoint
  double yaw_rad = 0;  // as it was set down
};

struct EpisodeRecord {
  Outcome outcome = Outcome::kError;
  std::string message;  // why, where the outcome alone does not say it
  std::vector<Event> events;
  std::vector<Intervention> interventions;
  std::optional<Timeout> timeout;  // where that is the outcome
  std::vector<SafetyRow> safety;   // of a supervised robot
  std::vector<RaisedAlarm> alarms;
  std::vector<SpeedShare> speed_shares;
  Metrics metrics;
  std::vector<Margin> margins;
  std::vector<TraceRow> trace;
  Grid<std::uint8_t> passes;  // of the tool, on the sweep area's grid
  GridFrame passes_frame;
  Grid<std::uint8_t> sweepable;
  std::vector<SampleStop> sample_stops;  // of an audit's plan: what it took, in order
  std::optional<FloorAudit> audit;       // what that says, where dirt is laid
  std::optional<KnownMap> known;         // what the robot's mapper drew, where it has one
  std::int64_t steps = 0;
  // Of an online planner: its own, for result.json and the columns plan.*, in order.
  std::vector<std::pair<std::string, double>> figures;

  // A success that covered less than it must is a failure, and says so.
  void RequireCoverage(double least);
  // A success that missed its plan's end is a failure, too. Whatever was missed is said.
  void TakeMissed(const MissedStops& missed);
};

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
// given outlives it; the scenario's plug-ins are started afresh.
class SteppedEpisode {
 public:
  // `navigator`: none: the scenario's own. Throws InputError.
  SteppedEpisode(Scenario& scenario, const Scene& scene, const PlanResult& plan,
                 std::unique_ptr<Navigator> navigator = nullptr);
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

// Drives the plan. The scenario's plug-ins are started afresh, so the same call gives the same
// record.
EpisodeRecord RunEpisode(Scenario& scenario, const Scene& scene, const PlanResult& plan,
                         EpisodeObserver* observer = nullptr);
// The same on any plant; `simulation`: for observers, nullptr where there is none.
EpisodeRecord RunEpisode(Scenario& scenario, Plant& plant, Simulation* simulation,
                         const PlanResult& plan, EpisodeObserver* observer);

}  // namespace floorproof

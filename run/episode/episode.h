// SPDX-License-Identifier: Apache-2.0
// One episode: a plan driven through physics, and everything that is recorded of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "env/core/coverage.h"
#include "env/core/event.h"
#include "env/core/known_map.h"
#include "env/sim/plant.h"
#include "env/sim/simulation.h"
#include "planners/planner.h"
#include "run/scenario/scenario.h"

namespace floorproof {

enum class Outcome { kSuccess, kFailure, kTimeout, kNotPlanned, kError, kInterrupted };
std::string_view Name(Outcome outcome);

// A row of trace.csv; truth unless est_.
struct TraceRow {
  double t_s;
  float x_m, y_m, z_m, roll_rad, pitch_rad, yaw_rad, vx_mps, vy_mps, wz_radps;
  float cmd_vx_mps, cmd_vy_mps, cmd_wz_radps, est_x_m, est_y_m, est_yaw_rad;
  float cross_track_m, power_w, coverage;
  int shape;           // as in Sample
  float est_spread_m;  // as in Estimate
};

struct Metrics {
  double coverage = 0, overlap = 0;
  double path_length_m = 0;            // driven
  double duration_s = 0;               // simulated
  double energy_j = 0;                 // at the battery's terminals
  double charge_ah = 0;                // drawn from it
  double least_battery_v = 0;          // at its terminals
  std::optional<double> battery_left;  // share of its capacity; none: the scenario states none
  double max_cross_track_m = 0, mean_cross_track_m = 0;
  int turns = 0;               // of the plan
  double cumulative_risk = 0;  // of the cells that its centre came to, as driven (RiskMeter)
  int interventions = 0;       // a person's
  int reactions = 0;           // times the robot went back from what it met (the key `react`)
  double max_estimate_error_m = 0, mean_estimate_error_m = 0;  // of the place, against the truth
  double p95_estimate_error_m = 0;    // below which it was for 95 % of the time, to a millimetre
  double mean_estimate_spread_m = 0;  // that the estimator itself believed in
  int contacts = 0;                   // times the body met an obstacle
  double max_impulse_ns = 0;          // of one physics step
};

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
  Metrics metrics;
  std::vector<Margin> margins;
  std::vector<TraceRow> trace;
  Grid<std::uint8_t> passes;  // of the tool, on the sweep area's grid
  GridFrame passes_frame;
  Grid<std::uint8_t> sweepable;
  std::optional<KnownMap> known;  // what the robot's mapper drew, where it has one
  std::int64_t steps = 0;
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

// Drives the plan. The scenario's plug-ins are started afresh, so the same call gives the same
// record.
EpisodeRecord RunEpisode(Scenario& scenario, const Scene& scene, const PlanResult& plan,
                         EpisodeObserver* observer = nullptr);
// The same on any plant; `simulation`: for observers, nullptr where there is none.
EpisodeRecord RunEpisode(Scenario& scenario, Plant& plant, Simulation* simulation,
                         const PlanResult& plan, EpisodeObserver* observer);

}  // namespace floorproof

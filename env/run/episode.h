// SPDX-License-Identifier: Apache-2.0
// One episode: a plan driven through physics, and everything that is recorded of it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "controllers/drive.h"
#include "env/core/coverage.h"
#include "env/core/event.h"
#include "env/run/scenario.h"
#include "env/sim/simulation.h"
#include "planners/planner.h"

namespace floorproof {

enum class Outcome { kSuccess, kFailure, kTimeout, kNotPlanned, kError, kInterrupted };
std::string_view Name(Outcome outcome);

// A row of trace.csv; truth unless est_.
struct TraceRow {
  double t_s;
  float x_m, y_m, z_m, roll_rad, pitch_rad, yaw_rad, vx_mps, vy_mps, wz_radps;
  float cmd_vx_mps, cmd_vy_mps, cmd_wz_radps, est_x_m, est_y_m, est_yaw_rad;
  float cross_track_m, power_w, coverage;
  int shape;  // as in Sample
};

struct Metrics {
  double coverage = 0, overlap = 0;
  double path_length_m = 0;  // driven
  double duration_s = 0;     // simulated
  double energy_j = 0;
  double max_cross_track_m = 0, mean_cross_track_m = 0;
  int turns = 0;  // of the plan
  int interventions = 0;
  int contacts = 0;           // times the body met an obstacle
  double max_impulse_ns = 0;  // of one physics step
};

struct Margin {
  std::string detector;
  double value = 0;  // least distance from failing, in the threshold's unit; positive is safe
};

struct EpisodeRecord {
  Outcome outcome = Outcome::kError;
  std::string message;  // why, where the outcome alone does not say it
  std::vector<Event> events;
  Metrics metrics;
  std::vector<Margin> margins;
  std::vector<TraceRow> trace;
  Grid<std::uint8_t> passes;  // of the tool, on the sweep area's grid
  GridFrame passes_frame;
  Grid<std::uint8_t> sweepable;
  std::int64_t steps = 0;
};

// Looks on once a control period: progress lines, films, Ctrl-C.
class EpisodeObserver {
 public:
  virtual ~EpisodeObserver() = default;
  // Returns false to end the episode here (outcome kInterrupted).
  virtual bool OnControl(Simulation& simulation, double coverage, double plan_fraction) = 0;
};

// The plan of the scenario: its planner's, or the user's file. The planner gets what is known.
PlanResult MakePlan(const Scenario& scenario);

// What the plan takes at its own speeds, without stopping to turn, s.
double PlanDuration(const Path& path, double cruise_mps);

// Drives the plan. The scenario's plug-ins are started afresh, so the same call gives the same
// record.
EpisodeRecord RunEpisode(Scenario& scenario, const Scene& scene, const PlanResult& plan,
                         EpisodeObserver* observer = nullptr);

}  // namespace floorproof

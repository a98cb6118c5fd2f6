// SPDX-License-Identifier: Apache-2.0
// Everything that is recorded of an episode.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "controllers/missed_stops.h"
#include "controllers/supervision/supervisor.h"
#include "env/core/drawn_map.h"
#include "env/core/encounter.h"
#include "env/core/event.h"
#include "run/episode/arrival.h"
#include "run/episode/floor_audit.h"
#include "run/episode/metrics.h"
#include "run/episode/sample_log.h"
#include "run/episode/timeout.h"
#include "run/episode/trace.h"

namespace floorproof {

// Aborted: the robot has stopped for good, by its own decision (controllers/supervision).
enum class Outcome { kSuccess, kFailure, kTimeout, kAborted, kNotPlanned, kError, kInterrupted };
std::string_view Name(Outcome outcome);

struct Margin {
  std::string detector;
  FailureMode mode = FailureMode::kVeerOff;
  double value = 0;  // least distance from failing, in the threshold's unit; positive is safe
  double share = 0;  // the same as a share of the threshold
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
  std::vector<Encounter> encounters;  // with hazards, in the order in which they began
  std::vector<Intervention> interventions;
  std::optional<Timeout> timeout;  // where that is the outcome
  std::optional<Arrival>
      arrival;  // none: of a drive that ends by its coverage, or from cell to cell
  std::vector<SafetyRow> safety;  // of a supervised robot
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
  // A success that did not arrive by its true place is a failure, and says so.
  void RequireArrival(const Arrival& arrival, double max_plan_left);
  // A success that missed its plan's end is a failure, too. Whatever was missed is said.
  void TakeMissed(const MissedStops& missed);
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The planner's contract. A new planner is one file in this folder and one line in list.inc.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/params.h"
#include "base/registry.h"
#include "env/core/hazard_map.h"
#include "env/core/path.h"
#include "env/core/robot_spec.h"
#include "env/core/sample_place.h"

namespace floorproof {

struct RiskMap;    // planners/risk/risk_map.h
struct RiskModel;  // planners/risk/rate_model.h

// What of a drive nobody knows before it, and what then holds from its start to its end.
struct DriveConditions {
  double friction = 0;                  // of floor and wheels
  double mass_kg = 0, clearance_m = 0;  // the robot's; clearance: from the floor to its belly
};

struct PlanRequest {
  const HazardMap& map;  // what is known of the floor, heights from that of the start (SeenFrom)
  const RobotSpec& robot;
  Pose2 start;  // X_WB
  std::optional<Vec2> goal;
  std::uint64_t seed = 0;
  const RiskMap* risk = nullptr;      // of this map and robot
  std::span<const Vec2> places = {};  // p_W, to be visited; none: the planner finds its own
  const RiskModel* model = nullptr;   // this robot's measured rates of failure; nullptr: none
  // As they may be, each as likely; none: the map's friction, and the robot as it is.
  std::span<const DriveConditions> conditions = {};
};

enum class PlanStatus {
  kSuccess,
  kStartBlocked,  // the robot does not fit where it starts
  kNoFloor,       // nothing to cover or visit can be reached
  kGoalUnreachable,
  kFloorDivided,   // much of the floor cannot be reached from the start
  kTooFewSamples,  // that the robot can reach, for a tour
  kOnline,         // there is none beforehand: it is made on the way
  kFailed,         // any other reason; the message says it
};
std::string_view Name(PlanStatus status);

struct PlanResult {
  PlanStatus status = PlanStatus::kFailed;
  std::string message;   // why, naming the place; on success what was left out, or empty
  Path path;             // from the start pose on
  double lead_in_m = 0;  // its first leg, where nobody planned it: from the start to a given plan
  // The clear shape and tool that the planner planned with (the robot's, or a plan's override).
  Shape2 clear, tool;
  double tool_width_m = 0;
  // Of the floor that was planned on: kept by who asked for the plan, for those who measure it.
  std::shared_ptr<const RiskMap> risk;
  // Free cells of the risk's grid that can be reached and are left out on purpose.
  int left_out_cells = 0;
  std::vector<SamplePlace> samples;           // of an audit, those that cannot be reached too
  std::optional<SampledParts> sampled_parts;  // what the samples speak for; none: of given places
  std::vector<Vec2> boundary;  // p_W along the room's boundary, if the places were found by it
  // The best length after each iteration of a search that has some, m.
  std::vector<double> convergence_m;
  // The planner's own figures, for plan.json and the columns plan.*, in order.
  std::vector<std::pair<std::string, double>> figures;
};

// What a planner promises of every plan that succeeds. Who asks for plans may rely on it, and the
// tests over all registered planners hold it to that (tests/conformance/planners_test.cc).
struct PlannerPromises {
  enum class Covers {
    kNothing,  // of its own accord: it goes where it is sent
    kGround,   // what the tool can sweep of the floor that the clear shape can reach
    kCells,    // the free cells of the risk's grid that can be reached, but for `left_out_cells`
  };
  Covers covers = Covers::kNothing;
  double least_coverage = 0;  // share of what it covers, on floors that are no worse than usual
  bool needs_risk = false;    // refuses a request without the floor's risk; else it takes no notice
  bool needs_model = false;   // refuses a request without measured rates; else it takes no notice
  bool needs_goal = false;    // refuses a request without a goal
  bool ends_at_goal = false;  // if the request has one; else it takes no notice
  bool uses_seed = false;     // else the same floor has the same plan, whatever the seed
  bool visits_places = false;  // that the request gives; else it takes no notice
};

class Planner : public Configurable {
 public:
  virtual PlanResult Plan(const PlanRequest& request) const = 0;
  virtual PlannerPromises promises() const = 0;
};

std::span<const PluginEntry<Planner>> Planners();

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The content of a scenario: names, parameters, draws, and the data of the files that it names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/registry.h"
#include "controllers/recovery.h"
#include "controllers/supervision/safety_plan.h"
#include "env/core/path.h"
#include "env/scene/robot_model.h"
#include "env/sensors/sensor.h"
#include "planners/online/online_planner.h"
#include "planners/planner.h"
#include "planners/risk/rate_model.h"
#include "planners/risk/risk_map.h"
#include "run/scenario/draws.h"
#include "run/scenario/plan_command.h"
#include "run/scenario/scenario_params.h"

namespace floorproof {

// The source of the plan.
enum class PlanBy {
  kPlanner,  // of known floors, before the drive
  kOnline,   // a planner of unknown floors, on the way
  kProgram,  // of the user's
  kFile,
  kNobody,  // no plan: the mission gives the places, or a caller steps the episode
};

struct SensorSpec {
  PluginSpec plugin;
  Reading fills{};
  bool draws = false;
  bool implied = false;  // not written: another part needs it
};

struct ScenarioSpec {
  std::filesystem::path file;
  std::string name;  // the key `name`, else the file's stem
  std::uint64_t episode_id = 0;
  Drawn drawn;                    // what `randomise` drew for it
  std::set<std::string> written;  // the keys at its top
  Sampling sampling = Sampling::kIndependent;
  std::filesystem::path site_file;  // empty: the site is written in the scenario

  std::string robot_name;
  RobotChanges robot_changes;
  std::filesystem::path robot_file;

  PlanBy plan_by = PlanBy::kFile;
  ParamValues planner_params;               // of a planner of ours
  PlannerPromises promises;                 // of a planner of known floors
  OnlineParams online;                      // of one of unknown floors
  bool draws_on_the_way = false;            // that one uses its seed
  std::string planner_name;                 // its name, or the program's; a file has none
  std::optional<PlanCommand> plan_command;  // plan_file is what it made once, if it has
  std::filesystem::path plan_file;
  Path user_plan;                     // what it holds, or the mission's places
  std::filesystem::path places_file;  // that the planner is to visit; empty: it finds its own
  std::vector<Vec2> places;           // what it holds, p_W

  std::filesystem::path fmea_file;
  FmeaTables fmea;
  RiskParams risk;
  std::filesystem::path risk_model_file;  // empty: none
  std::shared_ptr<const RiskModel> risk_model;

  PluginSpec tracker, estimator;
  bool estimator_draws = false;
  std::vector<SensorSpec> sensors;         // those written, and those that a part of it needs
  std::optional<ParamValues> mapper;       // none: no map is drawn
  std::optional<RecoveryParams> recovery;  // none: the plan is driven blindly
  std::filesystem::path mission_file;      // of its supervision; empty: none
  std::optional<SafetyPlan> safety;        // none: no supervision
  std::vector<PluginSpec> detectors;
  EpisodeParams episode;
  VideoParams video;
};

// The program that is yet to be asked for its plan; nullptr: none is run.
const PlanCommand* ProgramToAsk(const ScenarioSpec& spec);

// Whether there is no plan (PlanBy::kNobody).
bool LeadsItself(const ScenarioSpec& spec);

// Whether its plan needs the floor's risk, or its key `risk` asks for it: of any other nothing is
// said of risk.
bool AsksForRisk(const ScenarioSpec& spec);

std::vector<std::string> SensorNames(const ScenarioSpec& spec);

inline PluginSpec PlannerOf(const ScenarioSpec& spec) {
  return {spec.planner_name, spec.planner_params};
}

// Whether a planner of ours makes the plan.
inline bool IsPlanned(const ScenarioSpec& spec) {
  return spec.plan_by == PlanBy::kPlanner || spec.plan_by == PlanBy::kOnline;
}

}  // namespace floorproof

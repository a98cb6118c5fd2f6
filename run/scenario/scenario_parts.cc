// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/scenario_parts.h"

#include <algorithm>

#include "base/input_file.h"
#include "controllers/drive.h"
#include "controllers/estimator.h"
#include "controllers/mapper.h"
#include "controllers/tracker.h"
#include "env/core/blocks.h"
#include "env/core/standing.h"
#include "env/failures/detector.h"
#include "env/scene/measured_block.h"
#include "env/scene/models_folder.h"
#include "env/scene/roller_wheels.h"
#include "run/scenario/carried_sensors.h"
#include "run/scenario/floor_dirt.h"
#include "run/scenario/fmea_file.h"
#include "run/scenario/named_plugin.h"
#include "run/scenario/plan_file.h"
#include "run/scenario/risk_model_file.h"
#include "run/scenario/scenario.h"
#include "run/scenario/start_check.h"
#include "run/scenario/written_faults.h"
#include "run/scenario/written_safety.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// What is written under the key; nullptr where that is nothing, or null.
const ConfigNode* Written(const ConfigNode& root, std::string_view key) {
  const ConfigNode* node = root.Find(key);
  return node != nullptr && !node->IsNull() ? node : nullptr;
}

// The map of plug-ins under the key, each by its name, empty where there is none.
ConfigNode PluginMap(const ConfigNode& root, const std::string& key, const char* of,
                     const std::vector<std::string>& names) {
  const ConfigNode* node = Written(root, key);
  if (node == nullptr) return ConfigNode::Map();
  if (!node->IsMap()) throw InputError(node->mark, key, "", std::string("must be a map of ") + of);
  RefuseUnknownKeys(*node, key + ".", names);
  return *node;
}

// A group of parameters under a key of their own, which may be missing.
template <class Params>
void ReadGroup(const ConfigNode& root, const std::string& key, Params& params) {
  if (const ConfigNode* node = root.Find(key))
    ReadParams(*node, key + ".", [&](ParamVisitor& v) { params.Visit(v); });
}

// A plan names shapes before its robot is known.
void CheckShapes(const Scenario& s, const std::vector<int>& plan_lines) {
  for (std::size_t i = 0; i < s.spec.user_plan.size(); ++i) {
    const std::string& shape = s.spec.user_plan[i].shape;
    if (!shape.empty() && FindShape(s.world.robot.spec, shape) < 0)
      RefuseShape(s.world.robot.spec, {s.spec.plan_file.string(), plan_lines[i]}, "shape", shape);
  }
}

void ReadRobotPart(const ConfigNode& root, const std::vector<int>& plan_lines, Scenario& s) {
  const NamedPlugin named = ReadNamed(root, "robot", "name", "");
  if (named.name.empty()) throw InputError(named.mark, "robot", "", "the key is missing");
  s.spec.robot_name = named.name;
  s.spec.robot_file = FindRobotFile(named.name, named.mark);
  if (s.spec.robot_file == named.name) {  // not a bundled one
    ConfigNode path = ConfigNode::Scalar(named.name);
    path.mark = named.mark;
    s.spec.robot_file = NamedFile(s.spec.file.parent_path(), path, "robot", s.files);
  }
  ReadParams(named.params, "robot.", [&](ParamVisitor& v) { s.spec.robot_changes.Visit(v); },
             {"name"});
  Battery battery;
  ReadGroup(root, "battery", battery);
  s.spec.robot_changes.battery_v = battery.voltage_v;
  const bool folds = std::ranges::any_of(s.spec.user_plan, [&](const Waypoint& w) {
    return !w.shape.empty() && w.shape != s.spec.robot_changes.shape;
  });
  s.world.robot = ReadRobot(s.spec.robot_file, s.spec.robot_changes,
                            folds ? Blocks::kHinged : Blocks::kLocked, s.files);
  battery.voltage_v = s.world.robot.spec.battery.voltage_v;
  s.world.robot.spec.battery = battery;
  CheckShapes(s, plan_lines);
  if (s.spec.episode.wheels != "rollers") return;
  if (!HasMecanumWheels(s.world.robot.spec))
    throw InputError(MarkOf(root, "wheels"), "wheels", s.spec.episode.wheels,
                     "must be ideal: the wheels of " + s.spec.robot_name + " have no rollers");
  s.world.robot = WithRollerWheels(s.world.robot);
}

// What a message about a place is about: what was set of it, else what was drawn, which both stand
// elsewhere than the place itself; else where the place is written.
SourceMark MarkOfPlace(const ConfigNode& root, const std::string& key, const Scenario& s) {
  const SourceMark mark = MarkOf(root, key);
  const ConfigNode* place = root.Find(key);
  if (place == nullptr || mark.file != s.spec.file.string()) return mark;
  for (const auto& [name, part] : place->entries)
    if (part.mark.file != mark.file) return part.mark;
  for (const auto& [path, value] : s.spec.drawn)
    if (path == key || path.starts_with(key + ".")) return value.mark;
  return mark;
}

Pose2 ReadStart(const ConfigNode& root, const HazardMap& map) {
  Pose2 start = map.start.value_or(Pose2{});
  const ConfigNode* node = root.Find("start");
  if (node == nullptr) {
    if (!map.start)
      throw InputError(root.mark, "start", "",
                       "neither the scenario nor its site says where to start");
    start.yaw_rad = CanonicalDegrees(start.yaw_rad * 180 / kPi) * kPi / 180;
    return start;
  }
  double yaw_deg = start.yaw_rad * 180 / kPi;
  ReadParams(*node, "start.", [&](ParamVisitor& v) { VisitStart(v, start, yaw_deg); });
  start.yaw_rad = CanonicalDegrees(yaw_deg) * kPi / 180;
  return start;
}

void CheckStart(const ConfigNode& root, const Scenario& s) {
  const SourceMark mark = MarkOfPlace(root, "start", s);
  const Cell cell = s.world.site.map.frame.ToCell(s.world.start.p());
  const std::string value =
      FormatDouble(s.world.start.x_m) + ", " + FormatDouble(s.world.start.y_m);
  if (!s.world.site.map.frame.Inside(cell))
    throw InputError(mark, "start", value, "lies off the map");
  if (s.world.site.map.IsWall(cell))
    throw InputError(
        mark, "start", value,
        "lies in a wall, cell (" + std::to_string(cell.ix) + ", " + std::to_string(cell.iy) + ")");
  const Standing stands = StandAt(s.world.site.map, s.world.robot.spec, s.world.start);
  if (!stands.obstruction.empty())
    throw InputError(mark, "start", value,
                     s.spec.robot_name + " at this heading " + stands.why +
                         "; it must stand on one floor, clear of all solids");
}

std::optional<Vec2> ReadGoal(const ConfigNode& root, const Scenario& s) {
  const HazardMap& map = s.world.site.map;
  const ConfigNode* node = root.Find("goal");
  if (node == nullptr) return map.goal;
  Vec2 goal = map.goal.value_or(Vec2::Zero());
  ReadParams(*node, "goal.", [&](ParamVisitor& v) { VisitGoal(v, goal); });
  if (!map.frame.Inside(map.frame.ToCell(goal)))
    throw InputError(MarkOfPlace(root, "goal", s), "goal",
                     FormatDouble(goal.x()) + ", " + FormatDouble(goal.y()), "lies off the map");
  return goal;
}

// A user's own places, taken out of the planner's keys.
void ReadPlacesPart(ConfigNode& plan, Scenario& s) {
  const ConfigNode* samples = plan.Find("samples");
  const ConfigNode* file = samples && samples->IsMap() ? samples->Find("file") : nullptr;
  if (file == nullptr) return;
  for (const auto& [key, value] : samples->entries)
    if (key != "file")
      throw InputError(value.mark, "plan.samples." + key, value.scalar,
                       "stands beside plan.samples.file: places are either found or read from a "
                       "file; take one of them away");
  s.spec.places_file = NamedFile(s.spec.file.parent_path(), *file, "plan.samples.file", s.files);
  s.spec.places = ReadPlaces(s.spec.places_file, s.world.site.map.frame, s.files);
  plan.Remove("samples");
}

// The file that a key names: the bundled one by its name, or by a path that ends in .yaml. No key:
// the bundled one.
fs::path BundledOrNamed(const ConfigNode* node, const std::string& key, std::string_view bundled,
                        const fs::path& bundled_file, Scenario& s) {
  if (node == nullptr) return bundled_file;
  const std::string name = AsString(*node, key);
  if (name == bundled) return bundled_file;
  if (!name.ends_with(".yaml"))
    throw InputError(node->mark, key, name,
                     "must be " + std::string(bundled) + ", or a .yaml file");
  return NamedFile(s.spec.file.parent_path(), *node, key, s.files);
}

void ReadSafetyPart(const ConfigNode& root, Scenario& s) {
  const ConfigNode* safety = Written(root, "safety");
  const ConfigNode* mission = Written(root, "mission");
  if (safety == nullptr && mission == nullptr) return;
  if (s.spec.episode.drive == "cells")
    throw InputError(
        (safety != nullptr ? safety : mission)->mark, safety != nullptr ? "safety" : "mission", "",
        "is for drives through physics; with `drive: cells` nothing is sensed that could "
        "be watched");
  s.spec.mission_file = BundledOrNamed(mission, "mission", kBundledMission, BundledMission(), s);
  const ConfigNode tree = ReadYamlFile(s.spec.mission_file, s.files, "mission");
  s.spec.safety = ReadSafety(safety, tree);
  s.spec.safety->helped = s.spec.episode.on_failure == "assist";
  const HazardMap& map = s.world.site.map;
  for (const auto& [line, mark, skill] : LinesOf(s.spec.safety->mission, tree)) {
    const Cell cell = map.frame.ToCell(line.to_W);
    if (const bool off = !map.frame.Inside(cell); off || map.IsWall(cell))
      throw InputError(mark, "skills." + skill,
                       FormatDouble(line.to_W.x()) + ", " + FormatDouble(line.to_W.y()),
                       off ? "lies off the map" : "lies in a wall");
    Waypoint waypoint;
    waypoint.p_W = line.to_W;
    waypoint.speed_mps = line.speed_mps.value_or(0);
    s.spec.user_plan.push_back(waypoint);
  }
}

// Returns the line of each waypoint of a user's plan.
std::vector<int> ReadPlanPart(const ConfigNode& root, Scenario& s) {
  std::vector<int> lines;
  if (!s.spec.user_plan.empty()) {
    if (const ConfigNode* plan = root.Find("plan"))
      throw InputError(plan->mark, "plan", "",
                       "stands beside a mission that says itself where to drive; take one of them "
                       "away");
    s.spec.plan_by = PlanBy::kNobody;
    s.spec.planner_name = "mission";
    lines.assign(s.spec.user_plan.size(), 0);
    return lines;
  }
  const ConfigNode* node = root.Find("plan");
  if (node && node->IsMap() && node->Find("command") != nullptr) {
    s.spec.plan_command = ReadPlanCommand(*node, s.spec.file.parent_path(), s.files);
    s.spec.plan_by = PlanBy::kProgram;
    s.spec.planner_name = s.spec.plan_command->name;
    if (const ConfigNode* made = node->Find("made")) {
      s.spec.plan_file = NamedFile(s.spec.file.parent_path(), *made, "plan.made", s.files);
      s.spec.user_plan = ReadPlan(s.spec.plan_file, s.world.site.map.frame, &lines, s.files);
    }
    return lines;
  }
  if (const ConfigNode* file = node && node->IsMap() ? node->Find("file") : nullptr) {
    if (const ConfigNode* planner = node->Find("planner"))
      throw InputError(planner->mark, "plan.planner", planner->scalar,
                       "stands beside plan.file: a plan is either made by a planner or read from a "
                       "file; take one of them away");
    RefuseUnknownKeys(*node, "plan.", {"file"});
    s.spec.plan_file = NamedFile(s.spec.file.parent_path(), *file, "plan.file", s.files);
    s.spec.user_plan = ReadPlan(s.spec.plan_file, s.world.site.map.frame, &lines, s.files);
    return lines;
  }
  NamedPlugin named = ReadNamed(root, "plan", "planner", "boustrophedon");
  s.spec.planner_name = named.name;
  const std::vector<std::string> online = PluginNames(OnlinePlanners());
  const bool plans_ahead = std::ranges::find(online, named.name) == online.end();
  s.spec.plan_by = plans_ahead ? PlanBy::kPlanner : PlanBy::kOnline;
  if (plans_ahead) {
    const auto planner = MakePlugin(Planners(), named.name, "plan.planner", named.mark, online);
    if (planner->promises().visits_places) ReadPlacesPart(named.params, s);
    ReadParams(named.params, "plan.", *planner, {"planner"});
    s.spec.planner_params = ValuesOf(*planner);
    s.spec.promises = planner->promises();
  } else {
    const auto planner = MakePlugin(OnlinePlanners(), named.name, "plan.planner", named.mark);
    ReadParams(named.params, "plan.", *planner, {"planner"});
    s.spec.planner_params = ValuesOf(*planner);
    s.spec.online = planner->params();
    s.spec.draws_on_the_way = planner->uses_seed();
  }
  return lines;
}

// What a planner of unknown floors and the way it is driven must have in common.
void CheckOnline(const ConfigNode& root, const Scenario& s) {
  const bool cells = s.spec.episode.drive == "cells";
  const bool online = s.spec.plan_by == PlanBy::kOnline;
  if (cells && !online)
    throw InputError(MarkOf(root, "drive"), "drive", "cells",
                     "is for planners of unknown floors, which `floorproof list planners` names");
  if (!online) return;
  if (!cells && s.world.robot.spec.turn_radius_m > 0)
    throw InputError(MarkOf(root, "plan"), "plan", s.spec.planner_name,
                     "plans on the way, by turns on the spot, which " + s.spec.robot_name +
                         " cannot make; take a planner of known floors");
  const OnlineParams& asked = s.spec.online;
  const double cell_m = s.world.site.map.frame.cell_m;
  const double step_m = asked.step_m.value_or(cells ? cell_m : s.world.robot.spec.tool_width_m);
  const auto mark = [&](const char* key) { return MarkOf(*root.Find("plan"), key); };
  if (cells && std::abs(step_m - cell_m) > 1e-9 * cell_m)
    throw InputError(mark("step_m"), "plan.step_m", FormatDouble(step_m),
                     "must be the site's cell, " + FormatDouble(cell_m) +
                         " m, or none: with `drive: cells` a step leads to the next cell");
  if (asked.radius_m < step_m)
    throw InputError(mark("radius_m"), "plan.radius_m", FormatDouble(asked.radius_m),
                     "must be at least the step, " + FormatDouble(step_m) +
                         " m: else the robot does not see where it steps");
  constexpr int kMostSteps = 200;  // a window takes memory and time as its area
  if (asked.radius_m > kMostSteps * step_m)
    throw InputError(mark("radius_m"), "plan.radius_m", FormatDouble(asked.radius_m),
                     "must be at most " + std::to_string(kMostSteps) + " steps, " +
                         FormatDouble(kMostSteps * step_m) + " m");
}

// The first change of the scenario that makes another robot; empty: none. Rates depend on mass and
// clearance; a prediction reports a battery that is not full as left out
// (run/plan_check/prediction.h).
std::string ChangedBeyondRates(const Scenario& s) {
  const RobotChanges& changes = s.spec.robot_changes;
  if (changes.roller_radius_m) return "robot.roller_radius_m";
  if (!changes.wheel_radius_m && changes.shape.empty() && !changes.battery_v) return "";
  const RobotSpec& changed = s.world.robot.spec;
  const RobotSpec own = ReadRobot(s.spec.robot_file, {}, Blocks::kLocked, s.files).spec;
  for (std::size_t i = 0; i < own.wheels.size(); ++i)
    if (own.wheels[i].radius_m != changed.wheels[i].radius_m) return "robot.wheel_radius_m";
  if (own.shape != changed.shape) return "robot.shape";
  constexpr double kLow = 0.8, kFull = 1.1;  // of its voltage: a battery in use
  const std::optional<double>&own_v = own.battery.voltage_v, &v = changed.battery.voltage_v;
  if (v != own_v && (!v || !own_v || *v < kLow * *own_v || *v > kFull * *own_v))
    return "battery.voltage_v";
  return "";
}

// Whose rates they are is said by its model's hash; robots of an earlier version, whose model is
// measured anew, are others.
void RequireModelOf(const RiskModel& model, const Scenario& s, const ConfigNode& named) {
  const RobotSpec& robot = s.world.robot.spec;
  if (model.robot.name == robot.name &&
      model.robot.model == ModelHash(s.world.robot.files, s.files)) {
    if (const std::string changed = ChangedBeyondRates(s); !changed.empty())
      throw InputError(named.mark, "risk.model", named.scalar,
                       "was measured of " + robot.name +
                           " as its model is, and the scenario sets " + changed +
                           ": measure a model of its own");
    return;
  }
  throw InputError(named.mark, "risk.model", named.scalar,
                   model.robot.name == robot.name
                       ? "was measured of another model of " + robot.name +
                             ": measure it anew (floorproof measure)"
                       : "was measured of " + model.robot.name + ", and this is " + robot.name);
}

void ReadRisk(const ConfigNode& root, Scenario& s) {
  const ConfigNode* node = Written(root, "risk");
  if (node != nullptr)
    ReadParams(*node, "risk.", [&](ParamVisitor& v) { s.spec.risk.Visit(v); }, {"tables", "model"});
  const ConfigNode* tables = node != nullptr ? node->Find("tables") : nullptr;
  s.spec.fmea_file = BundledOrNamed(tables, "risk.tables", kBundledTables, BundledTables(), s);
  s.spec.fmea = ReadFmeaTables(s.spec.fmea_file, s.files);
  if (const ConfigNode* model = node != nullptr ? node->Find("model") : nullptr;
      model != nullptr && AsString(*model, "risk.model") != "none") {
    s.spec.risk_model_file = NamedFile(s.spec.file.parent_path(), *model, "risk.model", s.files);
    s.spec.risk_model = ReadRiskModel(s.spec.risk_model_file, s.files);
    RequireModelOf(*s.spec.risk_model, s, *model);
  }
  if (!s.spec.risk.cell_m) return;
  constexpr double kMaxCells = 4e6;
  const GridFrame& frame = s.world.site.map.frame;
  const double side = frame.cell_m / *s.spec.risk.cell_m;
  if (frame.width * side * frame.height * side > kMaxCells)
    throw InputError(node->Find("cell_m")->mark, "risk.cell_m", FormatDouble(*s.spec.risk.cell_m),
                     "makes more than 4 million cells of the floor");
}

void ReadControl(const ConfigNode& root, Scenario& s) {
  const RobotSpec& robot = s.world.robot.spec;
  const auto drive = MakePlugin(Drives(), robot.drive, "drive", {robot.model_file, 0});
  const NamedPlugin named = ReadNamed(root, "controller", "name", DefaultTracker(robot.drive));
  const auto tracker = MakePlugin(Trackers(), named.name, "controller", named.mark);
  ReadParams(named.params, "controller.", *tracker, {"name"});
  if (!tracker->Commands(*drive))
    throw InputError(named.mark, "controller", named.name,
                     "cannot command the drive " + robot.drive + " of " + s.spec.robot_name);
  s.spec.tracker = {named.name, ValuesOf(*tracker)};
}

// Returns what the estimator needs to be told.
std::vector<Reading> ReadEstimator(const ConfigNode& root, Scenario& s) {
  const NamedPlugin named = ReadNamed(root, "estimator", "name", Estimators().front().name);
  const auto estimator = MakePlugin(Estimators(), named.name, "estimator", named.mark);
  ReadParams(named.params, "estimator.", *estimator, {"name"});
  s.spec.estimator = {named.name, ValuesOf(*estimator)};
  s.spec.estimator_draws = estimator->draws();
  return estimator->Needs();
}

// For keys that know a robot in the shape in which it starts.
void RefuseFolding(const Scenario& s, const SourceMark& mark, const char* key, const char* value) {
  if (!s.world.robot.spec.hinges.empty())
    throw InputError(mark, key, value, "cannot be with a plan that changes the robot's shape");
}

// A cell of the robot's map takes some 20 bytes.
void CheckMapSize(const ConfigNode& node, const Mapper& mapper, const GridFrame& site) {
  constexpr double kMaxCells = 64e6;  // of the largest floor at 0.05 m
  const double cells = mapper.CellsOn(site);
  if (cells <= kMaxCells) return;
  const ConfigNode* written = node.Find("cell_m");
  throw InputError(written ? written->mark : node.mark, "mapper.cell_m",
                   written ? written->scalar : "",
                   "makes " + std::to_string(std::lround(cells / 1e6)) +
                       " million cells of the floor; at most 64 million are drawn");
}

// On an unknown floor a robot goes by what it draws, and by what it meets.
bool PlansByItsMap(const ScenarioSpec& spec) {
  return spec.plan_by == PlanBy::kOnline && spec.episode.drive == "physics";
}

// The mapper keeps what was met, so that a robot which reacts has one.
void ReadReaction(const ConfigNode& root, Scenario& s) {
  if (PlansByItsMap(s.spec)) {
    constexpr int kMost = 1000;  // reactions: to meet things is how it learns of them
    s.spec.recovery.emplace().most = kMost;
  }
  if (const ConfigNode* node = Written(root, "react")) {
    if (!s.spec.recovery) s.spec.recovery.emplace();
    ReadParams(*node, "react.", [&](ParamVisitor& v) { s.spec.recovery->Visit(v); });
    RefuseFolding(s, node->mark, "react", "");
  }
  const ConfigNode* written = Written(root, "mapper");
  if (written == nullptr && !s.spec.recovery) return;
  Mapper mapper;
  if (written != nullptr) ReadParams(*written, "mapper.", mapper);
  if (written != nullptr || PlansByItsMap(s.spec))
    CheckMapSize(written != nullptr ? *written : *root.Find("plan"), mapper,
                 s.world.site.map.frame);
  s.spec.mapper = ValuesOf(mapper);
}

// What the scenario's parts need to be told.
std::vector<Reading> NeededReadings(const ConfigNode& root, const ScenarioSpec& spec,
                                    std::vector<Reading> needed) {
  const auto add = [&needed](const std::vector<Reading>& more) {
    needed.insert(needed.end(), more.begin(), more.end());
  };
  // One that came with `react` does without.
  if (Written(root, "mapper") || PlansByItsMap(spec)) add(Mapper::Needs());
  if (spec.recovery) add(spec.recovery->Needs());
  if (spec.safety) add({std::begin(kSupervisionNeeds), std::end(kSupervisionNeeds)});
  return needed;
}

void ReadSensors(const ConfigNode& root, const std::vector<Reading>& estimator_needs, Scenario& s) {
  const ConfigNode written = PluginMap(root, "sensors", "sensors", PluginNames(Sensors()));
  std::vector<Reading> told;
  for (const NamedSensor& named :
       CarriedSensors(Sensors(), written, NeededReadings(root, s.spec, estimator_needs))) {
    told.push_back(named.sensor->Fills());
    s.spec.sensors.push_back({{named.name, ValuesOf(*named.sensor)},
                              named.sensor->Fills(),
                              named.sensor->draws(),
                              named.implied});
  }
  if (s.spec.safety) KeepMonitorsOf(told, *s.spec.safety);
}

void ReadFaultsPart(const ConfigNode& root, Scenario& s) {
  const ConfigNode* node = Written(root, "faults");
  if (node == nullptr) return;
  s.world.faults =
      ReadFaults(*node, {s.world.robot.spec, SensorNames(s.spec)}, s.world.physics.timestep_s);
}

void ReadDirtPart(const ConfigNode& root, Scenario& s) {
  if (const ConfigNode* node = Written(root, "dirt"))
    s.world.dirt = ReadDirt(*node, s.world.site.map);
}

void ReadFailures(const ConfigNode& root, Scenario& s) {
  const ConfigNode written = PluginMap(root, "failures", "detectors", PluginNames(Detectors()));
  for (const auto& entry : Detectors()) {
    auto detector = entry.make();
    const std::string name(entry.name);
    if (const ConfigNode* params = written.Find(name))
      ReadParams(*params, "failures." + name + ".", *detector);
    s.spec.detectors.push_back({name, ValuesOf(*detector)});
  }
  if (s.spec.episode.on_failure == "assist")
    RefuseFolding(s, MarkOf(root, "on_failure"), "on_failure", "assist");
}

// Where the file was looked for. What is set was looked for in the current folder, too.
std::string Tried(const fs::path& file, const ConfigNode& node) {
  const std::string there = fs::absolute(file).lexically_normal().string();
  const std::string here = fs::absolute(node.scalar).lexically_normal().string();
  return node.mark.file.starts_with(kSet) && here != there ? here + ", nor " + there : there;
}

}  // namespace

fs::path BundledTables() {
  return ModelsFolder() / "fmea" / (std::string(kBundledTables) + ".yaml");
}

const std::vector<std::string>& ScenarioKeys() {
  static const std::vector<std::string> keys = {
      "name",    "scenario",   "site",      "robot",    "start",      "goal",    "plan",
      "risk",    "controller", "estimator", "sensors",  "mapper",     "react",   "physics",
      "battery", "control_hz", "trace_hz",  "failures", "on_failure", "success", "time_limit_s",
      "seed",    "episode",    "drive",     "wheels",   "video",      "files",   "randomise",
      "matrix",  "gate",       "faults",    "dirt",     "safety",     "mission", "sampling"};
  return keys;
}

bool NamesFile(const std::string& key_path, const std::string& value) {
  if (key_path == "robot" || key_path == "robot.name") return value.ends_with(".xml");
  return key_path == "site" || key_path == "site.map" || key_path == "plan.file" ||
         key_path == "plan.made" || key_path == "plan.samples.file" ||
         (key_path == "mission" && value.ends_with(".yaml")) ||
         (key_path == "risk.tables" && value.ends_with(".yaml")) ||
         (key_path == "risk.model" && value != "none");
}

fs::path NamedFile(const fs::path& folder, const ConfigNode& node, const std::string& key,
                   const InputFiles& files) {
  fs::path file = PathIn(folder, node, key);
  if (const std::string why = files.WhyUnreadable(file, kMaxNamedBytes); !why.empty())
    throw InputError(node.mark, key, node.scalar, why + ": " + Tried(file, node));
  return file;
}

void VisitStart(ParamVisitor& v, Pose2& start, double& yaw_deg) {
  v("x_m", start.x_m, Any(), "x of the robot's centre (m)");
  v("y_m", start.y_m, Any(), "y of the robot's centre (m)");
  v("yaw_deg", yaw_deg, Any(), "heading (deg, from x to y)");
}

void VisitGoal(ParamVisitor& v, Vec2& goal) {
  v("x_m", goal.x(), Any(), "m");
  v("y_m", goal.y(), Any(), "m");
}

void ReadTopKeys(const ConfigNode& root, Scenario& s) {
  ReadParams(
      root, "", [&](ParamVisitor& v) { s.spec.episode.Visit(v); }, ScenarioKeys());
  ReadGroup(root, "physics", s.world.physics);
  ReadGroup(root, "video", s.spec.video);
  const double steps = 1 / (s.world.physics.timestep_s * s.spec.episode.control_hz);
  if (steps < 1 || std::abs(steps - std::round(steps)) > 1e-9 * steps)
    throw InputError(MarkOf(root, "control_hz"), "control_hz",
                     std::to_string(s.spec.episode.control_hz),
                     "a control period must be a whole number of steps of " +
                         FormatDouble(s.world.physics.timestep_s) + " s");
  if (s.spec.episode.control_hz % s.spec.episode.trace_hz != 0)
    throw InputError(MarkOf(root, "trace_hz"), "trace_hz", std::to_string(s.spec.episode.trace_hz),
                     "must divide control_hz = " + std::to_string(s.spec.episode.control_hz));
}

void ReadParts(const ConfigNode& root, Scenario& s) {
  ReadSafetyPart(root, s);
  const std::vector<int> plan_lines = ReadPlanPart(root, s);
  ReadRobotPart(root, plan_lines, s);  // whether it folds hangs on the plan
  s.world.robot.spec.step_m = TrustedStep(s.world.robot.spec, s.world.site.map.floor_friction);
  s.world.start = ReadStart(root, s.world.site.map);
  s.world.site.map.start = s.world.start;  // the scenario's own wins, on pictures too
  CheckStart(root, s);
  s.world.goal = ReadGoal(root, s);
  CheckOnline(root, s);
  ReadRisk(root, s);
  ReadControl(root, s);
  const std::vector<Reading> estimator_needs = ReadEstimator(root, s);
  ReadReaction(root, s);
  ReadSensors(root, estimator_needs, s);
  ReadFaultsPart(root, s);
  ReadDirtPart(root, s);
  ReadFailures(root, s);
  CheckStarts(root, s);
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "env/run/scenario.h"

#include <algorithm>

#include "env/core/blocks.h"
#include "env/core/input_file.h"
#include "env/run/file_output.h"
#include "env/run/plan_file.h"
#include "env/scene/roller_wheels.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = 256u << 20;  // the readers have narrower bounds of their own

const std::vector<std::string> kKeys = {
    "name",     "scenario",   "site",       "robot",   "start",        "goal",
    "plan",     "controller", "estimator",  "physics", "battery",      "control_hz",
    "trace_hz", "failures",   "on_failure", "success", "time_limit_s", "seed",
    "drive",    "wheels",     "video",      "files"};

ConfigNode EmptyMap(const SourceMark& mark) {
  ConfigNode node = ConfigNode::Map();
  node.mark = mark;
  return node;
}

// `--set`: site.* reaches into the site's own tree, once that is read.
void Apply(const std::vector<Override>& overrides, bool to_site, ConfigNode& root) {
  constexpr std::string_view kSite = "site.";
  for (const auto& o : overrides) {
    const bool is_site = o.key_path.starts_with(kSite);
    if (is_site != to_site) continue;
    ConfigNode value = ParseYaml(o.value, "--set " + o.key_path);
    root.SetPath(is_site ? std::string_view(o.key_path).substr(kSite.size()) : o.key_path,
                 std::move(value));
  }
}

// A file that the scenario names and that can be read.
fs::path NamedFile(const fs::path& folder, const ConfigNode& node, const std::string& key) {
  fs::path file = PathIn(folder, node, key);
  if (const std::string why = WhyUnreadable(file, kMostBytes); !why.empty())
    throw InputError(node.mark, key, node.scalar, why);
  return file;
}

// A plug-in written as NAME, or as a map with its name under `name_key` and its parameters beside.
struct Named {
  std::string name;
  ConfigNode params;
  SourceMark mark;
};
Named ReadNamed(const ConfigNode& root, const char* key, const char* name_key,
                std::string_view default_name) {
  const ConfigNode* node = root.Find(key);
  if (node == nullptr || node->IsNull())
    return {std::string(default_name), EmptyMap(root.mark), root.mark};
  if (node->IsScalar()) return {node->scalar, EmptyMap(node->mark), node->mark};
  if (!node->IsMap()) throw InputError(node->mark, key, "", "must be a name or a map");
  const ConfigNode* name = node->Find(name_key);
  return {name ? AsString(*name, std::string(key) + "." + name_key) : std::string(default_name),
          *node, name ? name->mark : node->mark};
}

void ReadSitePart(const ConfigNode& root, const std::vector<Override>& overrides, Scenario& s) {
  const ConfigNode* node = root.Find("site");
  if (node == nullptr) throw InputError(root.mark, "site", "", "the key is missing");
  const fs::path folder = s.file.parent_path();
  if (node->IsMap()) {
    s.site_node = *node;
    s.site_folder = folder;
  } else {
    s.site_file = NamedFile(folder, *node, "site");
    s.site_node = ReadYamlFile(s.site_file);
    s.site_folder = s.site_file.parent_path();
  }
  Apply(overrides, true, s.site_node);
  s.site_node = GeneratedSite(s.site_node, static_cast<std::uint64_t>(s.episode.seed), 0);
  s.site = ReadSite(s.site_node, s.site_folder);
  if (s.site.map.name.empty())
    s.site.map.name = s.site_file.empty() ? s.name : s.site_file.stem().string();
}

void ReadRobotPart(const ConfigNode& root, Scenario& s) {
  const Named named = ReadNamed(root, "robot", "name", "");
  if (named.name.empty()) throw InputError(named.mark, "robot", "", "the key is missing");
  s.robot_name = named.name;
  s.robot_file = FindRobotFile(named.name, named.mark);
  if (s.robot_file == named.name) {  // not a bundled one
    ConfigNode path = ConfigNode::Scalar(named.name);
    path.mark = named.mark;
    s.robot_file = NamedFile(s.file.parent_path(), path, "robot");
  }
  ReadParams(named.params, "robot.", [&](ParamVisitor& v) { s.robot_changes.Visit(v); }, {"name"});
  if (const ConfigNode* battery = root.Find("battery"))
    ReadParams(*battery, "battery.", [&](ParamVisitor& v) { s.battery.Visit(v); });
  s.robot_changes.battery_v = s.battery.voltage_v;
  const bool folds = std::ranges::any_of(s.user_plan, [&](const Waypoint& w) {
    return !w.shape.empty() && w.shape != s.robot_changes.shape;
  });
  s.robot = ReadRobot(s.robot_file, s.robot_changes, folds ? Blocks::kHinged : Blocks::kLocked);
  s.battery.voltage_v = s.robot.robot.battery.voltage_v;
  s.robot.robot.battery = s.battery;
  if (std::ranges::any_of(s.user_plan, [](const Waypoint& w) { return !w.shape.empty(); }))
    // Again, now that the robot is known: a refusal names the line.
    ReadPlan(s.plan_file, s.site.map.frame, [&](const SourceMark& mark, const std::string& shape) {
      if (FindShape(s.robot.robot, shape) < 0) RefuseShape(s.robot.robot, mark, "shape", shape);
    });
  if (s.episode.wheels != "rollers") return;
  if (!HasMecanumWheels(s.robot.robot)) {
    const ConfigNode* node = root.Find("wheels");
    throw InputError(node ? node->mark : root.mark, "wheels", s.episode.wheels,
                     "must be ideal: the wheels of " + s.robot_name + " have no rollers");
  }
  s.robot = WithRollerWheels(s.robot);
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
  ReadParams(*node, "start.", [&](ParamVisitor& v) {
    v("x_m", start.x_m, Any(), "x of the robot's centre (m)");
    v("y_m", start.y_m, Any(), "y of the robot's centre (m)");
    v("yaw_deg", yaw_deg, Any(), "heading (deg, from x to y)");
  });
  start.yaw_rad = CanonicalDegrees(yaw_deg) * kPi / 180;
  return start;
}

void CheckStart(const ConfigNode& root, const Scenario& s) {
  const ConfigNode* node = root.Find("start");
  const SourceMark mark = node ? node->mark : root.mark;
  const Cell cell = s.site.map.frame.ToCell(s.start.p());
  const std::string value = FormatDouble(s.start.x_m) + ", " + FormatDouble(s.start.y_m);
  if (!s.site.map.frame.Inside(cell)) throw InputError(mark, "start", value, "lies off the map");
  if (s.site.map.IsWall(cell)) throw InputError(mark, "start", value, "lies in a wall");
}

void ReadPlanPart(const ConfigNode& root, Scenario& s) {
  const ConfigNode* node = root.Find("plan");
  if (const ConfigNode* file = node && node->IsMap() ? node->Find("file") : nullptr) {
    RefuseUnknownKeys(*node, "plan.", {"file"});
    s.plan_file = NamedFile(s.file.parent_path(), *file, "plan.file");
    s.user_plan = ReadPlan(s.plan_file, s.site.map.frame);
    return;
  }
  const Named named = ReadNamed(root, "plan", "planner", "boustrophedon");
  s.planner_name = named.name;
  s.planner = MakePlugin(Planners(), named.name, "plan.planner", named.mark);
  ReadParams(named.params, "plan.", *s.planner, {"planner"});
}

void ReadControl(const ConfigNode& root, Scenario& s) {
  const Named tracker = ReadNamed(root, "controller", "name", DefaultTracker(s.robot.robot.drive));
  s.tracker_name = tracker.name;
  s.tracker = MakePlugin(Trackers(), tracker.name, "controller", tracker.mark);
  ReadParams(tracker.params, "controller.", *s.tracker, {"name"});
  const auto drives = s.tracker->Drives();
  if (std::ranges::find(drives, s.robot.robot.drive) == drives.end())
    throw InputError(tracker.mark, "controller", tracker.name,
                     "cannot command the drive " + s.robot.robot.drive + " of " + s.robot_name);
  const Named estimator = ReadNamed(root, "estimator", "name", Estimators().front().name);
  s.estimator_name = estimator.name;
  s.estimator = MakePlugin(Estimators(), estimator.name, "estimator", estimator.mark);
  ReadParams(estimator.params, "estimator.", *s.estimator, {"name"});
}

void ReadFailures(const ConfigNode& root, Scenario& s) {
  const ConfigNode* node = root.Find("failures");
  const ConfigNode none = EmptyMap(root.mark);
  if (node == nullptr || node->IsNull()) node = &none;
  if (!node->IsMap()) throw InputError(node->mark, "failures", "", "must be a map of detectors");
  RefuseUnknownKeys(*node, "failures.", PluginNames(Detectors()));
  for (const auto& entry : Detectors()) {
    auto detector = entry.make();
    const std::string name(entry.name);
    if (const ConfigNode* params = node->Find(name))
      ReadParams(*params, "failures." + name + ".", *detector);
    s.detectors.push_back(std::move(detector));
  }
}

// Refuses to run a resolved scenario whose files are no longer the ones it was resolved from.
void CheckHashes(const ConfigNode& root, const fs::path& folder) {
  const ConfigNode* files = root.Find("files");
  if (files == nullptr) return;
  if (!files->IsMap()) throw InputError(files->mark, "files", "", "must be a map of path: SHA-256");
  for (const auto& [path, hash] : files->entries) {
    if (const std::string why = WhyUnreadable(folder / path, kMostBytes); !why.empty())
      throw InputError(hash.mark, "files." + path, "", why);
    const std::string now = Sha256OfFile(folder / path);
    if (now != AsString(hash, "files." + path))
      throw InputError(hash.mark, "files." + path, hash.scalar,
                       "the file has changed since: SHA-256 " + now);
  }
}

void ReadTop(const ConfigNode& root, Scenario& s) {
  std::vector<std::string> others = kKeys;
  ReadParams(
      root, "", [&](ParamVisitor& v) { s.episode.Visit(v); }, others);
  if (const ConfigNode* physics = root.Find("physics"))
    ReadParams(*physics, "physics.", [&](ParamVisitor& v) { s.physics.Visit(v); });
  if (const ConfigNode* video = root.Find("video"))
    ReadParams(*video, "video.", [&](ParamVisitor& v) { s.video.Visit(v); });
  const double steps = 1 / (s.physics.timestep_s * s.episode.control_hz);
  if (steps < 1 || std::abs(steps - std::round(steps)) > 1e-9 * steps) {
    const ConfigNode* node = root.Find("control_hz");
    throw InputError(node ? node->mark : root.mark, "control_hz",
                     std::to_string(s.episode.control_hz),
                     "a control period must be a whole number of steps of " +
                         FormatDouble(s.physics.timestep_s) + " s");
  }
  if (s.episode.control_hz % s.episode.trace_hz != 0) {
    const ConfigNode* node = root.Find("trace_hz");
    throw InputError(node ? node->mark : root.mark, "trace_hz", std::to_string(s.episode.trace_hz),
                     "must divide control_hz = " + std::to_string(s.episode.control_hz));
  }
}

}  // namespace

void VideoParams::Visit(ParamVisitor& v) {
  v("camera", camera, {"auto", "chase", "top", "side"},
    "where the film is taken from; auto: from above in a time lapse, else from behind");
  v("fps", fps, Between(1, 120), "frames a second of film");
  v("speed_up", speed_up, Positive(),
    "simulated seconds a second of film; none: such that it keeps to max_frames");
  v("max_frames", max_frames, Between(2, 1e6), "most frames of a film");
  v("width", width, Between(64, 1920), "pixels, even");
  v("height", height, Between(64, 1080), "pixels, even");
}

void EpisodeParams::Visit(ParamVisitor& v) {
  v("control_hz", control_hz, Between(1, 2000), "control periods a second");
  v("trace_hz", trace_hz, Between(1, 2000), "rows of trace.csv a second");
  v("on_failure", on_failure, {"stop", "ignore"},
    "stop: the first failure ends the episode; ignore: it is logged and the drive goes on");
  v.Group(
      "success",
      [this](ParamVisitor& g) {
        g("min_coverage", min_coverage, Between(0, 1), "least coverage that counts as success");
      },
      "what counts as success");
  v("time_limit_s", time_limit_s, Positive(),
    "simulated seconds; none: a minute and three times what the plan takes at its own speeds");
  v("drive", drive, {"physics", "none"}, "physics: drive the plan; none: plan only");
  v("seed", seed, Between(0, 2147483647.0), "of every random stream");
  v("wheels", wheels, {"ideal", "rollers"},
    "Mecanum wheels; ideal: one body each, rollers: a hub and rollers that are bodies");
}

Scenario ReadScenario(const fs::path& file, const std::vector<Override>& overrides) {
  ConfigNode root = ReadYamlFile(file);
  if (!root.IsMap()) throw InputError({file.string(), 1}, "", "", "must be a map of keys");
  Apply(overrides, false, root);
  RefuseUnknownKeys(root, "", kKeys);
  const ConfigNode* version = root.Find("scenario");
  if (version == nullptr)
    throw InputError(root.mark, "scenario", "", "the key is missing (scenario: 1)");
  AsInt(*version, "scenario", Between(1, 1));

  Scenario s;
  s.file = file;
  s.name = file.stem().string();
  if (const ConfigNode* name = root.Find("name")) s.name = AsString(*name, "name");
  ReadTop(root, s);
  CheckHashes(root, file.parent_path());
  ReadSitePart(root, overrides, s);
  ReadPlanPart(root, s);
  ReadRobotPart(root, s);  // whether it folds hangs on the plan
  s.start = ReadStart(root, s.site.map);
  s.site.map.start = s.start;  // the scenario's own wins, on pictures too
  CheckStart(root, s);
  s.goal = s.site.map.goal;
  if (const ConfigNode* goal = root.Find("goal")) {
    Vec2 p = s.goal.value_or(Vec2::Zero());
    ReadParams(*goal, "goal.", [&](ParamVisitor& v) {
      v("x_m", p.x(), Any(), "m");
      v("y_m", p.y(), Any(), "m");
    });
    if (!s.site.map.frame.Inside(s.site.map.frame.ToCell(p)))
      throw InputError(goal->mark, "goal", FormatDouble(p.x()) + ", " + FormatDouble(p.y()),
                       "lies off the map");
    s.goal = p;
  }
  ReadControl(root, s);
  ReadFailures(root, s);
  return s;
}

std::vector<fs::path> FilesRead(const Scenario& s) {
  std::vector<fs::path> files = s.site.files_read;
  if (!s.site_file.empty()) files.insert(files.begin(), s.site_file);
  files.push_back(s.robot_file);
  if (!s.plan_file.empty()) files.push_back(s.plan_file);
  return files;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/resolved_scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "base/file_output.h"
#include "env/scene/models_folder.h"
#include "run/scenario/scenario.h"
#include "run/scenario/scenario_parts.h"
#include "run/scenario/written_faults.h"
#include "run/scenario/written_safety.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

fs::path PathFrom(const fs::path& folder, const fs::path& path) {
  return fs::relative(fs::absolute(path), fs::absolute(folder.empty() ? "." : folder));
}

ConfigNode Number(double value) { return ConfigNode::Scalar(FormatDouble(value)); }

// A map with this one text.
ConfigNode Named(const char* key, const std::string& text) {
  ConfigNode node = ConfigNode::Map();
  node.Add(key, ConfigNode::Scalar(text, true));
  return node;
}

ConfigNode Robot(const Scenario& s, const fs::path& folder) {
  const bool bundled =
      std::ranges::any_of(Robots(), [&](const auto& r) { return r.name == s.spec.robot_name; });
  return WithParams(
      Named("name", bundled ? s.spec.robot_name : PathFrom(folder, s.spec.robot_file).string()),
      s.spec.robot_changes);
}

ConfigNode Start(const Pose2& start) {
  ConfigNode node = ConfigNode::Map();
  node.Add("x_m", Number(start.x_m));
  node.Add("y_m", Number(start.y_m));
  node.Add("yaw_deg", Number(CanonicalDegrees(start.yaw_rad * 180 / kPi)));
  return node;
}

ConfigNode Goal(const Vec2& goal) {
  ConfigNode node = ConfigNode::Map();
  node.Add("x_m", Number(goal.x()));
  node.Add("y_m", Number(goal.y()));
  return node;
}

ConfigNode Plugin(const PluginSpec& plugin) {
  return WithValues(Named("name", plugin.name), plugin.params);
}

ConfigNode SensorsOf(const ScenarioSpec& spec) {
  ConfigNode node = ConfigNode::Map();
  for (const SensorSpec& sensor : spec.sensors)
    if (!sensor.implied)
      node.Add(sensor.plugin.name, WithValues(ConfigNode::Map(), sensor.plugin.params));
  return node;
}

ConfigNode Failures(const ScenarioSpec& spec) {
  ConfigNode node = ConfigNode::Map();
  for (const auto& [name, params] : spec.detectors)
    node.Add(name, WithValues(ConfigNode::Map(), params));
  return node;
}

// Whether variants or draws set one of these keys: what follows from their values must then not be
// stated.
bool Vary(const Scenario& s, const std::set<std::string>& keys) {
  for (const ConfigNode* node : {&s.text.randomise, &s.text.matrix})
    for (const auto& [path, value] : node->entries) {
      if (keys.contains(path)) return true;
      for (const ConfigNode& item : value.items)
        for (const auto& entry : item.entries)
          if (keys.contains(entry.first)) return true;
    }
  return false;
}

// As BundledOrNamed() reads it.
std::string NameOr(const fs::path& file, const fs::path& bundled_file, std::string_view bundled,
                   const fs::path& folder) {
  return file == bundled_file ? std::string(bundled) : PathFrom(folder, file).string();
}

// Its planner with all keys. Where variants have others, which need not know them, those alone that
// are not as by default.
ConfigNode PlannerKeys(const Scenario& s, const fs::path& folder) {
  ConfigNode node = WithValues(Named("planner", s.spec.planner_name), s.spec.planner_params);
  if (!s.spec.places_file.empty())
    *node.Find("samples") = Named("file", PathFrom(folder, s.spec.places_file).string());
  // A file of places stands alone; what variants without one have is as by default.
  if (Vary(s, {"plan.samples", "plan.samples.file"})) node.Remove("samples");
  if (!Vary(s, {"plan.planner"})) return node;
  const auto defaults = [&](auto planners) {
    ConfigNode usual = ConfigNode::Map();
    WriteParams(*MakePlugin(planners, s.spec.planner_name, "plan.planner"), usual);
    return usual;
  };
  const ConfigNode usual =
      s.spec.plan_by == PlanBy::kOnline ? defaults(OnlinePlanners()) : defaults(Planners());
  std::erase_if(node.entries, [&](const auto& entry) {
    const ConfigNode* other = usual.Find(entry.first);
    return other != nullptr && WriteYaml(*other) == WriteYaml(entry.second);
  });
  return node;
}

// Who makes its plan, with all keys.
ConfigNode Plan(const Scenario& s, const fs::path& folder, const fs::path& made) {
  if (IsPlanned(s.spec)) return PlannerKeys(s, folder);
  if (s.spec.plan_command)
    return WritePlanCommand(*s.spec.plan_command, folder, made.empty() ? s.spec.plan_file : made);
  return Named("file", PathFrom(folder, s.spec.plan_file).string());
}

// Whether a scenario names it by a word: it comes with the program.
bool IsBundled(const fs::path& file) {
  const auto is = [&](const fs::path& bundled) {
    return fs::absolute(bundled).lexically_normal() == fs::absolute(file).lexically_normal();
  };
  return is(BundledTables()) || is(BundledMission()) ||
         std::ranges::any_of(
             Robots(), [&](const RobotEntry& robot) { return is(ModelsFolder() / robot.file); });
}

std::string NameFrom(const fs::path& folder, const fs::path& file, const InputFiles& files) {
  if (IsBundled(file)) return std::string(kBundled) + PathFrom(ModelsFolder(), file).string();
  return files.IsAbsolute(file) ? fs::absolute(file).lexically_normal().string()
                                : PathFrom(folder, file).string();
}

// What reading the resolved file will read: the site now stands within it.
std::vector<fs::path> ListedFiles(const Scenario& s, const std::vector<fs::path>& more) {
  std::vector<fs::path> listed;
  const bool site_is_named = Vary(s, {"site"});
  for (const auto& files : {FilesRead(s), more})
    for (const fs::path& file : files)
      if (file != s.spec.file && (file != s.spec.site_file || site_is_named))
        listed.push_back(file);
  return listed;
}

ConfigNode Files(const Scenario& s, const fs::path& folder, const std::vector<fs::path>& more) {
  ConfigNode node = ConfigNode::Map();
  for (const fs::path& file : ListedFiles(s, more))
    node.Add(NameFrom(folder, file, s.files), ConfigNode::Scalar(s.files.Sha256(file), true));
  return node;
}

// A key's value, and what is within it.
void Rebase(const std::string& key, const fs::path& from, const fs::path& to, ConfigNode& value) {
  if (value.IsScalar() && NamesFile(key, value.scalar))
    value = ConfigNode::Scalar(PathFrom(to, from / value.scalar).string(), true);
  for (auto& [name, part] : value.entries) Rebase(key + "." + name, from, to, part);
}

// `randomise` and `matrix` with the paths that they set made valid from `to`; all else as it is.
ConfigNode Rebased(ConfigNode node, const fs::path& from, const fs::path& to) {
  for (auto& [key, value] : node.entries) {
    if (ConfigNode* choice = value.Find("choice"))
      for (ConfigNode& item : choice->items) Rebase(key, from, to, item);
    for (ConfigNode& item : value.items) {
      if (item.Find("label") == nullptr) {
        Rebase(key, from, to, item);
        continue;
      }
      for (auto& [name, set] : item.entries)
        if (name != "label") Rebase(name, from, to, set);
    }
  }
  return node;
}

// Without what sets keys of a generated site: it stands drawn in the file.
ConfigNode WithoutGenerate(ConfigNode node) {
  std::erase_if(node.entries, [](const auto& entry) {
    return entry.first == "site.generate" || entry.first.starts_with("site.generate.");
  });
  return node;
}

}  // namespace

std::string ResolvedScenario(const Scenario& s, const fs::path& folder,
                             const std::vector<fs::path>& more, const fs::path& made) {
  ConfigNode root = ConfigNode::Map();
  root.Add("scenario", ConfigNode::Scalar("1"));
  root.Add("name", ConfigNode::Scalar(s.spec.name, true));
  root.Add("site", ResolveSite(s.text.site, s.text.site_folder, folder));
  root.Find("site")->Add("name", ConfigNode::Scalar(s.world.site.map.name, true));
  root.Add("robot", Robot(s, folder));
  // What the site or the robot would say otherwise is stated where that is the same in all
  // episodes.
  const auto stated = [&](const char* key, bool varies) {
    return s.spec.written.contains(key) || !varies;
  };
  const bool site_varies = Vary(s, {"site"}) || s.text.site.Find("generate") != nullptr;
  const bool robot_varies = Vary(s, {"robot", "robot.name"});
  if (stated("start", site_varies || Vary(s, {"site.start", "site.start.x_m", "site.start.y_m",
                                              "site.start.yaw_deg"})))
    root.Add("start", Start(s.world.start));
  if (s.world.goal &&
      stated("goal", site_varies || Vary(s, {"site.goal", "site.goal.x_m", "site.goal.y_m"})))
    root.Add("goal", Goal(*s.world.goal));
  if (!LeadsItself(s.spec)) root.Add("plan", Plan(s, folder, made));
  if (AsksForRisk(s.spec)) {
    ConfigNode risk =
        Named("tables", NameOr(s.spec.fmea_file, BundledTables(), kBundledTables, folder));
    risk.Add("model", ConfigNode::Scalar(s.spec.risk_model_file.empty()
                                             ? "none"
                                             : PathFrom(folder, s.spec.risk_model_file).string(),
                                         true));
    root.Add("risk", WithParams(std::move(risk), s.spec.risk));
  }
  if (stated("controller", robot_varies)) root.Add("controller", Plugin(s.spec.tracker));
  root.Add("estimator", Plugin(s.spec.estimator));
  if (!std::ranges::all_of(s.spec.sensors, &SensorSpec::implied))
    root.Add("sensors", SensorsOf(s.spec));
  // One without a scan came with `react`, as it is by default; stated, it would ask for a lidar.
  const auto tells_scan = [](const SensorSpec& sensor) { return sensor.fills == Reading::kScan; };
  if (s.spec.mapper && std::ranges::any_of(s.spec.sensors, tells_scan))
    root.Add("mapper", WithValues(ConfigNode::Map(), *s.spec.mapper));
  if (s.spec.recovery) root.Add("react", WithParams(ConfigNode::Map(), *s.spec.recovery));
  if (s.spec.safety) {
    root.Add("mission",
             ConfigNode::Scalar(
                 NameOr(s.spec.mission_file, BundledMission(), kBundledMission, folder), true));
    root.Add("safety", WriteSafety(*s.spec.safety));
  }
  if (!s.world.faults.empty()) root.Add("faults", WriteFaults(s.world.faults));
  if (s.world.dirt) root.Add("dirt", WriteDirt(*s.world.dirt));
  root.Add("failures", Failures(s.spec));
  root = WithParams(std::move(root), s.spec.episode);
  if (stated("battery", robot_varies))
    root.Add("battery", WithParams(ConfigNode::Map(), s.world.robot.spec.battery));
  root.Add("physics", WithParams(ConfigNode::Map(), s.world.physics));
  root.Add("video", WithParams(ConfigNode::Map(), s.spec.video));
  ConfigNode randomise = s.text.randomise;
  if (root.Find("site")->Find("generate") == nullptr) randomise = WithoutGenerate(randomise);
  if (randomise.entries.empty()) randomise = {};
  for (const auto& [key, written] : {std::pair("randomise", &std::as_const(randomise)),
                                     {"matrix", &s.text.matrix},
                                     {"gate", &s.text.gate}})
    if (!written->IsNull()) root.Add(key, Rebased(*written, s.spec.file.parent_path(), folder));
  if (s.spec.sampling == Sampling::kLowDiscrepancy)
    root.Add("sampling", ConfigNode::Scalar("low_discrepancy"));
  root.Add("files", Files(s, folder, more));
  const char* except = Vary(s, {"plan.planner"})
                           ? "; of `plan`, whose planner varies, what is not as by default"
                           : "";
  return fmt::format("# Every key with the value used{}. Paths hold from this folder.\n", except) +
         WriteYaml(root);
}

void WriteResolvedScenario(const Scenario& s, const fs::path& folder,
                           const std::vector<fs::path>& more, const fs::path& made) {
  // First, so that whoever finds the settings finds what they name.
  for (const fs::path& file : ListedFiles(s, more))
    if (!IsBundled(file)) KeepCopy(s.files, file, folder);
  WriteFileWhole(folder / "scenario.resolved.yaml", ResolvedScenario(s, folder, more, made));
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A scenario written out with every default stated, so that it survives a change of defaults.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "base/file_output.h"
#include "env/scene/models_folder.h"
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

ConfigNode WithPlugin(ConfigNode node, Configurable& plugin) {
  WriteParams(plugin, node);
  return node;
}

ConfigNode Robot(const Scenario& s, const fs::path& folder) {
  const bool bundled =
      std::ranges::any_of(Robots(), [&](const auto& r) { return r.name == s.robot_name; });
  return WithParams(Named("name", bundled ? s.robot_name : PathFrom(folder, s.robot_file).string()),
                    s.robot_changes);
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

ConfigNode SensorsOf(const Scenario& s) {
  ConfigNode node = ConfigNode::Map();
  for (const NamedSensor& sensor : s.sensors)
    if (!sensor.implied) node.Add(sensor.name, WithPlugin(ConfigNode::Map(), *sensor.sensor));
  return node;
}

ConfigNode Failures(const Scenario& s) {
  ConfigNode node = ConfigNode::Map();
  for (const auto& [name, detector] : s.detectors)
    node.Add(name, WithPlugin(ConfigNode::Map(), *detector));
  return node;
}

// Whether variants or draws set one of these keys: what follows from their values must then not be
// stated.
bool Vary(const Scenario& s, const std::set<std::string>& keys) {
  for (const ConfigNode* node : {&s.randomise, &s.matrix})
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
  ConfigNode node = WithPlugin(Named("planner", s.planner_name), *PlannerOf(s));
  if (!s.places_file.empty())
    *node.Find("samples") = Named("file", PathFrom(folder, s.places_file).string());
  // A file of places stands alone; what variants without one have is as by default.
  if (Vary(s, {"plan.samples", "plan.samples.file"})) node.Remove("samples");
  if (!Vary(s, {"plan.planner"})) return node;
  const auto defaults = [&](auto planners) {
    return WithPlugin(ConfigNode::Map(), *MakePlugin(planners, s.planner_name, "plan.planner"));
  };
  const ConfigNode usual = s.online ? defaults(OnlinePlanners()) : defaults(Planners());
  std::erase_if(node.entries, [&](const auto& entry) {
    const ConfigNode* other = usual.Find(entry.first);
    return other != nullptr && WriteYaml(*other) == WriteYaml(entry.second);
  });
  return node;
}

// Who makes its plan, with all keys.
ConfigNode Plan(const Scenario& s, const fs::path& folder, const fs::path& made) {
  if (PlannerOf(s) != nullptr) return PlannerKeys(s, folder);
  if (s.plan_command)
    return WritePlanCommand(*s.plan_command, folder, made.empty() ? s.plan_file : made);
  return Named("file", PathFrom(folder, s.plan_file).string());
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
      if (file != s.file && (file != s.site_file || site_is_named)) listed.push_back(file);
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
  root.Add("name", ConfigNode::Scalar(s.name, true));
  root.Add("site", ResolveSite(s.site_node, s.site_folder, folder));
  root.Find("site")->Add("name", ConfigNode::Scalar(s.site.map.name, true));
  root.Add("robot", Robot(s, folder));
  // What the site or the robot would say otherwise is stated where that is the same in all
  // episodes.
  const auto stated = [&](const char* key, bool varies) {
    return s.written.contains(key) || !varies;
  };
  const bool site_varies = Vary(s, {"site"}) || s.site_node.Find("generate") != nullptr;
  const bool robot_varies = Vary(s, {"robot", "robot.name"});
  if (stated("start", site_varies || Vary(s, {"site.start", "site.start.x_m", "site.start.y_m",
                                              "site.start.yaw_deg"})))
    root.Add("start", Start(s.start));
  if (s.goal &&
      stated("goal", site_varies || Vary(s, {"site.goal", "site.goal.x_m", "site.goal.y_m"})))
    root.Add("goal", Goal(*s.goal));
  if (!LeadsItself(s)) root.Add("plan", Plan(s, folder, made));
  if (AsksForRisk(s)) {
    ConfigNode risk = Named("tables", NameOr(s.fmea_file, BundledTables(), kBundledTables, folder));
    risk.Add("model",
             ConfigNode::Scalar(
                 s.risk_model_file.empty() ? "none" : PathFrom(folder, s.risk_model_file).string(),
                 true));
    root.Add("risk", WithParams(std::move(risk), s.risk));
  }
  if (stated("controller", robot_varies))
    root.Add("controller", WithPlugin(Named("name", s.tracker_name), *s.tracker));
  root.Add("estimator", WithPlugin(Named("name", s.estimator_name), *s.estimator));
  if (!std::ranges::all_of(s.sensors, &NamedSensor::implied)) root.Add("sensors", SensorsOf(s));
  // One without a scan came with `react`, as it is by default; stated, it would ask for a lidar.
  const auto tells_scan = [](const NamedSensor& named) {
    return named.sensor->Fills() == Reading::kScan;
  };
  if (s.mapper && std::ranges::any_of(s.sensors, tells_scan)) {
    Mapper mapper = *s.mapper;
    root.Add("mapper", WithPlugin(ConfigNode::Map(), mapper));
  }
  if (s.recovery) root.Add("react", WithParams(ConfigNode::Map(), *s.recovery));
  if (s.safety) {
    root.Add("mission",
             ConfigNode::Scalar(NameOr(s.mission_file, BundledMission(), kBundledMission, folder),
                                true));
    root.Add("safety", WriteSafety(*s.safety));
  }
  if (!s.faults.empty()) root.Add("faults", WriteFaults(s.faults));
  if (s.dirt) root.Add("dirt", WriteDirt(*s.dirt));
  root.Add("failures", Failures(s));
  root = WithParams(std::move(root), s.episode);
  if (stated("battery", robot_varies))
    root.Add("battery", WithParams(ConfigNode::Map(), s.battery));
  root.Add("physics", WithParams(ConfigNode::Map(), s.physics));
  root.Add("video", WithParams(ConfigNode::Map(), s.video));
  ConfigNode randomise = s.randomise;
  if (root.Find("site")->Find("generate") == nullptr) randomise = WithoutGenerate(randomise);
  if (randomise.entries.empty()) randomise = {};
  for (const auto& [key, written] : {std::pair("randomise", &std::as_const(randomise)),
                                     {"matrix", &s.matrix},
                                     {"gate", &s.gate}})
    if (!written->IsNull()) root.Add(key, Rebased(*written, s.file.parent_path(), folder));
  if (s.sampling == Sampling::kLowDiscrepancy)
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

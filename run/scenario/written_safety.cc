// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/written_safety.h"

#include <algorithm>

#include "base/json_schema.h"
#include "env/scene/models_folder.h"
#include "env/scene/robot_model.h"

namespace floorproof {
namespace {

bool IsNone(const ConfigNode& node) { return node.IsNull() || node.scalar == "none"; }

void CheckMonitors(const ConfigNode& written, const std::vector<std::string>& named) {
  const std::vector<std::string> all = PluginNames(Monitors());
  for (const auto& [name, keys] : written.entries) {
    const std::string path = "safety.monitors." + name;
    if (std::ranges::find(named, name) == named.end())
      throw InputError(keys.mark, path, "",
                       std::ranges::find(all, name) != all.end()
                           ? "no primitive of the mission names this monitor under `monitors`"
                           : "unknown" + DidYouMean(name, named));
    if (!keys.IsMap() && !IsNone(keys))
      throw InputError(keys.mark, path, keys.scalar, "must be a map of its keys, or none: off");
  }
}

}  // namespace

std::filesystem::path BundledMission() {
  return ModelsFolder() / "missions" / (std::string(kBundledMission) + ".yaml");
}

SafetyPlan ReadSafety(const ConfigNode* safety, const ConfigNode& root) {
  SafetyPlan plan;
  plan.mission = ReadMission(root, RobotPrimitiveTypes());
  for (const MissionNode& node : plan.mission.nodes)
    if (node.kind == MissionNode::Kind::kPrimitive) MakePrimitive(plan.mission, node);
  // Those that nothing runs, too.
  for (std::size_t p = 0; p < plan.mission.primitives.size(); ++p) {
    MissionNode node;
    node.name = plan.mission.primitives[p].name;
    node.primitive = p;
    node.params = plan.mission.primitives[p].params;
    MakePrimitive(plan.mission, node);
    MonitorsOf(node);
  }
  const std::vector<std::string> named = MonitorsOf(plan.mission);
  const ConfigNode* written = nullptr;
  if (safety != nullptr) {
    ReadParams(*safety, "safety.", [&](ParamVisitor& v) { plan.reaction.Visit(v); }, {"monitors"});
    written = safety->Find("monitors");
    if (written != nullptr && !written->IsMap())
      throw InputError(written->mark, "safety.monitors", written->scalar,
                       "must be a map of monitors, each with its keys");
    if (written != nullptr) CheckMonitors(*written, named);
  }
  for (const std::string& name : named) {
    const ConfigNode* keys = written != nullptr ? written->Find(name) : nullptr;
    if (keys != nullptr && IsNone(*keys)) continue;
    auto monitor = MakePlugin(Monitors(), name, "monitors");
    if (keys != nullptr) ReadParams(*keys, "safety.monitors." + name + ".", *monitor);
    plan.monitors.push_back({name, ValuesOf(*monitor)});
  }
  return plan;
}

ConfigNode SafetySchema() {
  ReactionParams reaction;
  MapSchema monitors;
  for (const NamedSchema& one : PluginSchemas(Monitors()))
    monitors.Key(one.name, AnyOf({one.keys.Node(), NoneSchema()}), one.help);
  return AnyOf({MapSchema()
                    .Params([&](ParamVisitor& v) { reaction.Visit(v); })
                    .Key("monitors", monitors.Node(), "each with its keys, or none: off")
                    .Node(),
                NoneSchema()});
}

void KeepMonitorsOf(std::span<const Reading> told, SafetyPlan& plan) {
  const auto hears = [&](Reading r) { return std::ranges::find(told, r) != told.end(); };
  std::erase_if(plan.monitors, [&](const PluginSpec& spec) {
    const auto monitor = MakePlugin(Monitors(), spec, "monitors");
    return (monitor->by_estimate() && hears(Reading::kTruth)) ||
           !std::ranges::all_of(monitor->Needs(), hears);
  });
}

ConfigNode WriteSafety(const SafetyPlan& plan) {
  ReactionParams reaction = plan.reaction;
  ConfigNode node = WithParams(ConfigNode::Map(), reaction);
  ConfigNode monitors = ConfigNode::Map();
  const auto is_kept = [&](const std::string& name) {
    return std::ranges::find(plan.monitors, name, &PluginSpec::name) != plan.monitors.end();
  };
  for (const PluginSpec& spec : plan.monitors)
    monitors.Add(spec.name, WithValues(ConfigNode::Map(), spec.params));
  for (const std::string& name : MonitorsOf(plan.mission))
    if (!is_kept(name)) monitors.Add(name, ConfigNode::Scalar("none"));
  node.Add("monitors", std::move(monitors));
  return node;
}

}  // namespace floorproof

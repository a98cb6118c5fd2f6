// SPDX-License-Identifier: Apache-2.0
#include "controllers/supervision/safety_plan.h"

#include <algorithm>

namespace floorproof {

void ReactionParams::Visit(ParamVisitor& v) {
  v("react", react, "false: it watches and decides, and does nothing about it");
  v("adapt_share", adapt_share, Between(0.05, 1),
    "adaptation: the share of its speed that is left");
  v("wait_s", wait_s, NonNegative(),
    "safety waiting: how long it stands before it tries again (s)");
  v("patience_s", patience_s, NonNegative(),
    "what is seen to be bad while it stands is waited for so long (s)");
  v("cautious_s", cautious_s, NonNegative(), "after it has waited it drives adapted so long (s)");
  v("most_waits", most_waits, Between(0, 1000),
    "so often it waits, one soon after the other; then it hands over");
}

std::vector<std::string> MonitorsOf(const MissionNode& node) {
  std::vector<std::string> names;
  const ConfigNode* list = node.params.Find("monitors");
  if (list == nullptr) return names;
  const std::string path = node.name + ".monitors";
  if (!list->IsList())
    throw InputError(list->mark, path, list->scalar, "must be a list of monitors");
  for (const ConfigNode& item : list->items) {
    names.push_back(AsString(item, path));
    MakePlugin(Monitors(), names.back(), path, item.mark);
  }
  return names;
}

std::vector<std::string> MonitorsOf(const Mission& mission) {
  std::vector<std::string> names;
  for (const MissionNode& node : mission.nodes)
    for (const std::string& name : MonitorsOf(node))
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  return names;
}

std::vector<MissionLine> LinesOf(const Mission& mission, const ConfigNode& root) {
  std::vector<MissionLine> lines;
  int plans = 0;
  std::string skill;
  for (const MissionNode& node : mission.nodes) {
    if (node.kind == MissionNode::Kind::kSkill) skill = node.name;
    if (node.kind != MissionNode::Kind::kPrimitive) continue;
    const auto primitive = MakePrimitive(mission, node);
    plans += primitive->drives_plan() ? 1 : 0;
    const SourceMark mark = MarkOf(node.params, "x_m");
    try {
      if (const auto line = primitive->LeadsTo()) lines.push_back({*line, mark, skill});
    } catch (const InputError& e) {
      throw InputError(mark, "", "", skill + "." + node.name + "." + e.what());
    }
  }
  if (plans > 1 || (plans > 0) == !lines.empty())
    throw InputError(MarkOf(root, "run"), "run", "",
                     "must drive the plan once (follow_plan), or lead from place to place (line), "
                     "and not both");
  return lines;
}

std::unique_ptr<RobotPrimitive> MakePrimitive(const Mission& mission, const MissionNode& node) {
  const std::string& type = mission.primitives[node.primitive].type;
  auto primitive = MakePlugin(RobotPrimitives(), type, node.name, node.params.mark);
  ReadParams(node.params, node.name + ".", *primitive, {"monitors"});
  return primitive;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "controllers/safety/mission.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "base/error.h"

namespace floorproof {
namespace {

constexpr std::size_t kMostNodes = 10'000;

// The paper's names of a scale's values, and what each counts.
template <class T>
using Scale = std::span<const std::pair<std::string_view, T>>;

constexpr std::pair<std::string_view, Severity> kSeverities[] = {
    {"absence", Severity::kAbsence},
    {"minor", Severity::kMinor},
    {"catastrophic", Severity::kCatastrophic}};
constexpr std::pair<std::string_view, HarmExtent> kExtents[] = {
    {"isolated", HarmExtent::kIsolated}, {"external", HarmExtent::kExternal}};
constexpr std::pair<std::string_view, Availability> kAvailabilities[] = {
    {"redundant", Availability::kRedundant},
    {"eminent", Availability::kEminent},
    {"singular", Availability::kSingular}};
constexpr std::pair<std::string_view, Occurrence> kOccurrences[] = {
    {"very_low", Occurrence::kVeryLow},
    {"low", Occurrence::kLow},
    {"high", Occurrence::kHigh},
    {"relatively_high", Occurrence::kRelativelyHigh}};

// By its name or by what it counts.
template <class T>
void ReadRating(const ConfigNode& node, const char* key, const std::string& path, Scale<T> scale,
                T& rating) {
  const ConfigNode* written = node.Find(key);
  if (written == nullptr) return;
  const std::string text = AsString(*written, path + key);
  std::string rule = "must be one of";
  for (const auto& [name, value] : scale) {
    const std::string number = std::to_string(static_cast<int>(value));
    if (text == name || text == number) {
      rating = value;
      return;
    }
    rule += " " + std::string(name) + " (" + number + ")";
  }
  throw InputError(written->mark, path + key, text, rule);
}

const ConfigNode& Needed(const ConfigNode& node, const char* key, ConfigNode::Kind kind,
                         const char* what) {
  const ConfigNode* found = node.Find(key);
  if (found == nullptr) throw InputError(node.mark, key, "", std::string("is missing: ") + what);
  if (found->kind != kind || (found->IsMap() && found->entries.empty()) ||
      (found->IsList() && found->items.empty()))
    throw InputError(found->mark, key, found->scalar, std::string("must hold ") + what);
  return *found;
}

std::vector<std::string> NamesOf(const ConfigNode& map) {
  std::vector<std::string> names;
  for (const auto& [name, entry] : map.entries) names.push_back(name);
  return names;
}

class MissionReader {
 public:
  MissionReader(const ConfigNode& root, std::span<const PrimitiveType> types)
      : root_(root), types_(types) {}

  Mission Read() {
    constexpr int kVersion = 1;
    const ConfigNode* version = root_.Find("mission");
    if (version == nullptr) throw InputError(root_.mark, "mission", "", "is missing: mission: 1");
    RefuseUnknownKeys(root_, "",
                      {"mission", "name", "primitives", "skills", "tasks", "run", "weights",
                       "levels", "decision"});
    AsInt(*version, "mission", Between(kVersion, kVersion));
    if (const ConfigNode* name = root_.Find("name")) mission_.name = AsString(*name, "name");
    ReadNumbers();
    ReadPrimitives();
    skills_ = &Needed(root_, "skills", ConfigNode::Kind::kMap, "skills by name");
    tasks_ = &Needed(root_, "tasks", ConfigNode::Kind::kMap, "tasks by name");
    const ConfigNode& run =
        Needed(root_, "run", ConfigNode::Kind::kList, "the mission's tasks in order");
    Refuse(*skills_, "skills");
    Refuse(*tasks_, "tasks");
    Add(MissionNode::Kind::kMission, mission_.name, root_.mark);
    Steps steps;
    for (const ConfigNode& task : run.items) Take(steps, AddTask(0, task, "run"), task, "run");
    CheckTheRest();
    return std::move(mission_);
  }

 private:
  void ReadNumbers() {
    const auto read = [this](const char* key, auto& params) -> const ConfigNode* {
      const ConfigNode* node = root_.Find(key);
      if (node != nullptr)
        ReadParams(*node, std::string(key) + ".", [&](ParamVisitor& v) { params.Visit(v); });
      return node;
    };
    read("weights", mission_.weights);
    if (const ConfigNode* node = read("levels", mission_.levels))
      mission_.levels.Check(*node, "levels.");
    if (const ConfigNode* node = read("decision", mission_.decision))
      mission_.decision.Check(*node, "decision.");
    if (mission_.levels.serious >= mission_.decision.z_crit) {
      const ConfigNode* decision = root_.Find("decision");
      const ConfigNode* levels = root_.Find("levels");
      const std::string serious = FormatDouble(mission_.levels.serious),
                        z_crit = FormatDouble(mission_.decision.z_crit);
      if (decision != nullptr && decision->Find("z_crit") != nullptr)
        throw InputError(MarkOf(*decision, "z_crit"), "decision.z_crit", z_crit,
                         "must be above levels.serious, " + serious + ": it is where fatal begins");
      throw InputError(
          MarkOf(levels != nullptr ? *levels : root_, "serious"), "levels.serious", serious,
          "must be below decision.z_crit, " + z_crit + ", which is where fatal begins");
    }
  }

  // What nothing runs is held to the same: whoever writes it means to run it.
  void CheckTheRest() {
    const MissionNode mission = mission_.nodes[0];
    const std::size_t run = mission_.nodes.size();
    const auto check = [&](const ConfigNode& all, const auto& add) {
      for (const auto& [name, node] : all.entries) {
        if (used_.contains(name)) continue;
        add(name, node);
        mission_.nodes.resize(run);
        mission_.nodes[0] = mission;
      }
    };
    check(*tasks_, [&](const std::string& name, const ConfigNode& node) {
      ConfigNode named = ConfigNode::Scalar(name);
      named.mark = node.mark;
      AddTask(0, named, "tasks");
    });
    check(*skills_, [&](const std::string& name, const ConfigNode& node) {
      AddSkill(0, name, node, node.mark);
    });
  }

  void ReadPrimitives() {
    const ConfigNode& all =
        Needed(root_, "primitives", ConfigNode::Kind::kMap, "primitives by name");
    for (const auto& [name, node] : all.entries) {
      const std::string path = "primitives." + name + ".";
      if (!node.IsMap() && !node.IsNull())
        throw InputError(node.mark, "primitives." + name, node.scalar,
                         "must hold what is said of its failures");
      MissionPrimitive& primitive = mission_.primitives.emplace_back();
      primitive.name = primitive.type = name;
      const ConfigNode* type = node.Find("type");
      if (type != nullptr) primitive.type = AsString(*type, path + "type");
      const auto known = std::ranges::find(types_, primitive.type, &PrimitiveType::name);
      if (known == types_.end()) {
        std::vector<std::string> names;
        for (const PrimitiveType& t : types_) names.push_back(t.name);
        throw InputError(type != nullptr ? type->mark : node.mark, path + "type", primitive.type,
                         "is no primitive" + DidYouMeanOneOf(primitive.type, names));
      }
      FailureRating& rating = primitive.rating;
      ReadRating(node, "severity", path, Scale<Severity>(kSeverities), rating.severity);
      ReadRating(node, "extent", path, Scale<HarmExtent>(kExtents), rating.extent);
      ReadRating(node, "availability", path, Scale<Availability>(kAvailabilities),
                 rating.availability);
      ReadRating(node, "occurrence", path, Scale<Occurrence>(kOccurrences), rating.occurrence);
      primitive.params = node.IsMap() ? node : ConfigNode::Map();
      primitive.params.mark = node.mark;
      for (const char* key : {"type", "severity", "extent", "availability", "occurrence"})
        primitive.params.Remove(key);
      RefuseUnknownKeys(primitive.params, path, known->keys);
    }
  }

  // One name for two things would not say which of them is meant.
  void Refuse(const ConfigNode& map, const char* key) const {
    for (const auto& [name, node] : map.entries) {
      const bool primitive =
          std::ranges::find(mission_.primitives, name, &MissionPrimitive::name) !=
          mission_.primitives.end();
      if (primitive || (&map == tasks_ && skills_->Find(name) != nullptr))
        throw InputError(
            node.mark, std::string(key) + "." + name, "",
            primitive ? "is the name of a primitive, too" : "is the name of a skill, too");
    }
  }

  std::size_t Add(MissionNode::Kind kind, const std::string& name, const SourceMark& mark) {
    if (mission_.nodes.size() == kMostNodes)
      throw InputError(mark, "run", "", "makes a tree of more than 10,000 nodes");
    MissionNode& node = mission_.nodes.emplace_back();
    node.kind = kind;
    node.name = name;
    return mission_.nodes.size() - 1;
  }

  // A part of the tree, with all below it.
  struct Part {
    std::size_t node = 0;
    bool ends = true;
    std::set<std::string> needs;  // PrimitiveType::needs of its primitives
  };
  // The parts of one skill or task so far.
  struct Steps {
    bool ends = false;                         // some run in order
    std::map<std::string, std::string> users;  // resource -> name of the part
  };

  // Takes the next part, written as `item` under `key`.
  void Take(Steps& steps, const Part& part, const ConfigNode& item, const std::string& key,
            bool parallel = false) {
    MissionNode& node = mission_.nodes[part.node];
    node.parallel = parallel;
    if (!parallel && !part.ends)
      throw InputError(item.mark, key, node.name, "goes on for ever: it belongs under with");
    for (const std::string& need : part.needs) {
      const auto [user, added] = steps.users.emplace(need, node.name);
      if (!added && parallel)
        throw InputError(
            item.mark, key, node.name,
            "needs " + need + " while " + user->second + " does, which runs beside it");
    }
    steps.ends |= !parallel;
  }

  // Reads the parts under `run` and `with` of a skill or a task. Without `run` it has no end.
  template <class Add>
  Steps AddSteps(const ConfigNode& node, const std::string& path, const char* rule,
                 const Add& add) {
    Steps steps;
    const ConfigNode* with = node.Find("with");
    const bool beside = with != nullptr && with->IsList() && !with->items.empty();
    for (const char* key : {"run", "with"}) {
      const bool parallel = std::string_view(key) == "with";
      const ConfigNode* list = node.Find(key);
      if (list == nullptr && (parallel || beside)) continue;
      const std::string of = path + "." + key;
      if (list == nullptr || !list->IsList() || (!parallel && list->items.empty()))
        throw InputError(list != nullptr ? list->mark : node.mark, of,
                         list != nullptr ? list->scalar : "", rule);
      for (const ConfigNode& item : list->items)
        Take(steps, add(item, of, parallel), item, of, parallel);
    }
    return steps;
  }

  static Part Whole(std::size_t node, const Steps& steps) {
    Part part{node, steps.ends, {}};
    for (const auto& [need, user] : steps.users) part.needs.insert(need);
    return part;
  }

  Part AddTask(std::size_t parent, const ConfigNode& named, const std::string& key) {
    const std::string name = AsString(named, key);
    const ConfigNode* task = tasks_->Find(name);
    if (task == nullptr)
      throw InputError(named.mark, key, name,
                       std::string(skills_->Find(name) ? "is a skill, and no task" : "is no task") +
                           DidYouMeanOneOf(name, NamesOf(*tasks_)));
    if (std::ranges::find(within_, name) != within_.end())
      throw InputError(named.mark, key, name, "is part of itself: " + Cycle(name));
    constexpr std::size_t kDeepest = 100;
    if (within_.size() == kDeepest)
      throw InputError(named.mark, key, name, "lies more than 100 tasks deep");
    used_.insert(name);
    const std::string path = "tasks." + name;
    if (!task->IsMap() && (!task->IsList() || task->items.empty()))
      throw InputError(task->mark, path, task->scalar,
                       "must be a list of skills or tasks, or a map of run and with");
    const std::size_t node = Add(MissionNode::Kind::kTask, name, named.mark);
    mission_.nodes[parent].children.push_back(node);
    within_.push_back(name);
    Steps steps;
    if (task->IsMap()) {
      RefuseUnknownKeys(*task, path + ".", {"run", "with"});
      steps = AddSteps(*task, path, "must be a list of skills or tasks",
                       [&](const ConfigNode& step, const std::string& of, bool) {
                         return AddSkillOrTask(node, step, of);
                       });
    } else {
      for (const ConfigNode& step : task->items)
        Take(steps, AddSkillOrTask(node, step, path), step, path);
    }
    within_.pop_back();
    return Whole(node, steps);
  }

  Part AddSkillOrTask(std::size_t parent, const ConfigNode& step, const std::string& key) {
    const std::string name = AsString(step, key);
    if (const ConfigNode* skill = skills_->Find(name))
      return AddSkill(parent, name, *skill, step.mark);
    if (tasks_->Find(name) != nullptr) return AddTask(parent, step, key);
    throw InputError(step.mark, key, name,
                     "is neither skill nor task" + DidYouMeanOneOf(name, NamesOf(*skills_)));
  }

  std::string Cycle(const std::string& name) const {
    std::string text;
    for (auto it = std::ranges::find(within_, name); it != within_.end(); ++it)
      text += *it + " -> ";
    return text + name;
  }

  Part AddSkill(std::size_t parent, const std::string& name, const ConfigNode& skill,
                const SourceMark& mark) {
    used_.insert(name);
    const std::string path = "skills." + name;
    if (!skill.IsMap())
      throw InputError(skill.mark, path, skill.scalar,
                       "must hold run, its primitives in order, and may hold with");
    ConfigNode params = skill;  // what it hands to its primitives
    params.Remove("run");
    params.Remove("with");
    const std::size_t node = Add(MissionNode::Kind::kSkill, name, mark);
    mission_.nodes[parent].children.push_back(node);
    const Steps steps = AddSteps(skill, path, "must be a list of primitives",
                                 [&](const ConfigNode& item, const std::string& of, bool parallel) {
                                   return AddPrimitive(node, item, of, parallel, params);
                                 });
    std::vector<std::string> known = {"run", "with"};
    for (const std::size_t child : mission_.nodes[node].children) {
      const std::vector<std::string>& keys =
          TypeOf(mission_.primitives[mission_.nodes[child].primitive]).keys;
      known.insert(known.end(), keys.begin(), keys.end());
    }
    RefuseUnknownKeys(skill, path + ".", known);
    return Whole(node, steps);
  }

  Part AddPrimitive(std::size_t parent, const ConfigNode& item, const std::string& key,
                    bool parallel, const ConfigNode& of_skill) {
    const std::string name = AsString(item, key);
    const auto found = std::ranges::find(mission_.primitives, name, &MissionPrimitive::name);
    if (found == mission_.primitives.end()) {
      std::vector<std::string> names;
      for (const MissionPrimitive& p : mission_.primitives) names.push_back(p.name);
      const bool skill = skills_->Find(name) != nullptr;
      throw InputError(item.mark, key, name,
                       std::string(skill ? "is a skill: skills are made of primitives"
                                         : "is no primitive of this mission") +
                           DidYouMeanOneOf(name, names));
    }
    const PrimitiveType& type = TypeOf(*found);
    if (type.ends && parallel)
      throw InputError(item.mark, key, name, "comes to an end: it belongs under run");
    const std::size_t index = Add(MissionNode::Kind::kPrimitive, name, item.mark);
    mission_.nodes[parent].children.push_back(index);
    MissionNode& node = mission_.nodes[index];
    node.primitive = static_cast<std::size_t>(found - mission_.primitives.begin());
    node.params = found->params;
    const std::vector<std::string>& keys = type.keys;
    for (const auto& [handed, value] : of_skill.entries) {
      if (std::ranges::find(keys, handed) == keys.end()) continue;
      node.params.Remove(handed);  // the skill's rules
      node.params.Add(handed, value);
    }
    Part part{index, type.ends, {}};
    if (!type.needs.empty()) part.needs.insert(type.needs);
    return part;
  }

  const PrimitiveType& TypeOf(const MissionPrimitive& primitive) const {
    return *std::ranges::find(types_, primitive.type, &PrimitiveType::name);
  }

  const ConfigNode& root_;
  std::span<const PrimitiveType> types_;
  const ConfigNode* skills_ = nullptr;
  const ConfigNode* tasks_ = nullptr;
  std::vector<std::string> within_;  // the tasks that are being read
  std::set<std::string> used_;       // tasks and skills that were
  Mission mission_;
};

}  // namespace

Mission ReadMission(const ConfigNode& root, std::span<const PrimitiveType> types) {
  if (!root.IsMap()) throw InputError(root.mark, "mission", "", "must be a map of keys");
  return MissionReader(root, types).Read();
}

}  // namespace floorproof

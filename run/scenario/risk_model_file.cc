// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/risk_model_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>

#include "base/file_output.h"
#include "base/params.h"
#include "run/scenario/scenario_parts.h"

namespace floorproof {
namespace {

// Coefficients are of functions of about 1, and e to this power is no rate of anything.
const Bounds kCoefficient = Between(-1e4, 1e4);
constexpr int kMost = 1000 * 1000 * 1000;

// A map, and where it stands in the file.
class Keys {
 public:
  Keys(const ConfigNode& node, std::string path, const std::vector<std::string>& known)
      : node_(node), path_(std::move(path)) {
    if (!node.IsMap()) throw InputError(node.mark, path_, "", "must be a map of keys");
    RefuseUnknownKeys(node, path_.empty() ? "" : path_ + ".", known);
  }
  std::string Path(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  bool Has(const std::string& key) const { return node_.Find(key) != nullptr; }
  const ConfigNode& At(const std::string& key) const {
    const ConfigNode* found = node_.Find(key);
    if (found == nullptr) throw InputError(node_.mark, Path(key), "", "the key is missing");
    return *found;
  }
  double Number(const std::string& key, const Bounds& rule) const {
    return AsDouble(At(key), Path(key), rule);
  }
  int Count(const std::string& key) const {
    return static_cast<int>(AsInt(At(key), Path(key), Between(0, kMost)));
  }
  std::string Text(const std::string& key) const { return AsString(At(key), Path(key)); }
  bool Flag(const std::string& key) const { return AsBool(At(key), Path(key)); }
  const std::vector<ConfigNode>& List(const std::string& key) const {
    const ConfigNode& list = At(key);
    if (!list.IsList()) throw InputError(list.mark, Path(key), "", "must be a list");
    return list.items;
  }
  template <class Value>
  Value OneOf(const std::string& key,
              std::initializer_list<std::pair<const char*, Value>> choices) const {
    const std::string text = Text(key);
    std::vector<std::string> names;
    for (const auto& [name, value] : choices) {
      if (text == name) return value;
      names.emplace_back(name);
    }
    throw InputError(At(key).mark, Path(key), text, "must be one of " + Joined(names));
  }

 private:
  static std::string Joined(const std::vector<std::string>& names) {
    return fmt::format("{}", fmt::join(names, ", "));
  }
  const ConfigNode& node_;
  std::string path_;
};

std::vector<double> Numbers(const ConfigNode& node, const std::string& path, const Bounds& rule,
                            std::size_t count) {
  if (!node.IsList() || node.items.size() != count)
    throw InputError(node.mark, path, "", fmt::format("must be a list of {} numbers", count));
  std::vector<double> numbers;
  for (const ConfigNode& item : node.items) numbers.push_back(AsDouble(item, path, rule));
  return numbers;
}

RateAxis ReadAxis(const ConfigNode& node, const std::string& path) {
  const Keys keys(node, path, {"name", "of", "lower", "upper", "period", "knots", "functions"});
  RateAxis axis;
  axis.name = keys.Text("name");
  axis.of_hazard = keys.OneOf<bool>("of", {{"hazard", true}, {"approach", false}});
  const auto is_named = [&](const auto& column) { return column.name == axis.name; };
  if (!axis.of_hazard && std::ranges::none_of(kApproach, is_named) &&
      std::ranges::none_of(kDerived, is_named))
    throw InputError(keys.At("name").mark, keys.Path("name"), axis.name,
                     "is no column of an approach");
  axis.lower = keys.Number("lower", Any());
  axis.upper = keys.Number("upper", AtLeast(axis.lower));
  if (keys.Has("period")) axis.period = keys.Number("period", Positive());
  const ConfigNode& knots = keys.At("knots");
  axis.knots =
      Numbers(knots, keys.Path("knots"), Between(axis.lower, axis.upper), knots.items.size());
  const std::vector<ConfigNode>& functions = keys.List("functions");
  if (axis.knots.empty() && functions.empty()) return axis;
  if (axis.knots.size() < 2 || axis.knots.front() != axis.lower ||
      axis.knots.back() != axis.upper ||
      std::adjacent_find(axis.knots.begin(), axis.knots.end(), std::greater_equal<>()) !=
          axis.knots.end())
    throw InputError(knots.mark, keys.Path("knots"), "", "must ascend from lower to upper");
  for (const ConfigNode& function : functions)
    axis.functions.push_back(
        Numbers(function, keys.Path("functions"), kCoefficient, axis.knots.size()));
  return axis;
}

// Three numbers a factor: axis, first function, how many.
RateBlock ReadBlock(const ConfigNode& node, const std::string& path,
                    const std::vector<RateAxis>& axes) {
  constexpr std::size_t kMostFactors = 8, kMostProducts = 4096;
  if (!node.IsList() || node.items.empty() || node.items.size() % 3 != 0 ||
      node.items.size() > 3 * kMostFactors)
    throw InputError(node.mark, path, "",
                     "must be a list of three numbers a factor: axis, first function, how many");
  const auto number = [&](std::size_t i, double least, double most) {
    return static_cast<std::size_t>(AsInt(node.items[i], path, Between(least, most)));
  };
  RateBlock block;
  for (std::size_t i = 0; i < node.items.size(); i += 3) {
    RateFactor factor;
    factor.axis = number(i, 0, static_cast<double>(axes.size()) - 1);
    const auto functions = static_cast<double>(axes[factor.axis].functions.size());
    factor.first = number(i + 1, 0, functions - 1);
    factor.count = number(i + 2, 1, functions - static_cast<double>(factor.first));
    block.factors.push_back(factor);
    if (block.size() > kMostProducts)
      throw InputError(node.mark, path, "",
                       fmt::format("must be at most {} products", kMostProducts));
  }
  return block;
}

LinearPredictor ReadPredictor(const Keys& keys, const std::vector<RateAxis>& axes) {
  LinearPredictor of;
  of.events = keys.Count("events");
  std::size_t size = 1;
  for (const ConfigNode& block : keys.List("blocks")) {
    of.blocks.push_back(ReadBlock(block, keys.Path("blocks"), axes));
    size += of.blocks.back().size();
  }
  of.coefficients = Numbers(keys.At("coefficients"), keys.Path("coefficients"), kCoefficient, size);
  const std::vector<ConfigNode>& members = keys.List("members");
  if (members.size() != kRateMembers)
    throw InputError(keys.At("members").mark, keys.Path("members"), "",
                     fmt::format("must be {} lists", kRateMembers));
  for (const ConfigNode& member : members)
    of.members.push_back(Numbers(member, keys.Path("members"), kCoefficient, size));
  return of;
}

FailureMode ReadMode(const Keys& keys) {
  const std::string text = keys.Text("mode");
  std::vector<std::string> names;
  for (int m = 0; m < kNumFailureModes; ++m) {
    names.emplace_back(Name(FailureMode(m)));
    if (text == names.back()) return FailureMode(m);
  }
  throw InputError(keys.At("mode").mark, keys.Path("mode"), text,
                   fmt::format("must be one of {}", fmt::join(names, ", ")));
}

void ReadSplits(const Keys& of_kind, KindRates& kind) {
  const std::vector<ConfigNode>& nodes = of_kind.List("splits");
  if (nodes.size() != kind.splits.size())
    throw InputError(of_kind.At("splits").mark, of_kind.Path("splits"), "",
                     fmt::format("must be {} maps", kind.splits.size()));
  int left = kind.any.events;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Keys keys(nodes[k], fmt::format("{}.{}", of_kind.Path("splits"), k),
                    {"mode", "events", "blocks", "coefficients", "members"});
    ModeSplit& split = kind.splits[k];
    split.mode = ReadMode(keys);
    for (std::size_t before = 0; before < k; ++before)
      if (kind.splits[before].mode == split.mode)
        throw InputError(keys.At("mode").mark, keys.Path("mode"), std::string(Name(split.mode)),
                         "must be split off once");
    split.of = ReadPredictor(keys, kind.axes);
    if (split.of.events > left)
      throw InputError(keys.At("events").mark, keys.Path("events"), std::to_string(split.of.events),
                       fmt::format("must be at most the failures left, {}", left));
    left -= split.of.events;
  }
}

Passage ReadPassage(const Keys& keys) {
  return keys.OneOf<Passage>("passage", {{"over", Passage::kOver}, {"beside", Passage::kBeside}});
}

KindRates ReadKind(const ConfigNode& node, const std::string& path) {
  const Keys keys(node, path,
                  {"type", "passage", "manner", "per", "encounters", "cleared", "censored", "way_m",
                   "theta", "axes", "any", "splits"});
  KindRates kind;
  kind.type = keys.Text("type");
  kind.passage = ReadPassage(keys);
  kind.manner = keys.OneOf<Manner>(
      "manner",
      {{"any", Manner::kAny}, {"straight", Manner::kStraight}, {"turning", Manner::kTurning}});
  kind.per_metre = keys.OneOf<bool>("per", {{"metre", true}, {"encounter", false}});
  if (kind.per_metre != IsExposure(kind.type))
    throw InputError(keys.At("per").mark, keys.Path("per"), keys.Text("per"),
                     "must be metre of free floor and of walls, encounter of any other type");
  kind.encounters = keys.Count("encounters");
  kind.cleared = keys.Count("cleared");
  kind.censored = keys.Count("censored");
  kind.way_m = keys.Number("way_m", NonNegative());
  kind.theta = keys.Number("theta", Between(1, 100));  // powers stay numbers
  std::size_t number = 0;
  for (const ConfigNode& axis : keys.List("axes")) {
    const std::string at = fmt::format("{}.{}", keys.Path("axes"), number++);
    RateAxis read = ReadAxis(axis, at);
    for (const RateAxis& before : kind.axes)
      if (before.name == read.name && before.of_hazard == read.of_hazard)
        throw InputError(axis.mark, at + ".name", read.name, "must stand there once");
    kind.axes.push_back(std::move(read));
  }
  kind.any = ReadPredictor(
      {keys.At("any"), keys.Path("any"), {"events", "blocks", "coefficients", "members"}},
      kind.axes);
  ReadSplits(keys, kind);
  const std::int64_t outcomes =
      static_cast<std::int64_t>(kind.cleared) + kind.censored + kind.any.events;
  if (outcomes != kind.encounters)
    throw InputError(
        keys.At("encounters").mark, keys.Path("encounters"), std::to_string(kind.encounters),
        fmt::format("must be cleared, censored and the failures together, {}", outcomes));
  return kind;
}

CarryOver ReadCarryOver(const ConfigNode& node) {
  const Keys keys(node, "plans", {"intercept", "slope", "plans", "drives", "expected", "failed"});
  CarryOver of;
  of.intercept = keys.Number("intercept", Between(-10, 10));  // odds of 1 to 20,000
  of.slope = keys.Number("slope", Positive());  // what fails more often is predicted to
  of.plans = keys.Count("plans");
  of.drives = keys.Count("drives");
  if (of.drives < of.plans)
    throw InputError(keys.At("drives").mark, keys.Path("drives"), std::to_string(of.drives),
                     fmt::format("must be at least one a plan, {}", of.plans));
  of.expected = keys.Number("expected", NonNegative());
  of.failed = keys.Count("failed");
  if (of.failed > of.drives)
    throw InputError(keys.At("failed").mark, keys.Path("failed"), std::to_string(of.failed),
                     fmt::format("must be at most the drives, {}", of.drives));
  return of;
}

MeasuredRobot ReadMeasuredRobot(const ConfigNode& node) {
  const Keys keys(node, "robot", {"name", "drive", "mass_kg", "clearance_m", "model"});
  MeasuredRobot robot;
  robot.name = keys.Text("name");
  robot.drive = keys.Text("drive");
  robot.mass_kg = keys.Number("mass_kg", NonNegative());
  robot.clearance_m = keys.Number("clearance_m", NonNegative());
  robot.model = keys.Text("model");
  return robot;
}

}  // namespace

namespace {

RiskModel Parse(const std::filesystem::path& file, const InputFiles& files) {
  const ConfigNode root = ReadYamlFile(file, files, "risk_model");
  if (!root.IsMap()) throw InputError({file.string(), 1}, "", "", "must be a map of keys");
  if (root.Find("risk_model") == nullptr)
    throw InputError(root.mark, "risk_model", "",
                     fmt::format("the key is missing (risk_model: {}): this is no risk model",
                                 kRiskModelVersion));
  const ConfigNode& version = *root.Find("risk_model");
  if (AsInt(version, "risk_model", Between(0, 1e6)) != kRiskModelVersion)
    throw InputError(version.mark, "risk_model", version.scalar,
                     fmt::format("must be {}: another version of floorproof wrote it; measure the "
                                 "robot anew (floorproof measure)",
                                 kRiskModelVersion));
  const Keys keys(
      root, "", {"risk_model", "robot", "mirrored", "encounters", "plans", "kinds", "unmeasured"});
  RiskModel model;
  model.robot = ReadMeasuredRobot(keys.At("robot"));
  model.mirrored = keys.Flag("mirrored");
  model.encounters = keys.Count("encounters");
  if (keys.Has("plans")) model.carry_over = ReadCarryOver(keys.At("plans"));
  std::size_t number = 0;
  for (const ConfigNode& node : keys.List("kinds")) {
    const std::string path = fmt::format("kinds.{}", number++);
    KindRates kind = ReadKind(node, path);
    for (const KindRates& other : model.kinds)
      if (other.type == kind.type && other.passage == kind.passage &&
          (other.manner == kind.manner || other.manner == Manner::kAny ||
           kind.manner == Manner::kAny))
        throw InputError(node.mark, path, TextOf(kind), "must stand there once");
    model.kinds.push_back(std::move(kind));
  }
  if (model.kinds.empty())
    throw InputError(keys.At("kinds").mark, "kinds", "", "must not be empty: nothing was measured");
  number = 0;
  for (const ConfigNode& node : keys.List("unmeasured")) {
    const Keys unmeasured(node, fmt::format("unmeasured.{}", number++), {"type", "passage", "why"});
    model.unmeasured.push_back(
        {unmeasured.Text("type"), ReadPassage(unmeasured), unmeasured.Text("why")});
  }
  return model;
}

// Models by their bytes. A campaign's every episode reads its model.
class ReadModels {
 public:
  std::shared_ptr<const RiskModel> Get(const std::filesystem::path& file, const InputFiles& files) {
    const std::string hash = Sha256(files.Read(file, kMaxNamedBytes));
    const std::lock_guard lock(mutex_);
    std::shared_ptr<const RiskModel>& model = models_[hash];
    if (!model) model = std::make_shared<const RiskModel>(Parse(file, files));
    return model;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const RiskModel>> models_;
};

}  // namespace

std::shared_ptr<const RiskModel> ReadRiskModel(const std::filesystem::path& file,
                                               const InputFiles& files) {
  static ReadModels models;
  return models.Get(file, files);
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/scenario_file.h"

#include <algorithm>
#include <map>
#include <mutex>

#include "base/file_output.h"
#include "base/input_file.h"
#include "base/name_param.h"
#include "base/printable.h"
#include "env/map/ros_map.h"
#include "env/scene/models_folder.h"
#include "run/scenario/scenario_parts.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSite = "site.";

// A plug-in or robot that is written as its name alone, made a map that a key can be set in.
void MakeMap(ConfigNode& root, const std::string& key_path) {
  constexpr std::pair<const char*, const char*> kNamed[] = {
      {"robot", "name"}, {"plan", "planner"}, {"controller", "name"}, {"estimator", "name"}};
  for (const auto& [key, name_key] : kNamed) {
    ConfigNode* node = root.Find(key);
    if (node == nullptr || !node->IsScalar() || !key_path.starts_with(std::string(key) + "."))
      continue;
    ConfigNode map = ConfigNode::Map();
    map.mark = node->mark;
    map.Add(name_key, *node);
    *node = std::move(map);
  }
}

// A plan is made by a planner, read from a file or asked of a program: who sets one of them on the
// command line takes the other away, with its keys.
void ChooseWhosePlan(const std::string& key_path, ConfigNode& root) {
  const ConfigNode* plan = root.Find("plan");
  if (plan == nullptr) return;
  const bool from_file = plan->Find("file") != nullptr, asked = plan->Find("command") != nullptr;
  if ((key_path == "plan.file" && !from_file) || (key_path == "plan.command" && !asked) ||
      (key_path == "plan.planner" && (from_file || asked)))
    root.Remove("plan");
}

void Apply(const Variant& changes, ConfigNode& root) {
  for (const auto& [key, value] : changes.overrides) {
    if (key.starts_with(kSite)) continue;
    MakeMap(root, key);
    root.SetPath(key, value);
  }
}

// Keys site.* reach into the site's own tree, once that is read. Their paths are the scenario's,
// from its folder, wherever the site lies.
void ApplyToSite(const Variant& changes, const fs::path& scenario_folder, ConfigNode& site) {
  for (const auto& [key, value] : changes.overrides) {
    if (!key.starts_with(kSite)) continue;
    ConfigNode set = value;
    if (NamesFile(key, value.scalar))
      set.scalar = fs::absolute(PathIn(scenario_folder, value, key)).string();
    site.SetPath(std::string_view(key).substr(kSite.size()), std::move(set));
  }
}

InputFiles Confined(InputFiles files, const fs::path& scenario) {
  ConfineScenario(scenario, files);
  return files;
}

// A file that should hold this kind of thing, a scenario or a site, and its version under the key
// of that name.
ConfigNode ReadTree(const fs::path& file, const std::string& kind, const InputFiles& files) {
  RefuseMapImage(file, "a " + kind, files);
  return ReadYamlFile(file, files, kind);
}

// A path of an override is relative to the current folder if that has such a file; otherwise it is
// relative to the scenario's folder, as paths in the scenario are.
void FindFromHere(const std::string& key, const fs::path& folder, ConfigNode& value) {
  std::error_code ignored;
  for (auto& [name, part] : value.entries) FindFromHere(key + "." + name, folder, part);
  if (!value.IsScalar() || !NamesFile(key, value.scalar) || !fs::exists(value.scalar, ignored))
    return;
  if (!fs::equivalent(".", folder / ".", ignored))
    value.scalar = fs::absolute(value.scalar).string();
}

// A ROS map_server file has these and nothing of a scenario.
bool IsRosMap(const ConfigNode& root) {
  return root.Find("image") != nullptr && root.Find("resolution") != nullptr &&
         root.Find("scenario") == nullptr;
}

// A site file's own: its format version, where a scenario names its site.
bool IsSite(const ConfigNode& root) {
  const ConfigNode* version = root.Find("site");
  return version != nullptr && version->scalar == "1" && root.Find("scenario") == nullptr;
}

// What is no scenario, yet stands where one should.
void RefuseOtherKinds(const ConfigNode& root, const std::string& file) {
  if (!root.IsMap())
    throw InputError({file, 1}, "", "",
                     "must be a map of keys (scenario: 1, site: site.yaml, robot: beluga, ...)");
  if (IsRosMap(root))
    throw InputError(
        {file, 0}, "", "",
        "is a ROS map, not a scenario: `floorproof init " + file + "` writes a scenario for it");
  if (IsSite(root))
    throw InputError({file, 0}, "", "",
                     "is a site, not a scenario: a scenario names it, at least `scenario: 1`, "
                     "`site: " +
                         fs::path(file).filename().string() +
                         "`, `robot: beluga`; `floorproof init` writes one for a ROS map");
}

// What is `none`, or empty, is not there: no gate, nothing drawn, no variants. Supervision that
// says nothing more is there.
void RemoveNone(ConfigNode& root) {
  for (const char* key : {"gate", "randomise", "matrix", "safety", "mission"}) {
    const ConfigNode* node = root.Find(key);
    if (node == nullptr) continue;
    const bool supervises = std::string_view(key) == "safety";
    const bool none = node->IsNull() || (node->IsMap() && node->entries.empty() && !supervises) ||
                      (node->IsScalar() && !node->quoted && node->scalar == "none");
    if (none) root.Remove(key);
  }
}

// Whether setting `whole` replaces `key`.
bool Replaces(const std::string& whole, const std::string& key) {
  return key == whole || key.starts_with(whole + ".") ||
         ((whole == "plan.file" || whole == "plan.command") && key.starts_with("plan."));
}

// The files that a resolved scenario was made from. A copy kept beside it replaces each one; a file
// without a copy is refused if it has changed since.
void TakeListedFiles(const ConfigNode& root, const fs::path& folder, bool check,
                     const InputFiles& inputs) {
  const ConfigNode* files = root.Find("files");
  if (files == nullptr) return;
  if (!files->IsMap()) throw InputError(files->mark, "files", "", "must be a map of path: SHA-256");
  for (const auto& [path, node] : files->entries) {
    const bool bundled = path.starts_with(kBundled);  // trusted: never replaced by a copy
    const fs::path named = bundled ? ModelsFolder() / path.substr(kBundled.size()) : folder / path;
    const std::string hash = AsString(node, "files." + path);
    if (const fs::path copy = KeptCopy(folder, hash);
        !bundled && IsSha256(hash) && WhyUnreadable(copy, kMaxNamedBytes).empty())
      inputs.StandIn(named, hash, copy);
    if (!check) continue;
    if (const std::string why = inputs.WhyUnreadable(named, kMaxNamedBytes); !why.empty())
      throw InputError(node.mark, "files." + path, "", why);
    inputs.Read(named, kMaxNamedBytes);
    if (const std::string& now = inputs.Sha256(named); now != hash)
      throw InputError(node.mark, "files." + path, hash,
                       "the file has changed since: SHA-256 " + now);
  }
}

}  // namespace

struct ScenarioFile::SiteFiles {
  std::mutex mutex;
  std::map<fs::path, ConfigNode> trees;  // read once each
};

ScenarioFile::ScenarioFile(const fs::path& file, const std::vector<Override>& overrides,
                           Trust trust)
    : ScenarioFile(std::nullopt, file, overrides, trust, Files::kCheck) {}

ScenarioFile ScenarioFile::FromText(const std::string& text, const fs::path& file,
                                    const std::vector<Override>& overrides) {
  return {text, file, overrides, Trust::kFull, Files::kCheck};
}

ScenarioFile ScenarioFile::Unpack(const PackedScenario& packed) {
  const InputFiles inputs;
  for (const auto& [name, bytes] : packed.inputs) inputs.Hold(name, bytes);
  return {packed.text, packed.file, packed.overrides, packed.trust, Files::kCheck, inputs};
}

PackedScenario ScenarioFile::Pack() const {
  PackedScenario packed{file_, files_.confined() ? Trust::kNone : Trust::kFull, text_, {}, {}};
  for (const auto& [key, value] : overrides_) packed.overrides.push_back({key, WriteYaml(value)});
  const std::string bundled = (ModelsFolder() / "").string();
  for (auto& input : files_.Named())
    if (!input.first.starts_with(bundled)) packed.inputs.push_back(std::move(input));
  return packed;
}

ScenarioFile ScenarioFile::Recorded(const fs::path& file) {
  return {std::nullopt, file, {}, Trust::kNone, Files::kMayBeGone};
}

ScenarioFile::ScenarioFile(std::optional<std::string> text, const fs::path& file,
                           const std::vector<Override>& overrides, Trust trust, Files files,
                           InputFiles inputs)
    : file_(file),
      files_(trust == Trust::kFull ? inputs : Confined(inputs, file)),
      text_(std::move(text)),
      root_(text_ ? ParseYaml(*text_, file.string()) : ReadTree(file, "scenario", files_)),
      site_files_(std::make_shared<SiteFiles>()) {
  RefuseOtherKinds(root_, file.string());
  for (const Override& o : overrides) {
    overrides_.emplace_back(o.key_path, ParseYaml(o.value, std::string(kSet) + o.key_path));
    FindFromHere(o.key_path, file.parent_path(), overrides_.back().second);
    AllowTyped(o.key_path, overrides_.back().second, file.parent_path(), files_);
    ChooseWhosePlan(o.key_path, root_);
  }
  Apply({"", overrides_}, root_);
  RemoveNone(root_);
  const ConfigNode* version = root_.Find("scenario");
  if (version == nullptr)
    throw InputError(root_.mark, "scenario", "", "the key is missing (scenario: 1)");
  RefuseUnknownKeys(root_, "", ScenarioKeys());
  AsInt(*version, "scenario", Between(1, 1));
  TakeListedFiles(root_, file.parent_path(), files == Files::kCheck, files_);
  EpisodeParams params;
  ReadParams(
      root_, "", [&](ParamVisitor& v) { params.Visit(v); }, ScenarioKeys());
  seed_ = params.seed;
  episode_ = static_cast<std::uint64_t>(params.episode);

  sampling_ = ReadSampling(root_.Find("sampling"));
  randomised_ = ReadRandomise(root_.Find("randomise"), sampling_);
  if (sampling_ == Sampling::kLowDiscrepancy && !randomised_.empty())
    StateDimensions(randomised_, *root_.Find("randomise"));
  // A key that an override sets is not drawn, and is not in the record.
  const auto is_set = [&](const std::string& key) {
    return std::ranges::any_of(overrides_, [&](const auto& o) {
      return Replaces(o.first, key) || Replaces(key, o.first);
    });
  };
  std::erase_if(randomised_, [&](const RandomisedKey& key) { return is_set(key.key_path); });
  if (ConfigNode* draws = root_.Find("randomise"); draws != nullptr && draws->IsMap()) {
    std::erase_if(draws->entries, [&](const auto& entry) { return is_set(entry.first); });
    if (draws->entries.empty()) root_.Remove("randomise");
  }
  variants_ = ReadMatrix(root_.Find("matrix"));
  // The keys of all variants: labelled variants need not change the same keys.
  std::set<std::string> set_by_variants;
  for (const Variant& variant : variants_)
    for (const auto& [key, value] : variant.overrides) set_by_variants.insert(key);
  for (const std::string& key : set_by_variants)
    for (const auto& o : overrides_)
      if (Replaces(key, o.first) || Replaces(o.first, key))
        throw InputError(o.second.mark, o.first, "",
                         "the scenario's matrix sets " + key + "; --set matrix=null takes it away");
  for (const RandomisedKey& r : randomised_) {  // a key below one that a variant sets may be drawn
    const auto first = set_by_variants.lower_bound(r.key_path);
    const auto below = set_by_variants.lower_bound(r.key_path + ".");
    for (const auto at : {first, below})
      if (at != set_by_variants.end() && Replaces(r.key_path, *at))
        throw InputError(r.mark, "randomise." + r.key_path, "",
                         "the scenario's matrix sets " + *at);
  }
}

const ConfigNode& ScenarioFile::SiteTree(const fs::path& file) const {
  const std::lock_guard alone(site_files_->mutex);
  auto known = site_files_->trees.find(file);
  if (known == site_files_->trees.end())
    known = site_files_->trees.emplace(file, ReadTree(file, "site", files_)).first;
  return known->second;
}

void ScenarioFile::ReadSitePart(const ConfigNode& root, const Variant& changes, bool episode,
                                Scenario& s) const {
  const ConfigNode* node = root.Find("site");
  if (node == nullptr) throw InputError(root.mark, "site", "", "the key is missing");
  const fs::path folder = s.spec.file.parent_path();
  if (node->IsMap()) {
    s.text.site = *node;
    s.text.site_folder = folder;
  } else {
    s.spec.site_file = NamedFile(folder, *node, "site", files_);
    s.text.site = SiteTree(s.spec.site_file);
    s.text.site_folder = s.spec.site_file.parent_path();
  }
  ApplyToSite({"", overrides_}, folder, s.text.site);
  ApplyToSite(changes, folder, s.text.site);
  ConfigNode drawn =
      GeneratedSite(s.text.site, static_cast<std::uint64_t>(seed_), s.spec.episode_id);
  s.world.site = ReadSite(drawn, s.text.site_folder, files_);
  if (episode) s.text.site = std::move(drawn);  // else what is random about it stays so
  if (s.world.site.map.name.empty())
    s.world.site.map.name =
        s.spec.site_file.empty() ? s.spec.name : Printable(s.spec.site_file.stem().string());
}

std::string ScenarioFile::name() const {
  const ConfigNode* name = root_.Find("name");
  return name ? AsName(*name, "name") : Printable(file_.stem().string());
}

bool ScenarioFile::draws_differ() const {
  return std::ranges::any_of(randomised_,
                             [](const auto& key) { return key.distribution.varies(); });
}

Drawn ScenarioFile::DrawnOf(std::uint64_t episode) const {
  return Draw(randomised_, static_cast<std::uint64_t>(seed_), episode, sampling_);
}

ConfigNode ScenarioFile::gate() const {
  const ConfigNode* gate = root_.Find("gate");
  return gate ? *gate : ConfigNode();
}

bool ScenarioFile::drives() const {
  const ConfigNode* drive = root_.Find("drive");
  return drive == nullptr || drive->scalar == "physics";
}

void ScenarioFile::CheckDraws() const {
  constexpr std::size_t kMaxVariants = 100;
  constexpr std::uint64_t kTries = 10;  // one draw may be a start within a wall, ten are a mistake
  const auto check = [&](const Variant& variant, const Variant& forced) {
    std::optional<InputError> first;
    for (std::uint64_t episode = 0; episode < kTries; ++episode) try {
        const Drawn drawn = DrawnOf(episode);
        ReadWith(episode, &drawn, variant, forced);
        return;
      } catch (const InputError& e) {
        if (!first) first = e;
      }
    throw *first;
  };
  // One reading can hold a choice of each key: as many readings as the longest list is long.
  const auto read_together = [&](const Variant& variant) {
    std::size_t most = 0;
    for (const RandomisedKey& key : randomised_)
      most = std::max(most, key.distribution.choices.size());
    for (std::size_t i = 0; i < most; ++i) {
      Variant forced;
      for (const RandomisedKey& key : randomised_)
        if (i < key.distribution.choices.size())
          forced.overrides.emplace_back(key.key_path, key.distribution.choices[i]);
      try {
        const Drawn drawn = DrawnOf(0);
        ReadWith(0, &drawn, variant, forced);
      } catch (const InputError&) {
        return false;  // who is to blame is found one by one
      }
    }
    return true;
  };
  for (std::size_t v = 0; v < std::min(kMaxVariants, variants_.size()); ++v) {
    if (!randomised_.empty()) check(variants_[v], {});
    if (read_together(variants_[v])) continue;
    for (const RandomisedKey& key : randomised_)
      for (const ConfigNode& choice : key.distribution.choices)
        check(variants_[v], {"", {{key.key_path, choice}}});
  }
}

Scenario ScenarioFile::Read(std::optional<std::uint64_t> episode, const Variant& variant) const {
  if (!episode) return ReadWith(episode, nullptr, variant, {});
  const Drawn drawn = DrawnOf(*episode);
  return ReadWith(episode, &drawn, variant, {});
}

Scenario ScenarioFile::ReadDrawn(std::uint64_t episode, const Drawn& drawn) const {
  return ReadWith(episode, &drawn, {}, {});
}

Scenario ScenarioFile::ReadWith(std::optional<std::uint64_t> episode, const Drawn* drawn,
                                const Variant& variant, const Variant& forced) const {
  Scenario s;
  s.spec.file = file_;
  s.files = files_;
  s.spec.episode_id = episode.value_or(0);
  Variant changes = variant;
  if (drawn != nullptr) {
    s.spec.drawn = *drawn;
    changes.overrides.insert(changes.overrides.end(), s.spec.drawn.begin(), s.spec.drawn.end());
  }
  changes.overrides.insert(changes.overrides.end(), forced.overrides.begin(),
                           forced.overrides.end());
  ConfigNode root = root_;
  Apply(changes, root);
  RefuseUnknownKeys(root, "", ScenarioKeys());  // a variant's too
  s.spec.name = name();
  s.spec.sampling = sampling_;
  for (auto [key, node] : {std::pair("randomise", &s.text.randomise),
                           {"matrix", &s.text.matrix},
                           {"gate", &s.text.gate}})
    if (const ConfigNode* written = root.Find(key)) *node = *written;
  for (const auto& entry : root.entries) s.spec.written.insert(entry.first);
  ReadTopKeys(root, s);
  s.spec.episode.episode = static_cast<int>(s.spec.episode_id);
  ReadSitePart(root, changes, episode.has_value(), s);
  ReadParts(root, s);
  return s;
}

Scenario ReadScenario(const fs::path& file, const std::vector<Override>& overrides, Trust trust) {
  const ScenarioFile scenario(file, overrides, trust);
  return scenario.Read(scenario.episode());
}

}  // namespace floorproof

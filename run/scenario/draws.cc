// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/draws.h"

#include <algorithm>
#include <cstdlib>

#include "base/json_schema.h"
#include "base/params.h"
#include "base/printable.h"
#include "base/quantity.h"
#include "run/scenario/low_discrepancy.h"

namespace floorproof {
namespace {

constexpr std::size_t kMaxKeys = 1'000;
constexpr const char* kDimension = "dimension";
const Bounds kDimensions = Between(1, double{kMostDimensions});

// Keys that say what is done with an episode rather than what happens in it.
const std::vector<std::string> kFixed = {"scenario",  "name",     "seed",   "episode",
                                         "randomise", "sampling", "matrix", "gate",
                                         "files",     "drive",    "video",  "trace_hz"};

// Keys of `plan` that say which program is run.
const std::vector<std::string> kOfProgram = {"command", "folder", "made"};

// A campaign says before it begins which programs it will run.
void RefuseDrawnProgram(const RandomisedKey& drawn) {
  const auto refuse = [](const SourceMark& mark, const std::string& key) {
    throw InputError(mark, key, "",
                     "which program plans cannot be drawn: a campaign says it before it begins "
                     "(`matrix` may name several)");
  };
  for (const std::string& key : kOfProgram) {
    const std::string path = "plan." + key;
    if (drawn.key_path == path || drawn.key_path.starts_with(path + "."))
      refuse(drawn.mark, "randomise." + drawn.key_path);
    if (drawn.key_path != "plan") continue;
    for (const ConfigNode& choice : drawn.distribution.choices)
      if (const ConfigNode* named = choice.Find(key)) refuse(named->mark, "randomise." + path);
  }
}

// The coordinate of the last of the keys, where it is written.
void ReadDimension(const ConfigNode& node, Sampling sampling, std::vector<RandomisedKey>& keys) {
  RandomisedKey& last = keys.back();
  const std::string path = "randomise." + last.key_path;
  const ConfigNode* written = node.Find(kDimension);
  if (written != nullptr) {
    if (sampling == Sampling::kIndependent)
      throw InputError(written->mark, path + "." + kDimension, written->scalar,
                       "is for sampling: low_discrepancy");
    last.dimension =
        static_cast<std::size_t>(AsInt(*written, path + "." + kDimension, kDimensions) - 1);
  }
  if (sampling == Sampling::kIndependent) return;
  if (last.dimension >= kMostDimensions)
    throw InputError(last.mark, path, "",
                     "sampling: low_discrepancy has " + std::to_string(kMostDimensions) +
                         " dimensions, one a key");
  for (const RandomisedKey& other : keys)
    if (&other != &last && other.dimension == last.dimension)
      throw InputError(written != nullptr ? written->mark : last.mark, path + "." + kDimension,
                       std::to_string(last.dimension + 1),
                       "is that of " + other.key_path + " too, by its place or as written");
}

}  // namespace

ConfigNode SamplingSchema() {
  ConfigNode schema = ChoiceSchema({"independent", "low_discrepancy"});
  schema.Add("default", ConfigNode::Scalar("independent", true));
  return schema;
}

ConfigNode RandomiseSchema() {
  std::vector<std::string> never = kFixed;
  for (const std::string& key : kOfProgram) never.push_back("plan." + key);
  const MapSchema dimension =
      MapSchema().Key(kDimension, WholeSchema(kDimensions),
                      "with sampling: low_discrepancy, which coordinate of the points");
  ConfigNode keys = AnyKeysSchema(DistributionSchema(dimension), never);
  keys.Add("maxProperties", ConfigNode::Scalar(std::to_string(kMaxKeys)));
  return AnyOf({std::move(keys), NoneSchema()});
}

Sampling ReadSampling(const ConfigNode* node) {
  if (node == nullptr) return Sampling::kIndependent;
  const std::string text = AsString(*node, "sampling");
  if (text == "independent") return Sampling::kIndependent;
  if (text == "low_discrepancy") return Sampling::kLowDiscrepancy;
  throw InputError(node->mark, "sampling", text, "must be independent or low_discrepancy");
}

std::vector<RandomisedKey> ReadRandomise(const ConfigNode* node, Sampling sampling) {
  std::vector<RandomisedKey> keys;
  if (node == nullptr || node->IsNull()) return keys;
  if (!node->IsMap())
    throw InputError(node->mark, "randomise", node->scalar, "must be a map of keys: distribution");
  if (node->entries.size() > kMaxKeys)
    throw InputError(node->mark, "randomise", CountText(node->entries.size(), "key"),
                     "must be a map of at most " + std::to_string(kMaxKeys) + " keys");
  for (const auto& [key, value] : node->entries) {
    for (const std::string& fixed : kFixed)
      if (key == fixed || key.starts_with(fixed + "."))
        throw InputError(value.mark, "randomise." + key, "",
                         "this key cannot differ between episodes");
    keys.push_back(
        {key, ReadDistribution(value, "randomise." + key, {kDimension}), keys.size(), value.mark});
    RefuseDrawnProgram(keys.back());
    ReadDimension(value, sampling, keys);
  }
  return keys;
}

void StateDimensions(const std::vector<RandomisedKey>& keys, ConfigNode& randomise) {
  for (const RandomisedKey& key : keys)
    if (ConfigNode* written = randomise.Find(key.key_path); !written->Find(kDimension))
      written->Add(kDimension, ConfigNode::Scalar(std::to_string(key.dimension + 1)));
}

Drawn Draw(const std::vector<RandomisedKey>& keys, std::uint64_t seed, std::uint64_t episode,
           Sampling sampling) {
  Drawn drawn;
  std::vector<std::uint64_t> point;
  if (sampling == Sampling::kLowDiscrepancy && !keys.empty())
    point =
        SobolPoint(episode, 1 + std::ranges::max(keys, {}, &RandomisedKey::dimension).dimension);
  for (const RandomisedKey& key : keys) {
    const std::string name = "randomise." + key.key_path;
    if (sampling == Sampling::kIndependent) {
      Stream stream(seed, episode, name);
      drawn.emplace_back(key.key_path, key.distribution.Draw(stream));
    } else {
      const std::uint64_t shift = Stream(seed, 0, "sampling of " + name).Next();
      drawn.emplace_back(key.key_path,
                         key.distribution.Quantile(Shifted(point[key.dimension], shift)));
    }
    drawn.back().second.mark = key.mark;
  }
  return drawn;
}

std::string DrawnText(const Drawn& drawn) {
  std::string text;
  for (const auto& [key, value] : drawn) {
    char* end = nullptr;
    const double number = std::strtod(value.scalar.c_str(), &end);
    const bool is_number = value.IsScalar() && !value.scalar.empty() && *end == '\0';
    text += (text.empty() ? "" : ", ") + key + " " +
            (is_number          ? NumberText(number)
             : value.IsScalar() ? Printable(value.scalar)
                                : kValueInParts);
  }
  return text;
}

}  // namespace floorproof

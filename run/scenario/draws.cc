// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/draws.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/params.h"
#include "base/printable.h"
#include "base/quantity.h"

namespace floorproof {
namespace {

constexpr double kLeastMass = 0.01;  // of a bounded normal: else redrawing would go on for ever
constexpr int kMaxRedraws = 10'000;  // 0.99^10000 = 2e-44 that none of them keeps the bounds

// Keys that say what is done with an episode rather than what happens in it.
const std::vector<std::string> kFixed = {"scenario",  "name",   "seed",    "episode",
                                         "randomise", "matrix", "gate",    "files",
                                         "drive",     "video",  "trace_hz"};

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

double Cumulative(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

// How likely a draw keeps its bounds.
double Mass(const Distribution& d) {
  const auto at = [&](double x) {
    if (d.kind == Distribution::Kind::kNormal) return Cumulative((x - d.a) / d.b);
    return x <= 0 ? 0.0 : Cumulative(std::log(x / d.a) / d.b);
  };
  return at(d.max) - at(d.min);
}

Distribution ReadDistribution(const ConfigNode& node, const std::string& path) {
  const std::vector<std::string> kinds = {"uniform", "normal", "lognormal", "choice"};
  if (!node.IsMap())
    throw InputError(node.mark, path, node.scalar,
                     "must be {uniform: [low, high]}, {normal: [mean, deviation]}, {lognormal: "
                     "[median, deviation of the logarithm]} or {choice: [a, b, ..]}");
  std::vector<std::string> known = kinds;
  known.insert(known.end(), {"min", "max"});
  RefuseUnknownKeys(node, path + ".", known);
  Distribution d;
  const ConfigNode* values = nullptr;
  std::string name;
  for (std::size_t i = 0; i < kinds.size(); ++i)
    if (const ConfigNode* found = node.Find(kinds[i])) {
      if (values != nullptr)
        throw InputError(node.mark, path, "",
                         "holds two distributions, " + name + " and " + kinds[i]);
      values = found;
      name = kinds[i];
      d.kind = static_cast<Distribution::Kind>(i);
    }
  if (values == nullptr)
    throw InputError(node.mark, path, "",
                     "names no distribution: uniform, normal, lognormal or choice");
  const std::string key = path + "." + name;
  if (!values->IsList()) throw InputError(values->mark, key, values->scalar, "must be a list");
  if (d.kind == Distribution::Kind::kChoice) {
    if (values->items.empty()) throw InputError(values->mark, key, "", "must hold a value or more");
    d.choices = values->items;
  } else {
    if (values->items.size() != 2)
      throw InputError(values->mark, key, "", "must be a list of two numbers");
    d.a = AsDouble(values->items[0], key);
    d.b = AsDouble(values->items[1], key);
    if (d.kind == Distribution::Kind::kUniform && !(d.a <= d.b))
      throw InputError(values->mark, key, FormatDouble(d.b),
                       "the upper bound must not be below the lower");
    if (d.kind != Distribution::Kind::kUniform && !(d.b >= 0))
      throw InputError(values->mark, key, FormatDouble(d.b), "a deviation must be >= 0");
    if (d.kind == Distribution::Kind::kLognormal && !(d.a > 0))
      throw InputError(values->mark, key, FormatDouble(d.a), "a median must be > 0");
  }
  const ConfigNode *min = node.Find("min"), *max = node.Find("max");
  if (min == nullptr && max == nullptr) return d;
  if (d.kind != Distribution::Kind::kNormal && d.kind != Distribution::Kind::kLognormal)
    throw InputError((min ? min : max)->mark, path, "", "min and max are for normal and lognormal");
  if (min != nullptr) d.min = AsDouble(*min, path + ".min");
  if (max != nullptr) d.max = AsDouble(*max, path + ".max");
  const bool possible = d.b > 0 ? Mass(d) >= kLeastMass : d.a >= d.min && d.a <= d.max;
  if (!possible)
    throw InputError(node.mark, path, "", "fewer than one draw in a hundred keeps min and max");
  return d;
}

}  // namespace

ConfigNode Distribution::Draw(Stream& stream) const {
  if (kind == Kind::kChoice) return choices[stream.Below(choices.size())];
  double value = 0;
  for (int i = 0; i < kMaxRedraws; ++i) {
    if (kind == Kind::kUniform) value = stream.Uniform(a, b);
    if (kind == Kind::kNormal) value = a + b * stream.Normal();
    if (kind == Kind::kLognormal) value = a * std::exp(b * stream.Normal());
    if (value >= min && value <= max) break;
  }
  return ConfigNode::Scalar(FormatDouble(value));
}

bool Distribution::varies() const {
  if (kind == Kind::kUniform) return a < b;
  if (kind != Kind::kChoice) return b > 0 && min < max;
  return std::ranges::any_of(
      choices, [&](const ConfigNode& c) { return WriteYaml(c) != WriteYaml(choices.front()); });
}

std::vector<RandomisedKey> ReadRandomise(const ConfigNode* node) {
  std::vector<RandomisedKey> keys;
  if (node == nullptr || node->IsNull()) return keys;
  if (!node->IsMap())
    throw InputError(node->mark, "randomise", node->scalar, "must be a map of keys: distribution");
  for (const auto& [key, value] : node->entries) {
    for (const std::string& fixed : kFixed)
      if (key == fixed || key.starts_with(fixed + "."))
        throw InputError(value.mark, "randomise." + key, "",
                         "this key cannot differ between episodes");
    keys.push_back({key, ReadDistribution(value, "randomise." + key), value.mark});
    RefuseDrawnProgram(keys.back());
  }
  return keys;
}

Drawn Draw(const std::vector<RandomisedKey>& keys, std::uint64_t seed, std::uint64_t episode) {
  Drawn drawn;
  for (const RandomisedKey& key : keys) {
    Stream stream(seed, episode, "randomise." + key.key_path);
    drawn.emplace_back(key.key_path, key.distribution.Draw(stream));
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

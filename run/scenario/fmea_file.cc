// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/fmea_file.h"

#include <cmath>
#include <string>
#include <vector>

#include "base/params.h"

namespace floorproof {
namespace {

const Bounds kRating = {0, 100, true};  // the paper's go to 5

std::vector<std::string> Numbered(char letter, std::size_t count) {
  std::vector<std::string> keys;
  for (std::size_t i = 1; i <= count; ++i) keys.push_back(letter + std::to_string(i));
  return keys;
}

// The map under `key`, with these keys in it and no others; `path` stands before the key in
// messages.
const ConfigNode& MapOf(const ConfigNode& node, const std::string& path, const std::string& key,
                        const std::vector<std::string>& keys) {
  const ConfigNode* map = node.Find(key);
  if (map == nullptr) throw InputError(node.mark, path + key, "", "the key is missing");
  if (!map->IsMap()) throw InputError(map->mark, path + key, "", "must be a map of keys");
  RefuseUnknownKeys(*map, path + key + ".", keys);
  for (const std::string& needed : keys)
    if (needed != "name" && map->Find(needed) == nullptr)
      throw InputError(map->mark, path + key + "." + needed, "", "the key is missing");
  return *map;
}

// Probabilities under `key`, one for each of these keys, that sum to 1.
template <std::size_t N>
void ReadRow(const ConfigNode& node, const std::string& path, const std::string& key, char letter,
             std::array<double, N>& row) {
  const std::vector<std::string> keys = Numbered(letter, N);
  const ConfigNode& map = MapOf(node, path, key, keys);
  double sum = 0;
  for (std::size_t i = 0; i < N; ++i) {
    row[i] = AsDouble(*map.Find(keys[i]), path + key + "." + keys[i], Between(0, 1));
    sum += row[i];
  }
  constexpr double kRounding = 1e-6;
  if (std::abs(sum - 1) > kRounding)
    throw InputError(
        map.mark, path + key, "",
        "must sum to 1: " + keys.front() + " to " + keys.back() + " are " + FormatDouble(sum));
}

}  // namespace

FmeaTables ReadFmeaTables(const std::filesystem::path& file, const InputFiles& files) {
  const ConfigNode root = ReadYamlFile(file, files, "fmea");
  if (!root.IsMap()) throw InputError({file.string(), 1}, "", "", "must be a map of keys");
  const ConfigNode* version = root.Find("fmea");
  if (version == nullptr) throw InputError(root.mark, "fmea", "", "the key is missing (fmea: 1)");
  RefuseUnknownKeys(root, "", {"fmea", "classes", "modes", "effects"});
  AsInt(*version, "fmea", Between(1, 1));

  FmeaTables tables;
  const auto classes = Numbered('C', kNumHazardClasses), modes = Numbered('F', kNumFailureModes),
             effects = Numbered('E', kNumEffects);
  const ConfigNode& by_class = MapOf(root, "", "classes", classes);
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const std::string path = "classes." + classes[i] + ".";
    const ConfigNode& node =
        MapOf(by_class, "classes.", classes[i], {"name", "detectability", "modes"});
    tables.detectability[i] =
        AsDouble(*node.Find("detectability"), path + "detectability", kRating);
    ReadRow(node, path, "modes", 'F', tables.mode_of_class[i]);
  }
  const ConfigNode& by_mode = MapOf(root, "", "modes", modes);
  for (std::size_t j = 0; j < modes.size(); ++j)
    ReadRow(MapOf(by_mode, "modes.", modes[j], {"name", "effects"}), "modes." + modes[j] + ".",
            "effects", 'E', tables.effect_of_mode[j]);
  const ConfigNode& by_effect = MapOf(root, "", "effects", effects);
  for (std::size_t k = 0; k < effects.size(); ++k)
    tables.severity[k] =
        AsDouble(*MapOf(by_effect, "effects.", effects[k], {"name", "severity"}).Find("severity"),
                 "effects." + effects[k] + ".severity", kRating);
  return tables;
}

}  // namespace floorproof

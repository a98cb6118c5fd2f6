// SPDX-License-Identifier: Apache-2.0
// `randomise`: keys of a scenario that differ from episode to episode, and how they are drawn.
//
// Each key has a stream of its own (seed, episode, "randomise." + key): a key added or taken away
// changes no other's draws, and all variants of a matrix share them.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/config.h"
#include "base/streams.h"

namespace floorproof {

struct Distribution {
  enum class Kind { kUniform, kNormal, kLognormal, kChoice };
  Kind kind = Kind::kUniform;
  double a = 0, b = 0;               // [a, b); mean, deviation; median, deviation of the logarithm
  double min = -1e308, max = 1e308;  // draws outside are drawn again
  std::vector<ConfigNode> choices;   // each as likely

  ConfigNode Draw(Stream& stream) const;
  // Whether two draws can differ.
  bool varies() const;
};

struct RandomisedKey {
  std::string key_path;
  Distribution distribution;
  SourceMark mark;
};

// Reads the scenario's key `randomise`, a map of key path: {uniform: [low, high]} and so on; `node`
// may be nullptr. Throws InputError.
std::vector<RandomisedKey> ReadRandomise(const ConfigNode* node);

// What this episode draws, in the order written.
using Drawn = std::vector<std::pair<std::string, ConfigNode>>;
Drawn Draw(const std::vector<RandomisedKey>& keys, std::uint64_t seed, std::uint64_t episode);
// Stands for a drawn value that is no scalar, in a line for people.
inline constexpr const char* kValueInParts = "a value in parts";
// For people, in one line: "site.floor.friction 0.733, robot beluga".
std::string DrawnText(const Drawn& drawn);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// `randomise`: keys of a scenario that differ from episode to episode, and how they are drawn.
//
// Independent draws: each key has a stream of its own (seed, episode, "randomise." + key), and a
// key added or taken away changes no other's draws. Of low discrepancy: episode i is point i of a
// Sobol sequence, a coordinate a key, each shifted by a number hashed from (seed, key); coordinates
// go by the keys' order, unless their numbers are written. All variants of a matrix share the
// draws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/config.h"
#include "run/scenario/distribution.h"

namespace floorproof {

enum class Sampling { kIndependent, kLowDiscrepancy };
// Reads the scenario's key `sampling`; `node` may be nullptr. Throws InputError.
Sampling ReadSampling(const ConfigNode* node);
ConfigNode SamplingSchema();

struct RandomisedKey {
  std::string key_path;
  Distribution distribution;
  std::size_t dimension = 0;  // of low discrepancy: which coordinate of the points, from 0
  SourceMark mark;
};

// Reads the scenario's key `randomise`, a map of key path: {uniform: [low, high]} and so on; `node`
// may be nullptr. Throws InputError.
std::vector<RandomisedKey> ReadRandomise(const ConfigNode* node,
                                         Sampling sampling = Sampling::kIndependent);
ConfigNode RandomiseSchema();
// `randomise` with each key's `dimension` written, so that a key taken out moves no other's points.
void StateDimensions(const std::vector<RandomisedKey>& keys, ConfigNode& randomise);

// What this episode draws, in the order written.
using Drawn = std::vector<std::pair<std::string, ConfigNode>>;
Drawn Draw(const std::vector<RandomisedKey>& keys, std::uint64_t seed, std::uint64_t episode,
           Sampling sampling = Sampling::kIndependent);
// Stands for a drawn value that is no scalar, in a line for people.
inline constexpr const char* kValueInParts = "a value in parts";
// For people, in one line: "site.floor.friction 0.733, robot beluga".
std::string DrawnText(const Drawn& drawn);

}  // namespace floorproof

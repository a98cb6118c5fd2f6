// SPDX-License-Identifier: Apache-2.0
#include "run/episode/plain_draws.h"

#include <algorithm>

#include "base/params.h"
#include "base/streams.h"
#include "run/scenario/draws.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

constexpr PlainDraw kPlain[] = {
    {"site.floor.friction", &Approach::friction, &DriveConditions::friction},
    {"robot.mass_kg", &Approach::mass_kg, &DriveConditions::mass_kg},
    {"robot.clearance_m", &Approach::clearance_m, &DriveConditions::clearance_m}};

}  // namespace

const PlainDraw* FindPlainDraw(const std::string& key) {
  const auto* found =
      std::ranges::find_if(kPlain, [&](const PlainDraw& p) { return key == p.key; });
  return found == std::end(kPlain) ? nullptr : found;
}

std::vector<DriveConditions> ConditionsOf(const Scenario& s) {
  constexpr std::uint64_t kConditions = 64;
  const DriveConditions known{s.world.site.map.floor_friction, s.world.robot.spec.mass_kg,
                              s.world.robot.spec.clearance_m};
  std::vector<RandomisedKey> keys = ReadRandomise(&s.text.randomise, s.spec.sampling);
  std::erase_if(keys,
                [](const RandomisedKey& key) { return FindPlainDraw(key.key_path) == nullptr; });
  if (keys.empty()) return {known};
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i].dimension = i;
  const std::uint64_t seed =
      Stream(static_cast<std::uint64_t>(s.spec.episode.seed), 0, "conditions to plan for").Next();
  std::vector<DriveConditions> conditions(kConditions, known);
  for (std::uint64_t i = 0; i < kConditions; ++i)
    for (const auto& [key, value] : Draw(keys, seed, i, Sampling::kLowDiscrepancy))
      conditions[i].*FindPlainDraw(key)->of_drive = AsDouble(value, key);
  return conditions;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// An episode's random streams: each part draws from one of its own name.
#pragma once

#include <string_view>

#include "base/streams.h"
#include "run/scenario/scenario_spec.h"

namespace floorproof {

inline Stream EpisodeStream(const ScenarioSpec& spec, std::string_view name) {
  return {static_cast<std::uint64_t>(spec.episode.seed), spec.episode_id, name};
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A supervised drive over its time: what was truly broken, what the robot noticed, what its
// decision state machine made of it, and what it did.
#pragma once

#include <filesystem>

#include "render/timeline.h"
#include "run/episode/episode.h"

namespace floorproof {

struct Scenario;

Timeline SafetyTimeline(const Scenario& scenario, const EpisodeRecord& record);
// Into a PNG. Throws as WriteFileWhole does.
void WriteSafetyTimeline(const Scenario& scenario, const EpisodeRecord& record,
                         const std::filesystem::path& png);

}  // namespace floorproof

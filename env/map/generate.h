// SPDX-License-Identifier: Apache-2.0
// A site's key `generate`, whichever kind of site it names.
#pragma once

#include <cstdint>

#include "base/config.h"

namespace floorproof {

// Whether each episode has a site of its own: it is drawn at random, and no seed is written.
bool DrawnAtRandom(const ConfigNode& generate);
// `generate` with every default stated; it gives the same sites. Throws InputError.
ConfigNode ResolvedGenerate(const ConfigNode& generate);
ConfigNode GenerateSchema();
// The site's keys (`grid`, `start`, `goal`, perhaps `hazards`) for this campaign and episode.
// Throws InputError.
ConfigNode Generated(const ConfigNode& generate, std::uint64_t campaign_seed,
                     std::uint64_t episode);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Reads a site file (map, grid or generate, plus hazards) into a HazardMap.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/config.h"
#include "env/core/hazard_map.h"
#include "env/map/ros_map.h"

namespace floorproof {

struct Site {
  HazardMap map;
  std::vector<std::filesystem::path>
      files_read;                     // the site itself, the map's yaml and image: for hashes
  std::vector<std::string> warnings;  // what is read as written but may not be meant; one line each
};

// The site's tree with `generate` replaced by the grid, start and goal that the stream "site" of
// this campaign and episode draws (with generate.seed: the stream of that seed's episode 0). A
// start and a goal that are written stay; so does a site without `generate`. Throws InputError.
ConfigNode GeneratedSite(const ConfigNode& node, std::uint64_t campaign_seed,
                         std::uint64_t episode);

// `node` is the site file's tree (overrides applied); paths in it are relative to `folder`.
// A path that leaves `folder` is refused unless it is written absolute or starts with "../"
// (that is: said plainly in the file). `generate` must have a seed: else it is not one site, but
// one an episode, by GeneratedSite. Throws InputError.
Site ReadSite(const ConfigNode& node, const std::filesystem::path& folder);
Site ReadSiteFile(const std::filesystem::path& path);
// The site file's tree with every default stated and paths rewritten relative to `folder_out`.
// Resolving the result once more gives it again. `generate` is not drawn but stays, as what is
// random about the site. Throws InputError for what ReadSite does (but draws nothing).
ConfigNode ResolveSite(const ConfigNode& node, const std::filesystem::path& folder,
                       const std::filesystem::path& folder_out);

}  // namespace floorproof

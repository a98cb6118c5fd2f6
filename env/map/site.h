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

// The site's tree, with `generate` replaced by the grid, hazards, start and goal that it stands
// for. What is drawn at random is drawn by the stream "site" of this campaign and episode; with
// generate.seed by that of that seed's episode 0. A written start or goal stays, written hazards
// come first, and a site without `generate` is as it was. Throws InputError.
ConfigNode GeneratedSite(const ConfigNode& node, std::uint64_t campaign_seed,
                         std::uint64_t episode);

// `node` is the site file's tree with overrides applied; paths in it are relative to `folder`. A
// path that leaves `folder` is refused, unless it says so plainly: it is absolute or starts with
// "../". `generate` must have a seed. Without one it is not one site but one per episode, see
// GeneratedSite. Throws InputError.
Site ReadSite(const ConfigNode& node, const std::filesystem::path& folder,
              const InputFiles& files = {});
Site ReadSiteFile(const std::filesystem::path& path);
// The site file's tree, with every default stated and paths rewritten relative to `folder_out`.
// Resolving the result again gives the same. `generate` is not drawn but stays, as the random part
// of the site. Throws InputError as ReadSite does, but draws nothing.
ConfigNode ResolveSite(const ConfigNode& node, const std::filesystem::path& folder,
                       const std::filesystem::path& folder_out);

}  // namespace floorproof

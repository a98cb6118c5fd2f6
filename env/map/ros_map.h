// SPDX-License-Identifier: Apache-2.0
// A ROS map: a YAML file that names an image, as map_server (ROS 1, and Nav2's for ROS 2) reads it.
//
// The law is Nav2's nav2_map_server/src/map_io.cpp, of which ROS 1's image_loader.cpp is a subset:
// - A pixel's shade is the mean of its colour channels, 0 black to 1 white. In mode trinary an
// alpha
//   channel is averaged in as one more (opaque counts as white): an opaque grey 205 in an image
//   with alpha has shade 0.853, not 0.804. Modes scale and raw leave alpha out of the mean.
// - Occupancy p = 1 - shade, or shade with `negate`. Compared in exact arithmetic on the 8-bit
//   levels: grey 205 is p = 50/255 = 0.19608.
// - trinary: p > occupied_thresh is occupied, p < free_thresh free, the rest unknown.
// - scale: any pixel that is not opaque is unknown; else as above, and what lies between becomes
//   rint(100 (p - free) / (occupied - free)): 0 is free, 100 occupied, 1..99 unknown here (as amcl
//   takes it).
// - raw: the shade itself, as a level 0..255, is the occupancy in percent; above 100 is unknown;
//   `negate` does nothing. The map's own thresholds then divide 1..99 as they do p.
// - The image's top row is the map's highest; `origin` is the pose of the outer corner of the lower
//   left pixel, its yaw turning the whole map.
// A map with free_thresh 0.25 (Nav2's map_saver writes it) makes grey 205 free. The reader follows
// that, because the robot's own map_server does so, and says it in `warnings`. It is stricter than
// map_server about thresholds outside [0, 1] or in the wrong order, which map_server accepts
// silently. It is more lenient about `negate`, which may be missing (0). Keys of other tools are
// ignored.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/input_files.h"
#include "env/core/hazard_map.h"

namespace floorproof {

struct RosMap {
  GridFrame frame;
  Grid<CellState> occupancy;
  std::filesystem::path image;
  std::vector<std::string> warnings;
};

// Throws InputError naming file, line, key and rule.
RosMap ReadRosMap(const std::filesystem::path& yaml_path, const InputFiles& files = {});

// Refuses an image, which people take for the map, where a file of another kind is expected ("a
// scenario"): `init` takes the .yaml that names it. Reads but its start. Throws InputError.
void RefuseMapImage(const std::filesystem::path& file, const std::string& expected,
                    const InputFiles& files);

// Coverage is measured on cells of at most 0.05 m: refuses a floor that would need more than 64
// million of them (400 m x 400 m).
void CheckFloorSize(const GridFrame& frame, const SourceMark& mark, const std::string& key);

}  // namespace floorproof

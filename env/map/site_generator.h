// SPDX-License-Identifier: Apache-2.0
// Random sites: a site's key `generate` becomes a drawing, from a stream alone.
//
// A site is drawn as a person would furnish it: walls, strips from wall to wall, clusters of
// hazards, furniture, then a start and a goal. Whatever is drawn, floor and terrain (`. = g r`)
// are one piece joined by the cells' sides, so that all of it can be reached from the start by a
// robot that needs a whole free cell and drives over terrain. A drawing that has no room for what
// must be there is drawn again, a bounded number of times.
// What comes out is an ordinary site's tree; nothing that reads it can tell where it is from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/config.h"
#include "base/json_schema.h"
#include "base/params.h"
#include "env/map/floor_drawing.h"

namespace floorproof {

// How many of each the site has, drawn from the range. The range's lower end is always there. What
// exceeds it is there as far as it fits, while hazards take no more than a third of the floor.
struct HazardMix {
  IntRange glass, drop, raised, rough;  // clusters
  IntRange cable_cover, groove;         // strips, each from wall to wall
  IntRange mixed;                       // clusters, each of a type drawn among the first four
};

struct GenerateParams {
  std::string kind = "room";
  int width = 20, height = 16;  // cells, the outer wall's included
  double cell_m = 0.5;          // hTetro's own width
  double inset_m = 0.03;        // as a drawn site's
  // Share of the cells within the walls that are blind objects, to the nearest whole cell.
  double obstacle_density = 0.1;
  IntRange cluster_cells = {1, 6};  // of each cluster and each piece of furniture, about
  int room_cells = 5;               // kind rooms: least side of a room within its walls
  int door_cells = 2;               // kind rooms: 1 m, so that a robot of one cell may swerve
  HazardMix hazards;
  ConfigNode sizes;         // of the characters, as grid.sizes, every default stated
  std::optional<int> seed;  // of one fixed site
  void Visit(ParamVisitor& v);
};

struct SiteKind {
  const char* name;
  const char* help;
  bool has_rooms;                // else one
  bool level_changes_at_border;  // along the outer wall, else anywhere
  void (*defaults)(GenerateParams& params);
};
const std::vector<SiteKind>& SiteKinds();

// Reads a site's `generate`. Throws InputError.
GenerateParams ReadGenerate(const ConfigNode& node);
// Of each kind, without its key `kind`.
std::vector<NamedSchema> GenerateSchemas();
// `generate` with every default stated; reading it gives the same parameters.
ConfigNode WriteGenerate(const GenerateParams& params);
// The keys `grid`, `start` and `goal` of a site. `node` is what the parameters were read from:
// refusals name its lines. Throws InputError naming the key for which there is no room.
ConfigNode DrawSite(const GenerateParams& params, const ConfigNode& node, Stream& stream);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "env/core/levels.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "env/core/made_floors.h"
#include "env/core/standing.h"

namespace floorproof {
namespace {

constexpr double kThinnest_m = 1e-4;  // of a piece of floor: borders that are one, but for rounding

bool IsLevel(const Hazard& hazard) { return hazard.hazard_class == HazardClass::kLevelChange; }

bool IsThin(const Polygon& polygon) {
  double around_m = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    around_m += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  return std::abs(SignedArea(polygon)) < kThinnest_m * around_m / 2;
}

bool IsTerrain(const Hazard& hazard) { return hazard.hazard_class == HazardClass::kTerrain; }

// Adds what of the polygon the floors leave that the hazards from `first` on make, grooves where
// they count: the whole of it, or convex parts.
void AddBare(const Polygon& polygon, MadeFloors& floors, std::size_t first, bool grooves,
             std::vector<Polygon>& bare) {
  std::vector<Polygon> later;
  for (const MadeFloor* floor : floors.Near(polygon))
    if (floor->hazard >= first && (floor->level || grooves)) later.push_back(floor->polygon);
  if (later.empty()) {
    bare.push_back(polygon);
    return;
  }
  for (Polygon& part : ConvexParts(Difference({{polygon, {}}}, later)))
    if (!IsThin(part)) bare.push_back(std::move(part));
}

// The cells that are no wall as few rectangles: runs of a row, as long as the rows above repeat
// them.
std::vector<Polygon> FreeRectangles(const HazardMap& map) {
  struct Run {
    int first, end, bottom;
  };
  std::vector<Polygon> rectangles;
  std::vector<Run> open, row;
  for (int iy = 0; iy <= map.frame.height; ++iy) {
    row.clear();
    for (int ix = 0, end = 0; iy < map.frame.height && ix < map.frame.width; ix = end + 1) {
      for (end = ix; end < map.frame.width && !map.IsWall(end, iy);) ++end;
      if (end > ix) row.push_back({ix, end, iy});
    }
    for (const Run& run : open) {
      const auto same = std::ranges::lower_bound(row, run.first, {}, &Run::first);
      if (same != row.end() && same->first == run.first && same->end == run.end) {
        same->bottom = run.bottom;
        continue;
      }
      Polygon rectangle = Rectangle(map.frame.cell_m * Vec2(run.first, run.bottom),
                                    map.frame.cell_m * Vec2(run.end, iy));
      for (Vec2& p : rectangle) p = map.frame.X_WG * p;
      rectangles.push_back(std::move(rectangle));
    }
    std::swap(open, row);
  }
  return rectangles;
}

// What a level so high is built of: it stands on level 0, or is cut into it.
Solid LevelSolid(const Polygon& base, double height_m) {
  return {height_m < 0 ? Solid::Kind::kCut : Solid::Kind::kPrism,
          base,
          {},
          std::min(height_m, 0.0),
          std::max(height_m, 0.0)};
}

// The base floor as a step or a drop: so high over what is level 0.
Hazard BaseFloor(const HazardMap& map, MadeFloors& floors, double height_m) {
  Hazard base;
  base.id = BaseFloorId(map);
  base.type = "floor";
  base.hazard_class = HazardClass::kLevelChange;
  base.height_m = height_m;
  base.sizes = LevelSizes(height_m);
  for (const Polygon& rectangle : FreeRectangles(map))
    AddBare(rectangle, floors, 0, false, base.footprint);
  for (const Polygon& part : base.footprint) base.solids.push_back(LevelSolid(part, height_m));
  return base;
}

std::vector<Polygon> BareFloor(const HazardMap& map, MadeFloors& floors, std::size_t i) {
  const Hazard& hazard = map.hazards[i];
  if (!IsLevel(hazard) && !IsTerrain(hazard)) return hazard.footprint;
  std::vector<Polygon> bare;
  for (const Polygon& polygon : hazard.footprint)
    AddBare(polygon, floors, i + 1, IsTerrain(hazard), bare);
  return bare;
}

}  // namespace

std::vector<std::vector<Polygon>> BareFloors(const HazardMap& map) {
  MadeFloors floors(map.hazards, MadeFloors::Levels::kFootprints);
  std::vector<std::vector<Polygon>> bare;
  for (std::size_t i = 0; i < map.hazards.size(); ++i) bare.push_back(BareFloor(map, floors, i));
  return bare;
}

std::string BaseFloorId(const HazardMap& map) {
  std::string id = "base_floor";
  while (std::ranges::find(map.hazards, id, &Hazard::id) != map.hazards.end()) id += "_";
  return id;
}

HazardMap SeenFrom(HazardMap map, const RobotSpec& robot, const Pose2& X_WB) {
  const double floor_m = StandAt(map, robot, X_WB).floor_m;
  if (std::abs(floor_m) <= kSameLevel_m) return map;
  MadeFloors floors(map.hazards, MadeFloors::Levels::kFootprints);
  std::vector<Hazard> seen, others;
  if (Hazard base = BaseFloor(map, floors, -floor_m); !base.footprint.empty())
    seen.push_back(std::move(base));
  for (std::size_t i = 0; i < map.hazards.size(); ++i) {
    Hazard hazard = map.hazards[i];
    hazard.footprint = BareFloor(map, floors, i);
    if (!IsLevel(hazard)) {
      for (Solid& solid : hazard.solids) solid.z_low_m -= floor_m, solid.z_high_m -= floor_m;
      if (!hazard.footprint.empty()) others.push_back(std::move(hazard));
      continue;
    }
    hazard.height_m -= floor_m;
    hazard.floor_m -= floor_m;
    hazard.sizes = LevelSizes(hazard.height_m);
    if (std::abs(hazard.height_m) <= kSameLevel_m || hazard.footprint.empty()) continue;
    // A pit's bases need not be convex, those of what rises over a deeper one must be.
    std::vector<Solid> built;
    for (const Solid& solid : hazard.solids)
      for (const Polygon& part : ConvexParts({{solid.base, {}}}))
        built.push_back(LevelSolid(part, hazard.height_m));
    hazard.solids = std::move(built);
    seen.push_back(std::move(hazard));
  }
  seen.insert(seen.end(), std::make_move_iterator(others.begin()),
              std::make_move_iterator(others.end()));
  map.hazards = std::move(seen);
  return map;
}

}  // namespace floorproof

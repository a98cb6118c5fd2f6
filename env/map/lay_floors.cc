// SPDX-License-Identifier: Apache-2.0
// A tapered solid (a cover, a bump) within an upright convex column is convex again, but its upper
// corners lie at several heights: where the column's sides cross its slanted edges. Cut level
// through at these heights it falls into layers, each a solid from one cross-section to the next.
//
// The corners of a layer's two cross-sections do not go by pairs any more, so a layer cannot be cut
// again. Each solid is cut once, as its hazard made it: first its ground plan is divided among the
// floors and what replaces them, then the solid is cut to the parts.
#include "env/map/lay_floors.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "base/error.h"
#include "env/core/made_floors.h"
#include "env/core/slopes.h"
#include "env/core/standing.h"
#include "env/geometry/convex.h"

namespace floorproof {
namespace {

constexpr double kThinnest_m = 1e-4;  // of a piece
constexpr double kTouch_m = 1e-6;     // mean width of an overlap that is none

struct Split {
  std::vector<Region> within, beyond;
};

// Bounds the work of all cuts of a site. A cut takes up to 25 ns for each pair of corners, as
// nearly all of them may cross: some 5 s in all.
class Work {
 public:
  // Before a cut. Throws InputError once they are too many together.
  void Add(const std::vector<Region>& regions, const std::vector<Polygon>& covers) {
    std::size_t corners = 0;
    for (const Region& region : regions) {
      corners += region.outer.size();
      for (const Polygon& hole : region.holes) corners += hole.size();
    }
    for (const Polygon& cover : covers) corners += cover.size();
    pairs_ += static_cast<double>(corners) * static_cast<double>(corners);
    if (pairs_ > kMaxPairs)
      throw InputError({}, "hazards", "",
                       "too many corners lie on each other to cut the floors apart (250 hazards of "
                       "5 corners on one place, or 2 of 2,000)");
  }

 private:
  static constexpr double kMaxPairs = 2e8;
  double pairs_ = 0;
};

// What of the regions these polygons cover, and the rest. Regions that they but touch are whole.
Split SplitBy(const std::vector<Region>& regions, const std::vector<Polygon>& covers, Work& work) {
  const auto without_touches = [](std::vector<Region> parts) {
    std::erase_if(parts, [](const Region& part) {
      double around_m = 0;
      for (std::size_t i = 0; i < part.outer.size(); ++i)
        around_m += (part.outer[(i + 1) % part.outer.size()] - part.outer[i]).norm();
      return Area({part}) < kTouch_m * around_m / 2;
    });
    return parts;
  };
  if (covers.empty()) return {{}, regions};
  work.Add(regions, covers);
  Split split;
  split.within = without_touches(Intersection(regions, covers));
  if (split.within.empty()) return {{}, regions};
  split.beyond = without_touches(Difference(regions, covers));
  if (split.beyond.empty()) return {regions, {}};
  return split;
}

// A part of a solid's ground plan, and the floor that it stands on.
struct Ground {
  std::vector<Region> regions;
  double floor_m = 0;
};

using LevelsBelow = std::map<std::size_t, std::vector<Polygon>, std::greater<>>;  // by hazard

// Those of the floors that are level changes before hazard i; of a cut, without what lies on them.
LevelsBelow Below(std::size_t i, std::span<const MadeFloor* const> floors, bool cuts = false) {
  LevelsBelow levels;
  for (const MadeFloor* floor : floors)
    if (floor->level && floor->hazard < i && (floor->replaces || !cuts))
      levels[floor->hazard].push_back(floor->polygon);
  return levels;
}

// The ground plan, divided among the last of the levels that hold it and the base floor.
std::vector<Ground> Grounds(std::span<const Hazard> hazards, const LevelsBelow& levels,
                            const Polygon& base, Work& work) {
  std::vector<Ground> grounds;
  std::vector<Region> rest = {{base, {}}};
  for (const auto& [hazard, polygons] : levels) {
    if (rest.empty()) break;
    Split split = SplitBy(rest, polygons, work);
    if (!split.within.empty())
      grounds.push_back({std::move(split.within), hazards[hazard].height_m});
    rest = std::move(split.beyond);
  }
  if (!rest.empty()) grounds.push_back({std::move(rest), 0});
  return grounds;
}

// The least width of a convex polygon.
double Width(const Polygon& convex) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const Vec2 edge = convex[(i + 1) % convex.size()] - convex[i];
    if (edge.norm() == 0) continue;
    double across = 0;
    for (const Vec2& p : convex) across = std::max(across, Cross(edge, p - convex[i]));
    least = std::min(least, across / edge.norm());
  }
  return least;
}

// A tapered solid's cross-section, `share` of the way up.
Polygon Section(const Solid& solid, double share) {
  Polygon section;
  for (std::size_t i = 0; i < solid.base.size(); ++i)
    section.push_back(solid.base[i] + share * (solid.top[i] - solid.base[i]));
  return section;
}

// Where the cross-section's corners cross the column's sides, and its sides the column's corners:
// shares of the way up, 0 and 1 among them, ascending.
std::vector<double> Levels(const Solid& solid, const Polygon& column) {
  std::vector<double> levels = {0, 1};
  const auto add = [&levels](double share) {
    if (share > 0 && share < 1) levels.push_back(share);
  };
  const std::size_t n = solid.base.size(), m = column.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = solid.base[i], &b = solid.base[(i + 1) % n];
    const Vec2 rise = solid.top[i] - a;  // of the corner, over the whole height
    for (std::size_t k = 0; k < m; ++k) {
      const Vec2 side = column[(k + 1) % m] - column[k];
      const double across = Cross(rise, side);
      if (std::abs(across) > 1e-12) {
        const double at = Cross(column[k] - a, side) / across;
        const double along = Cross(column[k] - a, rise) / across;
        if (along >= 0 && along <= 1) add(at);
      }
      // The side from a to b stays parallel as it goes in.
      const Vec2 edge = (b - a).normalized();
      const double in = Cross(edge, rise);
      if (std::abs(in) > 1e-12) add(Cross(edge, column[k] - a) / in);
    }
  }
  std::ranges::sort(levels);
  return levels;
}

// What of a tapered solid stands within an upright convex column.
void AddWithin(const Solid& solid, const Polygon& column, std::vector<Solid>& out) {
  const double height_m = solid.z_high_m - solid.z_low_m;
  const auto within = [&](double share) {
    return ConvexIntersection(column, Section(solid, share));
  };
  const std::vector<double> levels = Levels(solid, column);
  double from = 0;
  Polygon low = within(0);
  for (const double to : levels) {
    if (low.size() < 3 || Width(low) < kThinnest_m) break;
    if ((to - from) * height_m < kThinnest_m / 10) continue;  // levels that are one
    Polygon high = within(to);
    if (high.empty()) break;
    out.push_back(
        {solid.kind, low, high, solid.z_low_m + from * height_m, solid.z_low_m + to * height_m});
    low = std::move(high);
    from = to;
  }
}

// Adds what of the solid, as its hazard made it, stands on this ground. A cut into a raised floor
// leaves its lower part, or reaches down into the base floor.
void AddOn(Solid solid, const Ground& ground, std::vector<Solid>& out) {
  solid.z_low_m += ground.floor_m;
  solid.z_high_m += ground.floor_m;
  const bool leaves_floor = solid.kind == Solid::Kind::kCut && solid.z_low_m > kThinnest_m;
  if (solid.kind == Solid::Kind::kCut) {
    if (leaves_floor) solid.kind = Solid::Kind::kPrism;
    solid.z_high_m = std::max(0.0, std::exchange(solid.z_low_m, std::min(solid.z_low_m, 0.0)));
  }
  std::vector<Region> to_part;
  for (const Region& region : ground.regions) {
    if (region.outer == solid.base && region.holes.empty() && !leaves_floor)  // nothing cut
      out.push_back(solid);
    else if (solid.kind == Solid::Kind::kCut && region.holes.empty())  // any shape
      out.push_back({solid.kind, region.outer, {}, solid.z_low_m, solid.z_high_m});
    else
      to_part.push_back(region);
  }
  // Left out, a thin piece of a floor is a slot that no wheel feels; one of a cut would be a fin
  // that stands in the pit. Between close corners of a curve pieces are thin one after the other.
  const bool prism = solid.kind == Solid::Kind::kPrism;
  if (prism) to_part = Simplified(to_part, kThinnest_m / 2);
  for (const Polygon& part : ConvexParts(to_part)) {
    if (prism && Width(part) < kThinnest_m) continue;
    if (IsSlope(solid) && HighestOn(solid, part) - solid.z_low_m < kThinnest_m) continue;
    if (solid.top.empty())
      out.push_back({solid.kind, part, {}, solid.z_low_m, HighestOn(solid, part), solid.gradient});
    else
      AddWithin(solid, part, out);
  }
}

// Adds what the floors leave of hazard i's solid, each part on its own ground; whether there are
// several.
bool LaySolid(const Solid& solid, std::span<const Hazard> hazards, std::size_t i,
              MadeFloors& floors, Work& work, std::vector<Solid>& laid) {
  const bool lies =
      (hazards[i].hazard_class == HazardClass::kTerrain || hazards[i].lies_on_floor) &&
      solid.kind != Solid::Kind::kSurface;
  const std::vector<const MadeFloor*>& near = floors.Near(solid.base);
  const bool cuts = solid.kind == Solid::Kind::kCut;
  const LevelsBelow below = lies ? Below(i, near, cuts) : LevelsBelow();
  std::vector<Polygon> replaced;
  for (const MadeFloor* floor : near)
    if (floor->hazard > i && floor->replaces) replaced.push_back(floor->polygon);
  const std::vector<Ground> grounds = Grounds(hazards, below, solid.base, work);
  for (const Ground& ground : grounds)
    AddOn(solid, {SplitBy(ground.regions, replaced, work).beyond, ground.floor_m}, laid);
  return grounds.size() > 1;
}

// Whether one of the solids is built where a slope of this hazard is.
bool LiesOnSlopeOf(const Hazard& ramp, std::span<const Solid> solids, Work& work) {
  return std::ranges::any_of(ramp.solids, [&](const Solid& slope) {
    return IsSlope(slope) && std::ranges::any_of(solids, [&](const Solid& solid) {
             return solid.kind == Solid::Kind::kPrism &&
                    Overlap(BoxAround(solid.base), BoxAround(slope.base)) &&
                    !SplitBy({{solid.base, {}}}, {slope.base}, work).within.empty();
           });
  });
}

void WarnOfSlopes(std::span<const Hazard> hazards, Work& work, std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < hazards.size(); ++i)
    for (std::size_t ramp = 0; ramp < i; ++ramp)
      if (LiesOnSlopeOf(hazards[ramp], hazards[i].solids, work))
        warnings.push_back(hazards[i].id + " lies on the slope of " + hazards[ramp].id +
                           ": it is built level, from the floor below the ramp");
}

bool ShapesFloor(const Hazard& hazard) {
  return hazard.hazard_class == HazardClass::kTerrain ||
         hazard.hazard_class == HazardClass::kLevelChange;
}

// 0: floors; 1: what lies on them; 2: terrain.
int LayerOf(const Hazard& hazard) {
  if (IsRamp(hazard)) return 0;
  if (hazard.hazard_class == HazardClass::kTerrain) return 2;
  return hazard.lies_on_floor ? 1 : 0;
}

// Floors before what lies on them, and that before terrain, where they may overlap; as far as that
// allows each keeps its place.
void Sort(std::vector<Hazard>& hazards) {
  std::vector<Box2> boxes;
  for (const Hazard& hazard : hazards) {
    Box2 box = hazard.footprint.empty() ? Box2{Vec2::Zero(), Vec2::Zero()}
                                        : BoxAround(hazard.footprint.front());
    for (const Polygon& polygon : hazard.footprint) {
      const Box2 other = BoxAround(polygon);
      box = {box.low.cwiseMin(other.low), box.high.cwiseMax(other.high)};
    }
    boxes.push_back(box);
  }
  const BoxGrid grid(boxes);
  std::vector<std::vector<std::size_t>> after(hazards.size());
  std::vector<int> waits(hazards.size(), 0);
  std::vector<int> near;
  for (std::size_t i = 0; i < hazards.size(); ++i) {
    if (!ShapesFloor(hazards[i])) continue;
    grid.Near(boxes[i].low, boxes[i].high, near);
    for (const int other : near) {
      const auto j = static_cast<std::size_t>(other);
      if (j == i || !ShapesFloor(hazards[j]) || !Overlap(boxes[i], boxes[j])) continue;
      if (std::pair(LayerOf(hazards[i]), i) > std::pair(LayerOf(hazards[j]), j)) continue;
      after[i].push_back(j);
      ++waits[j];
    }
  }
  std::set<std::size_t> ready;
  for (std::size_t i = 0; i < hazards.size(); ++i)
    if (waits[i] == 0) ready.insert(i);
  std::vector<Hazard> sorted;
  while (!ready.empty()) {
    const std::size_t next = *ready.begin();
    ready.erase(ready.begin());
    for (const std::size_t j : after[next])
      if (--waits[j] == 0) ready.insert(j);
    sorted.push_back(std::move(hazards[next]));
  }
  hazards = std::move(sorted);
}

// Sets the heights over the base floor of hazards that lie on others: on the highest of them.
// Returns those that do not bend down to the lowest.
std::vector<UnbentHazard> Lift(std::vector<Hazard>& hazards, MadeFloors& floors, Work& work) {
  std::vector<UnbentHazard> unbent;
  for (std::size_t i = 0; i < hazards.size(); ++i) {
    Hazard& hazard = hazards[i];
    if (!hazard.lies_on_floor) continue;
    double highest_m = -std::numeric_limits<double>::infinity(), lowest_m = -highest_m;
    for (const Polygon& polygon : hazard.footprint)
      for (const Ground& ground : Grounds(hazards, Below(i, floors.Near(polygon)), polygon, work)) {
        highest_m = std::max(highest_m, ground.floor_m);
        lowest_m = std::min(lowest_m, ground.floor_m);
      }
    hazard.floor_m = highest_m;
    hazard.height_m += highest_m;
    if (highest_m != 0) hazard.sizes = LevelSizes(hazard.height_m);  // from the base floor
    if (const double edge_m = highest_m - lowest_m;
        hazard.bend_m && edge_m > *hazard.bend_m + kSameLevel_m)
      unbent.push_back({hazard.id, edge_m});
  }
  return unbent;
}

}  // namespace

std::vector<UnbentHazard> LayFloors(std::vector<Hazard>& hazards,
                                    std::vector<std::string>& warnings) {
  Sort(hazards);
  Work work;
  WarnOfSlopes(hazards, work, warnings);
  MadeFloors floors(hazards, MadeFloors::Levels::kBuilt);
  std::vector<UnbentHazard> unbent = Lift(hazards, floors, work);
  std::vector<std::string> across;  // from the last to the first
  for (std::size_t i = hazards.size(); i-- > 0;) {
    Hazard& hazard = hazards[i];
    if (!ShapesFloor(hazard)) continue;
    bool on_several = false;
    std::vector<Solid> laid;
    for (const Solid& solid : hazard.solids)
      on_several |= LaySolid(solid, hazards, i, floors, work, laid);
    hazard.solids = std::move(laid);
    if (on_several)
      across.push_back(hazard.id +
                       " lies across the edge of a level change: each part lies on its own floor");
  }
  warnings.insert(warnings.end(), across.rbegin(), across.rend());
  return unbent;
}

}  // namespace floorproof

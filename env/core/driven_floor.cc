// SPDX-License-Identifier: Apache-2.0
#include "env/core/driven_floor.h"

#include <algorithm>

#include "env/core/levels.h"
#include "env/geometry/box.h"

namespace floorproof {
namespace {

// The ends of each touch or lie on both sides of the other's line.
bool SegmentsMeet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  if (DistanceToSegment(a, b, c) == 0 || DistanceToSegment(a, b, d) == 0 ||
      DistanceToSegment(c, d, a) == 0 || DistanceToSegment(c, d, b) == 0)
    return true;
  const auto apart = [](const Vec2& from, const Vec2& to, const Vec2& p, const Vec2& q) {
    return (Cross(to - from, p - from) > 0) != (Cross(to - from, q - from) > 0);
  };
  return apart(a, b, c, d) && apart(c, d, a, b);
}

bool Meets(const Polygon& footprint, const Vec2& a, const Vec2& b) {
  if (Contains(footprint, a) || Contains(footprint, b)) return true;
  for (std::size_t i = 0; i < footprint.size(); ++i)
    if (SegmentsMeet(footprint[i], footprint[(i + 1) % footprint.size()], a, b)) return true;
  return false;
}

bool Meets(const std::vector<Polygon>& floor, const Path& path) {
  return std::ranges::any_of(floor, [&](const Polygon& polygon) {
    const auto [low, high] = BoxAround(polygon);
    for (std::size_t i = 0; i < path.size(); ++i) {
      const Vec2 &a = path[i > 0 ? i - 1 : 0].p_W, &b = path[i].p_W;
      const bool near = (a.cwiseMin(b).array() <= high.array()).all() &&
                        (a.cwiseMax(b).array() >= low.array()).all();
      if (near && Meets(polygon, a, b)) return true;
    }
    return false;
  });
}

}  // namespace

std::vector<std::size_t> LevelChangesOnTheWay(const HazardMap& map, const Path& path) {
  const std::vector<std::vector<Polygon>> bare = BareFloors(map);
  std::vector<std::size_t> met;
  for (std::size_t i = 0; i < map.hazards.size(); ++i) {
    const Hazard& hazard = map.hazards[i];
    const bool counts = hazard.hazard_class == HazardClass::kLevelChange ||
                        (hazard.hazard_class == HazardClass::kTerrain && hazard.crossable == false);
    if (counts && Meets(bare[i], path)) met.push_back(i);
  }
  return met;
}

ClearanceField ClearanceOnTheWay(HazardMap map, const std::vector<std::size_t>& on_the_way,
                                 double step_m) {
  for (const std::size_t i : on_the_way) {
    map.hazards[i].height_m = 0;
    map.hazards[i].crossable.reset();
  }
  return ComputeClearance(map, step_m);
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Edges are looked at every few centimetres, a little inside and a little outside: exact enough for
// planners, whose cells are coarser, and it asks nothing of how the floors' polygons lie.
#include "env/core/ramps.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "env/core/levels.h"
#include "env/core/slopes.h"

namespace floorproof {
namespace {

constexpr double kSample_m = 0.02;  // from place to place along an edge
constexpr double kLook_m = 0.005;   // inside and outside of it

bool IsLevel(const Hazard& hazard) { return hazard.hazard_class == HazardClass::kLevelChange; }

bool Holds(const Hazard& hazard, const Vec2& p_W) {
  return std::ranges::any_of(hazard.footprint,
                             [&](const Polygon& part) { return Contains(part, p_W); });
}

class Floors {
 public:
  Floors(const HazardMap& map, double step_m) : map_(map), step_m_(step_m) {
    open_.assign(map.hazards.size(), false);
    for (bool more = true; more;) {
      more = false;
      for (std::size_t h = 0; h < map.hazards.size(); ++h)
        if (!open_[h] && (IsRamp(map.hazards[h]) ? IsDriven(map.hazards[h])
                                                 : IsLevel(map.hazards[h]) && IsReached(h))) {
          open_[h] = true;
          more = true;
        }
    }
  }
  bool IsOpen(std::size_t hazard) const { return open_[hazard]; }

  // The pieces along the edges of what is open that no robot crosses, and how much lower or higher
  // the floor beside lies there, at most.
  std::vector<Polygon> Edges(std::size_t hazard, double& most_m) const {
    std::vector<Polygon> strips;
    for (const Polygon& part : map_.hazards[hazard].footprint)
      for (std::size_t i = 0; i < part.size(); ++i)
        AddEdges(part[i], part[(i + 1) % part.size()], strips, most_m);
    return strips;
  }

 private:
  double HeightAt(const Vec2& p_W) const {
    for (std::size_t h = map_.hazards.size(); h-- > 0;) {
      const Hazard& hazard = map_.hazards[h];
      if (const Solid* slope = SlopeAt(hazard, p_W)) return TopAt(*slope, p_W);
      if (IsLevel(hazard) && Holds(hazard, p_W)) return hazard.height_m;
    }
    return 0;
  }

  bool Joins(const Hazard& ramp, const Hazard& level) const {
    return LeadsOnto(ramp, level.height_m, &level.footprint, step_m_);
  }
  // Not too steep for the robot, and it leads on from where that gets to.
  bool IsDriven(const Hazard& ramp) const {
    return !IsObstacle(ramp, step_m_) && StartsFromOpen(ramp);
  }
  // From level 0, or from an open level.
  bool StartsFromOpen(const Hazard& ramp) const {
    if (LeadsOnto(ramp, 0, nullptr, step_m_)) return true;
    for (std::size_t h = 0; h < open_.size(); ++h)
      if (open_[h] && IsLevel(map_.hazards[h]) && Joins(ramp, map_.hazards[h])) return true;
    return false;
  }
  bool IsReached(std::size_t level) const {
    for (std::size_t h = 0; h < open_.size(); ++h)
      if (open_[h] && IsRamp(map_.hazards[h]) && Joins(map_.hazards[h], map_.hazards[level]))
        return true;
    return false;
  }

  void AddEdges(const Vec2& from_W, const Vec2& to_W, std::vector<Polygon>& strips,
                double& most_m) const {
    const double length_m = (to_W - from_W).norm();
    if (length_m == 0) return;
    const Vec2 along = (to_W - from_W) / length_m, out = kLook_m * Vec2(along.y(), -along.x());
    const int n = std::max(1, static_cast<int>(std::ceil(length_m / kSample_m)));
    const auto corner = [&](int i) { return Vec2(from_W + along * (length_m * i / n)); };
    int since = -1;
    for (int i = 0; i <= n; ++i) {
      double change_m = 0;
      if (i < n) {
        const Vec2 middle = (corner(i) + corner(i + 1)) / 2;
        change_m = std::abs(HeightAt(middle + out) - HeightAt(middle - out));
      }
      if (change_m > step_m_) {
        most_m = std::max(most_m, change_m);
        if (since < 0) since = i;
      } else if (since >= 0) {
        strips.push_back(
            {corner(since) - out, corner(since) + out, corner(i) + out, corner(i) - out});
        since = -1;
      }
    }
  }

  const HazardMap& map_;
  double step_m_;
  std::vector<char> open_;
};

}  // namespace

HazardMap OpenByRamps(HazardMap map, double step_m) {
  if (std::ranges::none_of(map.hazards, IsRamp)) return map;
  std::vector<std::vector<Polygon>> bare = BareFloors(map);
  for (std::size_t h = 0; h < bare.size(); ++h) map.hazards[h].footprint = std::move(bare[h]);
  const Floors floors(map, step_m);
  std::vector<Hazard> opened;
  for (std::size_t h = 0; h < map.hazards.size(); ++h) {
    const Hazard& hazard = map.hazards[h];
    if (!floors.IsOpen(h)) {
      opened.push_back(hazard);
      continue;
    }
    if (!IsLevel(hazard)) opened.push_back(hazard);
    Hazard edge;
    edge.footprint = floors.Edges(h, edge.height_m);
    if (edge.footprint.empty()) continue;
    edge.id = hazard.id + " edge";
    edge.type = hazard.type;
    edge.hazard_class = HazardClass::kLevelChange;
    edge.material = hazard.material;
    opened.push_back(std::move(edge));
  }
  map.hazards = std::move(opened);
  return map;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A tapered solid (a cover, a bump) within an upright convex column is convex again, but its upper
// corners lie at several heights: where the column's sides cross its slanted edges. Cut level
// through at these heights it falls into layers, each a solid from one cross-section to the next.
#include "env/map/lay_floors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace floorproof {
namespace {

constexpr double kThinnest_m = 1e-4;  // of a piece
constexpr double kTouch = 1e-6;       // share of an area that is none

struct Box {
  Vec2 low, high;
  explicit Box(const Polygon& polygon) : low(polygon[0]), high(polygon[0]) {
    for (const Vec2& p : polygon) low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  bool Meets(const Box& other) const {
    return (low.array() < other.high.array()).all() && (other.low.array() < high.array()).all();
  }
};

std::vector<Polygon> Meeting(const Polygon& base, const std::vector<Polygon>& covers) {
  const Box box(base);
  std::vector<Polygon> meeting;
  for (const Polygon& cover : covers)
    if (box.Meets(Box(cover))) meeting.push_back(cover);
  return meeting;
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

// A tapered solid's cross-section, `share` of the way up. Corners that fall together are one.
Polygon Section(const Solid& solid, double share) {
  Polygon section;
  for (std::size_t i = 0; i < solid.base.size(); ++i) {
    const Vec2 p = solid.base[i] + share * (solid.top[i] - solid.base[i]);
    if (section.empty() || (p - section.back()).norm() > 1e-9) section.push_back(p);
  }
  while (section.size() > 1 && (section.front() - section.back()).norm() <= 1e-9)
    section.pop_back();
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
    const auto regions = Intersection({{column, {}}}, {Section(solid, share)});
    return regions.empty() ? Polygon{} : regions.front().outer;
  };
  const std::vector<double> levels = Levels(solid, column);
  double from = 0;
  Polygon low = within(0);
  for (const double to : levels) {
    if (low.size() < 3 || Width(low) < kThinnest_m) break;
    if ((to - from) * height_m < kThinnest_m / 10) continue;  // levels that are one
    Polygon high = within(to);
    for (const double short_of : {1e-6, 1e-3})  // where it runs out, in an edge or a corner
      if (high.size() < 3) high = within(to - short_of * (to - from));
    if (high.size() < 3) break;
    out.push_back(
        {solid.kind, low, high, solid.z_low_m + from * height_m, solid.z_low_m + to * height_m});
    low = std::move(high);
    from = to;
  }
}

// Adds what of the solid stands on these regions of its ground.
void AddOn(const Solid& solid, const std::vector<Region>& regions, std::vector<Solid>& out) {
  std::vector<Region> to_part;
  for (const Region& region : regions) {
    if (solid.kind == Solid::Kind::kCut && region.holes.empty())  // any shape
      out.push_back({solid.kind, region.outer, {}, solid.z_low_m, solid.z_high_m});
    else
      to_part.push_back(region);
  }
  for (const Polygon& part : ConvexParts(to_part)) {
    if (Width(part) < kThinnest_m) continue;
    if (solid.top.empty())
      out.push_back({solid.kind, part, {}, solid.z_low_m, solid.z_high_m});
    else
      AddWithin(solid, part, out);
  }
}

void CutAway(Solid solid, const std::vector<Polygon>& covers, std::vector<Solid>& rest) {
  const std::vector<Polygon> meeting = Meeting(solid.base, covers);
  if (meeting.empty()) {
    rest.push_back(std::move(solid));
    return;
  }
  const std::vector<Region> left = Difference({{solid.base, {}}}, meeting);
  if (Area(left) > (1 - kTouch) * std::abs(SignedArea(solid.base)))
    rest.push_back(std::move(solid));  // they but touch
  else
    AddOn(solid, left, rest);
}

// Adds the solid, put on the last of these floors that holds its ground; what none holds stays.
// True where it lies across an edge of one.
bool LayOn(std::span<const Hazard> before, Solid solid, std::vector<Solid>& laid) {
  for (std::size_t j = before.size(); j-- > 0;) {
    if (before[j].hazard_class != HazardClass::kLevelChange) continue;
    const std::vector<Polygon> floor = Meeting(solid.base, before[j].footprint);
    if (floor.empty()) continue;
    const std::vector<Region> ground = {{solid.base, {}}};
    const std::vector<Region> on = Intersection(ground, floor);
    const double share = Area(on) / std::abs(SignedArea(solid.base));
    if (share < kTouch) continue;
    std::vector<Solid> lifted;
    if (share > 1 - kTouch)
      lifted = {solid};
    else
      AddOn(solid, on, lifted);
    for (Solid& part : lifted) {
      part.z_low_m += before[j].height_m;
      part.z_high_m += before[j].height_m;
      laid.push_back(std::move(part));
    }
    if (share > 1 - kTouch) return false;
    std::vector<Solid> beside;
    AddOn(solid, Difference(ground, floor), beside);
    for (Solid& part : beside) LayOn(before.first(j), std::move(part), laid);
    return true;
  }
  laid.push_back(std::move(solid));
  return false;
}

void LayTerrain(std::span<const Hazard> before, Hazard& terrain,
                std::vector<std::string>& warnings) {
  bool across = false;
  std::vector<Solid> laid;
  for (Solid& solid : terrain.solids) {
    if (solid.kind == Solid::Kind::kPrism)
      across |= LayOn(before, std::move(solid), laid);
    else
      laid.push_back(std::move(solid));
  }
  terrain.solids = std::move(laid);
  if (across)
    warnings.push_back(terrain.id +
                       " lies across the edge of a level change: each part lies on its own floor");
}

}  // namespace

void LayFloors(std::vector<Hazard>& hazards, std::vector<std::string>& warnings) {
  const auto is_cut = [](const Hazard& h) {
    return std::ranges::any_of(h.solids,
                               [](const Solid& s) { return s.kind == Solid::Kind::kCut; });
  };
  for (std::size_t i = 0; i < hazards.size(); ++i)
    if (hazards[i].hazard_class == HazardClass::kTerrain)
      LayTerrain(std::span(hazards).first(i), hazards[i], warnings);

  std::vector<Polygon> later;  // what replaces the floor behind this one in the list
  for (std::size_t i = hazards.size(); i-- > 0;) {
    Hazard& hazard = hazards[i];
    const bool level = hazard.hazard_class == HazardClass::kLevelChange;
    if (!level && hazard.hazard_class != HazardClass::kTerrain) continue;
    const bool replaces = level || is_cut(hazard);
    std::vector<Solid> rest;
    for (Solid& solid : hazard.solids) CutAway(std::move(solid), later, rest);
    hazard.solids = std::move(rest);
    if (replaces) later.insert(later.end(), hazard.footprint.begin(), hazard.footprint.end());
  }
}

}  // namespace floorproof

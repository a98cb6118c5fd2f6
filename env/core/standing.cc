// SPDX-License-Identifier: Apache-2.0
#include "env/core/standing.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "env/core/slopes.h"
#include "env/geometry/box.h"
#include "env/geometry/rasterise.h"

namespace floorproof {
namespace {

constexpr double kLeast_m2 = 1e-8;  // of an overlap

bool Overlap(const Polygon& a, const Polygon& b) {
  return Overlap(BoxAround(a), BoxAround(b)) && Area(Intersection({{a, {}}}, {b})) > kLeast_m2;
}

// The ground plan of the wheel's cylinder up to this height over its lowest line.
Polygon WheelUpTo(const WheelSpec& wheel, double height_m) {
  const double r = wheel.radius_m, up = std::clamp(height_m, 0.0, r);
  const double half = std::sqrt(up * (2 * r - up)), across = wheel.half_width_m;
  return InWorld({wheel.p_BW.x(), wheel.p_BW.y(), wheel.yaw_rad},
                 Rectangle({-half, -across}, {half, across}));
}

bool IsBuiltAt(const Hazard& hazard, const Vec2& p_W) {
  return std::ranges::any_of(hazard.solids, [&](const Solid& s) { return Contains(s.base, p_W); });
}

bool IsGrooveAt(std::span<const Hazard> hazards, const Vec2& p_W) {
  return std::ranges::any_of(hazards, [&](const Hazard& hazard) {
    return hazard.hazard_class == HazardClass::kTerrain &&
           std::ranges::any_of(hazard.solids, [&](const Solid& solid) {
             return solid.kind == Solid::Kind::kCut && Contains(solid.base, p_W);
           });
  });
}

// A level is where it is built: on a drawing that is less than its cells, its footprint. A later
// groove has cut it, and leaves it the floor beside.
const Hazard* LevelHazardAt(const HazardMap& map, const Vec2& p_W) {
  for (std::size_t h = map.hazards.size(); h-- > 0;) {
    const Hazard& hazard = map.hazards[h];
    if (hazard.hazard_class != HazardClass::kLevelChange) continue;
    if (IsBuiltAt(hazard, p_W)) return &hazard;
    const auto holds = [&](const Polygon& p) { return Contains(p, p_W); };
    if (std::ranges::any_of(hazard.footprint, holds) &&
        IsGrooveAt(std::span(map.hazards).subspan(h + 1), p_W))
      return &hazard;
  }
  return nullptr;
}

const Solid* LastSlopeAt(const HazardMap& map, const Vec2& p_W) {
  for (std::size_t h = map.hazards.size(); h-- > 0;)
    if (const Solid* slope = SlopeAt(map.hazards[h], p_W)) return slope;
  return nullptr;
}

std::string Metres(double m) {
  std::string text = std::to_string(m);
  text.resize(text.find('.') + 4);
  return text + " m";
}

// Stands it on its floor; false: across an edge.
bool FindFloor(const HazardMap& map, const RobotSpec& robot, const Pose2& X_WB, Standing& out) {
  bool first = true;
  double low_m = 0;
  const Hazard *high = nullptr, *low = nullptr;
  for (const WheelSpec& wheel : robot.wheels) {
    const Vec2 p_W = X_WB * Vec2(wheel.p_BW.head<2>());
    const Hazard* level = LevelHazardAt(map, p_W);
    const double height_m = level != nullptr ? level->height_m : 0;
    const double ground_m = GroundAt(map, p_W).height_m;
    if (first || ground_m > out.rests_m) out.rests_m = ground_m;
    if (first || height_m > out.floor_m) out.floor_m = height_m, high = level;
    if (first || height_m < low_m) low_m = height_m, low = level;
    first = false;
  }
  if (out.floor_m - low_m <= kSameLevel_m) return true;
  out.obstruction = (high != nullptr ? high : low)->id;
  out.why = "stands across the edge of " + out.obstruction + ": its wheels are on floors at " +
            Metres(low_m) + " and " + Metres(out.floor_m);
  return false;
}

// A solid that it is in, or that a wheel rests on.
void MeetSolid(const RobotSpec& robot, const Pose2& X_WB, const std::vector<Polygon>& body_W,
               const Hazard& hazard, const Solid& solid, Standing& out) {
  const double rise_m = solid.z_high_m - out.floor_m;
  if (solid.kind != Solid::Kind::kPrism || rise_m <= kSameLevel_m || IsSlope(solid)) return;
  const Polygon& top = solid.top.empty() ? solid.base : solid.top;
  const double belly_m = out.rests_m + robot.clearance_m, roof_m = out.rests_m + robot.height_m;
  if (solid.z_high_m > belly_m + kTouch_m && solid.z_low_m < roof_m &&
      std::ranges::any_of(body_W, [&](const Polygon& part_W) { return Overlap(part_W, top); })) {
    out.obstruction = hazard.id;
    out.why = "overlaps " + hazard.id + ", " + hazard.type;
    return;
  }
  for (const WheelSpec& wheel : robot.wheels) {
    if (solid.z_low_m > out.floor_m + 2 * wheel.radius_m ||
        !Overlap(InWorld(X_WB, WheelUpTo(wheel, rise_m - kTouch_m)), top))
      continue;
    if (hazard.hazard_class == HazardClass::kTerrain && rise_m <= robot.clearance_m) {
      out.rests_m = std::max(out.rests_m, solid.z_high_m);
      continue;
    }
    out.obstruction = hazard.id;
    out.why = "has a wheel in " + hazard.id + ", " + hazard.type + ", " + Metres(rise_m) +
              " over its floor";
    return;
  }
}

// Terrain that bridges what is below the wheel.
bool IsBridged(const HazardMap& map, const Polygon& wheel_W) {
  return std::ranges::any_of(map.hazards, [&](const Hazard& hazard) {
    return hazard.hazard_class == HazardClass::kTerrain &&
           std::ranges::any_of(hazard.solids, [&](const Solid& solid) {
             return solid.kind == Solid::Kind::kPrism && Overlap(wheel_W, solid.base);
           });
  });
}

// A slot in which a wheel sinks deeper than the belly is high; over a narrow one it stays.
void MeetSlot(const HazardMap& map, const RobotSpec& robot, const Pose2& X_WB, const Hazard& hazard,
              Standing& out) {
  const bool level = hazard.hazard_class == HazardClass::kLevelChange;
  if (!level && hazard.hazard_class != HazardClass::kTerrain) return;
  const double bottom_m = level ? hazard.height_m - kSameLevel_m : out.floor_m;
  double deep_m = 0;
  std::vector<Polygon> slots;
  for (const Solid& solid : hazard.solids)
    if (solid.kind == Solid::Kind::kCut && solid.z_low_m < bottom_m &&
        out.floor_m - solid.z_low_m > robot.clearance_m) {
      slots.push_back(solid.base);
      deep_m = std::max(deep_m, out.floor_m - solid.z_low_m);
    }
  if (slots.empty()) return;
  for (const WheelSpec& wheel : robot.wheels) {
    const Polygon sunk = InWorld(X_WB, WheelUpTo(wheel, robot.clearance_m));
    if (Area(Difference({{sunk, {}}}, slots)) > kLeast_m2 || IsBridged(map, sunk)) continue;
    out.obstruction = hazard.id;
    out.why = "has a wheel in " + hazard.id + ", " + hazard.type + ", " + Metres(deep_m) +
              " below its floor";
    return;
  }
}

}  // namespace

std::vector<Polygon> OutlineAt(const RobotSpec& robot, const Pose2& X_WB, double drawn_in_m) {
  std::vector<Polygon> parts_W;
  for (const Polygon& part_B : robot.outline_B) {
    Vec2 middle = Vec2::Zero();
    for (const Vec2& p : part_B) middle += p / static_cast<double>(part_B.size());
    const double half_m = -SignedDistance(part_B, middle) / 2;
    parts_W.push_back(InWorld(X_WB, Offset(part_B, -std::min(drawn_in_m, half_m))));
  }
  return parts_W;
}

Polygon InWorld(const Pose2& X_WB, Polygon polygon_B) {
  for (Vec2& p : polygon_B) p = X_WB * p;
  return polygon_B;
}

bool TouchesWall(const HazardMap& map, Polygon polygon_W) {
  const GridFrame& frame = map.frame;
  bool touches = false;
  for (Vec2& p : polygon_W) {
    p = frame.ToGrid(p) / frame.cell_m;
    touches |= p.x() < 0 || p.y() < 0 || p.x() > frame.width || p.y() > frame.height;
  }
  Rasterise(polygon_W, frame.width, frame.height,
            [&](int ix, int iy) { touches |= map.IsWall(ix, iy); });
  return touches;
}

double LevelAt(const HazardMap& map, const Vec2& p_W) {
  const Hazard* level = LevelHazardAt(map, p_W);
  return level != nullptr ? level->height_m : 0;
}

Ground GroundAt(const HazardMap& map, const Vec2& p_W) {
  if (const Solid* slope = LastSlopeAt(map, p_W)) return {TopAt(*slope, p_W), slope->gradient};
  return {LevelAt(map, p_W)};
}

Standing StandAt(const HazardMap& map, const RobotSpec& robot, const Pose2& X_WB) {
  Standing out;
  if (!FindFloor(map, robot, X_WB, out)) return out;
  // Walls' solids are drawn back: the body is drawn in by as much.
  const double drawn_back_m = std::min(map.inset_m, robot.inscribed_radius_m / 2);
  if (std::ranges::any_of(OutlineAt(robot, X_WB, kTouch_m + drawn_back_m),
                          [&](const Polygon& part_W) { return TouchesWall(map, part_W); })) {
    out.obstruction = "wall";
    out.why = "overlaps a wall";
    return out;
  }
  const std::vector<Polygon> body_W = OutlineAt(robot, X_WB, kTouch_m);
  for (const Hazard& hazard : map.hazards) {
    for (const Solid& solid : hazard.solids) {
      MeetSolid(robot, X_WB, body_W, hazard, solid, out);
      if (!out.obstruction.empty()) return out;
    }
    MeetSlot(map, robot, X_WB, hazard, out);
    if (!out.obstruction.empty()) return out;
  }
  return out;
}

}  // namespace floorproof

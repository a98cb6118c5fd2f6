// SPDX-License-Identifier: Apache-2.0
// The one description of a floor that planner, scene, detectors and statistics read.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "env/geometry/grid.h"
#include "env/geometry/polygon.h"

namespace floorproof {

// Hazard classes of the hTetro FMEA paper, Table 1.
// A hazard has one, for all directions from which a robot may come: the worst.
enum class HazardClass { kBlindObject /*C1*/, kGlass /*C2*/, kLevelChange /*C3*/, kTerrain /*C4*/ };

// A piece of matter, or of missing floor, in the world frame; z = 0 is the base floor.
struct Solid {
  enum class Kind {
    kPrism,    // the convex hull of `base` at z_low_m and `top` at z_high_m, both convex: a box, a
               // prism, a frustum; a wedge, where corners of `top` coincide
    kCut,      // the floor is missing within `base` (any simple polygon) down to z_low_m (negative)
    kSurface,  // no matter: what is level or slanted floor within `base` (any simple polygon) has
               // the hazard's friction
  };
  Kind kind = Kind::kPrism;
  Polygon base;
  Polygon top;  // empty: the same as base
  double z_low_m = 0, z_high_m = 0;
  // Of a prism whose top is a slanted plane over `base`: its rise per metre along the world's x and
  // y. z_high_m is then the height of its highest corner, and `top` is empty.
  Vec2 gradient = Vec2::Zero();
};
// Whether its top is a slanted floor.
inline bool IsSlope(const Solid& solid) { return !solid.gradient.isZero(0); }
// The height of the solid's top at this place, which its base holds, m; a tapered one's is
// z_high_m.
double TopAt(const Solid& solid, const Vec2& p_W);
// The height of the highest place of its top over this part of its base, m.
double HighestOn(const Solid& solid, const Polygon& part);

struct Material {
  std::optional<double> friction;  // none: the floor's
  // What holds a wheel that rolls on it back, as a share of its load, beside what the wheel's own
  // bearings do (N / N).
  double rolling_drag = 0;
  double restitution = 0;  // 0 (dead) to 1 (elastic)
  double reflectance = 1;  // of a lidar's light, 0 (black) to 1 (white)
  std::array<float, 4> rgba = {0.6f, 0.6f, 0.6f, 1.0f};
};

// How large a hazard is, of a kind of which robots' limits are measured (the ladder,
// docs/validation.md).
struct HazardSize {
  std::string kind;
  double size = 0;  // m, rad, or a share
};

// The record that a hazard's plug-in makes from its keys (env/hazards). Nobody above env/map asks a
// plug-in.
struct Hazard {
  std::string id;    // unique on a site, default type-index
  std::string type;  // the plug-in's name
  HazardClass hazard_class = HazardClass::kBlindObject;
  bool known = true;               // false: in the scene, not in the map that planners get
  std::vector<Polygon> footprint;  // world frame
  // Signed: a drop is negative, a groove's depth negative. Of a level change over the base floor;
  // of terrain over the floor that it lies on or is cut into.
  double height_m = 0;
  // A level change that lies on the floor beneath, as a carpet does: its type states its height
  // over that. LayFloors (env/map) makes of it the height over the base floor, and keeps how high
  // the floor beneath is.
  bool lies_on_floor = false;
  double floor_m = 0;
  // The highest edge of floors beneath that it bends over. None: it need not bend, each part lies
  // on its own floor.
  std::optional<double> bend_m = {};
  std::vector<Solid> solids;
  Material material;
  // Its plug-in's keys that are numbers, as a site file states them ("height_m", 0.015), its
  // restitution, and its friction where that is not the floor's.
  std::vector<std::pair<std::string, double>> keys;
  // Each list says by itself how large it is: who crosses all that one of them holds crosses the
  // hazard. None: nothing of its kind is measured.
  std::vector<std::vector<HazardSize>> sizes;
  // Of a map as it is for one robot (JudgedFor): whether that crosses it, by its measured limits.
  // None: they say nothing of it, and its class decides.
  std::optional<bool> crossable = {};
};
// Up and down a level change so high.
std::vector<std::vector<HazardSize>> LevelSizes(double height_m);

struct HazardMap {
  std::string name;
  GridFrame frame;
  Grid<CellState> occupancy;
  bool unknown_is_wall = true;
  // Solids of occupied cells are drawn back by this on faces towards free cells (scene only;
  // planners see whole cells).
  double inset_m = 0;
  double floor_friction = 0.8;
  std::vector<Hazard> hazards;  // later ones win where they overlap
  std::optional<Pose2> start;
  std::optional<Vec2> goal;

  // Walls and furniture, unknown cells by policy, and all that lies beyond the map.
  bool IsWall(int ix, int iy) const {
    if (!occupancy.Inside(ix, iy)) return true;
    const CellState s = occupancy(ix, iy);
    return s == CellState::kOccupied || (s == CellState::kUnknown && unknown_is_wall);
  }
  bool IsWall(Cell c) const { return IsWall(c.ix, c.iy); }
};

// The map without hazards of `known: false`: what planners and localisation get.
HazardMap KnownPart(const HazardMap& map);

// Whether a robot that can cross steps of step_m must keep off this hazard. True for C1 and C2.
// Of all others the robot's measured limits decide, where the map was judged by them and they say
// something of it (`crossable`); else it is true for level changes higher or deeper than step_m,
// and terrain (C4) is driven over.
bool IsObstacle(const Hazard& hazard, double step_m);

}  // namespace floorproof

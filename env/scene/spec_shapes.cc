// SPDX-License-Identifier: Apache-2.0
// Reads a reconfigurable robot's blocks and the shapes that it knows; and how far a robot, whatever
// its shape, can tip.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/quantity.h"
#include "env/core/blocks.h"
#include "env/scene/spec_parts.h"

namespace floorproof {
namespace {

// What carries the robot, seen from above. A caster stands its trail's length from its pivot, in
// whatever direction it was driven last.
struct Carrier {
  Vec2 p;
  double trail_m = 0;
};

// The least distance from the centre of mass to the border of what carries, each caster swivelled
// to where it carries least; in directions half a degree apart. A line square to a direction has
// nothing beyond it that carries for sure from the farthest carrier on.
double LeastReach(const std::vector<Carrier>& carriers, const Vec2& com) {
  constexpr int kDirections = 720;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kDirections; ++k) {
    const double way_rad = 2 * kPi * k / kDirections;
    const Vec2 way(std::cos(way_rad), std::sin(way_rad));
    double reach = -std::numeric_limits<double>::infinity();
    for (const Carrier& c : carriers) reach = std::max(reach, way.dot(c.p - com) - c.trail_m);
    least = std::min(least, reach);
  }
  return least;
}

// The smallest angle about an edge of the hull of the points that carry the robot: atan(d / h),
// with d the distance from the edge to the centre of mass, seen from above, and h the centre's
// height. Casters that swivel carry at their worst; springs do not give.
double StaticTip(const CompiledRobot& compiled, const RobotSpec& robot,
                 const std::vector<double>& hinge_rad) {
  const mjModel* m = compiled.model();
  const BlockMotions blocks = MoveBlocks(robot.blocks, robot.hinges, AtRest(hinge_rad));
  const auto moved = [&](int body, const Vec3& p) {
    return blocks.block[static_cast<std::size_t>(compiled.BlockOf(body))].X_BK * Vec2(p.head<2>());
  };
  std::vector<Vec2> places;
  std::vector<Carrier> carriers;
  bool swivels = false;
  for (int g = 0; g < m->ngeom; ++g) {
    if (!compiled.Collides(g) || compiled.IsCarried(g)) continue;
    if (const auto swivel = compiled.SwivelOf(g)) {
      swivels = true;
      places.push_back(moved(m->geom_bodyid[g], swivel->pivot_B));
      carriers.push_back({places.back(), swivel->trail_m});
      continue;
    }
    const auto points = compiled.SurfacePoints(g);
    const auto lowest = std::ranges::min_element(points, {}, [](const Vec3& p) { return p.z(); });
    for (const auto& p : points)
      if (p.z() < lowest->z() + 1e-4) {
        places.push_back(moved(m->geom_bodyid[g], p));
        carriers.push_back({places.back(), 0});
      }
  }
  const Polygon hull = ConvexHull(places);
  if (hull.size() < 3)
    compiled.Refuse("wheels", "wheels and casters must support the robot on three points");
  Vec3 com = Vec3::Zero();
  for (int b = compiled.base(); b < m->nbody; ++b) {
    const Vec3 p = compiled.InBase(compiled.data()->xipos + 3 * b);
    const Vec2 p_B = moved(b, p);
    com += m->body_mass[b] / robot.mass_kg * Vec3(p_B.x(), p_B.y(), p.z());
  }
  const double d =
      swivels ? LeastReach(carriers, com.head<2>()) : -SignedDistance(hull, com.head<2>());
  if (d <= 0)
    compiled.Refuse("base",
                    "the centre of mass lies outside the wheels' support, by " + LengthText(-d) +
                        (swivels ? ", its casters swivelled to where they carry least" : "") +
                        ": move a mass, or a wheel or caster, or add a caster");
  if (!(com.z() > 0)) compiled.Refuse("base", "the centre of mass must lie above the floor");
  return std::atan2(d, com.z());
}

BlockSpec ReadBlock(const CompiledRobot& compiled, int body) {
  const mjModel* m = compiled.model();
  std::vector<Vec2> points;
  for (int g = 0; g < m->ngeom; ++g)
    if (compiled.Collides(g) && m->geom_bodyid[g] == body)
      for (const Vec3& p : compiled.SurfacePoints(g)) points.push_back(p.head<2>());
  const Polygon outline = ConvexHull(points);
  if (outline.size() < 3) compiled.Refuse("hinges", "every block needs a geom that collides");
  Vec2 centre = Vec2::Zero();
  for (const Vec2& p : outline) centre += p / static_cast<double>(outline.size());
  const char* name = mj_id2name(m, mjOBJ_BODY, body);
  if (name == nullptr) compiled.Refuse("hinges", "every block's body needs a name");
  return {name, outline, centre};
}

ShapeSpec ReadShape(const CompiledRobot& compiled, const RobotSpec& robot,
                    const std::string& name) {
  const mjModel* m = compiled.model();
  ShapeSpec shape;
  shape.name = name;
  const std::string key = "shape_" + name;
  const int id = mj_name2id(m, mjOBJ_NUMERIC, key.c_str());
  if (id < 0 || m->numeric_size[id] != static_cast<int>(robot.hinges.size()))
    compiled.Refuse(key, "must be under <custom>, with an angle in degrees for each of the hinges");
  const mjtNum* angles_deg = m->numeric_data + m->numeric_adr[id];
  for (std::size_t h = 0; h < robot.hinges.size(); ++h) {
    const HingeSpec& hinge = robot.hinges[h];
    shape.hinge_rad.push_back(angles_deg[h] * kPi / 180);
    constexpr double kStep_rad = kPi / 12;  // of the ways between shapes (controllers)
    if (!(std::abs(std::remainder(shape.hinge_rad[h], kStep_rad)) <= 1e-6))  // NaN, too
      compiled.Refuse(key, "angles must be multiples of 15 degrees");
    if (shape.hinge_rad[h] < hinge.min_rad || shape.hinge_rad[h] > hinge.max_rad)
      compiled.Refuse(key, "lies beyond the range of " + hinge.name);
  }
  shape.footprint_B = Footprint(robot.blocks, robot.hinges, shape.hinge_rad);
  if (shape.footprint_B.empty())
    compiled.Refuse(key,
                    "seen from above, the blocks' geoms that collide have no one outline: they "
                    "must cover some floor and stand within 0.25 m of one another");
  shape.static_tip_rad = StaticTip(compiled, robot, shape.hinge_rad);
  return shape;
}

}  // namespace

void ReadShapes(const CompiledRobot& compiled, RobotSpec& robot) {
  if (robot.hinges.empty()) {
    robot.static_tip_rad = StaticTip(compiled, robot, {});
    return;
  }
  for (const int body : compiled.blocks()) robot.blocks.push_back(ReadBlock(compiled, body));
  const auto names = compiled.Words("shapes");
  if (names.empty()) compiled.Refuse("shapes", "a robot with hinges needs its shapes' names");
  for (const auto& name : names) robot.shapes.push_back(ReadShape(compiled, robot, name));
  for (std::size_t h = 0; h < robot.hinges.size(); ++h)
    if (std::abs(robot.shapes[0].hinge_rad[h] - robot.hinges[h].model_rad) > 1e-6)
      compiled.Refuse("shape_" + names[0],
                      "the first shape must be the one that the model stands in");
  robot.static_tip_rad = robot.shapes[0].static_tip_rad;
}

}  // namespace floorproof

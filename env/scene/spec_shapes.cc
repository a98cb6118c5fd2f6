// SPDX-License-Identifier: Apache-2.0
// Reads a reconfigurable robot's blocks and the shapes that it knows; and how far a robot, whatever
// its shape, can tip.
#include <algorithm>
#include <cmath>

#include "base/quantity.h"
#include "env/core/blocks.h"
#include "env/scene/spec_parts.h"

namespace floorproof {
namespace {

// The smallest angle about an edge of the hull of the points that carry the robot: atan(d / h),
// with d the distance from the edge to the centre of mass, seen from above, and h the centre's
// height.
double StaticTip(const CompiledRobot& compiled, const RobotSpec& robot,
                 const std::vector<double>& hinge_rad) {
  const mjModel* m = compiled.model();
  const BlockMotions blocks = MoveBlocks(robot.blocks, robot.hinges, AtRest(hinge_rad));
  const auto moved = [&](int body, const Vec3& p) {
    return blocks.block[static_cast<std::size_t>(compiled.BlockOf(body))].X_BK * Vec2(p.head<2>());
  };
  std::vector<Vec2> carriers;
  for (int g = 0; g < m->ngeom; ++g) {
    if (!compiled.Collides(g) || compiled.IsCarried(g)) continue;
    const auto points = compiled.SurfacePoints(g);
    const auto lowest = std::ranges::min_element(points, {}, [](const Vec3& p) { return p.z(); });
    for (const auto& p : points)
      if (p.z() < lowest->z() + 1e-4) carriers.push_back(moved(m->geom_bodyid[g], p));
  }
  const Polygon hull = ConvexHull(carriers);
  if (hull.size() < 3)
    compiled.Refuse("wheels", "wheels and casters must support the robot on three points");
  Vec3 com = Vec3::Zero();
  for (int b = compiled.base(); b < m->nbody; ++b) {
    const Vec3 p = compiled.InBase(compiled.data()->xipos + 3 * b);
    const Vec2 p_B = moved(b, p);
    com += m->body_mass[b] / robot.mass_kg * Vec3(p_B.x(), p_B.y(), p.z());
  }
  const double d = -SignedDistance(hull, com.head<2>());
  if (d <= 0)
    compiled.Refuse("base", "the centre of mass lies outside the wheels' support, by " +
                                LengthText(-d) +
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

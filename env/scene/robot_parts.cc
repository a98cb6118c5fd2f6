// SPDX-License-Identifier: Apache-2.0
// Points whose hull is what is seen of each geom.
#include <algorithm>
#include <cmath>

#include "env/scene/compiled_robot.h"
#include "env/scene/loads.h"
#include "env/scene/robot_stance.h"
#include "env/scene/wheel_collider.h"

namespace floorproof {
namespace {

constexpr int kAround = 48, kRings = 16;

void AddRing(std::vector<Vec3>& points, double rx, double ry, double z) {
  for (int k = 0; k < kAround; ++k)
    points.emplace_back(rx * std::cos(2 * kPi * k / kAround), ry * std::sin(2 * kPi * k / kAround),
                        z);
}

void AddEllipsoid(std::vector<Vec3>& points, const Vec3& half, double raised) {
  for (int k = 0; k <= kRings; ++k) {
    const double angle = kPi * (static_cast<double>(k) / kRings - 0.5);
    const double z = half.z() * std::sin(angle);
    AddRing(points, half.x() * std::cos(angle), half.y() * std::cos(angle),
            z + (z > 0 ? raised : -raised));
  }
}

// In the geom's own frame.
std::vector<Vec3> OwnPoints(const mjModel* m, int geom) {
  const Vec3 size(m->geom_size + 3 * geom);
  std::vector<Vec3> points;
  switch (m->geom_type[geom]) {
    case mjGEOM_CYLINDER: {
      const double rollers = RollersOf(m, geom).radius_m;
      for (const double side : {-1.0, 1.0}) {
        AddRing(points, size.x() + rollers, size.x() + rollers, side * size.y());
        if (rollers > 0) AddRing(points, size.x(), size.x(), side * (size.y() + rollers));
      }
      break;
    }
    case mjGEOM_SPHERE:
      AddEllipsoid(points, Vec3::Constant(size.x()), 0);
      break;
    case mjGEOM_CAPSULE:
      AddEllipsoid(points, Vec3::Constant(size.x()), size.y());
      break;
    case mjGEOM_ELLIPSOID:
      AddEllipsoid(points, size, 0);
      break;
    case mjGEOM_MESH: {
      const int mesh = m->geom_dataid[geom];
      for (int v = m->mesh_vertadr[mesh]; v < m->mesh_vertadr[mesh] + m->mesh_vertnum[mesh]; ++v)
        points.emplace_back(m->mesh_vert[3 * v], m->mesh_vert[3 * v + 1], m->mesh_vert[3 * v + 2]);
      break;
    }
    default: {  // a box is its own bounds; of all else they must do
      const mjtNum* box = m->geom_aabb + 6 * geom;
      for (int k = 0; k < 8; ++k)
        points.emplace_back(box[0] + (k & 1 ? box[3] : -box[3]),
                            box[1] + (k & 2 ? box[4] : -box[4]),
                            box[2] + (k & 4 ? box[5] : -box[5]));
    }
  }
  return points;
}

std::array<float, 4> ColourOf(const mjModel* m, int geom) {
  const int material = m->geom_matid[geom];
  const float* rgba = material >= 0 ? m->mat_rgba + 4 * material : m->geom_rgba + 4 * geom;
  return {rgba[0], rgba[1], rgba[2], rgba[3]};
}

}  // namespace

std::vector<RobotPart> PartsOf(const RobotModel& robot) {
  const ModelPtr model = CompileAlone(robot);
  const mjModel* m = model.get();
  const CompiledRobot compiled(m, robot.spec.model_file);
  std::vector<RobotPart> parts;
  for (int g = 0; g < m->ngeom; ++g) {
    RobotPart part;
    part.rgba = ColourOf(m, g);
    if (part.rgba[3] <= 0) continue;
    using Kind = RobotPart::Kind;
    const bool carried = compiled.IsCarried(g);
    part.kind = carried ? (compiled.Collides(g) ? Kind::kBody : Kind::kLook)
                : IsDriven(m, m->geom_bodyid[g]) ? Kind::kWheel
                                                 : Kind::kCaster;
    const mjtNum* pos = compiled.data()->geom_xpos + 3 * g;
    const mjtNum* mat = compiled.data()->geom_xmat + 9 * g;
    for (const Vec3& p : OwnPoints(m, g)) {
      mjtNum p_W[3];
      mju_mulMatVec3(p_W, mat, p.data());
      mju_addTo3(p_W, pos);
      part.points_B.push_back(compiled.InBase(p_W));
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace floorproof

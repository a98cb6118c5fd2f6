// SPDX-License-Identifier: Apache-2.0
#include "env/scene/world_geoms.h"

#include <algorithm>
#include <cmath>

#include "env/scene/restitution.h"

namespace floorproof {
namespace {

// Contact softness that was sound at 1-5 ms (physics.md, "Settings that were sound").
constexpr double kTimeConstant_s = 0.01;
constexpr mjtNum kSolimp[] = {0.95, 0.99, 0.0005};

bool IsRectangle(const Polygon& p) {
  const Vec2 a = p[1] - p[0], b = p[2] - p[1], c = p[3] - p[2];
  return std::abs(a.dot(b)) < 1e-9 * a.norm() * b.norm() + 1e-15 && (a + c).norm() < 1e-9;
}

}  // namespace

WorldGeoms::WorldGeoms(const HazardMap& map, const ContactWalk& walk, mjSpec* spec)
    : map_(map),
      walk_(walk),
      spec_(spec),
      world_(mjs_findBody(spec, "world")),
      geom_names_(spec, mjOBJ_GEOM),
      mesh_names_(spec, mjOBJ_MESH) {}

mjsGeom* WorldGeoms::Add(GeomRole role, double friction, double restitution) {
  mjsGeom* geom = mjs_addGeom(world_, nullptr);
  const bool wall = role.kind == GeomRole::Kind::kWall;
  geom->contype = wall ? kWallBit : kFloorBit;
  geom->conaffinity = 0;
  geom->condim = 3;
  geom->priority = 1;  // what is met rules over the robot's own friction and softness
  geom->friction[0] = friction;
  const ContactSoftness softness = role.kind == GeomRole::Kind::kFloor
                                       ? ContactSoftness{kTimeConstant_s, 1}
                                       : SoftnessFor(restitution, walk_);
  geom->solref[0] = softness.time_constant_s;
  geom->solref[1] = softness.damping_ratio;
  std::copy(std::begin(kSolimp), std::end(kSolimp), geom->solimp);
  if (restitution > 0) geom->solimp[0] = geom->solimp[1];  // as SoftnessFor assumes
  all_.push_back({geom, role});
  const std::string name = geom_names_.For(Name(role));
  mjs_setName(geom->element, name.c_str());
  return geom;
}

// Names that a reader of the exported MJCF understands.
std::string WorldGeoms::Name(const GeomRole& role) const {
  const std::string number = std::to_string(all_.size());
  if (role.hazard >= 0)
    return map_.hazards[static_cast<std::size_t>(role.hazard)].id + "/" + number;
  return (role.kind == GeomRole::Kind::kWall ? "wall/" : "floor/") + number;
}

mjsGeom* WorldGeoms::Extrude(const Solid& solid, GeomRole role, double friction,
                             double restitution) {
  const Polygon &base = solid.base, &top = solid.top.empty() ? base : solid.top;
  const double z_low = solid.z_low_m, z_high = solid.z_high_m;
  mjsGeom* geom = Add(role, friction, restitution);
  if (base.size() == 4 && top == base && !IsSlope(solid) && IsRectangle(base)) {
    const Vec2 middle = (base[0] + base[2]) / 2, along = base[1] - base[0];
    geom->type = mjGEOM_BOX;
    geom->pos[0] = middle.x();
    geom->pos[1] = middle.y();
    geom->pos[2] = (z_low + z_high) / 2;
    SetYaw(geom->quat, std::atan2(along.y(), along.x()));
    geom->size[0] = along.norm() / 2;
    geom->size[1] = (base[2] - base[1]).norm() / 2;
    geom->size[2] = (z_high - z_low) / 2;
    return geom;
  }
  // Vertices around the middle, so that single precision costs nothing far from the origin.
  Vec2 middle = Vec2::Zero();
  for (const auto& p : base) middle += p / static_cast<double>(base.size());
  std::vector<float> vertices;
  const auto add = [&](const Vec2& p, double z) {
    for (const double v : {p.x() - middle.x(), p.y() - middle.y(), z - z_low})
      vertices.push_back(static_cast<float>(v));
  };
  for (const Vec2& p : base) add(p, z_low);
  for (const Vec2& p : top) add(p, TopAt(solid, p));
  mjsMesh* mesh = mjs_addMesh(spec_, nullptr);
  const std::string name = mesh_names_.For("mesh/" + std::to_string(all_.size()));
  mjs_setName(mesh->element, name.c_str());
  mjs_setFloat(mesh->uservert, vertices.data(), static_cast<int>(vertices.size()));
  geom->type = mjGEOM_MESH;
  mjs_setString(geom->meshname, name.c_str());
  geom->pos[0] = middle.x();
  geom->pos[1] = middle.y();
  geom->pos[2] = z_low;
  return geom;
}

void SetYaw(double* quat, double yaw_rad) {
  quat[0] = std::cos(yaw_rad / 2);
  quat[1] = quat[2] = 0;
  quat[3] = std::sin(yaw_rad / 2);
}

}  // namespace floorproof

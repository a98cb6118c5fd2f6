// SPDX-License-Identifier: Apache-2.0
#include "env/scene/exposed_wheels.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "env/geometry/geometry.h"
#include "env/scene/compiled_robot.h"
#include "env/scene/farthest_along.h"
#include "env/scene/walls.h"
#include "env/scene/world_geoms.h"

namespace floorproof {
namespace {

constexpr double kFlush_m = 1e-3;  // a wheel flush with the body's side is covered

struct Cover {
  int block = 0;
  Polygon outline_B;
};

// What walls meet, each geom for itself. What lies above the walls covers nothing.
std::vector<Cover> Covers(const CompiledRobot& compiled) {
  constexpr int kAround = 72;
  const mjModel* m = compiled.model();
  std::vector<Cover> covers;
  for (int g = 0; g < m->ngeom; ++g) {
    if (!compiled.IsCarried(g) || (m->geom_conaffinity[g] & kWallBit) == 0) continue;
    const int type = m->geom_type[g];
    if (type == mjGEOM_PLANE || type == mjGEOM_HFIELD || type == mjGEOM_SDF) continue;
    Eigen::Matrix3d R_GB;  // MuJoCo has rows first, Eigen columns
    mju_mulMatTMat(R_GB.data(), compiled.data()->xmat + 9 * compiled.base(),
                   compiled.data()->geom_xmat + 9 * g, 3, 3, 3);
    const Vec3 p_BG = compiled.InBase(compiled.data()->geom_xpos + 3 * g);
    const auto farthest = [&](const Vec3& way_B) {
      return Vec3(p_BG + R_GB.transpose() * FarthestAlong(m, g, R_GB * way_B));
    };
    if (farthest(-Vec3::UnitZ()).z() >= kWallHeight_m) continue;
    std::vector<Vec2> outline;
    for (int k = 0; k < kAround; ++k) {
      const double way_rad = 2 * kPi * k / kAround;
      outline.push_back(farthest({std::cos(way_rad), std::sin(way_rad), 0}).head<2>());
    }
    covers.push_back({compiled.BlockOf(m->geom_bodyid[g]), ConvexHull(outline)});
  }
  return covers;
}

bool IsExposed(const CompiledRobot& compiled, const std::vector<Cover>& covers, int geom) {
  const int block = compiled.BlockOf(compiled.model()->geom_bodyid[geom]);
  return std::ranges::any_of(compiled.SweptPoints(geom), [&](const Vec3& p) {
    return std::ranges::none_of(covers, [&](const Cover& cover) {
      return cover.block == block && SignedDistance(cover.outline_B, p.head<2>()) <= kFlush_m;
    });
  });
}

}  // namespace

void LetExposedWheelsMeetWalls(mjSpec* spec, const mjModel* model, const RobotSpec& robot) {
  CompiledRobot compiled(model, robot.model_file);
  for (const BlockSpec& block : robot.blocks)
    if (const int body = mj_name2id(model, mjOBJ_BODY, block.name.c_str());
        body >= 0 && !compiled.IsBlock(body))
      compiled.AddBlock(body);
  const std::vector<Cover> covers = Covers(compiled);
  for (mjsElement* e = mjs_firstElement(spec, mjOBJ_GEOM); e; e = mjs_nextElement(spec, e)) {
    const int g = mjs_getId(e);
    if (g < 0 || model->geom_bodyid[g] == 0 || compiled.IsCarried(g) || !compiled.Collides(g))
      continue;
    if (IsExposed(compiled, covers, g)) mjs_asGeom(e)->conaffinity |= kWallBit;
  }
}

}  // namespace floorproof

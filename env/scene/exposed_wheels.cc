// SPDX-License-Identifier: Apache-2.0
#include "env/scene/exposed_wheels.h"

#include <algorithm>
#include <vector>

#include "env/geometry/geometry.h"
#include "env/scene/compiled_robot.h"
#include "env/scene/world_geoms.h"

namespace floorproof {
namespace {

constexpr double kFlush_m = 1e-3;  // a wheel flush with the body's side is covered

struct Cover {
  int block = 0;
  Polygon outline_B;
};

// What walls meet: each geom for itself, as it collides by its hull.
std::vector<Cover> Covers(const CompiledRobot& compiled) {
  const mjModel* m = compiled.model();
  std::vector<Cover> covers;
  for (int g = 0; g < m->ngeom; ++g) {
    if (!compiled.IsCarried(g) || (m->geom_conaffinity[g] & kWallBit) == 0) continue;
    std::vector<Vec2> points;
    for (const Vec3& p : compiled.SurfacePoints(g)) points.push_back(p.head<2>());
    covers.push_back({compiled.BlockOf(m->geom_bodyid[g]), ConvexHull(points)});
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

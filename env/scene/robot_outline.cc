// SPDX-License-Identifier: Apache-2.0
#include "env/scene/robot_outline.h"

#include <algorithm>

#include "env/scene/compiled_robot.h"

namespace floorproof {
namespace {

bool Holds(const Polygon& outer, const Polygon& inner) {
  return std::ranges::all_of(inner, [&](const Vec2& p) { return Contains(outer, p); });
}

std::vector<Polygon> OutlinesOfGeoms(const RobotModel& robot) {
  const ModelPtr model = CompileAlone(robot);
  const CompiledRobot compiled(model.get(), robot.spec.model_file);
  std::vector<Polygon> outlines;
  for (int g = 0; g < model->ngeom; ++g) {
    if (!compiled.Collides(g)) continue;
    std::vector<Vec2> points;
    for (const Vec3& p : compiled.SweptPoints(g)) points.push_back(p.head<2>());
    Polygon outline = ConvexHull(std::move(points));
    if (outline.size() < 3 ||
        std::ranges::any_of(outlines, [&](const Polygon& o) { return Holds(o, outline); }))
      continue;
    std::erase_if(outlines, [&](const Polygon& o) { return Holds(outline, o); });
    outlines.push_back(std::move(outline));
  }
  return outlines;
}

}  // namespace

std::vector<Polygon> OutlineOf(const RobotModel& robot) {
  const RobotSpec& spec = robot.spec;
  if (!spec.shapes.empty())
    return ConvexParts({{spec.shapes[static_cast<std::size_t>(spec.shape)].footprint_B, {}}});
  if (spec.clear.kind == Shape2::Kind::kFootprint)
    return ConvexParts({{spec.clear.footprint_B, {}}});
  return OutlinesOfGeoms(robot);
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "run/plan_check/obstacles.h"

#include "env/core/levels.h"
#include "env/scene/walls.h"

namespace floorproof {

Obstacles::Obstacles(const HazardMap& known, const RobotSpec& robot, const Vec2& start_W) {
  for (const Box2& box : WallBoxes(known, robot, start_W))
    parts_.push_back({Rectangle(box.low, box.high), kWall});
  AddHazards(known, [&](const Hazard& hazard) { return IsObstacle(hazard, robot.step_m); });
  FindByPlace();
}

Obstacles Obstacles::OthersOf(const HazardMap& map, const RobotSpec& robot) {
  Obstacles others;
  others.AddHazards(map, [&](const Hazard& hazard) {
    return !hazard.known || !IsObstacle(hazard, robot.step_m);
  });
  others.FindByPlace();
  return others;
}

void Obstacles::FindByPlace() {
  std::vector<Box2> boxes;
  for (const Part& part : parts_) boxes.push_back(BoxAround(part.polygon_G));
  boxes_ = BoxGrid(std::move(boxes));
}

void Obstacles::AddHazards(const HazardMap& map, const std::function<bool(const Hazard&)>& counts) {
  const Pose2 X_GW = map.frame.X_WG.Inverse();
  const std::vector<std::vector<Polygon>> floors = BareFloors(map);
  for (std::size_t i = 0; i < map.hazards.size(); ++i) {
    ids_.push_back(map.hazards[i].id);
    if (!counts(map.hazards[i])) continue;
    for (const Polygon& bare : floors[i])
      for (Polygon part : ConvexParts({{bare, {}}})) {
        for (Vec2& p : part) p = X_GW * p;
        parts_.push_back({std::move(part), static_cast<int>(i)});
      }
  }
}

std::optional<Obstacles::Hit> Obstacles::Cast(const Vec2& from_G, const Vec2& direction_G,
                                              double most_m) {
  std::optional<Hit> nearest;
  const Vec2 to_G = from_G + most_m * direction_G;
  Near(from_G.cwiseMin(to_G), from_G.cwiseMax(to_G), [&](const Part& part) {
    const Polygon& polygon = part.polygon_G;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
      const double across = Cross(direction_G, edge);
      if (std::abs(across) < 1e-12) continue;
      const Vec2 to_corner = polygon[i] - from_G;
      const double along_m = Cross(to_corner, edge) / across;
      const double share = Cross(to_corner, direction_G) / across;
      if (along_m < 0 || along_m > most_m || share < 0 || share > 1) continue;
      if (!nearest || along_m < nearest->along_m) nearest = Hit{along_m, part.hazard};
    }
  });
  return nearest;
}

std::string Obstacles::Id(int hazard) const {
  return hazard == kWall ? "wall" : ids_[static_cast<std::size_t>(hazard)];
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "run/episode/intervention.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "env/core/standing.h"
#include "env/scene/walls.h"
#include "run/scenario/world.h"

namespace floorproof {
namespace {

// A footprint that overlaps by less stands beside: plans often run along borders of cells, and
// nobody sets a robot down more exactly.
constexpr double kBeside_m = 0.001;

Polygon Outline(const Shape2& shape) {
  if (shape.kind == Shape2::Kind::kFootprint) return shape.footprint_B;
  constexpr int kCorners = 64;  // within 0.12 % of the circle
  return RegularPolygon(Vec2::Zero(), shape.radius_m, kCorners);
}

// A level change that holds the whole of it is its floor.
bool TouchesHazard(const HazardMap& map, const Pose2& X_WB, const RobotSpec& robot,
                   const Polygon& footprint_B) {
  constexpr double kWhole = 1 - 1e-6;
  const std::vector<Region> footprint_W = {{InWorld(X_WB, footprint_B), {}}};
  return std::ranges::any_of(map.hazards, [&](const Hazard& hazard) {
    double met_m2 = 0;
    for (const Polygon& polygon : hazard.footprint)
      if (SignedDistance(polygon, X_WB.p()) < robot.circumscribed_radius_m)
        met_m2 += Area(Intersection(footprint_W, {polygon}));
    if (hazard.hazard_class == HazardClass::kLevelChange && met_m2 > kWhole * Area(footprint_W))
      return false;
    return met_m2 > 0;
  });
}

// Where the plan wants the body to head at this waypoint: as it says; else onwards, or at its end
// the way that led here.
double HeadingAt(const Path& path, std::size_t waypoint) {
  constexpr double kSamePlace_m = 1e-6;
  if (path[waypoint].yaw_rad) return *path[waypoint].yaw_rad;
  const Vec2& here = path[waypoint].p_W;
  for (std::size_t i = waypoint + 1; i < path.size(); ++i)
    if (const Vec2 way = path[i].p_W - here; way.norm() > kSamePlace_m)
      return std::atan2(way.y(), way.x());
  for (std::size_t i = waypoint; i-- > 0;)
    if (const Vec2 way = here - path[i].p_W; way.norm() > kSamePlace_m)
      return std::atan2(way.y(), way.x());
  return 0;
}

}  // namespace

std::optional<SetDownPlace> PlaceAhead(const World& world, const Path& path, std::size_t first) {
  const HazardMap& map = world.site.map;
  const RobotSpec& robot = world.robot.spec;
  const Grid<std::uint8_t> floor = FloorAround(map, world.start.p());
  const double drawn_back_m = std::min(map.inset_m, robot.inscribed_radius_m / 2);
  const Polygon outline_B = Outline(robot.clear), inner_B = Offset(outline_B, -kBeside_m),
                among_walls_B = Offset(inner_B, -drawn_back_m);
  for (std::size_t i = first; i < path.size(); ++i) {
    const Pose2 X_WB{path[i].p_W.x(), path[i].p_W.y(), HeadingAt(path, i)};
    const Cell cell = map.frame.ToCell(path[i].p_W);
    if (floor.Inside(cell) && floor(cell) && !TouchesWall(map, InWorld(X_WB, among_walls_B)) &&
        !TouchesHazard(map, X_WB, robot, inner_B))
      return SetDownPlace{i, X_WB};
  }
  return std::nullopt;
}

bool Interventions::Call(const Path& path, const Sample& failed) {
  if (params_.on_failure != "assist") return false;
  if (failed.battery_v == 0) return false;  // a robot without power goes on from nowhere
  const std::size_t ahead = failed.command.segment + 1;
  place_ = PlaceAhead(world_, path, ahead);
  if (!place_) {
    why_not_ = fmt::format("nowhere ahead of x {:.2f}, y {:.2f} m could the robot be set down: {}",
                           failed.p_WB.x(), failed.p_WB.y(),
                           ahead >= path.size()
                               ? "no waypoint is left"
                               : "at each waypoint left it would touch a hazard or a wall, or be "
                                 "walled off from its start");
    return false;
  }
  comes_s_ = failed.t_s + kComes_s;
  ++calls_;
  return true;
}

Intervention Interventions::SetDown(Plant& plant, RobotSide& side) {
  const Truth& failed = plant.truth();
  const Intervention help{failed.t_s, failed.p_WB.head<2>(), place_->X_WB.p(),
                          place_->X_WB.yaw_rad};
  plant.SetDown(place_->X_WB);
  side.GoOnFrom(place_->waypoint);
  place_.reset();
  return help;
}

}  // namespace floorproof

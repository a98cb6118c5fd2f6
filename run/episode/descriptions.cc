// SPDX-License-Identifier: Apache-2.0
#include "run/episode/descriptions.h"

#include <nlohmann/json.hpp>
#include <string_view>

#include "controllers/drive.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

Json PolygonJson(const Polygon& polygon) {
  Json json = Json::array();
  for (const Vec2& p : polygon) json.push_back(Json::array({p.x(), p.y()}));
  return json;
}

Json ShapeJson(const Shape2& shape) {
  if (shape.kind == Shape2::Kind::kCircle) return {{"circle_radius_m", shape.radius_m}};
  return {{"polygon_m", PolygonJson(shape.footprint_B)}};
}

std::string_view ClassText(HazardClass hazard_class) {
  switch (hazard_class) {
    case HazardClass::kBlindObject:
      return "blind_object";
    case HazardClass::kGlass:
      return "glass";
    case HazardClass::kLevelChange:
      return "level_change";
    case HazardClass::kTerrain:
      return "terrain";
  }
  return "?";
}

}  // namespace

Json DescribePose(const Pose2& pose) {
  return {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"yaw_rad", pose.yaw_rad}};
}

Json DescribeFrame(const GridFrame& frame) {
  return {{"width", frame.width},
          {"height", frame.height},
          {"cell_m", frame.cell_m},
          {"origin", DescribePose(frame.X_WG)}};
}

Json DescribeRobot(const RobotSpec& robot) {
  const auto drive = MakePlugin(Drives(), robot.drive, "drive");
  return {{"name", robot.name},
          {"drive", robot.drive},
          {"clear", ShapeJson(robot.clear)},
          {"tool", ShapeJson(robot.tool)},
          {"tool_width_m", robot.tool_width_m},
          {"inscribed_radius_m", robot.inscribed_radius_m},
          {"circumscribed_radius_m", robot.circumscribed_radius_m},
          {"height_m", robot.height_m},
          {"mass_kg", robot.mass_kg},
          {"holonomic", drive->holonomic()},
          {"turns_on_the_spot", drive->turns_on_the_spot()},
          {"turn_radius_m", robot.turn_radius_m},
          {"cruise_mps", robot.cruise_mps},
          {"max_speed_mps", robot.max_speed_mps},
          {"max_accel_mps2", robot.max_accel_mps2},
          {"max_yaw_rate_radps", robot.max_yaw_rate_radps},
          {"max_yaw_accel_radps2", robot.max_yaw_accel_radps2},
          {"step_m", robot.step_m}};
}

Json DescribeHazards(const HazardMap& map, std::optional<double> step_m) {
  Json json = Json::array();
  for (const Hazard& hazard : map.hazards) {
    Json polygons = Json::array();
    for (const Polygon& part : hazard.footprint) polygons.push_back(PolygonJson(part));
    Json one = {{"id", hazard.id},
                {"type", hazard.type},
                {"class", ClassText(hazard.hazard_class)},
                {"height_m", hazard.height_m},
                {"known", hazard.known}};
    if (step_m) one["keep_off"] = IsObstacle(hazard, *step_m);
    one["polygons_m"] = std::move(polygons);
    json.push_back(std::move(one));
  }
  return json;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "run/episode/plan_request_files.h"

#include <nlohmann/json.hpp>
#include <string>

#include "base/file_output.h"
#include "controllers/drive.h"
#include "env/core/coverage.h"
#include "media/media.h"
#include "run/episode/records.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

// Grey values, as ROS map_server writes them.
constexpr std::uint8_t kOccupied = 0, kUnknown = 205, kFree = 254;

Json PointJson(const Vec2& p) { return Json::array({p.x(), p.y()}); }

Json PolygonJson(const Polygon& polygon) {
  Json json = Json::array();
  for (const Vec2& p : polygon) json.push_back(PointJson(p));
  return json;
}

Json ShapeJson(const Shape2& shape) {
  if (shape.kind == Shape2::Kind::kCircle) return {{"circle_radius_m", shape.radius_m}};
  return {{"polygon_m", PolygonJson(shape.footprint_B)}};
}

Json PoseJson(const Pose2& pose) {
  return {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"yaw_rad", pose.yaw_rad}};
}

Json FrameJson(const GridFrame& frame) {
  return {{"width", frame.width},
          {"height", frame.height},
          {"cell_m", frame.cell_m},
          {"origin", PoseJson(frame.X_WG)}};
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

Json HazardsJson(const HazardMap& map, double step_m) {
  Json json = Json::array();
  for (const Hazard& hazard : map.hazards) {
    Json polygons = Json::array();
    for (const Polygon& part : hazard.footprint) polygons.push_back(PolygonJson(part));
    json.push_back({{"id", hazard.id},
                    {"type", hazard.type},
                    {"class", ClassText(hazard.hazard_class)},
                    {"height_m", hazard.height_m},
                    {"keep_off", IsObstacle(hazard, step_m)},
                    {"polygons_m", std::move(polygons)}});
  }
  return json;
}

// The layer as NAME.pgm and NAME.png, the top row first.
template <class T, class Grey>
void WriteLayer(const Grid<T>& layer, const Grey& grey, const std::filesystem::path& folder,
                const std::string& name) {
  Image image{layer.width, layer.height, 1, {}};
  image.data.reserve(layer.cells.size());
  for (int iy = layer.height - 1; iy >= 0; --iy)
    for (int ix = 0; ix < layer.width; ++ix) image.data.push_back(grey(layer(ix, iy)));
  WritePng(folder / (name + ".png"), image);
  WriteFileWhole(folder / (name + ".pgm"), "P5\n" + std::to_string(layer.width) + " " +
                                               std::to_string(layer.height) + "\n255\n" +
                                               std::string(image.data.begin(), image.data.end()));
}

std::uint8_t GreyOf(CellState state) {
  if (state == CellState::kFree) return kFree;
  return state == CellState::kOccupied ? kOccupied : kUnknown;
}

}  // namespace

Json RobotJson(const RobotSpec& robot) {
  const auto drive = MakePlugin(Drives(), robot.drive, "drive");
  return {{"name", robot.name},
          {"clear", ShapeJson(robot.clear)},
          {"tool", ShapeJson(robot.tool)},
          {"tool_width_m", robot.tool_width_m},
          {"inscribed_radius_m", robot.inscribed_radius_m},
          {"circumscribed_radius_m", robot.circumscribed_radius_m},
          {"height_m", robot.height_m},
          {"holonomic", drive->holonomic()},
          {"turns_on_the_spot", drive->turns_on_the_spot()},
          {"turn_radius_m", robot.turn_radius_m},
          {"cruise_mps", robot.cruise_mps},
          {"max_speed_mps", robot.max_speed_mps},
          {"max_accel_mps2", robot.max_accel_mps2},
          {"max_yaw_rate_radps", robot.max_yaw_rate_radps},
          {"step_m", robot.step_m}};
}

void WritePlanRequest(const PlanRequest& request, std::uint32_t seed,
                      const std::filesystem::path& folder) {
  const HazardMap& map = request.map;
  const RobotSpec& robot = request.robot;
  const SweepArea area =
      ComputeSweepArea(map, robot.clear, robot.tool, robot.step_m, request.start.p());
  Json goal;
  if (request.goal) goal = {{"x_m", request.goal->x()}, {"y_m", request.goal->y()}};
  Json map_json = {{"pgm", "map.pgm"}, {"png", "map.png"}};
  map_json.update(FrameJson(map.frame));
  map_json.update({{"occupied", kOccupied},
                   {"unknown", kUnknown},
                   {"free", kFree},
                   {"unknown_is_wall", map.unknown_is_wall}});
  Json reach_json = {{"pgm", "reach.pgm"}, {"png", "reach.png"}};
  reach_json.update(FrameJson(area.frame));
  reach_json.update({{"no", kOccupied}, {"yes", kFree}});
  Json risk_json = {{"csv", "risk.csv"}};
  risk_json.update(FrameJson(request.risk->grid.frame));
  const Json json = {{"request", kPlanRequestVersion},
                     {"robot", RobotJson(robot)},
                     {"start", PoseJson(request.start)},
                     {"goal", std::move(goal)},
                     {"seed", seed},
                     {"map", std::move(map_json)},
                     {"reach", std::move(reach_json)},
                     {"hazards", HazardsJson(map, robot.step_m)},
                     {"risk", std::move(risk_json)}};
  WriteLayer(map.occupancy, GreyOf, folder, "map");
  WriteLayer(
      area.reachable, [](std::uint8_t yes) { return yes != 0 ? kFree : kOccupied; }, folder,
      "reach");
  WriteFileWhole(folder / "risk.csv", RiskCsv(*request.risk));
  WriteFileWhole(folder / "request.json", JsonText(json) + "\n");
}

}  // namespace floorproof

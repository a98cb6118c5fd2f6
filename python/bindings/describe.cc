// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/describe.h"

#include <string>

namespace floorproof {

nb::tuple PoseTuple(const Pose2& pose) { return nb::make_tuple(pose.x_m, pose.y_m, pose.yaw_rad); }

nb::dict FrameDict(const GridFrame& frame) {
  nb::dict out;
  out["width"] = frame.width;
  out["height"] = frame.height;
  out["cell_m"] = frame.cell_m;
  out["origin"] = PoseTuple(frame.X_WG);
  return out;
}

nb::list PointList(const std::vector<Vec2>& points) {
  nb::list out;
  for (const Vec2& p : points) out.append(nb::make_tuple(p.x(), p.y()));
  return out;
}

nb::dict ShapeDict(const Shape2& shape) {
  nb::dict out;
  if (shape.kind == Shape2::Kind::kCircle)
    out["radius_m"] = shape.radius_m;
  else
    out["polygon"] = PointList(shape.footprint_B);
  return out;
}

nb::dict RobotDict(const RobotSpec& robot) {
  nb::dict out;
  out["name"] = robot.name;
  out["drive"] = robot.drive;
  out["clear"] = ShapeDict(robot.clear);
  out["tool"] = ShapeDict(robot.tool);
  out["tool_width_m"] = robot.tool_width_m;
  out["inscribed_radius_m"] = robot.inscribed_radius_m;
  out["circumscribed_radius_m"] = robot.circumscribed_radius_m;
  out["turn_radius_m"] = robot.turn_radius_m;
  out["mass_kg"] = robot.mass_kg;
  out["step_m"] = robot.step_m;
  out["cruise_mps"] = robot.cruise_mps;
  out["max_speed_mps"] = robot.max_speed_mps;
  out["max_accel_mps2"] = robot.max_accel_mps2;
  out["max_yaw_rate_radps"] = robot.max_yaw_rate_radps;
  out["max_yaw_accel_radps2"] = robot.max_yaw_accel_radps2;
  return out;
}

nb::list HazardList(const HazardMap& map) {
  nb::list out;
  for (const Hazard& hazard : map.hazards) {
    nb::dict one;
    one["id"] = hazard.id;
    one["type"] = hazard.type;
    one["hazard_class"] = "C" + std::to_string(1 + static_cast<int>(hazard.hazard_class));
    one["known"] = hazard.known;
    one["height_m"] = hazard.height_m;
    nb::list polygons;
    for (const Polygon& polygon : hazard.footprint) polygons.append(PointList(polygon));
    one["footprint"] = polygons;
    out.append(one);
  }
  return out;
}

void WarnOfProgram(const Scenario& scenario) {
  const PlanCommand* program = ProgramToAsk(scenario);
  if (program == nullptr) return;
  InPython("warnings.warn", [line = ProgramLine(*program)] {
    nb::module_::import_("floorproof._warn").attr("warn")(line);
  });
}

}  // namespace floorproof

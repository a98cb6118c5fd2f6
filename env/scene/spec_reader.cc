// SPDX-License-Identifier: Apache-2.0
#include "env/scene/spec_reader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <vector>

#include "env/scene/robot_changes.h"
#include "env/scene/robot_limits.h"
#include "env/scene/spec_parts.h"

namespace floorproof {
namespace {

void ReadCustom(const CompiledRobot& compiled, RobotSpec& robot) {
  robot.drive = compiled.Text("drive");
  robot.tool_width_m = compiled.Number("tool_width_m", kToolWidth_m);
  robot.step_m = compiled.Number("step_m", kStep_m);
  robot.cruise_mps = compiled.Number("cruise_mps", kSpeed_mps);
  robot.max_speed_mps = compiled.Number("max_speed_mps", Between(robot.cruise_mps, kSpeed_mps.max));
  robot.max_accel_mps2 = compiled.Number("max_accel_mps2", kAcceleration_mps2);
  robot.max_yaw_rate_radps = compiled.Number("max_yaw_rate_radps", kYawRate_radps);
  robot.max_yaw_accel_radps2 = compiled.Number("max_yaw_accel_radps2", kYawAcceleration_radps2);
  robot.hotel_load_w = compiled.Number("hotel_load_w", kPower_w);
  const auto optional = [&](const char* name, const Bounds& rule) {
    return compiled.OptionalNumber(name, rule).value_or(0);
  };
  const double degree = kPi / 180;
  robot.cover_forward_rad = degree * optional("cover_forward_deg", Between(0, 90));
  robot.cover_sideways_rad = degree * optional("cover_sideways_deg", Between(0, 90));
  robot.cover_speed_mps = optional("cover_speed_mps", Between(0.001, robot.max_speed_mps));
  robot.audit_speed_mps = optional("audit_speed_mps", Between(0.001, robot.max_speed_mps));
  robot.audit_dwell_s = optional("audit_dwell_s", kDwell_s);
  robot.audit_sensor_x_m = optional("audit_sensor_x_m", Between(0, 10));
}

// One battery feeds every driver: all have its voltage.
void ReadBattery(const CompiledRobot& compiled, RobotSpec& robot) {
  const mjModel* m = compiled.model();
  for (int a = 0; a < m->nu; ++a) {
    const double volt = DriverVoltage(m, a);
    if (robot.battery.voltage_v && *robot.battery.voltage_v != volt)
      throw InputError({compiled.file(), 0}, mj_id2name(m, mjOBJ_ACTUATOR, a), FormatDouble(volt),
                       "drivers on one battery have one voltage (Vmax), others have " +
                           FormatDouble(*robot.battery.voltage_v));
    robot.battery.voltage_v = volt;
  }
}

// As the model says; else the usual one.
Standstill ReadStandstill(const CompiledRobot& compiled, double mass_kg) {
  constexpr const char* kKey = "standstill";
  const auto text = compiled.OptionalText(kKey);
  if (!text) return UsualStandstill(mass_kg);
  for (const Standstill kind : {Standstill::kBrake, Standstill::kHold, Standstill::kFree})
    if (*text == Name(kind)) return kind;
  throw InputError({compiled.file(), 0}, kKey, *text, "must be brake, hold or free");
}

bool Holds(const Polygon& outer, const Polygon& inner) {
  return std::ranges::all_of(inner, [&](const Vec2& p) { return Contains(outer, p); });
}

// Adds the geom's outline, unless another one contains it.
void AddOutline(Polygon outline, std::vector<Polygon>& outlines) {
  if (outline.size() < 3 ||
      std::ranges::any_of(outlines, [&](const Polygon& o) { return Holds(o, outline); }))
    return;
  std::erase_if(outlines, [&](const Polygon& o) { return Holds(outline, o); });
  outlines.push_back(std::move(outline));
}

Shape2 ReadShape(const CompiledRobot& compiled, const char* key, double radius_m,
                 const Polygon& hull) {
  const std::string kind = compiled.Text(key);
  if (kind == "circle") return {Shape2::Kind::kCircle, radius_m, {}};
  if (kind == "footprint") return {Shape2::Kind::kFootprint, 0, hull};
  throw InputError({compiled.file(), 0}, key, kind, "must be circle or footprint");
}

void ReadBody(const CompiledRobot& compiled, RobotSpec& robot) {
  const mjModel* m = compiled.model();
  robot.mass_kg = m->body_subtreemass[compiled.base()];
  robot.p_BCom = compiled.InBase(compiled.data()->subtree_com + 3 * compiled.base());
  double low = std::numeric_limits<double>::infinity(), high = -low, reach = 0;
  std::vector<Vec2> outline;
  for (int g = 0; g < m->ngeom; ++g) {
    if (!compiled.Collides(g)) continue;
    Polygon points;
    for (const Vec3& p : compiled.SweptPoints(g)) {
      if (!(p.norm() <= kMaxReach_m))  // rollers are the robot's own data: MuJoCo knows no bound
        compiled.Refuse("geom " + std::to_string(g),
                        "must end within " + FormatDouble(kMaxReach_m) + " m of the robot's base");
      high = std::max(high, p.z());
      if (compiled.IsCarried(g)) low = std::min(low, p.z());
      reach = std::max(reach, p.head<2>().norm());
      points.push_back(p.head<2>());
    }
    outline.insert(outline.end(), points.begin(), points.end());
    AddOutline(ConvexHull(std::move(points)), robot.outline_B);
  }
  if (outline.empty()) compiled.Refuse("base", "the robot has nothing that collides");
  if (std::isinf(low))
    compiled.Refuse("base",
                    "nothing but wheels and casters collides: no wall would stop the robot's body; "
                    "give it a geom of conaffinity=\"3\"");
  if (!(low > 0))
    compiled.Refuse("base", "the body must stand above the floor (z = 0 of its frame)");
  robot.clearance_m = low;
  robot.height_m = high;
  const Polygon hull = ConvexHull(outline);
  robot.inscribed_radius_m = std::abs(SignedDistance(hull, Vec2::Zero()));
  robot.circumscribed_radius_m = reach;
  robot.clear = ReadShape(compiled, "clear_shape", reach, hull);
  robot.tool = ReadShape(compiled, "tool_shape", robot.tool_width_m / 2, hull);
  if (robot.clear.kind == Shape2::Kind::kFootprint) robot.outline_B = {hull};
}

}  // namespace

RobotSpec ReadSpec(const mjModel* model, const std::string& file) {
  RefuseBeyondLimits(model, file);
  CompiledRobot compiled(model, file);
  RobotSpec robot;
  robot.model_file = file;
  robot.name = std::filesystem::path(file).stem().string();
  ReadCustom(compiled, robot);
  ReadHinges(compiled, robot);
  ReadWheels(compiled, robot);
  ReadSteering(compiled, robot);
  ReadBattery(compiled, robot);
  ReadBody(compiled, robot);
  robot.standstill = ReadStandstill(compiled, robot.mass_kg);
  ReadShapes(compiled, robot);
  ReadMeasuredLimits(compiled, robot);
  return robot;
}

}  // namespace floorproof

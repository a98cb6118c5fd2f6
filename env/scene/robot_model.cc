// SPDX-License-Identifier: Apache-2.0
#include "env/scene/robot_model.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "env/core/params.h"
#include "env/scene/mecanum_wheel.h"
#include "env/scene/mjcf_check.h"

namespace floorproof {
namespace {

// Reads one compiled robot into a RobotSpec; every refusal names the file.
class SpecReader {
 public:
  SpecReader(const mjModel* model, std::string file) : m_(model), file_(std::move(file)) {}

  RobotSpec Read() {
    RobotSpec robot;
    robot.model_file = file_;
    robot.name = std::filesystem::path(file_).stem().string();
    base_ = mj_name2id(m_, mjOBJ_BODY, "base");
    if (base_ < 0) Refuse("base", "a robot needs a body named base");
    if (m_->body_jntnum[base_] != 1 || m_->jnt_type[m_->body_jntadr[base_]] != mjJNT_FREE)
      Refuse("base", "the body base needs a free joint");
    data_ = MakeData(m_);
    ForwardEngine(m_, data_.get());
    ReadCustom(robot);
    ReadWheels(robot);
    ReadBattery(robot);
    ReadBody(robot);
    robot.static_tip_rad = StaticTip(robot);
    return robot;
  }

 private:
  [[noreturn]] void Refuse(std::string_view key, std::string_view rule) const {
    throw InputError({file_, 0}, key, "", rule);
  }

  double Number(const char* name, const Bounds& rule) const {
    const int id = mj_name2id(m_, mjOBJ_NUMERIC, name);
    if (id < 0) Refuse(name, "missing under <custom>");
    const double value = m_->numeric_data[m_->numeric_adr[id]];
    if (!rule.Allows(value)) throw InputError({file_, 0}, name, FormatDouble(value), rule.Text());
    return value;
  }
  std::string Text(const char* name) const {
    const int id = mj_name2id(m_, mjOBJ_TEXT, name);
    if (id < 0) Refuse(name, "missing under <custom>");
    return m_->text_data + m_->text_adr[id];
  }

  void ReadCustom(RobotSpec& robot) const {
    robot.drive = Text("drive");
    robot.tool_width_m = Number("tool_width_m", Positive());
    robot.step_m = Number("step_m", NonNegative());
    robot.cruise_mps = Number("cruise_mps", Positive());
    robot.max_speed_mps = Number("max_speed_mps", AtLeast(robot.cruise_mps));
    robot.max_accel_mps2 = Number("max_accel_mps2", Positive());
    robot.max_yaw_rate_radps = Number("max_yaw_rate_radps", Positive());
    robot.max_yaw_accel_radps2 = Number("max_yaw_accel_radps2", Positive());
    robot.hotel_load_w = Number("hotel_load_w", NonNegative());
    if (mj_name2id(m_, mjOBJ_NUMERIC, "audit_speed_mps") >= 0)
      robot.audit_speed_mps = Number("audit_speed_mps", Between(0.001, robot.max_speed_mps));
    if (mj_name2id(m_, mjOBJ_NUMERIC, "audit_dwell_s") >= 0)
      robot.audit_dwell_s = Number("audit_dwell_s", NonNegative());
  }

  Vec3 InBase(const mjtNum* p_W) const {
    mjtNum offset[3], p_B[3];
    mju_sub3(offset, p_W, data_->xpos + 3 * base_);
    mju_mulMatTVec3(p_B, data_->xmat + 9 * base_, offset);
    return {p_B[0], p_B[1], p_B[2]};
  }

  void ReadWheels(RobotSpec& robot) const {
    if (m_->nu == 0) Refuse("actuator", "a robot needs at least one driven wheel");
    for (int a = 0; a < m_->nu; ++a) {
      WheelSpec wheel;
      const char* name = mj_id2name(m_, mjOBJ_ACTUATOR, a);
      wheel.name = name ? name : "actuator " + std::to_string(a);
      const int joint = m_->actuator_trnid[2 * a];
      if (m_->actuator_trntype[a] != mjTRN_JOINT || m_->jnt_type[joint] != mjJNT_HINGE)
        Refuse(wheel.name, "an actuator must drive a wheel's hinge");
      const int body = m_->jnt_bodyid[joint];
      int geom = -1;
      for (int g = m_->body_geomadr[body]; g < m_->body_geomadr[body] + m_->body_geomnum[body]; ++g)
        if (m_->geom_type[g] == mjGEOM_CYLINDER && m_->geom_conaffinity[g] != 0) geom = g;
      if (geom < 0) Refuse(wheel.name, "the wheel's body needs a cylinder that collides");
      const Rollers rollers = RollersOf(m_, geom);
      if (!(rollers.radius_m >= 0) || (rollers.radius_m > 0) != (rollers.angle_rad != 0) ||
          !(std::abs(rollers.angle_rad) < kPi / 2))
        Refuse(wheel.name,
               "user must be the rollers' radius (m, > 0) and angle (rad, not 0, within +-pi/2)");
      wheel.radius_m = m_->geom_size[3 * geom] + rollers.radius_m;
      wheel.roller_radius_m = rollers.radius_m;
      wheel.roller_angle_rad = rollers.angle_rad;
      wheel.p_BW = InBase(data_->geom_xpos + 3 * geom);
      if (m_->actuator_dyntype[a] != mjDYN_DCMOTOR && m_->actuator_gaintype[a] != mjGAIN_DCMOTOR)
        Refuse(wheel.name, "a wheel's actuator must be a <dcmotor input=\"vel\">");
      // A dcmotor's gain parameters: 0 resistance, 1 motor constant, 7 the driver's voltage.
      const mjtNum* gain = m_->actuator_gainprm + mjNGAIN * a;
      const double resistance = gain[0], constant = gain[1], volt = gain[7];
      if (!(resistance > 0 && constant > 0 && volt > 0))
        Refuse(wheel.name, "the dcmotor needs a resistance, a motor constant and a voltage (Vmax)");
      wheel.max_speed_radps = volt / constant;
      wheel.max_torque_nm = constant * volt / resistance;
      if (m_->actuator_forcelimited[a])
        wheel.max_torque_nm = std::min(wheel.max_torque_nm, m_->actuator_forcerange[2 * a + 1]);
      robot.wheels.push_back(wheel);
    }
  }

  // One battery feeds every driver: all have its voltage.
  void ReadBattery(RobotSpec& robot) const {
    for (int a = 0; a < m_->nu; ++a) {
      const double volt = DriverVoltage(m_, a);
      if (robot.battery.voltage_v && *robot.battery.voltage_v != volt)
        throw InputError({file_, 0}, mj_id2name(m_, mjOBJ_ACTUATOR, a), FormatDouble(volt),
                         "drivers on one battery have one voltage (Vmax), others have " +
                             FormatDouble(*robot.battery.voltage_v));
      robot.battery.voltage_v = volt;
    }
  }

  // Points on the surface of a geom that bound it, in the base frame.
  std::vector<Vec3> SurfacePoints(int geom) const {
    const mjtNum* size = m_->geom_size + 3 * geom;
    const mjtNum* pos = data_->geom_xpos + 3 * geom;
    const mjtNum* mat = data_->geom_xmat + 9 * geom;
    std::vector<Vec3> points;
    const auto add = [&](double x, double y, double z) {
      const mjtNum local[3] = {x, y, z};
      mjtNum world[3];
      mju_mulMatVec3(world, mat, local);
      mju_addTo3(world, pos);
      points.push_back(InBase(world));
    };
    constexpr int kAround = 72;
    const auto add_rings = [&](double radius, double half_height) {
      for (int k = 0; k < kAround; ++k) {
        const double c = radius * std::cos(2 * kPi * k / kAround);
        const double s = radius * std::sin(2 * kPi * k / kAround);
        add(c, s, -half_height);
        add(c, s, half_height);
      }
    };
    switch (m_->geom_type[geom]) {
      case mjGEOM_BOX:
        for (int k = 0; k < 8; ++k)
          add(k & 1 ? size[0] : -size[0], k & 2 ? size[1] : -size[1], k & 4 ? size[2] : -size[2]);
        break;
      case mjGEOM_CYLINDER: {
        const double rollers = RollersOf(m_, geom).radius_m;
        add_rings(size[0] + rollers, size[1]);
        if (rollers > 0) add_rings(size[0], size[1] + rollers);
        break;
      }
      case mjGEOM_SPHERE:
        add_rings(size[0], 0);
        add(0, 0, -size[0]);
        add(0, 0, size[0]);
        break;
      default: {  // the axis-aligned box in the geom's frame bounds every other type
        const mjtNum* box = m_->geom_aabb + 6 * geom;
        for (int k = 0; k < 8; ++k)
          add(box[0] + (k & 1 ? box[3] : -box[3]), box[1] + (k & 2 ? box[4] : -box[4]),
              box[2] + (k & 4 ? box[5] : -box[5]));
      }
    }
    return points;
  }

  bool Collides(int geom) const { return m_->geom_conaffinity[geom] || m_->geom_contype[geom]; }

  void ReadBody(RobotSpec& robot) const {
    robot.mass_kg = m_->body_subtreemass[base_];
    robot.p_BCom = InBase(data_->subtree_com + 3 * base_);
    double low = std::numeric_limits<double>::infinity(), high = -low, reach = 0;
    std::vector<Vec2> outline;
    for (int g = 0; g < m_->ngeom; ++g) {
      if (!Collides(g)) continue;
      for (const Vec3& p : SurfacePoints(g)) {
        high = std::max(high, p.z());
        if (m_->geom_bodyid[g] == base_) low = std::min(low, p.z());
        reach = std::max(reach, p.head<2>().norm());
        outline.push_back(p.head<2>());
      }
    }
    if (outline.empty()) Refuse("base", "the robot has nothing that collides");
    if (!(low > 0)) Refuse("base", "the body must stand above the floor (z = 0 of its frame)");
    robot.clearance_m = low;
    robot.height_m = high;
    const Polygon hull = ConvexHull(outline);
    double inscribed = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hull.size(); ++i)
      inscribed = std::min(inscribed,
                           DistanceToSegment(hull[i], hull[(i + 1) % hull.size()], Vec2::Zero()));
    robot.inscribed_radius_m = inscribed;
    robot.circumscribed_radius_m = reach;
    robot.clear = ReadShape("clear_shape", reach, hull);
    robot.tool = ReadShape("tool_shape", robot.tool_width_m / 2, hull);
  }

  Shape2 ReadShape(const char* key, double radius_m, const Polygon& hull) const {
    const std::string kind = Text(key);
    if (kind == "circle") return {Shape2::Kind::kCircle, radius_m, {}};
    if (kind == "footprint") return {Shape2::Kind::kFootprint, 0, hull};
    throw InputError({file_, 0}, key, kind, "must be circle or footprint");
  }

  // Least angle about an edge of the hull of the points that carry the robot: atan(d / h) with d
  // from the edge to the centre of mass, seen from above, and h its height.
  double StaticTip(const RobotSpec& robot) const {
    std::vector<Vec2> carriers;
    for (int g = 0; g < m_->ngeom; ++g) {
      if (!Collides(g) || m_->geom_bodyid[g] == base_) continue;
      const auto points = SurfacePoints(g);
      const auto lowest = std::ranges::min_element(points, {}, [](const Vec3& p) { return p.z(); });
      for (const auto& p : points)
        if (p.z() < lowest->z() + 1e-4) carriers.push_back(p.head<2>());
    }
    const Polygon hull = ConvexHull(carriers);
    if (hull.size() < 3)
      Refuse("wheels", "wheels and casters must support the robot on three points");
    const double d = -SignedDistance(hull, robot.p_BCom.head<2>());
    if (d <= 0) Refuse("base", "the centre of mass lies outside the wheels' support");
    return std::atan2(d, robot.p_BCom.z());
  }

  const mjModel* m_;
  std::string file_;
  DataPtr data_;
  int base_ = -1;
};

}  // namespace

std::span<const RobotEntry> Robots() {
  static constexpr RobotEntry kTable[] = {
#define FP_ROBOT(name, file, help) {name, file, help},
#include "models/list.inc"
#undef FP_ROBOT
  };
  return kTable;
}

std::filesystem::path ModelsFolder() {
  if (const char* folder = std::getenv("FLOORPROOF_MODELS")) return folder;
  return FLOORPROOF_MODELS_DIR;
}

std::filesystem::path FindRobotFile(const std::string& name_or_path, const SourceMark& mark) {
  std::vector<std::string> names;
  for (const auto& entry : Robots()) {
    if (entry.name == name_or_path) return ModelsFolder() / entry.file;
    names.emplace_back(entry.name);
  }
  if (name_or_path.ends_with(".xml")) return name_or_path;
  std::string rule = "unknown robot";
  if (const auto near = Nearest(name_or_path, names); !near.empty())
    rule += "; did you mean " + near + "?";
  throw InputError(mark, "robot", name_or_path,
                   rule + " (a name of `list robots`, or an .xml file)");
}

RobotModel ReadRobot(const std::filesystem::path& file, const RobotChanges& changes) {
  CheckMjcf(file);
  char error[1000] = "";
  RobotModel out;
  out.spec.reset(mj_parseXML(file.c_str(), nullptr, error, sizeof error));
  if (!out.spec) throw InputError({file.string(), 0}, "", error, "is not MJCF that MuJoCo reads");
  const auto read = [&] {
    ModelPtr model(mj_compile(out.spec.get(), nullptr));
    if (!model)
      throw InputError({file.string(), 0}, "", mjs_getError(out.spec.get()), "does not compile");
    return SpecReader(model.get(), file.string()).Read();
  };
  out.robot = read();
  if (ChangeRobot(out.spec.get(), out.robot, changes)) out.robot = read();
  return out;
}

}  // namespace floorproof

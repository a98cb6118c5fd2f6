// SPDX-License-Identifier: Apache-2.0
#include "env/scene/spec_reader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <sstream>
#include <vector>

#include "env/core/blocks.h"
#include "env/core/params.h"
#include "env/scene/engine.h"
#include "env/scene/lock_blocks.h"
#include "env/scene/mecanum_wheel.h"
#include "env/scene/robot_changes.h"

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
    ReadHinges(robot);
    ReadWheels(robot);
    ReadBattery(robot);
    ReadBody(robot);
    ReadShapes(robot);
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
  // The words of a text; none where there is no such text.
  std::vector<std::string> Words(const char* name) const {
    if (mj_name2id(m_, mjOBJ_TEXT, name) < 0) return {};
    std::istringstream in(Text(name));
    return {std::istream_iterator<std::string>(in), {}};
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

  // The block that the body is, or is carried by.
  int BlockOf(int body) const {
    for (; body > 0; body = m_->body_parentid[body])
      if (const auto at = std::ranges::find(block_bodies_, body); at != block_bodies_.end())
        return static_cast<int>(at - block_bodies_.begin());
    return 0;
  }

  // The hinge's joint by its actuator; its body becomes a block, in its parent's frame.
  HingeSpec ReadHinge(const std::string& name) {
    HingeSpec hinge;
    hinge.name = name;
    const int a = mj_name2id(m_, mjOBJ_ACTUATOR, name.c_str());
    if (a < 0) Refuse(name, "named under hinges, but there is no actuator of that name");
    const int joint = m_->actuator_trnid[2 * a];
    if (m_->actuator_trntype[a] != mjTRN_JOINT || m_->jnt_type[joint] != mjJNT_HINGE ||
        std::abs(std::abs(m_->jnt_axis[3 * joint + 2]) - 1) > 1e-9)
      Refuse(name, "must drive a hinge joint with a vertical axis");
    const int body = m_->jnt_bodyid[joint], parent = m_->body_parentid[body];
    if (std::ranges::find(block_bodies_, parent) == block_bodies_.end())
      Refuse(name, "its body must be a child of base or of a block whose hinge is named before");
    const mjtNum *p = m_->body_pos + 3 * body, *q = m_->body_quat + 4 * body;
    if (mju_norm3(p) > 1e-9 || std::abs(q[0]) < 1 - 1e-12)
      Refuse(name, "its body must stand in its parent's own frame (no pos, no orientation)");
    hinge.parent = BlockOf(parent);
    hinge.block = static_cast<int>(block_bodies_.size());
    block_bodies_.push_back(body);
    hinge.p_K = {m_->jnt_pos[3 * joint], m_->jnt_pos[3 * joint + 1]};
    hinge.sign = m_->jnt_axis[3 * joint + 2];
    hinge.model_rad = m_->qpos0[m_->jnt_qposadr[joint]];
    if (!m_->jnt_limited[joint]) Refuse(name, "its joint needs a range");
    hinge.min_rad = m_->jnt_range[2 * joint];
    hinge.max_rad = m_->jnt_range[2 * joint + 1];
    hinge.max_rate_radps = ReadMotor(a, name).no_load_radps;
    return hinge;
  }

  void ReadHinges(RobotSpec& robot) {
    block_bodies_ = {base_};
    for (const auto& name : Words(kLockedBlocks))
      block_bodies_.push_back(mj_name2id(m_, mjOBJ_BODY, name.c_str()));
    const auto names = Words("hinges");
    if (names.size() > HingeState::kMost)
      Refuse("hinges", "at most " + std::to_string(HingeState::kMost) + " are possible");
    for (const auto& name : names) robot.hinges.push_back(ReadHinge(name));
  }

  struct Motor {
    double no_load_radps, stall_nm;
  };
  Motor ReadMotor(int a, const std::string& name) const {
    if (m_->actuator_dyntype[a] != mjDYN_DCMOTOR && m_->actuator_gaintype[a] != mjGAIN_DCMOTOR)
      Refuse(name, "a wheel's or hinge's actuator must be a <dcmotor input=\"vel\">");
    // A dcmotor's gain parameters: 0 resistance, 1 motor constant, 7 the driver's voltage.
    const mjtNum* gain = m_->actuator_gainprm + mjNGAIN * a;
    const double resistance = gain[0], constant = gain[1], volt = gain[7];
    if (!(resistance > 0 && constant > 0 && volt > 0))
      Refuse(name, "the dcmotor needs a resistance, a motor constant and a voltage (Vmax)");
    Motor motor{volt / constant, constant * volt / resistance};
    if (m_->actuator_forcelimited[a])
      motor.stall_nm = std::min(motor.stall_nm, m_->actuator_forcerange[2 * a + 1]);
    return motor;
  }

  void ReadWheels(RobotSpec& robot) const {
    for (int a = 0; a < m_->nu; ++a) {
      WheelSpec wheel;
      const char* name = mj_id2name(m_, mjOBJ_ACTUATOR, a);
      wheel.name = name ? name : "actuator " + std::to_string(a);
      if (std::ranges::find(robot.hinges, wheel.name, &HingeSpec::name) != robot.hinges.end()) {
        if (a < m_->nu - static_cast<int>(robot.hinges.size()))
          Refuse(wheel.name, "the hinges' actuators must stand behind the wheels', in their order");
        continue;
      }
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
      wheel.half_width_m = m_->geom_size[3 * geom + 1];
      wheel.roller_radius_m = rollers.radius_m;
      wheel.roller_angle_rad = rollers.angle_rad;
      wheel.p_BW = InBase(data_->geom_xpos + 3 * geom);
      const Motor motor = ReadMotor(a, wheel.name);
      wheel.max_speed_radps = motor.no_load_radps;
      wheel.max_torque_nm = motor.stall_nm;
      wheel.block = BlockOf(body);
      // The wheel's axle, to the left; its own forward lies a quarter turn to the right of it.
      const mjtNum* axis_W = data_->xaxis + 3 * joint;
      wheel.yaw_rad = WrapAngle(std::atan2(axis_W[1], axis_W[0]) - kPi / 2);
      robot.wheels.push_back(wheel);
    }
    if (robot.wheels.empty()) Refuse("actuator", "a robot needs at least one driven wheel");
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
  // By the wheels: part of the chassis.
  bool Carried(int geom) const {
    return std::ranges::find(block_bodies_, m_->geom_bodyid[geom]) != block_bodies_.end();
  }

  void ReadBody(RobotSpec& robot) const {
    robot.mass_kg = m_->body_subtreemass[base_];
    robot.p_BCom = InBase(data_->subtree_com + 3 * base_);
    double low = std::numeric_limits<double>::infinity(), high = -low, reach = 0;
    std::vector<Vec2> outline;
    for (int g = 0; g < m_->ngeom; ++g) {
      if (!Collides(g)) continue;
      for (const Vec3& p : SurfacePoints(g)) {
        high = std::max(high, p.z());
        if (Carried(g)) low = std::min(low, p.z());
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

  // The blocks' outlines and the shapes that they can take; of a robot without, the one it has.
  void ReadShapes(RobotSpec& robot) const {
    const std::vector<double> none;
    if (robot.hinges.empty()) {
      robot.static_tip_rad = StaticTip(robot, none);
      return;
    }
    for (std::size_t k = 0; k < block_bodies_.size(); ++k) {
      std::vector<Vec2> points;
      for (int g = 0; g < m_->ngeom; ++g)
        if (Collides(g) && m_->geom_bodyid[g] == block_bodies_[k])
          for (const Vec3& p : SurfacePoints(g)) points.push_back(p.head<2>());
      const Polygon outline = ConvexHull(points);
      if (outline.size() < 3) Refuse("hinges", "every block needs a geom that collides");
      Vec2 centre = Vec2::Zero();
      for (const Vec2& p : outline) centre += p / static_cast<double>(outline.size());
      const char* name = mj_id2name(m_, mjOBJ_BODY, block_bodies_[k]);
      if (name == nullptr) Refuse("hinges", "every block's body needs a name");
      robot.blocks.push_back({name, outline, centre});
    }
    const auto names = Words("shapes");
    if (names.empty()) Refuse("shapes", "a robot with hinges needs its shapes' names");
    for (const auto& name : names) robot.shapes.push_back(ReadShape(robot, name));
    for (std::size_t h = 0; h < robot.hinges.size(); ++h)
      if (std::abs(robot.shapes[0].hinge_rad[h] - robot.hinges[h].model_rad) > 1e-6)
        Refuse("shape_" + names[0], "the first shape must be the one that the model stands in");
    robot.static_tip_rad = robot.shapes[0].static_tip_rad;
  }

  ShapeSpec ReadShape(const RobotSpec& robot, const std::string& name) const {
    ShapeSpec shape;
    shape.name = name;
    const std::string key = "shape_" + name;
    const int id = mj_name2id(m_, mjOBJ_NUMERIC, key.c_str());
    if (id < 0 || m_->numeric_size[id] != static_cast<int>(robot.hinges.size()))
      Refuse(key, "must be under <custom>, with an angle in degrees for each of the hinges");
    for (std::size_t h = 0; h < robot.hinges.size(); ++h) {
      const HingeSpec& hinge = robot.hinges[h];
      shape.hinge_rad.push_back(m_->numeric_data[m_->numeric_adr[id] + static_cast<int>(h)] * kPi /
                                180);
      constexpr double kStep_rad = kPi / 12;  // of the ways between shapes (controllers)
      if (std::abs(std::remainder(shape.hinge_rad[h], kStep_rad)) > 1e-6)
        Refuse(key, "angles must be multiples of 15 degrees");
      if (shape.hinge_rad[h] < hinge.min_rad || shape.hinge_rad[h] > hinge.max_rad)
        Refuse(key, "lies beyond the range of " + hinge.name);
    }
    shape.footprint_B = Footprint(robot.blocks, robot.hinges, shape.hinge_rad);
    shape.static_tip_rad = StaticTip(robot, shape.hinge_rad);
    return shape;
  }

  // Least angle about an edge of the hull of the points that carry the robot: atan(d / h) with d
  // from the edge to the centre of mass, seen from above, and h its height.
  double StaticTip(const RobotSpec& robot, const std::vector<double>& hinge_rad) const {
    const BlockMotions blocks = MoveBlocks(robot.blocks, robot.hinges, AtRest(hinge_rad));
    std::vector<Vec2> carriers;
    for (int g = 0; g < m_->ngeom; ++g) {
      if (!Collides(g) || Carried(g)) continue;
      const Pose2& X_BK = blocks.block[static_cast<std::size_t>(BlockOf(m_->geom_bodyid[g]))].X_BK;
      const auto points = SurfacePoints(g);
      const auto lowest = std::ranges::min_element(points, {}, [](const Vec3& p) { return p.z(); });
      for (const auto& p : points)
        if (p.z() < lowest->z() + 1e-4) carriers.push_back(X_BK * Vec2(p.head<2>()));
    }
    const Polygon hull = ConvexHull(carriers);
    if (hull.size() < 3)
      Refuse("wheels", "wheels and casters must support the robot on three points");
    Vec3 com = Vec3::Zero();
    for (int b = base_; b < m_->nbody; ++b) {
      const Vec3 p = InBase(data_->xipos + 3 * b);
      const Vec2 moved =
          blocks.block[static_cast<std::size_t>(BlockOf(b))].X_BK * Vec2(p.head<2>());
      com += m_->body_mass[b] / robot.mass_kg * Vec3(moved.x(), moved.y(), p.z());
    }
    const double d = -SignedDistance(hull, com.head<2>());
    if (d <= 0) Refuse("base", "the centre of mass lies outside the wheels' support");
    return std::atan2(d, com.z());
  }

  const mjModel* m_;
  std::string file_;
  DataPtr data_;
  int base_ = -1;
  std::vector<int> block_bodies_;  // the base first
};

}  // namespace

RobotSpec ReadSpec(const mjModel* model, const std::string& file) {
  return SpecReader(model, file).Read();
}

}  // namespace floorproof

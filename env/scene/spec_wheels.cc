// SPDX-License-Identifier: Apache-2.0
// Reads what motors turn: wheels, and the hinges between blocks.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "env/core/blocks.h"
#include "env/scene/robot_changes.h"
#include "env/scene/robot_limits.h"
#include "env/scene/spec_parts.h"
#include "env/scene/wheel_collider.h"

namespace floorproof {

Motor ReadMotor(const CompiledRobot& compiled, int a, const std::string& name) {
  const mjModel* m = compiled.model();
  if (m->actuator_dyntype[a] != mjDYN_DCMOTOR && m->actuator_gaintype[a] != mjGAIN_DCMOTOR)
    compiled.Refuse(name, "an actuator must be a <dcmotor input=\"vel\">");
  // A dcmotor's gain parameters: 0 resistance, 1 motor constant.
  const mjtNum* gain = m->actuator_gainprm + mjNGAIN * a;
  const double resistance = gain[0], constant = gain[1], volt = DriverVoltage(m, a);
  if (!(resistance > 0 && constant > 0 && volt > 0))
    compiled.Refuse(name, "the dcmotor needs a resistance, a motor constant and a voltage (Vmax)");
  // Of its controller: 4 to 6 are the gains kp, ki and kd of the speed or position that it holds.
  if (std::any_of(gain + 4, gain + 7, [](mjtNum k) { return !(k >= 0); }))
    compiled.Refuse(name, "its controller's gains must be 0 or more");
  Motor motor{volt / constant, constant * volt / resistance};
  if (m->actuator_forcelimited[a])
    motor.stall_nm = std::min(motor.stall_nm, m->actuator_forcerange[2 * a + 1]);
  const auto check = [&](double value, const char* what, const Bounds& rule) {
    if (!rule.Allows(value))
      compiled.Refuse(name, what + rule.Text() + ", is " + FormatDouble(value));
  };
  check(volt, "its driver's voltage (V) ", kMotorVoltage_v);
  check(motor.no_load_radps, "its speed without load (rad/s) ", kMotorSpeed_radps);
  check(motor.stall_nm, "its stall torque (N m) ", kMotorTorque_nm);
  return motor;
}

namespace {

// The hinge's joint by its actuator; its body becomes a block, in its parent's frame.
HingeSpec ReadHinge(CompiledRobot& compiled, const std::string& name) {
  const mjModel* m = compiled.model();
  HingeSpec hinge;
  hinge.name = name;
  const int a = mj_name2id(m, mjOBJ_ACTUATOR, name.c_str());
  if (a < 0) compiled.Refuse(name, "named under hinges, but there is no actuator of that name");
  const int joint = m->actuator_trnid[2 * a];
  if (m->actuator_trntype[a] != mjTRN_JOINT || m->jnt_type[joint] != mjJNT_HINGE ||
      std::abs(std::abs(m->jnt_axis[3 * joint + 2]) - 1) > 1e-9)
    compiled.Refuse(name, "must drive a hinge joint with a vertical axis");
  const int body = m->jnt_bodyid[joint], parent = m->body_parentid[body];
  if (!compiled.IsBlock(parent))
    compiled.Refuse(name,
                    "its body must be a child of base or of a block whose hinge is named before");
  const mjtNum *p = m->body_pos + 3 * body, *q = m->body_quat + 4 * body;
  if (mju_norm3(p) > 1e-9 || std::abs(q[0]) < 1 - 1e-12)
    compiled.Refuse(name, "its body must stand in its parent's own frame (no pos, no orientation)");
  hinge.parent = compiled.BlockOf(parent);
  hinge.block = static_cast<int>(compiled.blocks().size());
  compiled.AddBlock(body);
  hinge.p_K = {m->jnt_pos[3 * joint], m->jnt_pos[3 * joint + 1]};
  hinge.sign = m->jnt_axis[3 * joint + 2];
  hinge.model_rad = m->qpos0[m->jnt_qposadr[joint]];
  if (!m->jnt_limited[joint]) compiled.Refuse(name, "its joint needs a range");
  hinge.min_rad = m->jnt_range[2 * joint];
  hinge.max_rad = m->jnt_range[2 * joint + 1];
  hinge.max_rate_radps = ReadMotor(compiled, a, name).no_load_radps;
  return hinge;
}

// A wheel that turns about anything but its own axis is an eccentric, or a castor: it has no
// radius.
void RefuseOffAxis(const CompiledRobot& compiled, int joint, int geom, const std::string& name) {
  constexpr double kAskew = 1e-3, kBeside_m = 1e-4;
  const mjData* d = compiled.data();
  const Vec3 hinge_W(d->xaxis + 3 * joint);
  const mjtNum* R = d->geom_xmat + 9 * geom;
  const Vec3 axis_W(R[2], R[5], R[8]);
  const Vec3 arm_W = Vec3(d->geom_xpos + 3 * geom) - Vec3(d->xanchor + 3 * joint);
  if (hinge_W.cross(axis_W).norm() > kAskew || hinge_W.cross(arm_W).norm() > kBeside_m)
    compiled.Refuse(name, "the wheel's hinge must be its cylinder's axis");
}

WheelSpec ReadWheel(const CompiledRobot& compiled, int a, const std::string& name) {
  const mjModel* m = compiled.model();
  WheelSpec wheel;
  wheel.name = name;
  const int joint = m->actuator_trnid[2 * a];
  if (m->actuator_trntype[a] != mjTRN_JOINT || m->jnt_type[joint] != mjJNT_HINGE)
    compiled.Refuse(name, "an actuator must drive a wheel's hinge");
  const int body = m->jnt_bodyid[joint];
  int geom = -1;
  for (int g = m->body_geomadr[body]; g < m->body_geomadr[body] + m->body_geomnum[body]; ++g)
    if (m->geom_type[g] == mjGEOM_CYLINDER && m->geom_conaffinity[g] != 0) geom = g;
  if (geom < 0) {
    constexpr double kUpright = 0.9;
    const bool upright = std::abs(compiled.data()->xaxis[3 * joint + 2]) > kUpright;
    compiled.Refuse(name, std::string("the wheel's body needs a cylinder that collides") +
                              (upright ? "; what turns about the vertical is no wheel: a fork is "
                                         "named as steering, a hinge as hinges, under <custom>"
                                       : ""));
  }
  RefuseOffAxis(compiled, joint, geom, name);
  const Rollers rollers = RollersOf(m, geom);
  constexpr double kLeastAngle_rad = 0.1;  // along the axle rollers would be as long as it is far
  if (!(rollers.radius_m >= 0) || (rollers.radius_m > 0) != (rollers.angle_rad != 0) ||
      !(std::abs(rollers.angle_rad) < kPi / 2) ||
      (rollers.radius_m > 0 && !(std::abs(rollers.angle_rad) >= kLeastAngle_rad)))
    compiled.Refuse(name,
                    "user must be the rollers' radius (m, > 0) and angle (rad, 0.1 to pi/2, or as "
                    "much the other way)");
  wheel.radius_m = m->geom_size[3 * geom] + rollers.radius_m;
  if (!kWheelRadius_m.Allows(wheel.radius_m))
    compiled.Refuse(name, "the wheel's radius (m) " + kWheelRadius_m.Text() + ", is " +
                              FormatDouble(wheel.radius_m));
  wheel.half_width_m = m->geom_size[3 * geom + 1];
  wheel.roller_radius_m = rollers.radius_m;
  wheel.roller_angle_rad = rollers.angle_rad;
  wheel.p_BW = compiled.InBase(compiled.data()->geom_xpos + 3 * geom);
  const Motor motor = ReadMotor(compiled, a, name);
  wheel.max_speed_radps = motor.no_load_radps;
  wheel.max_torque_nm = motor.stall_nm;
  wheel.motor = DriveOf(m, a).value_or(VelocityDrive{});
  wheel.block = compiled.BlockOf(body);
  // The wheel's axle, to the left; its own forward lies a quarter turn to the right of it.
  const mjtNum* axis_W = compiled.data()->xaxis + 3 * joint;
  wheel.yaw_rad = WrapAngle(std::atan2(axis_W[1], axis_W[0]) - kPi / 2);
  return wheel;
}

}  // namespace

void ReadHinges(CompiledRobot& compiled, RobotSpec& robot) {
  const auto names = compiled.Words("hinges");
  if (names.size() > HingeState::kMax)
    compiled.Refuse("hinges", "at most " + std::to_string(HingeState::kMax) + " are possible");
  for (const auto& name : names) robot.hinges.push_back(ReadHinge(compiled, name));
}

void ReadWheels(const CompiledRobot& compiled, RobotSpec& robot) {
  const mjModel* m = compiled.model();
  std::vector<std::string> others = compiled.Words("hinges");
  for (std::string& name : compiled.Words("steering")) others.push_back(std::move(name));
  for (int a = 0; a < m->nu; ++a) {
    const std::string name = mj_id2name(m, mjOBJ_ACTUATOR, a);
    const auto behind = a - m->nu + static_cast<std::ptrdiff_t>(others.size());
    if (std::ranges::find(others, name) == others.end())
      robot.wheels.push_back(ReadWheel(compiled, a, name));
    else if (behind < 0 || others[static_cast<std::size_t>(behind)] != name)
      compiled.Refuse(name,
                      "the actuators of hinges and of steering must stand behind the wheels', in "
                      "the order in which they are named");
  }
  if (robot.wheels.empty()) compiled.Refuse("actuator", "a robot needs at least one driven wheel");
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Reads what steers: a fork on an upright hinge, and how tightly the robot turns by it.
#include <algorithm>
#include <cmath>

#include "env/scene/spec_parts.h"

namespace floorproof {
namespace {

constexpr double kSame_m = 1e-3;  // places that count as one

// The wheel that the fork's body carries.
std::size_t SteeredWheel(const CompiledRobot& compiled, const RobotSpec& robot, int fork,
                         const std::string& name) {
  const mjModel* m = compiled.model();
  std::size_t found = robot.wheels.size();
  for (std::size_t w = 0; w < robot.wheels.size(); ++w) {
    const int joint = m->actuator_trnid[2 * static_cast<int>(w)];
    int body = m->jnt_bodyid[joint];
    while (body > 0 && body != fork) body = m->body_parentid[body];
    if (body != fork) continue;
    if (found < robot.wheels.size()) compiled.Refuse(name, "its fork must carry one driven wheel");
    found = w;
  }
  if (found == robot.wheels.size())
    compiled.Refuse(name, "its fork must carry a driven wheel, in a body of its own");
  return found;
}

SteeringSpec ReadFork(const CompiledRobot& compiled, const RobotSpec& robot,
                      const std::string& name) {
  constexpr double kMost_rad = 89 * kPi / 180;
  const mjModel* m = compiled.model();
  const int a = mj_name2id(m, mjOBJ_ACTUATOR, name.c_str());
  if (a < 0) compiled.Refuse(name, "named under steering, but there is no actuator of that name");
  const int joint = m->actuator_trnid[2 * a];
  if (m->actuator_trntype[a] != mjTRN_JOINT || m->jnt_type[joint] != mjJNT_HINGE ||
      compiled.data()->xaxis[3 * joint + 2] < 1 - 1e-6)
    compiled.Refuse(name, "must drive a hinge joint whose axis points up");
  const int body = m->jnt_bodyid[joint];
  if (!compiled.IsBlock(m->body_parentid[body]))
    compiled.Refuse(name, "the fork's body must be a child of base");
  SteeringSpec fork;
  fork.name = name;
  fork.wheel = SteeredWheel(compiled, robot, body, name);
  const WheelSpec& wheel = robot.wheels[fork.wheel];
  const Vec3 off_B = wheel.p_BW - compiled.InBase(compiled.data()->xanchor + 3 * joint);
  if (off_B.head<2>().norm() > kSame_m)
    compiled.Refuse(name, "its axis must pass through the wheel's centre");
  if (!(std::abs(wheel.yaw_rad) < 1e-3))
    compiled.Refuse(name, "its wheel must point straight ahead in the model");
  if (!m->jnt_limited[joint]) compiled.Refuse(name, "its joint needs a range");
  fork.min_rad = m->jnt_range[2 * joint];
  fork.max_rad = m->jnt_range[2 * joint + 1];
  if (!(fork.min_rad < 0 && fork.min_rad >= -kMost_rad && fork.max_rad > 0 &&
        fork.max_rad <= kMost_rad))
    compiled.Refuse(name, "its range must hold 0 and end within 89 degrees to either side");
  fork.max_rate_radps = ReadMotor(compiled, a, name).no_load_radps;
  return fork;
}

// Wheels that only roll: they neither steer nor swivel, and the robot turns about their axle.
void RequireAxle(const CompiledRobot& compiled) {
  const mjModel* m = compiled.model();
  bool found = false;
  for (int g = 0; g < m->ngeom; ++g) {
    if (!compiled.Collides(g) || compiled.IsCarried(g) || compiled.SwivelOf(g)) continue;
    const int body = m->geom_bodyid[g];
    const auto rolls = [&](int j) {
      return m->jnt_type[j] == mjJNT_HINGE && std::abs(compiled.data()->xaxis[3 * j + 2]) < 0.1;
    };
    const auto driven = [&](int j) {
      for (int a = 0; a < m->nu; ++a)
        if (m->actuator_trnid[2 * a] == j) return true;
      return false;
    };
    for (int j = m->body_jntadr[body]; j >= 0 && j < m->body_jntadr[body] + m->body_jntnum[body];
         ++j) {
      if (!rolls(j) || driven(j)) continue;
      found = true;
      const Vec3 p_B = compiled.InBase(compiled.data()->geom_xpos + 3 * g);
      if (std::abs(p_B.x()) > kSame_m || std::abs(compiled.data()->xaxis[3 * j]) > 1e-3)
        compiled.Refuse(mj_id2name(m, mjOBJ_BODY, body) ? mj_id2name(m, mjOBJ_BODY, body) : "body",
                        "a robot that steers has its origin below the axle of the wheels that do "
                        "not steer: they must stand at x = 0 and roll along x");
    }
  }
  if (!found)
    compiled.Refuse("steering",
                    "a robot that steers needs wheels that roll along x on an axle at x = 0");
}

}  // namespace

void ReadSteering(const CompiledRobot& compiled, RobotSpec& robot) {
  const auto names = compiled.Words("steering");
  if (names.empty()) return;
  if (names.size() > 1) compiled.Refuse("steering", "must name one motor: one wheel can steer");
  RequireAxle(compiled);
  const SteeringSpec fork = ReadFork(compiled, robot, names.front());
  const double ahead_m = std::abs(robot.wheels[fork.wheel].p_BW.x());
  if (!(ahead_m > 10 * kSame_m))
    compiled.Refuse(fork.name, "the steered wheel must stand 10 mm or more from the axle at x = 0");
  robot.turn_radius_m = ahead_m / std::tan(std::min(fork.max_rad, -fork.min_rad));
  robot.steering = fork;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "env/scene/roller_wheels.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "env/scene/wheel_collider.h"

namespace floorproof {
namespace {

// The rollers' share of a wheel's mass. The pitch circle has about the core's radius; the wheel
// gains an inertia of about 2 % of its motor's armature in htetro.
constexpr double kRollersShare = 0.5;
// Ideal rollers turn freely, and these nearly do. A roller at 20 rad/s loses the torque of 0.3 mN
// at its tread, yet one that was lifted comes to rest within seconds.
constexpr double kDamping_nms = 1e-7;

// A Mecanum wheel in the spec, found before anything is changed.
struct Wheel {
  WheelSpec spec;
  mjsBody* body = nullptr;
  mjsGeom* core = nullptr;
  std::vector<mjsGeom*> drawn;  // rollers that are only seen
  // In the body's frame: the core's centre and axis, and the way down as the robot is placed.
  Vec3 centre = Vec3::Zero(), axle = Vec3::Zero(), down = Vec3::Zero();
  double mass_kg = 0;
};

std::vector<Wheel> FindWheels(mjSpec* spec, const RobotSpec& robot, const mjVFS* assets) {
  const ModelPtr model = CompileSpec(spec, assets);
  const DataPtr data = MakeData(model.get());
  ForwardEngine(model.get(), data.get());
  std::vector<Wheel> wheels;
  for (const WheelSpec& wheel_spec : robot.wheels) {
    Wheel wheel;
    wheel.spec = wheel_spec;
    wheel.body = mjs_getParent(DrivenJoint(spec, wheel_spec.name)->element);
    mjsElement* body = wheel.body->element;
    for (mjsElement* e = mjs_firstChild(wheel.body, mjOBJ_GEOM, 0); e;
         e = mjs_nextChild(wheel.body, e, 0)) {
      mjsGeom* geom = mjs_asGeom(e);
      if (RollersOf(geom).radius_m > 0)
        wheel.core = geom;
      else if (geom->type == mjGEOM_ELLIPSOID && geom->contype == 0 && geom->conaffinity == 0)
        wheel.drawn.push_back(geom);
    }
    if (wheel.core == nullptr) continue;
    const int b = mjs_getId(body), g = mjs_getId(wheel.core->element);
    mjtNum mat[9];
    mju_quat2Mat(mat, model->geom_quat + 4 * g);
    wheel.centre = Vec3(model->geom_pos + 3 * g);
    wheel.axle = Vec3(mat[2], mat[5], mat[8]);
    const Vec3 down(data->xmat[9 * b + 6], data->xmat[9 * b + 7], data->xmat[9 * b + 8]);
    wheel.down = (-down + down.dot(wheel.axle) * wheel.axle).normalized();
    wheel.mass_kg = model->body_mass[b];
    wheels.push_back(std::move(wheel));
  }
  return wheels;
}

// The hub keeps the drawn core and the rest of the mass.
void MakeHub(const Wheel& wheel) {
  ScaleMass(wheel.body, 1 - kRollersShare);
  wheel.core->contype = wheel.core->conaffinity = 0;
  mjs_setDouble(wheel.core->userdata, nullptr, 0);
}

// All that a robot's own defaults could have set otherwise is stated.
void AddRoller(const Wheel& wheel, const Vec3& outward, const std::string& name) {
  const WheelSpec& spec = wheel.spec;
  mjsBody* roller = mjs_addBody(wheel.body, nullptr);
  const Vec3 p = wheel.centre + (spec.radius_m - spec.roller_radius_m) * outward;
  std::copy_n(p.data(), 3, roller->pos);
  // As the collider of ideal wheels has it.
  const Vec3 axis = std::cos(spec.roller_angle_rad) * wheel.axle -
                    std::sin(spec.roller_angle_rad) * outward.cross(wheel.axle);
  mju_quatZ2Vec(roller->quat, axis.data());

  mjsJoint* hinge = mjs_addJoint(roller, nullptr);
  hinge->type = mjJNT_HINGE;
  const double z[3] = {0, 0, 1};
  std::copy(std::begin(z), std::end(z), hinge->axis);
  hinge->limited = mjLIMITED_FALSE;
  hinge->stiffness[0] = 0;
  hinge->damping[0] = kDamping_nms;
  hinge->frictionloss = 0;
  hinge->armature = 0;

  mjsGeom* geom = mjs_addGeom(roller, nullptr);
  mjs_setName(geom->element, name.c_str());
  geom->type = mjGEOM_ELLIPSOID;
  geom->size[0] = geom->size[1] = spec.roller_radius_m;
  geom->size[2] = RollerHalfLength(spec);
  geom->mass = kRollersShare * wheel.mass_kg / kRollers;
  geom->contype = 0;
  geom->conaffinity = wheel.core->conaffinity;
  geom->condim = 3;
  geom->priority = 0;
  geom->margin = geom->gap = 0;
  geom->group = wheel.core->group;
  const mjsGeom* look = wheel.drawn.empty() ? wheel.core : wheel.drawn.front();
  mjs_setString(geom->material, mjs_getString(look->material));
  std::copy(std::begin(look->rgba), std::end(look->rgba), geom->rgba);
}

// The feet with rollers in the place of cores, each with its wheel's tyre: one of them carries it.
std::vector<Foot> OnRollers(const std::vector<Foot>& ideal, const std::vector<Wheel>& wheels,
                            const mjModel& m) {
  std::vector<Foot> feet;
  for (const Foot& foot : ideal) {
    const auto wheel = std::ranges::find_if(wheels, [&](const Wheel& w) {
      return foot.geom == mjs_getString(mjs_getName(w.core->element));
    });
    if (wheel == wheels.end()) {
      feet.push_back(foot);
      continue;
    }
    for (int k = 0; k < kRollers; ++k) {
      Foot& roller = feet.emplace_back(foot);
      roller.geom = RollerPrefix(wheel->spec.name) + std::to_string(k);
      roller.rolls_m = wheel->spec.roller_radius_m;
      const int geom = mj_name2id(&m, mjOBJ_GEOM, roller.geom.c_str());
      roller.inverse_mass_pkg = m.body_invweight0[2 * m.geom_bodyid[geom]];
    }
  }
  return feet;
}

}  // namespace

std::string RollerPrefix(const std::string& wheel) { return wheel + "/roller/"; }

bool HasMecanumWheels(const RobotSpec& robot) {
  return std::ranges::any_of(robot.wheels, [](const auto& w) { return w.roller_radius_m > 0; });
}

double RollerHalfLength(const WheelSpec& wheel) {
  const double x = kPi / kRollers, r = wheel.roller_radius_m;
  const double drop = wheel.radius_m - (wheel.radius_m - r) * std::cos(x);
  const double slant = std::sin(wheel.roller_angle_rad) * std::sin(x);
  return std::sqrt(r * r + (drop * drop - r * r) / (slant * slant));
}

RobotModel WithRollerWheels(const RobotModel& robot) {
  RobotModel out{SpecPtr(mj_copySpec(robot.mjcf.get())), robot.spec, robot.files, robot.assets, {}};
  const std::vector<Wheel> wheels = FindWheels(out.mjcf.get(), robot.spec, robot.assets.get());
  for (const Wheel& wheel : wheels) {
    const Vec3 ahead = wheel.axle.cross(wheel.down);
    for (int k = 0; k < kRollers; ++k) {
      const double turn = 2 * kPi * k / kRollers;
      AddRoller(wheel, std::cos(turn) * wheel.down + std::sin(turn) * ahead,
                RollerPrefix(wheel.spec.name) + std::to_string(k));
    }
    MakeHub(wheel);
    for (mjsGeom* geom : wheel.drawn) mjs_delete(out.mjcf.get(), geom->element);
  }
  out.feet = OnRollers(robot.feet, wheels, *CompileAlone(out));
  DropLimits(out.spec.measured, "they are of ideal wheels");
  return out;
}

}  // namespace floorproof

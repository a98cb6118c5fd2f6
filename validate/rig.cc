// SPDX-License-Identifier: Apache-2.0
#include "validate/rig.h"

#include <algorithm>

#include "base/registry.h"
#include "env/scene/edge_contacts.h"
#include "env/scene/roller_wheels.h"

namespace floorproof {
namespace {

constexpr int kCells = 40;
constexpr double kCell_m = 0.5;

// Shapes that make the model wrong, on top of the changes that are meant; all else that is wrong
// about it alters the simulation.
RobotChanges WrongShape(RobotChanges changes, const RobotSpec& robot, const WrongModel& wrong) {
  if (wrong.wheel_radius_add_m != 0) {
    changes.wheel_radius_m = robot.wheels.front().radius_m + wrong.wheel_radius_add_m;
    changes.clearance_m = robot.clearance_m + wrong.wheel_radius_add_m;
  }
  return changes;
}

Alterations WrongValues(const WrongModel& wrong) {
  return {.floor_friction = wrong.friction_factor,
          .motor_resistance = wrong.resistance_factor,
          .battery_voltage = wrong.battery_factor,
          .hotel_load = wrong.hotel_load_factor};
}

}  // namespace

Rig::Rig(const std::string& robot_name, RigOptions options) {
  const auto file = FindRobotFile(robot_name, {});
  true_robot_ = ReadRobot(file, options.changes, options.blocks).spec;
  model_ = ReadRobot(file, WrongShape(options.changes, true_robot_, options.wrong), options.blocks);
  if (options.rollers) model_ = WithRollerWheels(model_);
  drive_ = MakePlugin(Drives(), true_robot_.drive, "drive", {true_robot_.model_file, 0});
  drive_->Configure(true_robot_);
  Build(std::move(options));
}

Rig::Rig(RobotModel body, RigOptions options) : true_robot_(body.spec), model_(std::move(body)) {
  Build(std::move(options));
}

void Rig::Build(RigOptions options) {
  wrong_ = options.wrong;
  map_.frame = {kCells, kCells, kCell_m, {-kCells * kCell_m / 2, -kCells * kCell_m / 2, 0}};
  map_.occupancy = Grid<CellState>(kCells, kCells);
  map_.hazards = std::move(options.hazards);
  for (Hazard& hazard : map_.hazards) {
    hazard.material.restitution *= wrong_.restitution_factor;
    hazard.material.rolling_drag *= wrong_.drag_factor;
  }
  map_.floor_friction = options.friction;
  scene_ = BuildScene(map_, model_, options.physics, {});
  mjModel* m = scene_.model.get();
  bool lower = false;
  for (int g = 0; g < m->ngeom; ++g) {
    const GeomRole& role = scene_.roles[static_cast<std::size_t>(g)];
    if (role.kind != GeomRole::Kind::kFloor || role.hazard >= 0) continue;
    if (lower) m->geom_pos[3 * g + 2] -= wrong_.seam_step_m;
    lower = !lower;
  }
  if (wrong_.contacts_forget) UnmarkBodyGeoms(m);
  for (int p = 0; p < m->npair; ++p)
    if (m->pair_solref[mjNREF * p] < 0) m->pair_solref[mjNREF * p] *= wrong_.tyre_factor;
  wheel_radps_.resize(true_robot_.wheels.size());
  if (!options.holds_still) model_.spec.standstill = Standstill::kFree;  // rigs push and tilt it
  sim_ = std::make_unique<Simulation>(scene_, map_, model_.spec);
  if (const Alterations wrong = WrongValues(wrong_); wrong != Alterations{}) sim_->Alter(wrong);
  SetGravity(-Vec3::UnitZ());
  sim_->Reset({});
}

void Rig::Command(const BodyTwist& twist, HingeState hinges) {
  twist_ = twist;
  hinges_ = hinges;
  steers_ = true_robot_.steering.has_value();
  Actuate();
}

void Rig::Actuate() {
  HingeState hinges = hinges_;
  hinges.TakeSteering(truth().hinges);
  hinges.steer_rad -= wrong_.steering_add_rad;
  drive_->ToWheels(twist_, hinges, wheel_radps_);
  sim_->SetWheelSpeeds(wheel_radps_);
  sim_->SetHingeSpeeds(hinges);
}

void Rig::CommandWheels(double wheel_radps) {
  steers_ = false;
  std::ranges::fill(wheel_radps_, wheel_radps);
  sim_->SetWheelSpeeds(wheel_radps_);
}

void Rig::Brake() {
  constexpr double kHold_nm = 1000;
  mjModel* m = sim_->model();
  for (int a = 0; a < static_cast<int>(true_robot_.wheels.size()); ++a)
    m->dof_frictionloss[m->jnt_dofadr[m->actuator_trnid[2 * a]]] = kHold_nm;
}

void Rig::SetBase(const Vec3& p_WB, const Eigen::Quaterniond& q_WB, const Vec3& v_WB_W) {
  const mjModel* m = scene_.model.get();
  const int joint = m->body_jntadr[scene_.base_body];
  mjtNum* q = data()->qpos + m->jnt_qposadr[joint];
  std::copy_n(p_WB.data(), 3, q);
  q[3] = q_WB.w();
  std::copy_n(q_WB.vec().data(), 3, q + 4);
  std::copy_n(v_WB_W.data(), 3, data()->qvel + m->jnt_dofadr[joint]);
  ForwardEngine(m, data());
}

void Rig::SetGravity(const Vec3& direction_W) {
  const Vec3 g = direction_W * kGravity_mps2 * wrong_.gravity_factor;
  std::copy_n(g.data(), 3, sim_->model()->opt.gravity);
}

void Rig::Step() {
  if (steers_) Actuate();
  if (!sim_->Step()) throw InternalError("the physics diverged on the rig: " + sim_->divergence());
}

BodyTwist Rig::Run(const BodyTwist& twist, double t_s) {
  Command(twist);
  const double start_s = truth().t_s;
  BodyTwist mean;
  int n = 0;
  while (truth().t_s < start_s + t_s) {
    Step();
    if (truth().t_s < start_s + t_s / 2) continue;
    const BodyTwist& v = truth().V_WB_B;
    mean.vx_mps += v.vx_mps;
    mean.vy_mps += v.vy_mps;
    mean.wz_radps += v.wz_radps;
    ++n;
  }
  return {mean.vx_mps / n, mean.vy_mps / n, mean.wz_radps / n};
}

RobotModel BodyFromMjcf(const std::string& mjcf) {
  char error[1000] = "";
  RobotModel out;
  out.mjcf.reset(mj_parseXMLString(mjcf.c_str(), nullptr, error, sizeof error));
  if (!out.mjcf) throw InternalError(std::string("a law's own body: ") + error);
  const ModelPtr model = CompileSpec(out.mjcf.get());
  out.spec.wheels.resize(static_cast<std::size_t>(model->nu));
  out.spec.mass_kg = mj_getTotalmass(model.get());
  out.feet = FeetOf(out.mjcf.get(), model.get(), out.spec);
  return out;
}

Hazard Prism(const std::string& id, const Polygon& base, const Polygon& top, double height_m) {
  Hazard hazard;
  hazard.id = id;
  hazard.solids = {{Solid::Kind::kPrism, base, top, 0, height_m}};
  return hazard;
}

}  // namespace floorproof

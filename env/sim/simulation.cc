// SPDX-License-Identifier: Apache-2.0
#include "env/sim/simulation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "env/core/standing.h"
#include "env/sim/divergence.h"

namespace floorproof {
namespace {

// Sets `quat` to the attitude `as`, turned about the vertical to this yaw.
void Tilt(const std::array<mjtNum, 4>& as, double yaw_rad, mjtNum* quat) {
  mjtNum R[9], turn[4];
  mju_quat2Mat(R, as.data());
  const mjtNum vertical[3] = {0, 0, 1};
  mju_axisAngle2Quat(turn, vertical, yaw_rad - std::atan2(R[3], R[0]));
  mju_mulQuat(quat, turn, as.data());
}

}  // namespace

double MotorTorque(const mjModel* m, const mjData* d, int actuator) {
  const auto drive = DriveOf(m, actuator);
  if (!drive) return d->actuator_force[actuator];
  return DriveTorque(*drive, d->ctrl[actuator],
                     d->qvel[m->jnt_dofadr[m->actuator_trnid[2 * actuator]]]);
}

Simulation::Simulation(const Scene& scene, const HazardMap& map, const RobotSpec& robot)
    : scene_(scene),
      map_(map),
      robot_(robot),
      own_(CopyModel(scene.model.get())),
      live_(scene, *own_),
      data_(MakeData(scene.model.get())),
      contacts_(scene, map, robot),
      hold_(robot, scene.model.get()),
      fine_steps_(scene, robot),
      cvel_(6 * static_cast<std::size_t>(scene.model->nbody)),
      cut_(robot.wheels.size(), 0),
      motor_nm_(static_cast<std::size_t>(scene.model->nu)),
      battery_(robot.battery),
      voltage_changes_(robot.battery.resistance_ohm > 0 || robot.battery.capacity_wh) {
  const mjModel* m = model();
  for (const HingeSpec& hinge : robot.hinges) {
    const int joint = m->actuator_trnid[2 * mj_name2id(m, mjOBJ_ACTUATOR, hinge.name.c_str())];
    hinge_qpos_.push_back(m->jnt_qposadr[joint]);
    hinge_dof_.push_back(m->jnt_dofadr[joint]);
  }
  if (robot.steering) {
    const int fork = mj_name2id(m, mjOBJ_ACTUATOR, robot.steering->name.c_str());
    const int joint = m->actuator_trnid[2 * fork];
    fork_qpos_ = m->jnt_qposadr[joint];
    fork_dof_ = m->jnt_dofadr[joint];
  }
  for (int a = 0; a < static_cast<int>(robot.wheels.size()); ++a) {
    const int joint = m->actuator_trnid[2 * a];
    wheel_bodies_.push_back(m->jnt_bodyid[joint]);
    wheel_qpos_.push_back(m->jnt_qposadr[joint]);
  }
  lowest_W_.resize(wheel_bodies_.size());
}

void Simulation::Place(const Pose2& X_WB) {
  mjtNum* q = data_->qpos + model()->jnt_qposadr[model()->body_jntadr[scene_.base_body]];
  const HingeState start = StartState(robot_);
  for (std::size_t h = 0; h < hinge_qpos_.size(); ++h)
    data_->qpos[hinge_qpos_[h]] = folded_ ? folded_->rad[h] : start.rad[h];
  if (robot_.steering) data_->qpos[fork_qpos_] = folded_ ? folded_->steer_rad : start.steer_rad;
  ReadHinges();
  const Vec2 p_WR = X_WB * Vec2(-blocks_.p_RB);
  q[0] = p_WR.x();
  q[1] = p_WR.y();
  q[3] = std::cos(X_WB.yaw_rad / 2);
  q[4] = q[5] = 0;
  q[6] = std::sin(X_WB.yaw_rad / 2);
}

void Simulation::Reset(const Pose2& X_WB) {
  mj_resetData(model(), data_.get());
  battery_ = BatteryInUse(robot_.battery);
  battery_.Weaken(altered_.battery_voltage);
  truth_ = Truth{};
  CutMotors({});
  StandStill();
  Settle(X_WB, 0);
}

// All that the engine remembers of the last place goes: velocities, the motors' state and orders,
// the solver's warm start, springs under load.
void Simulation::SetDown(const Pose2& X_WB) {
  mjData* d = data_.get();
  const double t_s = d->time;
  std::vector<mjtNum> turned_rad;
  for (const int adr : wheel_qpos_) turned_rad.push_back(d->qpos[adr]);
  mj_resetData(model(), d);
  for (std::size_t w = 0; w < turned_rad.size(); ++w) d->qpos[wheel_qpos_[w]] = turned_rad[w];
  StandStill();
  Settle(X_WB, t_s);
}

// Told to stand, and not held yet.
void Simulation::StandStill() {
  std::fill_n(data_->ctrl, robot_.wheels.size(), 0.0);
  hold_.Command({data_->ctrl, robot_.wheels.size()});
  hold_.Release(own_.get(), live_.model(), data_.get());
  live_.Refresh();
}

void Simulation::CarryTo(const Pose2& X_WB) {
  std::vector<mjtNum> orders(data_->ctrl, data_->ctrl + model()->nu);
  std::ranges::copy(hold_.command_radps(), orders.begin());
  folded_ = truth_.hinges;  // whoever takes it up does not fold it
  SetDown(X_WB);
  folded_.reset();
  std::ranges::copy(orders, data_->ctrl);
  hold_.Command(std::span(orders).first(robot_.wheels.size()));
  ++truth_.carried;
}

// Springs and contacts take a moment to carry the weight: it stands still for that long while the
// clock does not count, then is put exactly where it was asked for, at t_s. A load that was put on
// it is held until then: it might tip it.
void Simulation::Settle(const Pose2& X_WB, double t_s) {
  constexpr double kSettle_s = 0.5;
  mjData* d = data_.get();
  divergence_.clear();
  const double load_kg = std::exchange(altered_.payload_kg, 0);
  if (load_kg > 0) AlterPayload();
  const Standing stands = StandAt(map_, robot_, X_WB);
  mjtNum* q = d->qpos + model()->jnt_qposadr[model()->body_jntadr[scene_.base_body]];
  q[2] += stands.rests_m;
  Place(X_WB);
  SetDriverVoltages();
  while (d->time < kSettle_s) {
    live_.Update(d);
    WalkStep(model(), d, fine_steps_.OnFloor(model()), [this] { NoteDivergence(); });
    NoteDivergence();
  }
  if (!divergence_.empty()) divergence_ += ", while it settled on the floor";
  if (load_kg > 0) {
    altered_.payload_kg = load_kg;
    AlterPayload();
  }
  const std::array<mjtNum, 4> settled = {q[3], q[4], q[5], q[6]};
  Place(X_WB);
  // On terrain it stands as it came to rest: level, its wheels would be in what tilts it.
  if (stands.rests_m != stands.floor_m) Tilt(settled, X_WB.yaw_rad, q + 3);
  std::fill_n(d->qvel, model()->nv, 0.0);
  d->time = t_s;
  live_.Update(d);
  ForwardEngine(model(), d);
  ReadPose();
  contacts_.Reset();
  contacts_.BeginStep(1, truth_);
  contacts_.ReadLastPart(model(), data_.get(), lowest_W_, truth_);
  ReadPower(0);
}

void Simulation::SetWheelSpeeds(std::span<const double> wheel_radps) {
  std::copy(wheel_radps.begin(), wheel_radps.end(), data_->ctrl);
  HoldStuckWheels();
  hold_.Command({data_->ctrl, robot_.wheels.size()});
}

void Simulation::CutMotors(std::span<const char> cut) {
  const auto is_cut = [&](std::size_t w) { return w < cut.size() && cut[w] != 0; };
  bool changed = false;
  for (std::size_t w = 0; w < cut_.size(); ++w)
    changed |= std::exchange(cut_[w], is_cut(w) ? 1 : 0) != (is_cut(w) ? 1 : 0);
  if (!changed) return;
  AlterMotors();
  SetDriverVoltages();
}

void Simulation::HoldStuckWheels() {
  for (std::size_t w = 0; w < altered_.wheel_stuck_radps.size(); ++w)
    if (const auto& stuck_radps = altered_.wheel_stuck_radps[w]) data_->ctrl[w] = *stuck_radps;
}

bool Simulation::Step() {
  if (hold_.Update(own_.get(), live_.model(), data_.get(), cut_)) live_.Refresh();
  live_.Update(data_.get());
  parts_ = fine_steps_.Parts(model(), data_.get(), truth_);
  contacts_.BeginStep(parts_, truth_);
  bool first = true;
  WalkStep(model(), data_.get(), parts_, [&] {
    if (std::exchange(first, false)) std::copy_n(data_->cvel, cvel_.size(), cvel_.begin());
    contacts_.ReadPart(model(), data_.get(), truth_);
    NoteDivergence();
  });
  NoteDivergence();
  ReadPose();
  contacts_.ReadLastPart(model(), data_.get(), lowest_W_, truth_);
  // Sensors get the body velocities from before the step, divided or not.
  if (parts_ > 1) std::ranges::copy(cvel_, data_->cvel);
  ReadPower(model()->opt.timestep);
  if (divergence_.empty() &&
      !(std::isfinite(truth_.p_WB.sum()) && std::isfinite(truth_.v_WB_W.sum())))
    divergence_ = DescribeDivergence(model(), data_.get(), scene_.base_body);
  return divergence_.empty();
}

// The first one: what it leaves spreads to all bodies.
void Simulation::NoteDivergence() {
  if (divergence_.empty() && HasDiverged(data_.get()))
    divergence_ = DescribeDivergence(model(), data_.get(), scene_.base_body);
}

void Simulation::SetHingeSpeeds(const HingeState& hinges) {
  mjtNum* ctrl = data_->ctrl + robot_.wheels.size();
  ctrl = std::copy_n(hinges.radps.begin(), hinge_dof_.size(), ctrl);
  if (robot_.steering) *ctrl = hinges.steer_radps;
}

void Simulation::ReadHinges() {
  truth_.shape = robot_.shape;
  if (robot_.steering) {
    truth_.hinges.steered = true;
    truth_.hinges.steer_rad = data_->qpos[fork_qpos_];
    truth_.hinges.steer_radps = data_->qvel[fork_dof_];
  }
  if (hinge_dof_.empty()) return;
  truth_.hinges.n = static_cast<int>(hinge_dof_.size());
  for (std::size_t h = 0; h < hinge_dof_.size(); ++h) {
    truth_.hinges.rad[h] = data_->qpos[hinge_qpos_[h]];
    truth_.hinges.radps[h] = data_->qvel[hinge_dof_[h]];
  }
  truth_.shape = ShapeOf(robot_, truth_.hinges, kInShape_rad);
  blocks_ = MoveBlocks(robot_.blocks, robot_.hinges, truth_.hinges);
}

void Simulation::ReadPose() {
  // qpos and qvel are the state after the step; xpos and the like are from before it. The free
  // joint's linear velocity is in the world frame, its angular velocity in the body's.
  const mjModel* m = model();
  const mjData* d = data_.get();
  const int joint = m->body_jntadr[scene_.base_body];
  const mjtNum* q = d->qpos + m->jnt_qposadr[joint];
  const mjtNum* v = d->qvel + m->jnt_dofadr[joint];
  mjtNum R[9];
  mju_quat2Mat(R, q + 3);
  ReadHinges();
  truth_.t_s = d->time;
  truth_.roll_rad = std::atan2(R[7], R[8]);
  truth_.pitch_rad = std::asin(std::clamp(-R[6], -1.0, 1.0));
  truth_.yaw_rad = std::atan2(R[3], R[0]);
  truth_.tilt_rad = std::acos(std::clamp(R[8], -1.0, 1.0));
  Vec3 w_W;
  mju_mulMatVec3(w_W.data(), R, v + 3);
  // From the base block's frame R to B, which moves against it as the hinges turn.
  const mjtNum p_RB[3] = {blocks_.p_RB.x(), blocks_.p_RB.y(), 0};
  const mjtNum v_RB[3] = {blocks_.v_RB.x(), blocks_.v_RB.y(), 0};
  mjtNum arm_W[3], slide_W[3], v_B[3];
  mju_mulMatVec3(arm_W, R, p_RB);
  mju_mulMatVec3(slide_W, R, v_RB);
  truth_.p_WB = Vec3(q[0], q[1], q[2]) + Vec3(arm_W[0], arm_W[1], arm_W[2]);
  truth_.v_WB_W = Vec3(v[0], v[1], v[2]) + w_W.cross(Vec3(arm_W[0], arm_W[1], arm_W[2])) +
                  Vec3(slide_W[0], slide_W[1], slide_W[2]);
  mju_mulMatTVec3(v_B, R, truth_.v_WB_W.data());
  truth_.V_WB_B = {v_B[0], v_B[1], v[5]};

  double lowest = 1e9;
  truth_.rim_mps = 0;
  for (std::size_t w = 0; w < wheel_bodies_.size(); ++w) {
    // Lowest point of a cylinder whose axle is tilted: radius and half width share the drop; its
    // rollers round it.
    const WheelSpec& wheel = robot_.wheels[w];
    const mjtNum* up = d->xmat + 9 * wheel_bodies_[w] + 6;  // the world's z in the body's axes
    const double axle_z = mju_dot3(up, m->jnt_axis + 3 * m->actuator_trnid[2 * w]);
    const double drop =
        (wheel.radius_m - wheel.roller_radius_m) * std::sqrt(std::max(0.0, 1 - axle_z * axle_z)) +
        wheel.half_width_m * std::abs(axle_z) + wheel.roller_radius_m;
    const mjtNum* p_W = d->xpos + 3 * wheel_bodies_[w];
    lowest_W_[w] = {p_W[0], p_W[1], p_W[2] - drop};
    lowest = std::min(lowest, lowest_W_[w].z());
    const double omega_radps = d->qvel[m->jnt_dofadr[m->actuator_trnid[2 * w]]];
    truth_.rim_mps +=
        std::abs(omega_radps) * wheel.radius_m / static_cast<double>(wheel_bodies_.size());
  }
  truth_.wheel_floor_z_m = lowest;
}

void Simulation::ReadPower(double dt_s) {
  const mjModel* m = model();
  const mjData* d = data_.get();
  double load_w = robot_.hotel_load_w * altered_.hotel_load;
  for (int a = 0; a < m->nu; ++a) {
    const mjtNum* gain = m->actuator_gainprm + mjNGAIN * a;
    const int dof = m->jnt_dofadr[m->actuator_trnid[2 * a]];
    double& torque_nm = motor_nm_[static_cast<std::size_t>(a)];
    torque_nm = MotorTorque(m, d, a);
    load_w += MotorPower(torque_nm, d->qvel[dof], gain[0], gain[1]);
  }
  const BatteryOutput out = battery_.Feed(load_w, dt_s);
  truth_.power_w = out.power_w();
  truth_.battery_v = out.voltage_v;
  truth_.battery_a = out.current_a;
  SetDriverVoltages();
}

// What the drivers can give in the next step.
void Simulation::SetDriverVoltages() {
  if (!voltage_changes_) return;
  for (int a = 0; a < model()->nu; ++a) SetDriverVoltage(model(), a, battery_.voltage_v());
}

}  // namespace floorproof

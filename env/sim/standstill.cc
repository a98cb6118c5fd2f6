// SPDX-License-Identifier: Apache-2.0
#include "env/sim/standstill.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace floorproof {
namespace {

constexpr double kMoment_s = 0.1;     // for which wheels stand before they are held
constexpr double kStands_mps = 0.05;  // slower than that is a rim: a driver that gives way creeps
constexpr double kStiffness_radps = 10;  // commanded speed, for each radian of error
// How much stiffer the contacts' friction is than their normal forces: MuJoCo's `impratio`.
constexpr double kFrictionStiffness = 1e4;
// The engine's usual softness would let a held wheel creep.
constexpr double kStable = 0.05;  // of a wheel's inertia over the time step squared
constexpr double kBack_s = 0.05;  // in which a wheel that has crept is back
constexpr double kQuickest = 2;   // time steps, the engine's least time constant
constexpr mjtNum kHard[mjNIMP] = {0.9999, 0.9999, 0.001, 0.5, 2};

}  // namespace

StandstillHold::StandstillHold(const RobotSpec& robot, const mjModel* m) : kind_(robot.standstill) {
  for (std::size_t w = 0; w < robot.wheels.size(); ++w) {
    const int joint = m->actuator_trnid[2 * w];
    dofs_.push_back(m->jnt_dofadr[joint]);
    qpos_.push_back(m->jnt_qposadr[joint]);
    radius_m_ = std::max(radius_m_, robot.wheels[w].radius_m);
  }
  brake_nm_ = 2 * robot.mass_kg * -m->opt.gravity[2] * radius_m_;  // beyond any grip
  command_radps_.resize(dofs_.size());
  held_rad_.resize(dofs_.size());
  crept_rad_s_.resize(dofs_.size());
  loss_nm_.resize(dofs_.size());
  solimp_.resize(mjNIMP * dofs_.size());
  solref_.resize(mjNREF * dofs_.size());
}

void StandstillHold::Command(std::span<const double> wheel_radps) {
  std::ranges::copy(wheel_radps, command_radps_.begin());
}

bool StandstillHold::Update(mjModel* own, mjModel* live, mjData* d, std::span<const char> cut) {
  if (kind_ == Standstill::kFree) return false;
  const bool powered = std::ranges::none_of(cut, [](char c) { return c != 0; });
  const bool stops = std::ranges::all_of(command_radps_, [](double w) { return w == 0; });
  if (!stops || (kind_ == Standstill::kHold && !powered)) {
    if (!engaged_) return false;
    Release(own, live, d);
    return true;
  }
  const bool engages = !engaged_;
  if (engages) {
    const bool stands = std::ranges::all_of(
        dofs_, [&](int dof) { return std::abs(d->qvel[dof]) * radius_m_ < kStands_mps; });
    stood_s_ = stands ? stood_s_ + own->opt.timestep : 0;
    if (stood_s_ < kMoment_s) return false;
    Engage(own, live, d);
  }
  for (std::size_t w = 0; w < dofs_.size(); ++w) {
    const double off_rad = d->qpos[qpos_[w]] - held_rad_[w];
    if (kind_ == Standstill::kHold) {
      d->ctrl[w] = -kStiffness_radps * off_rad;
      continue;
    }
    // What dry friction alone would let creep.
    const double dt_s = own->opt.timestep;
    const double stiffness_nm = kStable * own->dof_M0[dofs_[w]] / (dt_s * dt_s);
    crept_rad_s_[w] += off_rad * dt_s;
    d->qfrc_applied[dofs_[w]] =
        std::clamp(-stiffness_nm * (off_rad + crept_rad_s_[w] / kBack_s), -brake_nm_, brake_nm_);
  }
  return engages;
}

void StandstillHold::Engage(mjModel* own, mjModel* live, const mjData* d) {
  engaged_ = true;
  impratio_ = std::exchange(live->opt.impratio, kFrictionStiffness);
  for (std::size_t w = 0; w < dofs_.size(); ++w) {
    held_rad_[w] = d->qpos[qpos_[w]];
    crept_rad_s_[w] = 0;
    if (kind_ != Standstill::kBrake) continue;
    mjtNum* solimp = own->dof_solimp + mjNIMP * dofs_[w];
    loss_nm_[w] = std::exchange(own->dof_frictionloss[dofs_[w]], brake_nm_);
    std::copy_n(solimp, mjNIMP, &solimp_[mjNIMP * w]);
    std::copy_n(kHard, mjNIMP, solimp);
    mjtNum* solref = own->dof_solref + mjNREF * dofs_[w];
    std::copy_n(solref, mjNREF, &solref_[mjNREF * w]);
    solref[0] = kQuickest * own->opt.timestep;
    solref[1] = 1;
  }
}

void StandstillHold::Release(mjModel* own, mjModel* live, mjData* d) {
  stood_s_ = 0;
  if (!std::exchange(engaged_, false)) return;
  live->opt.impratio = impratio_;
  if (kind_ != Standstill::kBrake) return;
  for (std::size_t w = 0; w < dofs_.size(); ++w) {
    d->qfrc_applied[dofs_[w]] = 0;
    own->dof_frictionloss[dofs_[w]] = loss_nm_[w];
    std::copy_n(&solimp_[mjNIMP * w], mjNIMP, own->dof_solimp + mjNIMP * dofs_[w]);
    std::copy_n(&solref_[mjNREF * w], mjNREF, own->dof_solref + mjNREF * dofs_[w]);
  }
}

}  // namespace floorproof

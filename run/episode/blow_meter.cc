// SPDX-License-Identifier: Apache-2.0
#include "run/episode/blow_meter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "env/failures/posture.h"

namespace floorproof {

BlowMeter::BlowMeter(const RobotSpec& robot, double timestep_s)
    : p_BCom_(robot.p_BCom),
      mass_kg_(robot.mass_kg),
      timestep_s_(timestep_s),
      energy_j_(std::max<std::size_t>(1, static_cast<std::size_t>(kBlow_s / timestep_s)), 0.0) {}

void BlowMeter::OnStep(const Truth& truth) {
  const Vec3 com_W = truth.p_WB + Attitude(truth) * p_BCom_;
  const Vec3 last_W = std::exchange(last_W_, com_W);
  if (!std::exchange(has_last_, true)) return;
  const double v2 = (com_W - last_W).squaredNorm() / (timestep_s_ * timestep_s_);
  const double now_j = mass_kg_ * v2 / 2;
  hardest_j_ = std::max(hardest_j_, *std::ranges::max_element(energy_j_) - now_j);
  energy_j_[step_++ % energy_j_.size()] = now_j;
}

void BlowMeter::Lift() {
  std::ranges::fill(energy_j_, 0.0);
  has_last_ = false;
}

double BlowMeter::Take() { return std::exchange(hardest_j_, 0.0); }

}  // namespace floorproof

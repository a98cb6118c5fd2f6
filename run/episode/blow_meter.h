// SPDX-License-Identifier: Apache-2.0
// How hard a robot falls or is hit: what a moment takes of its energy of motion.
//
// Energy of motion is m v^2 / 2 of the centre of mass, all three directions. A blow is what it
// loses within kBlow_s: a wall takes all of it, a drop gives m g h, which landing takes, and a
// robot that rolls down a ramp loses nothing. What is not in it: the energy of turning, a fourth of
// a block's that topples about its edge, and that a blow may meet one corner alone. Its own brakes
// count, too.
#pragma once

#include <cstddef>
#include <vector>

#include "env/core/motion.h"
#include "env/core/robot_spec.h"

namespace floorproof {

class BlowMeter {
 public:
  BlowMeter(const RobotSpec& robot, double timestep_s);

  // Every physics step. Allocates nothing.
  void OnStep(const Truth& truth);
  // It was carried, or set down.
  void Lift();
  // The hardest since this was last asked, J.
  double Take();

 private:
  // The engine's contacts are soft: what is hit takes some 40 ms to take all.
  static constexpr double kBlow_s = 0.06;

  Vec3 p_BCom_;
  double mass_kg_, timestep_s_;
  std::vector<double> energy_j_;  // of the last steps, a ring
  std::size_t step_ = 0;
  bool has_last_ = false;
  Vec3 last_W_ = Vec3::Zero();
  double hardest_j_ = 0;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A robot's feet: wheels, casters and rollers, each with its tyre.
#pragma once

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

#include "env/core/robot_spec.h"
#include "env/scene/tyre.h"

namespace floorproof {

struct Foot {
  std::string geom;     // its name in the MJCF
  bool driven = false;  // by a motor
  double rolls_m = 0;   // the radius that it rolls on; 0: it slides, as a ball that is fixed
  double scrubs_m = 0;  // lever of its friction as it turns on the spot: a quarter of its width
  double load_n = 0;    // on level floor, at rest
  Tyre tyre = {};
  double inverse_mass_pkg = 0;  // of its body where it touches: MuJoCo's body_invweight0

  double sink_m() const { return load_n / tyre.stiffness_npm; }
};

// All feet, in the order of their geoms; geoms without a name get one. `model` is `mjcf` compiled.
// Throws InputError where the tyres that the MJCF states under <custom> break a rule.
std::vector<Foot> FeetOf(mjSpec* mjcf, const mjModel* model, const RobotSpec& robot);

// The most that the phase of a tyre's vibration, in rad, grows in this time, of all feet.
double FastestPhase(const std::vector<Foot>& feet, double time_s);

}  // namespace floorproof

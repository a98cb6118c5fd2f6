// SPDX-License-Identifier: Apache-2.0
// Holds a robot at rest, as its model says (RobotSpec::standstill).
//
// A driver that holds a speed of zero gives way under a load: a robot on a slope rolls down. Once
// all driven wheels are commanded to zero speed and have almost stopped for a moment,
//   a brake locks them: it adds more friction to each wheel's joint than the floor can overcome,
//   and
//     a torque that takes back what this friction lets creep;
//   a driver with position control turns each wheel back to where it stopped.
// The engine's contacts creep under a steady load, so their friction is stiffer for as long. (Its
// noslip iterations would let ideal Mecanum wheels creep, whose friction depends on the direction.)
// The remaining creep on a slope of 1:12 is less than 1 mm a minute. A motor without power holds
// nothing; a brake needs no power.
#pragma once

#include <mujoco/mujoco.h>

#include <span>
#include <vector>

#include "env/core/robot_spec.h"

namespace floorproof {

class StandstillHold {
 public:
  // `model`: of a scene with this robot.
  StandstillHold(const RobotSpec& robot, const mjModel* model);

  // The wheels' commanded speeds from now on, rad/s.
  void Command(std::span<const double> wheel_radps);
  std::span<const double> command_radps() const { return command_radps_; }
  // Before each step. `own`: holds the model's arrays; `live`: its options; `cut`: a flag for each
  // wheel, or none. Whether values of `own` have changed. Allocates nothing.
  bool Update(mjModel* own, mjModel* live, mjData* data, std::span<const char> cut);
  // Lets the wheels turn again.
  void Release(mjModel* own, mjModel* live, mjData* data);

 private:
  void Engage(mjModel* own, mjModel* live, const mjData* data);

  Standstill kind_;
  double radius_m_ = 0, brake_nm_ = 0;
  std::vector<int> dofs_, qpos_;
  std::vector<double> command_radps_, held_rad_, crept_rad_s_, loss_nm_;
  std::vector<mjtNum> solimp_, solref_;
  double impratio_ = 1;  // while nothing is held
  double stood_s_ = 0;   // since all have stood
  bool engaged_ = false;
};

}  // namespace floorproof

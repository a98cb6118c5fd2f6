// SPDX-License-Identifier: Apache-2.0
// How a robot stands still that is told to (RobotSpec::standstill).
//
// A driver that holds a speed of zero gives way under a load: a robot on a slope rolls down. Once
// all driven wheels have been told to stand and have all but stood for a moment,
//   a brake locks them: more friction in each wheel's joint than the floor can turn it with, and as
//     much torque as brings back what that lets creep;
//   a driver that holds its position turns each wheel back to where it stood.
// The engine's contacts and dry friction give a little under a steady load, so that for as long its
// solver is asked for no slip (MuJoCo's noslip iterations). What is left on a slope of 1:12: 1.4 mm
// a minute at most; on ideal Mecanum wheels, whose friction has a direction, 14 mm. A motor without
// power holds nothing; a brake does not need any.
#pragma once

#include <mujoco/mujoco.h>

#include <span>
#include <vector>

#include "env/core/robot_spec.h"

namespace floorproof {

class StandstillHold {
 public:
  // `wheel_dofs`, `wheel_qpos`: addresses of the driven wheels' joints in the model.
  StandstillHold(const RobotSpec& robot, const mjModel* model, std::vector<int> wheel_dofs,
                 std::vector<int> wheel_qpos);

  // What the wheels are told from now on, rad/s.
  void Command(std::span<const double> wheel_radps);
  std::span<const double> told_radps() const { return told_radps_; }
  // Before each step. `own`: holds the model's arrays; `live`: its options; `cut`: a flag for each
  // wheel, or none. Whether values of `own` have changed. Allocates nothing.
  bool Update(mjModel* own, mjModel* live, mjData* data, std::span<const char> cut);
  // The robot is set down anew: it may move.
  void Release(mjModel* own, mjModel* live, mjData* data);

 private:
  void Engage(mjModel* own, mjModel* live, const mjData* data);

  Standstill kind_;
  double radius_m_ = 0, brake_nm_ = 0;
  std::vector<int> dofs_, qpos_;
  std::vector<double> told_radps_, held_rad_, crept_rad_s_, loss_nm_;
  std::vector<mjtNum> solimp_, solref_;
  double stood_s_ = 0;  // since all have stood
  bool engaged_ = false;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What a URDF cannot say, or does not: asked for by keys, guessed where nobody answers.
#pragma once

#include <optional>
#include <string>

#include "base/params.h"

namespace floorproof {

struct UrdfAnswers {
  std::string driven;
  std::string standstill;    // empty: guessed
  std::string tyre, caster;  // what they are made of; empty: guessed
  std::optional<double> wheel_radius_m, roller_radius_m;
  double motor_voltage_v = 12;
  std::optional<double> no_load_radps, stall_nm, peak_nm, friction_nm, top_speed_mps;
  std::optional<double> armature_kgm2;
  double sprung_share = 0;
  std::optional<double> spring_travel_m, spring_preload;
  std::optional<double> cruise_mps, max_speed_mps, max_accel_mps2, max_yaw_rate_radps;
  std::optional<double> tool_width_m, step_m, hotel_load_w, lidar_z_m;

  void Visit(ParamVisitor& v);
};

}  // namespace floorproof

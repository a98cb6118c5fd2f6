// SPDX-License-Identifier: Apache-2.0
// A base on two driven wheels and a ball caster behind them, as MJCF that tests make wrong.
#pragma once

#include <string>

namespace floorproof {

struct TwoWheels {
  double wheel_z_m = 0.05;
  double caster_x_m = -0.12, caster_friction = 0.02;
  double stall_nm = 2, no_load_radps = 10, driver_gain = 2;
  double max_speed_mps = 0.4, max_accel_mps2 = 0.5, step_m = 0.005;
  std::string base_inertial = {};  // an <inertial> in place of what the geoms say
};

inline std::string Mjcf(const TwoWheels& r) {
  const auto n = [](double value) { return std::to_string(value); };
  const std::string motor = " nominal=\"12 " + n(r.stall_nm) + " " + n(r.no_load_radps) +
                            "\" input=\"vel\" controller=\"0 0 " + n(r.driver_gain) + " 0 0 12\"/>";
  const auto wheel = [&](const char* name, const char* y) {
    return std::string("<body name=\"") + name + "\" pos=\"0 " + y + " " + n(r.wheel_z_m) +
           "\"><joint name=\"" + name +
           "\" axis=\"0 1 0\" armature=\"0.001\" damping=\"0.001\" frictionloss=\"0.01\"/>"
           "<geom type=\"cylinder\" size=\"0.05 0.006\" zaxis=\"0 1 0\" contype=\"0\" "
           "conaffinity=\"1\" condim=\"3\" mass=\"0.2\"/></body>";
  };
  return "<mujoco><custom><text name=\"drive\" data=\"differential\"/>"
         "<text name=\"clear_shape\" data=\"circle\"/><text name=\"tool_shape\" data=\"circle\"/>"
         "<numeric name=\"tool_width_m\" data=\"0.2\"/><numeric name=\"step_m\" data=\"" +
         n(r.step_m) +
         "\"/><numeric name=\"cruise_mps\" data=\"0.2\"/><numeric name=\"max_speed_mps\" data=\"" +
         n(r.max_speed_mps) + "\"/><numeric name=\"max_accel_mps2\" data=\"" + n(r.max_accel_mps2) +
         "\"/><numeric name=\"max_yaw_rate_radps\" data=\"1\"/>"
         "<numeric name=\"max_yaw_accel_radps2\" data=\"3\"/>"
         "<numeric name=\"hotel_load_w\" data=\"5\"/></custom>"
         "<compiler angle=\"radian\" autolimits=\"true\"/><worldbody><body name=\"base\">"
         "<freejoint/><site name=\"lidar\" pos=\"0 0 0.17\"/>" +
         r.base_inertial +
         "<geom type=\"box\" size=\"0.12 0.08 0.05\" pos=\"-0.03 0 0.08\" contype=\"0\" "
         "conaffinity=\"3\" mass=\"4\"/>" +
         wheel("left", "0.1") + wheel("right", "-0.1") + "<body name=\"ball\" pos=\"" +
         n(r.caster_x_m) +
         " 0 0.015\"><geom size=\"0.015\" contype=\"0\" conaffinity=\"1\" condim=\"3\" "
         "priority=\"2\" friction=\"" +
         n(r.caster_friction) +
         " 0 0\" mass=\"0.05\"/></body></body></worldbody><actuator>"
         "<dcmotor name=\"left\" joint=\"left\"" +
         motor + "<dcmotor name=\"right\" joint=\"right\"" + motor + "</actuator></mujoco>";
}

}  // namespace floorproof

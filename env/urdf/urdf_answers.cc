// SPDX-License-Identifier: Apache-2.0
#include "env/urdf/urdf_answers.h"

#include "env/scene/robot_limits.h"

namespace floorproof {

void UrdfAnswers::Visit(ParamVisitor& v) {
  v("driven", driven, {},
    "joints of the driven wheels, commas between; empty: those that are found");
  v("wheel_radius_m", wheel_radius_m, kWheelRadius_m,
    "of driven wheels without a shape (m); none: they are no wheels");
  v("motor_voltage_v", motor_voltage_v, Positive(), "of the motors' drivers (V)");
  v("no_load_radps", no_load_radps, kMotorSpeed_radps,
    "speed of a wheel's motor without load, at the wheel (rad/s); none: by top_speed_mps");
  v("stall_nm", stall_nm, kMotorTorque_nm, "its stall torque, at the wheel (N m); none: guessed");
  v("top_speed_mps", top_speed_mps, kSpeed_mps,
    "the robot's fastest, which its motors reach (m/s); none: guessed");
  v("cruise_mps", cruise_mps, kSpeed_mps, "speed along a plan (m/s); none: guessed");
  v("max_speed_mps", max_speed_mps, kSpeed_mps, "the controller's limit (m/s); none: guessed");
  v("max_accel_mps2", max_accel_mps2, kAcceleration_mps2,
    "the controller's limit (m/s2); none: guessed");
  v("max_yaw_rate_radps", max_yaw_rate_radps, kYawRate_radps,
    "the controller's limit (rad/s); none: guessed");
  v("tool_width_m", tool_width_m, kToolWidth_m, "what it sweeps (m); none: guessed");
  v("step_m", step_m, kStep_m,
    "highest level change that it is trusted to cross (m); none: guessed");
  v("hotel_load_w", hotel_load_w, kPower_w, "computer and sensors (W); none: guessed");
  v("lidar_z_m", lidar_z_m, kClearance_m,
    "height of the lidar's plane (m); none: of the link that is named after one");
}

}  // namespace floorproof

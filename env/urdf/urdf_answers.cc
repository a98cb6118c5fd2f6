// SPDX-License-Identifier: Apache-2.0
#include "env/urdf/urdf_answers.h"

#include "env/scene/robot_limits.h"

namespace floorproof {
namespace {

constexpr Bounds kFriction_nm = {0, 1000, false};
constexpr Bounds kSpringTravel_m = {0.001, 0.2, false};
constexpr Bounds kArmature_kgm2 = {0, 100, false};

}  // namespace

void UrdfAnswers::Visit(ParamVisitor& v) {
  v("driven", driven, {},
    "joints of the driven wheels, commas between; empty: those that are found");
  v("wheel_radius_m", wheel_radius_m, kWheelRadius_m,
    "of driven wheels without a shape (m); none: they are no wheels");
  v("roller_radius_m", roller_radius_m, kWheelRadius_m,
    "of the rollers of Mecanum wheels, at 45 degrees as in docs/robot.md (m); none: plain wheels");
  v("motor_voltage_v", motor_voltage_v, Positive(), "of the motors' drivers (V)");
  v("no_load_radps", no_load_radps, kMotorSpeed_radps,
    "speed of a wheel's motor without load, at the wheel (rad/s); none: by top_speed_mps");
  v("stall_nm", stall_nm, kMotorTorque_nm, "its stall torque, at the wheel (N m); none: guessed");
  v("peak_nm", peak_nm, kMotorTorque_nm,
    "what its driver's current limit lets it give, at the wheel (N m); none: its stall torque");
  v("friction_nm", friction_nm, kFriction_nm,
    "dry friction of a driven wheel with its gear and motor, at the wheel (N m); none: guessed");
  v("armature_kgm2", armature_kgm2, kArmature_kgm2,
    "inertia of a motor's rotor and its gear, at the wheel (kg m2); none: guessed");
  v("sprung_share", sprung_share, Between(0, 1),
    "of the weight, what the driven wheels carry on springs; 0: they are held");
  v("spring_travel_m", spring_travel_m, kSpringTravel_m,
    "how far such a wheel goes down, and up, from where it stands (m); none: guessed");
  v("spring_preload", spring_preload, Between(0, 0.99),
    "a spring's force at the lower stop, as a share of its load at rest; none: 0");
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
  v("standstill", standstill, {"brake", "hold", "free"},
    "brakes, motors that hold their wheels' positions, or wheels that turn; none: guessed");
  for (const auto& [key, answer] : {std::pair{"tyre", &tyre}, std::pair{"caster", &caster}})
    v(key, *answer, {"soft_rubber", "hard_rubber", "polyurethane"},
      "what driven wheels, or casters, are made of; none: guessed");
  v("lidar_z_m", lidar_z_m, kClearance_m,
    "height of the lidar's plane (m); none: of the link that is named after one");
}

}  // namespace floorproof

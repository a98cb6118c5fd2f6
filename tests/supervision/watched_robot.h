// SPDX-License-Identifier: Apache-2.0
// Robots without physics, and what their sensors would tell: readings are written by the test.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "controllers/monitors/monitor.h"

namespace floorproof {

inline WheelSpec DrivenWheel(const std::string& name, double x_m, double y_m) {
  WheelSpec wheel;
  wheel.name = name;
  wheel.p_BW = {x_m, y_m, 0.05};
  wheel.radius_m = 0.05;
  wheel.max_speed_radps = 20;
  wheel.max_torque_nm = 2;
  // Stall: 10 A, 2 N m.
  wheel.motor = {.resistance_ohm = 1.2, .constant = 0.2, .gain = 1, .voltage_v = 12};
  return wheel;
}

inline RobotSpec Limits(RobotSpec robot) {
  robot.cruise_mps = 0.25;
  robot.max_speed_mps = 0.4;
  robot.max_accel_mps2 = 0.5;
  robot.max_yaw_rate_radps = 1;
  robot.max_yaw_accel_radps2 = 3;
  return robot;
}

inline RobotSpec TwoWheels() {
  RobotSpec robot;
  robot.drive = "differential";
  robot.wheels = {DrivenWheel("left", 0, 0.15), DrivenWheel("right", 0, -0.15)};
  return Limits(robot);
}

// Mecanum wheels, in four rows of two.
inline RobotSpec EightWheels() {
  RobotSpec robot;
  robot.drive = "mecanum";
  for (int row = 0; row < 4; ++row)
    for (const int side : {1, -1}) {
      WheelSpec wheel = DrivenWheel((side > 0 ? "left" : "right") + std::to_string(row),
                                    0.3 - 0.2 * row, 0.15 * side);
      wheel.roller_radius_m = 0.01;
      wheel.roller_angle_rad = (row % 2 == 0 ? 1 : -1) * side * kPi / 4;
      robot.wheels.push_back(wheel);
    }
  return Limits(robot);
}

// Plain wheels, in two rows of two.
inline RobotSpec FourWheels() {
  RobotSpec robot;
  robot.drive = "skid_steer";
  for (const double x_m : {0.2, -0.2})
    for (const double y_m : {0.2, -0.2})
      robot.wheels.push_back(DrivenWheel(y_m > 0 ? "left" : "right", x_m, y_m));
  return Limits(robot);
}

class WatchedRobot {
 public:
  static constexpr double kControl_s = 0.02;

  explicit WatchedRobot(RobotSpec robot)
      : robot_(std::move(robot)), drive_(MakePlugin(Drives(), robot_.drive, "drive")) {
    drive_->Configure(robot_);
    const std::size_t n = robot_.wheels.size();
    wheel_rad.assign(n, 0);
    commanded_radps_.assign(n, 0);
    power = {true, std::vector<double>(n), 12};
    accel_mps2 = {0, 0, 9.81};
    map.frame = {10, 10, 0.5, {}};
    map.occupancy = Grid<CellState>(10, 10, CellState::kFree);
  }

  // A sound robot told to drive so: its wheels turn as told, against so much current each, and it
  // gets on.
  void Tell(const BodyTwist& twist, double current_a = 0.1) {
    commanded = twist;
    drive_->ToWheels(twist, commanded_radps_);
    for (std::size_t w = 0; w < wheel_rad.size(); ++w) {
      const VelocityDrive& motor = robot_.wheels[w].motor;
      const double sense = commanded_radps_[w] < 0 ? -1 : 1;
      power.motor_a[w] = commanded_radps_[w] == 0 ? 0 : sense * current_a;
      const double lags = power.motor_a[w] * motor.constant / motor.gain;
      wheel_rad[w] = (commanded_radps_[w] - lags) * kControl_s;
    }
    gyro_radps.z() = twist.wz_radps;
    estimate.V_WB_B = twist;
  }
  MonitorReadings Readings() const {
    return {t_s,    kControl_s, commanded,  commanded_radps_, wheel_rad,
            hinges, has_imu,    gyro_radps, accel_mps2,       scan,
            bump,   power,      estimate};
  }
  // Time goes on, and the robot with it.
  void Pass() {
    t_s += kControl_s;
    ++periods;
    const BodyTwist& V = estimate.V_WB_B;
    const Vec2 step_W = estimate.X_WB.Rotate(Vec2(V.vx_mps, V.vy_mps) * kControl_s);
    estimate.X_WB.x_m += step_W.x();
    estimate.X_WB.y_m += step_W.y();
    estimate.X_WB.yaw_rad = WrapAngle(estimate.X_WB.yaw_rad + V.wz_radps * kControl_s);
    // A living IMU is never twice the same.
    gyro_radps.x() = 1e-4 * std::sin(1000 * t_s);
  }
  void Scan(double range_m) {
    scan.fresh = true;
    scan.t_s = t_s;
    scan.range_m.assign(scan.angle_rad.size(), range_m);
  }

  const RobotSpec& robot() const { return robot_; }
  const Drive& drive() const { return *drive_; }
  std::span<const double> commanded_radps() const { return commanded_radps_; }

  double t_s = 0;
  int periods = 0;
  BodyTwist commanded;
  std::vector<double> wheel_rad;
  HingeState hinges;
  bool has_imu = true;
  Vec3 gyro_radps = Vec3::Zero(), accel_mps2 = Vec3::Zero();
  LidarScan scan;
  Bump bump;
  PowerReading power;
  Estimate estimate;
  HazardMap map;

 private:
  RobotSpec robot_;
  std::unique_ptr<Drive> drive_;
  std::vector<double> commanded_radps_;
};

}  // namespace floorproof

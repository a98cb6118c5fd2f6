// SPDX-License-Identifier: Apache-2.0
// What a robot's sensors told it, once a control period: all that estimators and mappers may know.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "env/core/motion.h"

namespace floorproof {

// The parts of an Observation. A sensor fills one of them, and whoever goes by an observation says
// which it needs.
enum class Reading { kWheels, kImu, kScan, kBump, kCliffs, kPower, kTruth };  // kWheels: hinges too
inline constexpr Reading kReadings[] = {Reading::kWheels, Reading::kImu,    Reading::kScan,
                                        Reading::kBump,   Reading::kCliffs, Reading::kPower,
                                        Reading::kTruth};
constexpr std::string_view Name(Reading reading) {
  constexpr std::string_view kNames[] = {"wheels' turns", "IMU",   "scan", "bump",
                                         "cliffs",        "power", "truth"};
  return kNames[static_cast<int>(reading)];
}

// One turn of a 2D lidar, taken at one moment.
struct LidarScan {
  double t_s = -1;                 // of the turn; before the first: negative
  bool fresh = false;              // it is this period's
  Pose2 X_BL;                      // scanner in the body frame
  double height_m = 0;             // of the scan plane above the floor, the robot level
  double least_m = 0, most_m = 0;  // ranges that it can tell
  std::vector<double> angle_rad;   // of each beam in L, counter-clockwise from x
  std::vector<double> range_m;     // infinity: nothing came back

  // Calls see(p_L) with where each beam that came back ended.
  template <class See>
  void ForEachEnd(const See& see) const {
    for (std::size_t i = 0; i < range_m.size(); ++i)
      if (std::isfinite(range_m[i]))
        see(Vec2(range_m[i] * std::cos(angle_rad[i]), range_m[i] * std::sin(angle_rad[i])));
  }
};

// The shell was touched.
struct Bump {
  bool pressed = false;
  double bearing_rad = 0;  // from the body's x to where, counter-clockwise
};

// Sensors around the robot's edge that look down.
struct CliffRing {
  static constexpr int kMax = 8;
  int n = 0;
  std::array<Vec2, kMax> p_B;              // where each looks, body frame
  std::array<bool, kMax> drop{};           // it sees no floor within its reach
  CliffRing() { p_B.fill(Vec2::Zero()); }  // Eigen's own leaves them as they lie in memory
  bool any() const {
    for (int i = 0; i < n; ++i)
      if (drop[static_cast<std::size_t>(i)]) return true;
    return false;
  }
};

// What the motors' drivers and the battery measure.
struct PowerReading {
  bool heard = false;
  // Of each driven wheel's motor, A, RobotSpec's order; positive: it drives the wheel forward. The
  // mean since the last period.
  std::vector<double> motor_a;
  double battery_v = 0;  // at its terminals
};

// As no sensor of a real robot tells it.
struct TruePose {
  Pose2 X_WB;
  BodyTwist V_WB_B;
  HingeState hinges;
};

struct Observation {
  double t_s = 0;
  // Encoders: how far each driven wheel has turned since the last period, rad, in RobotSpec's
  // order; empty: the robot has none.
  std::vector<double> wheel_rad;
  HingeState hinges;  // as the encoders of hinges and of a fork that steers say
  // IMU, body axes: rate of turn, and what an accelerometer says (at rest: g, upwards).
  bool has_imu = false;
  Vec3 gyro_radps = Vec3::Zero(), accel_mps2 = Vec3::Zero();
  LidarScan scan;
  Bump bump;
  CliffRing cliffs;
  PowerReading power;
  std::optional<TruePose> truth;  // of the sensor `truth` alone
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "controllers/odometry.h"

namespace floorproof {

BodyTwist RolledTwist(const Drive& drive, std::span<const double> wheel_rad,
                      const HingeState& hinges, double dt_s, std::span<double> radps) {
  for (std::size_t i = 0; i < radps.size(); ++i) radps[i] = wheel_rad[i] / dt_s;
  return drive.ToTwist(radps, hinges);
}

void Odometry::Start(const RobotSpec& robot) {
  drive_ = MakePlugin(Drives(), robot.drive, "drive");
  drive_->Configure(robot);
  wheel_radps_.assign(robot.wheels.size(), 0);
}

BodyTwist Odometry::Update(const Observation& sensed, double dt_s) {
  BodyTwist twist = RolledTwist(*drive_, sensed.wheel_rad, sensed.hinges, dt_s, wheel_radps_);
  if (sensed.has_imu) twist.wz_radps = sensed.gyro_radps.z();
  return twist;
}

Pose2 Moved(const Pose2& X_WB, const BodyTwist& V, double dt_s) {
  const double turn = V.wz_radps * dt_s;
  // The chord of the arc points along the middle of the turn.
  const double chord = std::abs(turn) < 1e-9 ? 1 : std::sin(turn / 2) / (turn / 2);
  const Vec2 step =
      Pose2{0, 0, X_WB.yaw_rad + turn / 2}.Rotate(Vec2(V.vx_mps, V.vy_mps) * (dt_s * chord));
  return {X_WB.x_m + step.x(), X_WB.y_m + step.y(), WrapAngle(X_WB.yaw_rad + turn)};
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Dead reckoning: the body's motion in one control period, as encoders and gyro tell it.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "controllers/drive.h"
#include "env/core/observation.h"

namespace floorproof {

// The twist that wheels rolled which turned so far in dt_s. `radps`: room for a speed a wheel.
BodyTwist RolledTwist(const Drive& drive, std::span<const double> wheel_rad,
                      const HingeState& hinges, double dt_s, std::span<double> radps);

class Odometry {
 public:
  void Start(const RobotSpec& robot);
  // The twist of the last period: travel from the wheels, turn from the gyro where there is one.
  BodyTwist Update(const Observation& sensed, double dt_s);

  // See Drive::Exclude.
  void Exclude(std::span<const char> wheels) { drive_->Exclude(wheels); }

 private:
  std::unique_ptr<Drive> drive_;
  std::vector<double> wheel_radps_;
};

// The pose after moving with this twist for dt_s, along the arc.
Pose2 Moved(const Pose2& X_WB, const BodyTwist& V_WB_B, double dt_s);

}  // namespace floorproof

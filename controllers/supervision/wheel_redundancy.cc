// SPDX-License-Identifier: Apache-2.0
#include "controllers/supervision/wheel_redundancy.h"

namespace floorproof {

WheelRedundancy::WheelRedundancy(const RobotSpec& robot)
    : drive_(MakePlugin(Drives(), robot.drive, "drive")),
      out_(robot.wheels.size(), 0),
      tried_(robot.wheels.size(), 0) {
  drive_->Configure(robot);
}

Availability WheelRedundancy::Without(std::span<const char> wheels) const {
  for (std::size_t w = 0; w < out_.size(); ++w) tried_[w] = out_[w] || wheels[w];
  if (tried_ == asked_) return answer_;  // as in the last period: it allocates else
  asked_ = tried_;
  return answer_ = LeftWithoutTried();
}

Availability WheelRedundancy::LeftWithoutTried() const {
  if (!drive_->Exclude(tried_)) return Availability::kSingular;
  for (std::size_t w = 0; w < out_.size(); ++w) {
    if (tried_[w]) continue;
    tried_[w] = 1;
    const bool can = drive_->Exclude(tried_);
    tried_[w] = 0;
    if (!can) return Availability::kEminent;
  }
  return Availability::kRedundant;
}

bool WheelRedundancy::Exclude(std::span<const char> wheels) {
  for (std::size_t w = 0; w < out_.size(); ++w) tried_[w] = out_[w] || wheels[w];
  if (!drive_->Exclude(tried_)) return false;
  out_ = tried_;
  return true;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What a robot can still do without some of its wheels.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "controllers/drive.h"
#include "controllers/safety/safety_state.h"

namespace floorproof {

class WheelRedundancy {
 public:
  explicit WheelRedundancy(const RobotSpec& robot);

  // Without these wheels, a flag each, and those that are out of use already. As the paper says of
  // a car of four motors (section 3.2): redundant while any other one may fail, too; eminent when
  // "no other fail is tolerable"; singular when the rest cannot move it every way that it could.
  Availability Without(std::span<const char> wheels) const;
  // From now on they are out of use. False, and nothing changes, where that is singular.
  bool Exclude(std::span<const char> wheels);
  // A flag a wheel.
  std::span<const char> out() const { return out_; }

 private:
  Availability LeftWithoutTried() const;

  std::unique_ptr<Drive> drive_;  // asked, never driven with
  std::vector<char> out_;
  mutable std::vector<char> tried_;
  mutable std::vector<char> asked_;  // last, and
  mutable Availability answer_ = Availability::kRedundant;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Two driven wheels on one axle that roll without slip.
//
// Wheel i stands at (x, y_i) and rolls along x, so its rim moves at r_i w_i = vx - wz y_i. Two such
// equations give vx and wz; the radii may differ. The axle cannot move sideways, which makes the
// body origin move at vy = -wz x when the axle stands ahead of it. Siegwart, Nourbakhsh &
// Scaramuzza, Introduction to Autonomous Mobile Robots, 2nd ed., section 3.2.
// Assumes wheels that point along x; does not know slip.
#include <algorithm>
#include <cmath>
#include <string>

#include "base/params.h"
#include "controllers/drive.h"

namespace floorproof {
namespace {

constexpr double kLeastTrackM = 1e-3;  // below this the yaw rate is lost in rounding

class DifferentialDrive final : public Drive {
 public:
  bool holonomic() const override { return false; }
  bool turns_on_the_spot() const override { return true; }

  void Configure(const RobotSpec& robot) override {
    const auto refuse = [&](const std::string& rule) {
      throw InputError({robot.model_file, 0}, "drive", "differential", rule);
    };
    if (robot.wheels.size() != 2)
      refuse("needs two driven wheels, not " + std::to_string(robot.wheels.size()));
    for (std::size_t i = 0; i < 2; ++i) {
      const WheelSpec& wheel = robot.wheels[i];
      if (!(wheel.radius_m > 0)) refuse("wheel " + wheel.name + " has no radius");
      if (!(wheel.max_speed_radps > 0)) refuse("wheel " + wheel.name + " has no top speed");
      if (wheel.roller_angle_rad != 0) refuse("wheel " + wheel.name + " has rollers");
      radius_m_[i] = wheel.radius_m;
      y_m_[i] = wheel.p_BW.y();
      max_speed_radps_[i] = wheel.max_speed_radps;
    }
    if (std::abs(y_m_[0] - y_m_[1]) < kLeastTrackM) refuse("both wheels stand at the same y");
    axle_x_m_ = 0.5 * (robot.wheels[0].p_BW.x() + robot.wheels[1].p_BW.x());
  }

  bool Exclude(std::span<const char> wheels) override { return !wheels[0] && !wheels[1]; }

  void ToWheels(const BodyTwist& twist, HingeState&, std::span<double> wheel_radps) const override {
    double scale = 1;
    for (std::size_t i = 0; i < 2; ++i) {
      wheel_radps[i] = (twist.vx_mps - twist.wz_radps * y_m_[i]) / radius_m_[i];
      const double speed = std::abs(wheel_radps[i]);
      if (speed > max_speed_radps_[i]) scale = std::min(scale, max_speed_radps_[i] / speed);
    }
    for (std::size_t i = 0; i < 2; ++i) wheel_radps[i] *= scale;
  }

  BodyTwist ToTwist(std::span<const double> wheel_radps, const HingeState&) const override {
    const double rim_0 = wheel_radps[0] * radius_m_[0], rim_1 = wheel_radps[1] * radius_m_[1];
    const double wz = (rim_1 - rim_0) / (y_m_[0] - y_m_[1]);
    return {rim_0 + wz * y_m_[0], -wz * axle_x_m_, wz};
  }

 private:
  double radius_m_[2] = {}, y_m_[2] = {}, max_speed_radps_[2] = {};
  double axle_x_m_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Drive, DifferentialDrive)

}  // namespace floorproof

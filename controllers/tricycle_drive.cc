// SPDX-License-Identifier: Apache-2.0
// One wheel that drives and steers, before or behind an axle whose wheels only roll.
//
// Body frame B has its origin on the axle, so it never moves sideways. The steered wheel stands at
// (L, 0) and rolls along its own heading d at the rim's speed u:
//   vx = u cos(d),  wz = u sin(d) / L;  back:  d = atan(L wz / vx),  u = vx / cos(d).
// Siegwart, Nourbakhsh & Scaramuzza, Introduction to Autonomous Mobile Robots, 2nd ed.,
// section 3.2. The turn about the axle's middle is at most tan(d_max) / L tight: beyond the
// steering's stops the curvature is clipped, vx stays. A fork takes time to turn. Meanwhile the
// wheel is told the speed that suits the heading it has, so that vx is kept, and less the farther
// it is from where it is to point: a robot that stands steers first. Standing still it keeps its
// heading. Assumes wheels that roll without slip, a fork without trail, a driver that holds the
// fork's rate.
#include <algorithm>
#include <cmath>
#include <string>

#include "base/params.h"
#include "controllers/drive.h"

namespace floorproof {
namespace {

// Rate of the fork for its error: a driver that follows within some 0.05 s does not overshoot.
constexpr double kSteer_1ps = 6;
// So far off its heading the wheel stands.
constexpr double kTooFar_rad = 0.6;

class TricycleDrive final : public Drive {
 public:
  bool holonomic() const override { return false; }
  bool turns_on_the_spot() const override { return false; }

  void Configure(const RobotSpec& robot) override {
    const auto refuse = [&](const std::string& rule) {
      throw InputError({robot.model_file, 0}, "drive", "tricycle", rule);
    };
    if (robot.wheels.size() != 1)
      refuse("needs one driven wheel, not " + std::to_string(robot.wheels.size()));
    if (!robot.steering)
      refuse("needs a motor that steers its wheel, named under <custom> as steering");
    const WheelSpec& wheel = robot.wheels.front();
    constexpr double kMiddle_m = 1e-3, kLeastBase_m = 0.01;
    if (!(wheel.radius_m > 0)) refuse("wheel " + wheel.name + " has no radius");
    if (!(wheel.max_speed_radps > 0)) refuse("wheel " + wheel.name + " has no top speed");
    if (wheel.roller_angle_rad != 0) refuse("wheel " + wheel.name + " has rollers");
    if (!(std::abs(wheel.p_BW.y()) < kMiddle_m))
      refuse("wheel " + wheel.name + " must stand on the robot's middle line, y = 0");
    if (!(std::abs(wheel.p_BW.x()) > kLeastBase_m))
      refuse("wheel " + wheel.name + " must stand before or behind the axle");
    fork_ = *robot.steering;
    if (!(fork_.max_rate_radps > 0)) refuse("fork " + fork_.name + " has no rate");
    base_m_ = wheel.p_BW.x();
    radius_m_ = wheel.radius_m;
    max_speed_radps_ = wheel.max_speed_radps;
  }

  bool Exclude(std::span<const char> wheels) override { return !wheels[0]; }

  void ToWheels(const BodyTwist& twist, HingeState& hinges,
                std::span<double> wheel_radps) const override {
    const bool known = hinges.steered;
    const double now_rad = known ? hinges.steer_rad : 0;
    const double wanted_rad = Heading(twist, now_rad);
    double share = 1;
    if (known) {
      const double off_rad = wanted_rad - now_rad;
      hinges.steer_radps =
          std::clamp(kSteer_1ps * off_rad, -fork_.max_rate_radps, fork_.max_rate_radps);
      share = std::max(0.0, 1 - std::abs(off_rad) / kTooFar_rad);
    }
    const double rim_mps = share * twist.vx_mps / std::cos(known ? now_rad : wanted_rad);
    wheel_radps[0] = std::clamp(rim_mps / radius_m_, -max_speed_radps_, max_speed_radps_);
  }

  BodyTwist ToTwist(std::span<const double> wheel_radps, const HingeState& hinges) const override {
    const double heading_rad = hinges.steered ? hinges.steer_rad : 0;
    const double rim_mps = wheel_radps[0] * radius_m_;
    return {rim_mps * std::cos(heading_rad), 0, rim_mps * std::sin(heading_rad) / base_m_};
  }

 private:
  // Where the wheel is to point for this motion, within its stops.
  double Heading(const BodyTwist& twist, double now_rad) const {
    constexpr double kStands_mps = 1e-6;
    if (std::abs(twist.vx_mps) < kStands_mps) return now_rad;
    return std::clamp(std::atan(base_m_ * twist.wz_radps / twist.vx_mps), fork_.min_rad,
                      fork_.max_rad);
  }

  SteeringSpec fork_;
  double base_m_ = 0, radius_m_ = 0, max_speed_radps_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Drive, TricycleDrive)

}  // namespace floorproof

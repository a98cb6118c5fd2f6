// SPDX-License-Identifier: Apache-2.0
// Mecanum wheels, any number of them, that roll without slip.
//
// A wheel at (x, y) whose roller's axis at the floor stands at the angle g to its axle slides
// freely across that axis and not along it: R w = (vx - wz y) - cot(g) (vy + wz x). One row a
// wheel; wheel speeds follow from the twist exactly, the twist from wheel speeds in the
// least-squares sense. Muir & Neuman, "Kinematic modeling for feedback control of an
// omnidirectional wheeled mobile robot", 1987 (their eq. 18 is the case g = +-45 deg). Assumes
// axles along y; does not know slip.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "controllers/drive.h"
#include "env/core/params.h"

namespace floorproof {
namespace {

class MecanumDrive final : public Drive {
 public:
  void Configure(const RobotSpec& robot) override {
    const auto refuse = [&](const std::string& rule) {
      throw InputError({robot.model_file, 0}, "drive", "mecanum", rule);
    };
    const auto n = static_cast<Eigen::Index>(robot.wheels.size());
    if (n < 3) refuse("needs three or more driven wheels, not " + std::to_string(n));
    to_wheels_.resize(n, 3);
    max_speed_radps_.clear();
    for (Eigen::Index i = 0; i < n; ++i) {
      const WheelSpec& wheel = robot.wheels[static_cast<std::size_t>(i)];
      if (!(wheel.radius_m > 0)) refuse("wheel " + wheel.name + " has no radius");
      if (!(wheel.max_speed_radps > 0)) refuse("wheel " + wheel.name + " has no top speed");
      if (!(wheel.roller_radius_m > 0) || wheel.roller_angle_rad == 0)
        refuse("wheel " + wheel.name + " has no rollers");
      const double cot = 1 / std::tan(wheel.roller_angle_rad);
      to_wheels_.row(i) << 1, -cot, -(wheel.p_BW.y() + cot * wheel.p_BW.x());
      to_wheels_.row(i) /= wheel.radius_m;
      max_speed_radps_.push_back(wheel.max_speed_radps);
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixX3d> solver(to_wheels_);
    if (solver.rank() < 3)
      refuse("these wheels cannot turn and move every way: some need rollers of the other hand");
    to_twist_ = solver.solve(Eigen::MatrixXd::Identity(n, n));
  }

  void ToWheels(const BodyTwist& twist, std::span<double> wheel_radps) const override {
    double scale = 1;
    for (std::size_t i = 0; i < max_speed_radps_.size(); ++i) {
      const auto row = to_wheels_.row(static_cast<Eigen::Index>(i));
      wheel_radps[i] = row[0] * twist.vx_mps + row[1] * twist.vy_mps + row[2] * twist.wz_radps;
      const double speed = std::abs(wheel_radps[i]);
      if (speed > max_speed_radps_[i]) scale = std::min(scale, max_speed_radps_[i] / speed);
    }
    for (double& speed : wheel_radps) speed *= scale;
  }

  BodyTwist ToTwist(std::span<const double> wheel_radps) const override {
    Vec3 twist = Vec3::Zero();
    for (std::size_t i = 0; i < max_speed_radps_.size(); ++i)
      twist += wheel_radps[i] * to_twist_.col(static_cast<Eigen::Index>(i));
    return {twist.x(), twist.y(), twist.z()};
  }

 private:
  Eigen::MatrixX3d to_wheels_;  // a row a wheel: rad/s for each of vx, vy, wz
  Eigen::Matrix3Xd to_twist_;   // its pseudo-inverse
  std::vector<double> max_speed_radps_;
};

}  // namespace

FP_DEFINE_PLUGIN(Drive, MecanumDrive)

}  // namespace floorproof

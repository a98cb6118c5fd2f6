// SPDX-License-Identifier: Apache-2.0
// Four, six or more plain wheels, two or more a side, that point ahead: they turn by sliding.
//
// Wheels that roll at rim speeds v_l on the left and v_r on the right leave the body the twist at
// which their friction is in balance: forces along and across and the yaw moment add up to nothing.
// With Coulomb friction that is the same in all directions this is the twist at which sliding takes
// the least power, sum_i N_i |u_i|, u_i the velocity of wheel i over the floor: a convex function
// of the twist with one least value, found by weighted least squares, weights N_i / |u_i|
// (Weiszfeld 1937). The friction itself cancels. The twist is a homogeneous function of the rims'
// speeds that rolling on shifts, so three numbers say it all: each side rolls as if it stood at y_l
// or y_r, and the body turns about points at x_c,
//   v_l = vx - wz y_l,  v_r = vx - wz y_r,  vy = -wz x_c,
// the ICR coefficients of Mandow, Martinez, Morales, Blanco, Garcia-Cerezo & Gonzalez 2007,
// "Experimental kinematics for wheeled skid-steer mobile robots", which measures them. Four wheels
// at (+-a, +-b) under equal loads give x_c = 0, y_l = -y_r = b + a^2 / b; six, the middle ones at
// x = 0, the root of 2 (a^2 - b s) / sqrt(a^2 + s^2) = b with y_l = b + s.
//
// Assumes: slow (no centripetal force), a level floor, tyres that touch at one point each, and that
// the driven wheels alone carry the robot, on springs that are all alike: loads lie on a plane over
// the wheels' places, and a wheel that this would pull down carries nothing. A tyre of half width h
// turns slower by some h^2 / (a^2 + b^2).
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/params.h"
#include "controllers/drive.h"

namespace floorproof {
namespace {

constexpr double kLeastHalfTrack_m = 1e-3;  // nearer to the middle line a wheel has no side
constexpr double kAskew_rad = 0.01;

// Shares of the weight that wheels at these places carry, alike springs under a stiff body.
Eigen::VectorXd Loads(const std::vector<Vec2>& p_BW, const Vec2& p_BCom) {
  Eigen::Matrix3Xd moments(3, static_cast<Eigen::Index>(p_BW.size()));
  for (Eigen::Index i = 0; i < moments.cols(); ++i)
    moments.col(i) << 1, p_BW[static_cast<std::size_t>(i)];
  const Vec3 weight(1, p_BCom.x(), p_BCom.y());
  Eigen::VectorXd loads;
  for (Eigen::Index lifted = 0; lifted < moments.cols(); ++lifted) {
    const Eigen::Matrix3d normal = moments * moments.transpose();
    loads = moments.transpose() * normal.completeOrthogonalDecomposition().solve(weight);
    Eigen::Index lightest = 0;
    if (loads.minCoeff(&lightest) >= 0) break;
    moments.col(lightest).setZero();
  }
  return loads.cwiseMax(0.0);
}

class SkidSteerDrive final : public Drive {
 public:
  bool holonomic() const override { return false; }
  bool turns_on_the_spot() const override { return true; }

  void Configure(const RobotSpec& robot) override {
    const auto refuse = [&](const std::string& rule) {
      throw InputError({robot.model_file, 0}, "drive", "skid_steer", rule);
    };
    wheels_.clear();
    std::vector<Vec2> p_BW;
    std::size_t num[2] = {0, 0};
    for (const WheelSpec& wheel : robot.wheels) {
      if (!(wheel.radius_m > 0)) refuse("wheel " + wheel.name + " has no radius");
      if (!(wheel.max_speed_radps > 0)) refuse("wheel " + wheel.name + " has no top speed");
      if (wheel.roller_angle_rad != 0) refuse("wheel " + wheel.name + " has rollers");
      if (!(std::abs(wheel.p_BW.y()) > kLeastHalfTrack_m))
        refuse("wheel " + wheel.name + " stands neither left nor right");
      if (!(std::abs(wheel.yaw_rad) < kAskew_rad))
        refuse("wheel " + wheel.name + " does not point ahead, its axle's axis to the left");
      const std::size_t side = wheel.p_BW.y() > 0 ? kLeft : kRight;
      ++num[side];
      p_BW.emplace_back(wheel.p_BW.head<2>());
      wheels_.push_back({side, wheel.radius_m, wheel.max_speed_radps, false});
    }
    if (num[kLeft] < 2 || num[kRight] < 2)
      refuse("needs two or more driven wheels on each side, not " + std::to_string(num[kLeft]) +
             " on the left and " + std::to_string(num[kRight]) + " on the right");
    Balance(p_BW, Loads(p_BW, robot.p_BCom.head<2>()));
    if (!(y_m_[kLeft] > y_m_[kRight])) refuse("these wheels cannot turn the robot");
  }

  bool Exclude(std::span<const char> wheels) override {
    std::size_t left[2] = {0, 0};
    for (std::size_t i = 0; i < wheels_.size(); ++i) left[wheels_[i].side] += wheels[i] == 0;
    if (left[kLeft] == 0 || left[kRight] == 0) return false;
    for (std::size_t i = 0; i < wheels_.size(); ++i) wheels_[i].out = wheels[i] != 0;
    return true;
  }

  void ToWheels(const BodyTwist& twist, HingeState&, std::span<double> wheel_radps) const override {
    double scale = 1;
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      const Wheel& wheel = wheels_[i];
      wheel_radps[i] = (twist.vx_mps - twist.wz_radps * y_m_[wheel.side]) / wheel.radius_m;
      const double speed = wheel.out ? 0 : std::abs(wheel_radps[i]);
      if (speed > wheel.max_speed_radps) scale = std::min(scale, wheel.max_speed_radps / speed);
    }
    for (double& speed : wheel_radps) speed *= scale;
  }

  // A side rolls as the mean of its wheels in use does.
  BodyTwist ToTwist(std::span<const double> wheel_radps, const HingeState&) const override {
    double rim_mps[2] = {0, 0}, num[2] = {0, 0};
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      const Wheel& wheel = wheels_[i];
      if (wheel.out) continue;
      rim_mps[wheel.side] += wheel_radps[i] * wheel.radius_m;
      ++num[wheel.side];
    }
    for (const std::size_t side : {kLeft, kRight}) rim_mps[side] /= num[side];
    const double wz = (rim_mps[kRight] - rim_mps[kLeft]) / (y_m_[kLeft] - y_m_[kRight]);
    return {rim_mps[kLeft] + wz * y_m_[kLeft], -wz * turns_about_x_m_, wz};
  }

 private:
  static constexpr std::size_t kLeft = 0, kRight = 1;
  struct Wheel {
    std::size_t side;
    double radius_m, max_speed_radps;
    bool out = false;  // of use
  };

  // Finds y_l, y_r and x_c from the twist that rims of -1 and 1 m/s leave the body.
  void Balance(const std::vector<Vec2>& p_BW, const Eigen::VectorXd& loads) {
    constexpr int kMost = 10000;
    constexpr double kStill_mps = 1e-9;  // a wheel that slides no faster rolls
    constexpr double kSame = 1e-14;
    constexpr double kRim_mps[] = {-1, 1};
    Vec3 twist = Vec3::Zero();
    std::vector<double> weights(loads.data(), loads.data() + loads.size());
    for (int k = 0; k < kMost; ++k) {
      Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
      Vec3 right = Vec3::Zero();
      for (std::size_t i = 0; i < p_BW.size(); ++i) {
        const Vec3 along(1, 0, -p_BW[i].y()), across(0, 1, p_BW[i].x());
        normal += weights[i] * (along * along.transpose() + across * across.transpose());
        right += weights[i] * kRim_mps[wheels_[i].side] * along;
      }
      const Vec3 last = twist;
      twist = normal.ldlt().solve(right);
      if ((twist - last).norm() <= kSame * twist.norm()) break;
      for (std::size_t i = 0; i < p_BW.size(); ++i) {
        const Vec2 slide(twist.x() - twist.z() * p_BW[i].y() - kRim_mps[wheels_[i].side],
                         twist.y() + twist.z() * p_BW[i].x());
        weights[i] = loads(static_cast<Eigen::Index>(i)) / std::max(slide.norm(), kStill_mps);
      }
    }
    for (const std::size_t side : {kLeft, kRight})
      y_m_[side] = (twist.x() - kRim_mps[side]) / twist.z();
    turns_about_x_m_ = -twist.y() / twist.z();
  }

  std::vector<Wheel> wheels_;
  double y_m_[2] = {0, 0};      // where each side rolls as if it stood
  double turns_about_x_m_ = 0;  // the body
};

}  // namespace

FP_DEFINE_PLUGIN(Drive, SkidSteerDrive)

}  // namespace floorproof

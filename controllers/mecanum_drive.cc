// SPDX-License-Identifier: Apache-2.0
// Mecanum wheels, any number of them, that roll without slip.
//
// A wheel at (x, y) slides freely across the axis of the roller that touches the floor, and not
// along it. With g the angle from the axle to that axis: R w = (vx - wz y) - cot(g) (vy + wz x).
// Each wheel gives one row. Wheel speeds follow from the twist exactly, the twist from wheel speeds
// in the least-squares sense. Muir & Neuman, "Kinematic modeling for feedback control of an
// omnidirectional wheeled mobile robot", 1987 (their eq. 18 is the case g = +-45 deg). x and y are
// in the wheel's own directions, so wheels may stand at any yaw. Where hinges move the blocks that
// carry the wheels, each wheel rolls with the velocity that its own block has there. Does not know
// slip.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/params.h"
#include "controllers/drive.h"
#include "env/core/blocks.h"

namespace floorproof {
namespace {

class MecanumDrive final : public Drive {
 public:
  bool holonomic() const override { return true; }
  bool turns_on_the_spot() const override { return true; }

  void Configure(const RobotSpec& robot) override {
    const auto refuse = [&](const std::string& rule) {
      throw InputError({robot.model_file, 0}, "drive", "mecanum", rule);
    };
    const auto n = static_cast<Eigen::Index>(robot.wheels.size());
    if (n < 3) refuse("needs three or more driven wheels, not " + std::to_string(n));
    blocks_ = robot.blocks;
    hinges_ = robot.hinges;
    const BlockMotions start = MoveBlocks(blocks_, hinges_, StartState(robot));
    to_wheels_.resize(n, 3);
    wheels_.clear();
    for (const WheelSpec& wheel : robot.wheels) {
      if (!(wheel.radius_m > 0)) refuse("wheel " + wheel.name + " has no radius");
      if (!(wheel.max_speed_radps > 0)) refuse("wheel " + wheel.name + " has no top speed");
      if (!(wheel.roller_radius_m > 0) || wheel.roller_angle_rad == 0)
        refuse("wheel " + wheel.name + " has no rollers");
      const Pose2 X_BW{wheel.p_BW.x(), wheel.p_BW.y(), wheel.yaw_rad};
      const auto block = static_cast<std::size_t>(hinges_.empty() ? 0 : wheel.block);
      wheels_.push_back({block, start.block[block].X_BK.Inverse() * X_BW,
                         1 / std::tan(wheel.roller_angle_rad), wheel.radius_m,
                         wheel.max_speed_radps, false});
      to_wheels_.row(static_cast<Eigen::Index>(wheels_.size()) - 1) = wheels_.back().Row(X_BW);
    }
    if (!Exclude(std::vector<char>(wheels_.size(), 0)))
      refuse("these wheels cannot turn and move every way: some need rollers of the other hand");
  }

  bool Exclude(std::span<const char> wheels) override {
    Eigen::MatrixX3d rows = to_wheels_;
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
      if (wheels[static_cast<std::size_t>(i)]) rows.row(i).setZero();
    const Eigen::ColPivHouseholderQR<Eigen::MatrixX3d> solver(rows);
    if (solver.rank() < 3) return false;
    to_twist_ = solver.solve(Eigen::MatrixXd::Identity(rows.rows(), rows.rows()));
    for (std::size_t i = 0; i < wheels_.size(); ++i) wheels_[i].out = wheels[i] != 0;
    return true;
  }

  void ToWheels(const BodyTwist& twist, HingeState& hinges,
                std::span<double> wheel_radps) const override {
    const Vec3 V(twist.vx_mps, twist.vy_mps, twist.wz_radps);
    BlockMotions motions;
    if (hinges.n > 0) motions = MoveBlocks(blocks_, hinges_, hinges);
    double scale = 1;
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      wheel_radps[i] = hinges.n > 0 ? wheels_[i].Row(motions).dot(V) + wheels_[i].Swing(motions)
                                    : to_wheels_.row(static_cast<Eigen::Index>(i)).dot(V);
      const double speed = wheels_[i].out ? 0 : std::abs(wheel_radps[i]);
      if (speed > wheels_[i].max_speed_radps)
        scale = std::min(scale, wheels_[i].max_speed_radps / speed);
    }
    for (double& speed : wheel_radps) speed *= scale;
    for (double& rate : hinges.radps) rate *= scale;
  }

  BodyTwist ToTwist(std::span<const double> wheel_radps, const HingeState& hinges) const override {
    Vec3 twist = Vec3::Zero();
    if (hinges.n == 0) {
      for (std::size_t i = 0; i < wheels_.size(); ++i)
        twist += wheel_radps[i] * to_twist_.col(static_cast<Eigen::Index>(i));
    } else {
      // The normal equations of what is left when the hinges' share is taken off.
      const BlockMotions motions = MoveBlocks(blocks_, hinges_, hinges);
      Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
      for (std::size_t i = 0; i < wheels_.size(); ++i) {
        if (wheels_[i].out) continue;
        const Vec3 row = wheels_[i].Row(motions);
        normal += row * row.transpose();
        twist += row * (wheel_radps[i] - wheels_[i].Swing(motions));
      }
      twist = normal.ldlt().solve(twist).eval();
    }
    return {twist.x(), twist.y(), twist.z()};
  }

 private:
  struct Wheel {
    std::size_t block;  // that carries it, in whose frame K it stands
    Pose2 X_KW;
    double cot, radius_m, max_speed_radps;
    bool out = false;  // of use
    Pose2 X_BW(const BlockMotions& motions) const { return motions.block[block].X_BK * X_KW; }
    // Its speed when its centre moves at v_B and its own x points along yaw_rad.
    double Speed(double yaw_rad, const Vec2& v_B) const {
      const Vec2 v_W = Pose2{0, 0, -yaw_rad}.Rotate(v_B);
      return (v_W.x() - cot * v_W.y()) / radius_m;
    }
    // Its speed for each of vx, vy and wz.
    Vec3 Row(const Pose2& X_BW) const {
      return {Speed(X_BW.yaw_rad, {1, 0}), Speed(X_BW.yaw_rad, {0, 1}),
              Speed(X_BW.yaw_rad, {-X_BW.y_m, X_BW.x_m})};
    }
    Vec3 Row(const BlockMotions& motions) const { return Row(X_BW(motions)); }
    // Its speed for the motion of its block against the body.
    double Swing(const BlockMotions& motions) const {
      const Pose2 at = X_BW(motions);
      return Speed(at.yaw_rad, motions.block[block].VelocityAt(at.p()));
    }
  };

  Eigen::MatrixX3d to_wheels_;  // a row a wheel: rad/s for each of vx, vy, wz, the hinges at rest
  Eigen::Matrix3Xd to_twist_;   // its pseudo-inverse
  std::vector<Wheel> wheels_;
  std::vector<BlockSpec> blocks_;
  std::vector<HingeSpec> hinges_;
};

}  // namespace

FP_DEFINE_PLUGIN(Drive, MecanumDrive)

}  // namespace floorproof

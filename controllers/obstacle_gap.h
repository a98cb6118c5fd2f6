// SPDX-License-Identifier: Apache-2.0
// Slows the robot down near known obstacles, as regulated pure pursuit does.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/params.h"
#include "controllers/reference_path.h"
#include "env/core/coverage.h"
#include "env/core/robot_spec.h"

namespace floorproof {

struct ObstacleGapParams {
  double gap_m = 0.10, speed_share = 0.6;
  void Visit(ParamVisitor& v) {
    v("obstacle_gap_m", gap_m, NonNegative(),
      "gap between clear shape and known obstacles below which it slows down");
    v("obstacle_speed_share", speed_share, Between(0.1, 1), "share of the speed at no gap");
  }
};

class ObstacleGap {
 public:
  // `clearance` may be nullptr: no obstacle is known.
  void Start(const ObstacleGapParams& params, const RobotSpec& robot,
             const ClearanceField* clearance) {
    params_ = params;
    clearance_ = clearance;
    radius_m_ = 0;
    border_B_.clear();
    if (robot.clear.kind == Shape2::Kind::kCircle) {
      radius_m_ = robot.inscribed_radius_m > 0 ? robot.inscribed_radius_m : robot.clear.radius_m;
      border_B_ = {Vec2::Zero()};
      return;
    }
    constexpr int kPointsAnEdge = 4;
    const Polygon& footprint = robot.clear.footprint_B;
    for (std::size_t i = 0; i < footprint.size(); ++i) {
      const Vec2 edge = footprint[(i + 1) % footprint.size()] - footprint[i];
      for (int k = 0; k < kPointsAnEdge; ++k)
        border_B_.emplace_back(footprint[i] + edge * k / kPointsAnEdge);
    }
  }
  // The speed allowed where the robot is and where it is heading.
  double Limit(double speed_mps, const Pose2& X_WB, const Vec2& target_W) const {
    return speed_mps * Share(X_WB, target_W);
  }
  // Seconds that this adds to a drive along the path at the path's own speeds. Speeding up and
  // stopping are taken to be as short as ever.
  double Delay(const ReferencePath& path) const {
    constexpr double kStep_m = 0.05, kAhead_m = 0.15;
    double delay_s = 0;
    if (clearance_ == nullptr || params_.gap_m <= 0) return delay_s;
    for (std::size_t i = 0; i + 1 < path.vertices.size(); ++i) {
      const ReferenceVertex& leg = path.vertices[i];
      const double length_m = path.vertices[i + 1].s_m - leg.s_m;
      const double yaw_rad =
          leg.yaw_rad.value_or(std::atan2(leg.direction_W.y(), leg.direction_W.x()));
      const int steps = std::max(1, static_cast<int>(std::ceil(length_m / kStep_m)));
      for (int k = 0; k < steps; ++k) {
        const double s_m = (k + 0.5) / steps * length_m;
        const auto at = [&](double way_m) -> Vec2 {
          return leg.p_W + std::min(way_m, length_m) * leg.direction_W;
        };
        const Vec2 p_W = at(s_m);
        const double share = Share({p_W.x(), p_W.y(), yaw_rad}, at(s_m + kAhead_m));
        delay_s += length_m / steps / leg.speed_mps * (1 / share - 1);
      }
    }
    return delay_s;
  }

 private:
  double Share(const Pose2& X_WB, const Vec2& target_W) const {
    if (clearance_ == nullptr || params_.gap_m <= 0) return 1;
    double gap_m = params_.gap_m + radius_m_;
    for (const Vec2& p_B : border_B_) {
      const Vec2 offset_W = X_WB.Rotate(p_B);
      gap_m = std::min(
          {gap_m, clearance_->At(X_WB.p() + offset_W), clearance_->At(target_W + offset_W)});
    }
    const double share = params_.speed_share;
    return share + (1 - share) * std::clamp((gap_m - radius_m_) / params_.gap_m, 0.0, 1.0);
  }

  ObstacleGapParams params_;
  // Points from which the gap is read, less radius_m_: the middle of a circle, a footprint's
  // border.
  std::vector<Vec2> border_B_;
  const ClearanceField* clearance_ = nullptr;
  double radius_m_ = 0;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "env/urdf/round_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace floorproof {
namespace {

using Kind = UrdfShape::Kind;

bool IsAlong(const UrdfShape& shape, const Vec3& axis) {
  constexpr double kAskew = 0.05;
  return shape.R_M.col(2).cross(axis).norm() < kAskew;
}

RoundFit FitOne(const UrdfShape& shape, const Vec3& p, const Vec3& axis) {
  constexpr double kBallWidth = 0.25;  // of its radius: what of a ball touches like a tyre
  double low = std::numeric_limits<double>::infinity(), high = -low, radius = 0;
  for (const Vec3& q : shape.Points()) {
    const double along = axis.dot(q - p);
    low = std::min(low, along);
    high = std::max(high, along);
    radius = std::max(radius, (q - p - along * axis).norm());
  }
  RoundFit fit{p + (low + high) / 2 * axis, radius, (high - low) / 2, ""};
  if (shape.kind == Kind::kSphere) {
    fit.radius_m = shape.size.x();
    fit.half_width_m = kBallWidth * shape.size.x();
    fit.guess = "its width: a ball stands for it";
  } else if (shape.kind == Kind::kCylinder && IsAlong(shape, axis)) {
    fit.radius_m = shape.size.x();
    fit.half_width_m = shape.size.y();
  } else {
    fit.guess = "its radius and width: the farthest points of its shape from its axle";
  }
  return fit;
}

}  // namespace

std::optional<RoundFit> FitRound(const std::vector<UrdfShape>& shapes, const Vec3& p,
                                 const Vec3& axis) {
  const bool solid = std::ranges::any_of(shapes, &UrdfShape::collides);
  std::optional<RoundFit> best;
  for (const UrdfShape& shape : shapes) {
    if (shape.collides != solid) continue;
    RoundFit fit = FitOne(shape, p, axis);
    if (!best || fit.radius_m > best->radius_m) best = std::move(fit);
  }
  return best;
}

Eigen::AlignedBox3d BoundsOf(const UrdfShape& shape) {
  Eigen::AlignedBox3d bounds;
  for (const Vec3& q : shape.Points()) bounds.extend(q);
  return bounds;
}

BallFit FitBall(const UrdfShape& shape) {
  if (shape.kind == Kind::kSphere) return {shape.p_M, shape.size.x(), ""};
  const Eigen::AlignedBox3d bounds = BoundsOf(shape);
  const Vec3 half = bounds.sizes() / 2;
  const bool lies = shape.kind == Kind::kCylinder && std::abs(shape.R_M(2, 2)) < 0.1;
  BallFit fit;
  fit.radius_m = lies ? shape.size.x() : half.minCoeff();
  fit.centre = bounds.center();
  fit.centre.z() = bounds.min().z() + fit.radius_m;
  fit.guess = "a ball in place of its shape";
  return fit;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Points, planar poses and polygons in SI units. World frame W: x right, y up, z up (REP 103
// bodies).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace floorproof {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

inline constexpr double kPi = 3.14159265358979323846;

// The angle's representative in (-pi, pi].
inline double WrapAngle(double a_rad) {
  a_rad = std::remainder(a_rad, 2 * kPi);
  return a_rad <= -kPi ? a_rad + 2 * kPi : a_rad;
}

// Degrees as they are written to files: in (-180, 180], rounded to a billionth, so that a resolved
// file that is read again gives exactly the same radians.
inline double CanonicalDegrees(double yaw_deg) {
  yaw_deg = std::round(std::remainder(yaw_deg, 360.0) * 1e9) / 1e9;
  return yaw_deg <= -180 ? yaw_deg + 360 : yaw_deg + 0.0;
}

inline double Cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

// A planar pose X_AB: body B in frame A. X_AB * X_BC = X_AC; X_AB * p_BC = p_AC.
struct Pose2 {
  double x_m = 0, y_m = 0, yaw_rad = 0;

  Vec2 p() const { return {x_m, y_m}; }
  // Most maps lie along the axes, and are asked of places millions of times: without a turn there
  // is nothing to take a sine of.
  Vec2 Rotate(const Vec2& v_B) const {
    if (yaw_rad == 0) return v_B;
    const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
    return {c * v_B.x() - s * v_B.y(), s * v_B.x() + c * v_B.y()};
  }
  Vec2 operator*(const Vec2& p_B) const { return p() + Rotate(p_B); }
  Pose2 operator*(const Pose2& X_BC) const {
    const Vec2 q = *this * X_BC.p();
    return {q.x(), q.y(), WrapAngle(yaw_rad + X_BC.yaw_rad)};
  }
  Pose2 Inverse() const {
    if (yaw_rad == 0) return {-x_m, -y_m, 0};
    const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
    return {-c * x_m - s * y_m, s * x_m - c * y_m, WrapAngle(-yaw_rad)};
  }
  // Inverse() * p but for rounding, with half as many sines and cosines.
  Vec2 InverseTimes(const Vec2& p) const {
    if (yaw_rad == 0) return {p.x() - x_m, p.y() - y_m};
    const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
    return {-c * x_m - s * y_m + (c * p.x() + s * p.y()),
            s * x_m - c * y_m + (c * p.y() - s * p.x())};
  }
  bool operator==(const Pose2&) const = default;
};

// The point of segment ab nearest to p, as the fraction in [0, 1] of the way from a to b.
inline double NearestFraction(const Vec2& a, const Vec2& b, const Vec2& p) {
  const Vec2 d = b - a;
  const double n = d.squaredNorm();
  return n == 0 ? 0.0 : std::fmin(1.0, std::fmax(0.0, (p - a).dot(d) / n));
}

inline double DistanceToSegment(const Vec2& a, const Vec2& b, const Vec2& p) {
  return (a + NearestFraction(a, b, p) * (b - a) - p).norm();
}

}  // namespace floorproof

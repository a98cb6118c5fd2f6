// SPDX-License-Identifier: Apache-2.0
// Dubins curves: the shortest ways from pose to pose of a robot that drives forward only and turns
// on arcs of at least a radius (Dubins 1957, "On curves of minimal length with a constraint on
// average curvature, and with prescribed initial and terminal positions and tangents").
#pragma once

#include <array>
#include <vector>

#include "env/geometry/geometry.h"

namespace floorproof {

struct DubinsCurve {
  Pose2 from;
  double radius_m = 0;
  // Three pieces, some of length 0: +1 an arc to the left, -1 to the right, 0 straight on.
  std::array<int, 3> turns{};
  std::array<double, 3> length_m{};

  double Length() const { return length_m[0] + length_m[1] + length_m[2]; }
  // The pose after s_m of the way.
  Pose2 At(double s_m) const;
};

// The places along a curve, for who asks for many of them.
class CurvePlaces {
 public:
  explicit CurvePlaces(const DubinsCurve& curve);
  // As DubinsCurve::At().
  Vec2 At(double s_m) const;

 private:
  DubinsCurve curve_;
  struct Piece {
    Vec2 p_W, along_W;  // where it begins, and its heading there, unit
  };
  std::array<Piece, 3> pieces_;
};

// Of the six kinds LSL, RSR, LSR, RSL, RLR and LRL those that there are, the shortest first.
struct DubinsCurves {
  std::array<DubinsCurve, 6> curves;
  int n = 0;
};
DubinsCurves CurvesBetween(const Pose2& from, const Pose2& to, double radius_m);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Lengths by the circles that touch both poses. Everything is in units of the radius, in the frame
// of the first pose: it stands at the origin and faces along x.
#include "planners/lines/dubins.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace floorproof {
namespace {

using Word = std::array<int, 3>;

// An arc forward takes 0 to a whole turn; what rounding makes of no turn is none.
double WithinATurn(double angle_rad) {
  constexpr double kNone = 1e-9;
  double turned = std::fmod(angle_rad, 2 * kPi);
  if (turned < 0) turned += 2 * kPi;
  return turned > 2 * kPi - kNone ? 0 : turned;
}

// Centre of the circle on that side of a pose.
Vec2 Centre(const Pose2& pose, int side) {
  return pose.p() + side * Vec2(-std::sin(pose.yaw_rad), std::cos(pose.yaw_rad));
}

// Arc, straight, arc: the heading of the straight is that of the line which touches both circles.
std::optional<std::array<double, 3>> WithStraight(const Pose2& to, const Word& word) {
  const Vec2 way = Centre(to, word[2]) - Centre({}, word[0]);
  double straight = way.norm(), heading = std::atan2(way.y(), way.x());
  if (word[0] != word[2]) {  // crosses from one side to the other
    const double squared = way.squaredNorm() - 4;
    if (squared < 0) return {};
    straight = std::sqrt(squared);
    heading += word[0] * std::atan2(2, straight);
  }
  return std::array{WithinATurn(word[0] * heading), straight,
                    WithinATurn(word[2] * (to.yaw_rad - heading))};
}

// Three arcs: the middle circle touches both others, on the far side, so that its arc is more than
// half a turn.
std::optional<std::array<double, 3>> OfArcs(const Pose2& to, const Word& word) {
  const Vec2 first = Centre({}, word[0]), last = Centre(to, word[2]);
  const Vec2 way = last - first;
  const double apart = way.norm();
  if (apart > 4) return {};
  const double aside = std::acos(apart / 4);
  const double line = apart > 0 ? std::atan2(way.y(), way.x()) : 0;
  const double to_middle = line + word[0] * aside;
  const Vec2 middle = first + 2 * Vec2(std::cos(to_middle), std::sin(to_middle));
  const Vec2 on = last - middle;
  // Headings where the arcs meet, square to the line of the centres.
  const double leaves = to_middle + word[0] * kPi / 2;
  const double enters = std::atan2(on.y(), on.x()) + word[1] * kPi / 2;
  return std::array{WithinATurn(word[0] * leaves), WithinATurn(word[1] * (enters - leaves)),
                    WithinATurn(word[2] * (to.yaw_rad - enters))};
}

// The way that a piece leads, in the frame of the pose where it begins.
Vec2 Ahead(int turn, double length_m, double radius_m) {
  if (turn == 0) return {length_m, 0};
  const double angle = turn * length_m / radius_m;
  return {radius_m * std::sin(std::abs(angle)), turn * radius_m * (1 - std::cos(angle))};
}

Pose2 Along(const Pose2& from, int turn, double length_m, double radius_m) {
  const Vec2 p = from * Ahead(turn, length_m, radius_m);
  if (turn == 0) return {p.x(), p.y(), from.yaw_rad};
  return {p.x(), p.y(), WrapAngle(from.yaw_rad + turn * length_m / radius_m)};
}

}  // namespace

Pose2 DubinsCurve::At(double s_m) const {
  Pose2 at = from;
  for (std::size_t k = 0; k < turns.size() && s_m > 0; ++k) {
    at = Along(at, turns[k], std::min(s_m, length_m[k]), radius_m);
    s_m -= length_m[k];
  }
  return at;
}

CurvePlaces::CurvePlaces(const DubinsCurve& curve) : curve_(curve) {
  Pose2 at = curve.from;
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    pieces_[k] = {at.p(), {std::cos(at.yaw_rad), std::sin(at.yaw_rad)}};
    if (k + 1 < pieces_.size()) at = Along(at, curve.turns[k], curve.length_m[k], curve.radius_m);
  }
}

Vec2 CurvePlaces::At(double s_m) const {
  std::size_t k = 0;
  for (; k + 1 < pieces_.size() && s_m > curve_.length_m[k]; ++k) s_m -= curve_.length_m[k];
  const auto& [p_W, along_W] = pieces_[k];
  const double length_m = std::min(s_m, curve_.length_m[k]);
  const Vec2 way = Ahead(curve_.turns[k], length_m, curve_.radius_m);
  return p_W + Vec2(along_W.x() * way.x() - along_W.y() * way.y(),
                    along_W.y() * way.x() + along_W.x() * way.y());
}

DubinsCurves CurvesBetween(const Pose2& from, const Pose2& to, double radius_m) {
  static constexpr Word kWords[] = {{1, 0, 1},  {-1, 0, -1}, {1, 0, -1},
                                    {-1, 0, 1}, {-1, 1, -1}, {1, -1, 1}};
  Pose2 there = from.Inverse() * to;
  there.x_m /= radius_m;
  there.y_m /= radius_m;
  DubinsCurves out;
  for (const Word& word : kWords) {
    const auto lengths = word[1] == 0 ? WithStraight(there, word) : OfArcs(there, word);
    if (!lengths) continue;
    DubinsCurve& curve = out.curves[static_cast<std::size_t>(out.n++)];
    curve = {from, radius_m, word, *lengths};
    for (double& length : curve.length_m) length *= radius_m;
  }
  std::stable_sort(out.curves.begin(), out.curves.begin() + out.n,
                   [](const auto& a, const auto& b) { return a.Length() < b.Length(); });
  return out;
}

}  // namespace floorproof

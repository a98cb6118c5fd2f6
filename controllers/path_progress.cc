// SPDX-License-Identifier: Apache-2.0
#include "controllers/path_progress.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace floorproof {
namespace {

constexpr double kTimeSlackS = 1e-9;     // sums of control periods are not exact
constexpr double kBendGateM = 0.3;       // a leg is left only this near its end
constexpr double kPushedBackM = 0.05;    // so far back, a bend that was near is ahead again
constexpr double kBesideCornerM = 0.04;  // farther beside a corner than this it is not reached yet

}  // namespace

void PathProgress::Start(const Path& path, const ReferenceLimits& limits,
                         double corner_tolerance_m) {
  limits_ = limits;
  corner_tolerance_m_ = corner_tolerance_m;
  reference_ = MakeReference(path, limits);
  // The way to the first waypoint is a homing to it; mostly the robot stands there already.
  phase_ = reference_.vertices.empty() ? Phase::kDone : Phase::kDrive;
  homing_ = true;
  leg_begins_ = false;
  vertex_ = goal_ = ahead_ = waypoint_ = 0;
  missed_ = {};
  if (!reference_.vertices.empty()) turn_W_ = Vertex(0).p_W;
  dwell_until_s_ = 0;
  creep_.Reset();
  is_held_ = false;
}

// A corner that was passed beside is not gone back to: the way leads on.
void PathProgress::Extend(const Path& path) {
  reference_ = MakeReference(path, limits_);
  homing_ = false;
  // Where it stands to dwell, the segment that is tracked is the one that led there.
  vertex_ = standing() && vertex_ > 0 && reference_.vertices.size() > 1 ? 1 : 0;
  goal_ = ahead_ = vertex_;
  waypoint_ = 0;
  seen_m_ = 0;
  creep_.Reset();
  const bool gone = standing() && (dwell_ >= leg().dwells.size() ||
                                   (phase_ == Phase::kFace && !leg().dwells[dwell_].face_rad));
  if (gone) Depart();
}

void PathProgress::Update(const Pose2& X_WB, double t_s) {
  if (phase_ == Phase::kDwell) EndDwells(t_s);
  const std::pair way(vertex_, homing_);
  if (moving()) Advance(X_WB, t_s);
  if (phase_ == Phase::kDrive && !is_held_ && way == std::pair(vertex_, homing_))
    creep_.Update(LeftFrom(X_WB.p()), t_s);
  else
    creep_.Reset();
}

bool PathProgress::WouldBeDone(const Pose2& X_WB, double t_s) const {
  if (phase_ == Phase::kDone) return true;
  const bool on_last_leg = vertex_ + 2 >= reference_.vertices.size();
  const Vec2& end_W = reference_.vertices.back().p_W;
  if (!on_last_leg || (end_W - X_WB.p()).norm() > kBendGateM + Wide()) return false;
  PathProgress then = *this;
  then.Update(X_WB, t_s);
  return then.phase_ == Phase::kDone;
}

void PathProgress::Advance(const Pose2& X_WB, double t_s) {
  if (homing_) {
    Settle(goal_, X_WB, t_s);
    return;
  }
  if (std::exchange(leg_begins_, false) && limits_.turn_radius_m > 0 && IsJudged(vertex_ + 1) &&
      Settle(vertex_ + 1, X_WB, t_s))
    return;
  while (true) {
    const ReferenceVertex &from = Vertex(vertex_), &to = Vertex(vertex_ + 1);
    const Vec2 passed = X_WB.p() - to.p_W;
    if (to.stop) {
      const double beyond_m = passed.dot(from.direction_W);
      if (beyond_m < -corner_tolerance_m_) return;
      // Who turns on the spot comes to rest there, or turns back.
      const bool on_it = limits_.turn_radius_m == 0 || beyond_m <= Reach();
      if (on_it && std::abs(Cross(from.direction_W, passed)) <= kBesideCornerM)
        return Arrive(vertex_ + 1, t_s);
      homing_ = true;
      goal_ = vertex_ + 1;
      if (HasPassed(goal_, X_WB)) Miss(goal_);
      return;
    }
    // A bend is passed at its bisector; far off, the plane alone would skip whole loops.
    if (passed.dot(from.direction_W + to.direction_W) < 0 || passed.norm() > kBendGateM + Wide())
      return;
    ++vertex_;
  }
}

// Arrives at a stop that is near, and gives up one that was passed. Whether it did either.
bool PathProgress::Settle(std::size_t vertex, const Pose2& X_WB, double t_s) {
  const double left_m = (Vertex(vertex).p_W - X_WB.p()).norm();
  const bool near = left_m <= (IsJudged(vertex) ? Reach() : std::max(Reach(), Wide()));
  if (near)
    Arrive(vertex, t_s);
  else if (HasPassed(vertex, X_WB))
    Miss(vertex);
  else
    return false;
  return true;
}

double PathProgress::Reach() const {
  return std::max(2 * corner_tolerance_m_, limits_.turn_radius_m > 0 ? kBesideCornerM : 0);
}

// Whether something is done there.
bool PathProgress::IsJudged(std::size_t vertex) const {
  return vertex + 1 == reference_.vertices.size() || !Vertex(vertex).dwells.empty();
}

// Whether the robot is near a stop and yet cannot come to it but by a loop: it drives away from it,
// or it lies inside the tightest circle on its side. From farther off it turns round.
bool PathProgress::HasPassed(std::size_t vertex, const Pose2& X_WB) const {
  if (limits_.turn_radius_m == 0 || !IsJudged(vertex)) return false;
  const Vec2 stop_B = X_WB.Inverse() * Vertex(vertex).p_W;
  if (stop_B.norm() > Wide() + Reach()) return false;
  const Vec2 from_middle(stop_B.x(), std::abs(stop_B.y()) - limits_.turn_radius_m);
  return stop_B.x() <= 0 || from_middle.norm() < limits_.turn_radius_m - Reach();
}

// Nothing is done there.
void PathProgress::Miss(std::size_t vertex) {
  vertex_ = ahead_ = vertex;
  homing_ = false;
  if (missed_.count++ == 0) missed_.first_W = Vertex(vertex).p_W;
  missed_.end = vertex + 1 == reference_.vertices.size();
  Folded();
}

void PathProgress::Arrive(std::size_t vertex, double t_s) {
  vertex_ = ahead_ = vertex;
  turn_W_ = Vertex(vertex).p_W;
  homing_ = false;
  dwell_ = 0;
  BeginDwell(t_s);
}

void PathProgress::BeginDwell(double t_s) {
  if (dwell_ == leg().dwells.size())
    Depart();
  else if (leg().dwells[dwell_].face_rad)
    phase_ = Phase::kFace;
  else
    Faced(t_s);
}

void PathProgress::Faced(double t_s) {
  phase_ = Phase::kDwell;
  dwell_until_s_ = t_s + leg().dwells[dwell_].time_s;
  EndDwells(t_s);
}

void PathProgress::EndDwells(double t_s) {
  if (t_s < dwell_until_s_ - kTimeSlackS) return;
  ++dwell_;
  BeginDwell(t_s);
}

void PathProgress::Depart() {
  if (Vertex(vertex_).shapes.empty())
    Folded();
  else
    phase_ = Phase::kFold;
}

void PathProgress::Folded() {
  leg_begins_ = vertex_ + 1 < reference_.vertices.size();
  phase_ = leg_begins_ ? Phase::kTurn : Phase::kDone;
}

// The way along the legs that p_W has come, not before the leg now tracked.
double PathProgress::Along(const Vec2& p_W) const {
  const ReferenceVertex& from = Vertex(vertex_);
  if (homing_ || standing() || vertex_ + 1 == reference_.vertices.size()) return from.s_m;
  const double leg_m = Vertex(vertex_ + 1).s_m - from.s_m;
  return from.s_m + std::clamp((p_W - from.p_W).dot(from.direction_W), 0.0, leg_m);
}

std::size_t PathProgress::Segment(const Vec2& p_W) {
  const std::size_t n = reference_.waypoint_s_m.size();
  if (n < 2) return 0;
  const double s_m = Along(p_W);
  const auto left = [&](double end_m) { return standing() ? end_m < s_m : end_m <= s_m; };
  while (waypoint_ + 2 < n && left(reference_.waypoint_s_m[waypoint_ + 1])) ++waypoint_;
  return waypoint_;
}

// Moves ahead_ to the leg that holds the point `way_m` ahead. If that point lies beyond a stop,
// ahead_ becomes the leg that ends at the stop. Returns the distance of the point along that leg or
// its extension.
double PathProgress::SeekAhead(const Vec2& p_W, double way_m) {
  const double s_m = Along(p_W) + way_m;
  ahead_ = std::max(ahead_, vertex_);
  while (ahead_ > vertex_ && Vertex(ahead_).s_m > s_m) --ahead_;
  while (!Vertex(ahead_ + 1).stop && Vertex(ahead_ + 1).s_m <= s_m) ++ahead_;
  return s_m - Vertex(ahead_).s_m;
}

// The way to the end of the leg, or to where it is homing to.
double PathProgress::LeftFrom(const Vec2& p_W) const {
  if (homing_) return (Vertex(goal_).p_W - p_W).norm() - corner_tolerance_m_;
  return (Vertex(vertex_ + 1).p_W - p_W).dot(leg().direction_W);
}

double PathProgress::SpeedFrom(const Vec2& p_W) const {
  const double then_mps = homing_ ? 0 : Vertex(vertex_ + 1).passing_mps;
  const double approach_mps = ApproachSpeed(then_mps, LeftFrom(p_W), limits_);
  return std::min(homing_ ? limits_.cruise_mps : leg().speed_mps,
                  std::max(approach_mps, creep_.speed()));
}

PathProgress::Aim PathProgress::AimFrom(const Vec2& p_W, double speed_mps,
                                        const Lookahead& lookahead) {
  if (homing_) return {Vertex(goal_).p_W, SpeedFrom(p_W)};
  if (phase_ == Phase::kTurn) speed_mps = leg().speed_mps;
  // Beyond a stop the point lies on the leg's extension, so that the robot arrives straight.
  const double along_m = SeekAhead(p_W, std::clamp(speed_mps * lookahead.time_s, lookahead.min_m,
                                                   std::max(lookahead.min_m, lookahead.max_m)));
  return {Vertex(ahead_).p_W + along_m * Vertex(ahead_).direction_W, SpeedFrom(p_W)};
}

PathProgress::Course PathProgress::CourseFrom(const Vec2& p_W, double ahead_m) {
  if (homing_) return {(Vertex(goal_).p_W - p_W).normalized(), Vec2::Zero(), SpeedFrom(p_W)};
  ahead_ = std::max(ahead_, vertex_);
  const double left_m = Vertex(vertex_ + 1).s_m - Along(p_W);
  if (ahead_ == vertex_ && left_m <= ahead_m && !Vertex(vertex_ + 1).stop) {
    ++ahead_;
    seen_m_ = left_m;
  } else if (ahead_ > vertex_ && left_m > seen_m_ + kPushedBackM) {
    ahead_ = vertex_;
  }
  const Vec2 from_leg_W = p_W - leg().p_W, &along_W = leg().direction_W;
  return {Vertex(ahead_).direction_W, from_leg_W.dot(along_W) * along_W - from_leg_W,
          SpeedFrom(p_W)};
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "controllers/compliance.h"

#include <algorithm>

#include "controllers/follower_params.h"

namespace floorproof {
namespace {

// What is older than this counts for less: a time, or at a slow pace the time that this way takes.
// A robot at 0.05 m/s would never be expected to have come as far as is judged.
constexpr double kLately_s = 0.4, kLately_m = 0.04;
constexpr double kLeast_m = 0.02;   // of way expected before the way made is judged
constexpr double kHeldShare = 0.5;  // who makes less of it is held
constexpr double kAside_s = 0.1;    // over which the slide is smoothed; later, it overshoots
// Of the turn about the caught wheel that would undo the slide: from a fifth to two thirds of it,
// covers and steps are crossed alike; with more of it the robot swings from side to side.
constexpr double kSquaringShare = 0.4;
constexpr double kBackShare = 0.25;  // of the speed: wheels keep turning, the path is not lost

}  // namespace

void Compliance::Start(const RobotSpec& robot, double bearable_rad) {
  length_m_ = 2 * robot.circumscribed_radius_m;
  bearable_rad_ = bearable_rad;
  Drop();
}

void Compliance::Drop() {
  last_W_.reset();
  expected_mps_ = expected_m_ = made_m_ = aside_mps_ = to_bear_m_ = 0;
  held_ = false;
}

void Compliance::Update(const Vec2& p_W, const Vec2& direction_W, double commanded_mps,
                        double dt_s) {
  const Vec2 step_W = last_W_ ? Vec2(p_W - *last_W_) : Vec2(Vec2::Zero());
  last_W_ = p_W;
  const double step_m = step_W.dot(direction_W);
  const auto share = [dt_s](double time_s) { return std::min(1.0, dt_s / time_s); };
  expected_mps_ += (commanded_mps - expected_mps_) * share(kWheelLag_s);
  const double lately_s = std::max(kLately_s, kLately_m / std::max(expected_mps_, 1e-6));
  expected_m_ += expected_mps_ * dt_s - expected_m_ * share(lately_s);
  made_m_ += step_m - made_m_ * share(lately_s);
  aside_mps_ += (Cross(direction_W, step_W) / dt_s - aside_mps_) * share(kAside_s);

  to_bear_m_ = std::max(0.0, to_bear_m_ - std::max(0.0, step_m));
  held_ = expected_m_ > kLeast_m && made_m_ < kHeldShare * expected_m_;
  if (held_) to_bear_m_ = length_m_;
}

double Compliance::YawError(double error_rad) const {
  return active() ? error_rad - std::clamp(error_rad, -bearable_rad_, bearable_rad_) : error_rad;
}

double Compliance::SquaringRate() const {
  return held_ && length_m_ > 0 ? -kSquaringShare * aside_mps_ / (0.5 * length_m_) : 0;
}

double Compliance::BackSpeed(double speed_mps, double otherwise_mps) const {
  return active() ? kBackShare * speed_mps : otherwise_mps;
}

}  // namespace floorproof

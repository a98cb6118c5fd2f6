// SPDX-License-Identifier: Apache-2.0
#include "controllers/recovery.h"

#include <algorithm>
#include <cmath>

#include "controllers/drive.h"

namespace floorproof {
namespace {

constexpr double kStanding_mps = 0.02, kStanding_radps = 0.05;
constexpr double kAhead = 0.1, kBehind = 0.5;  // cosines: so much on its way; squarely behind

// Calls see(side) with where each alarm came from, unit, body frame.
template <class See>
void ForEachAlarm(const Observation& sensed, bool bumper, bool cliff, const See& see) {
  if (bumper && sensed.bump.pressed)
    see(Vec2(std::cos(sensed.bump.bearing_rad), std::sin(sensed.bump.bearing_rad)));
  for (std::size_t i = 0; cliff && i < static_cast<std::size_t>(sensed.cliffs.n); ++i)
    if (sensed.cliffs.drop[i]) see(Vec2(sensed.cliffs.p_B[i].normalized()));
}

// Where they came from on the whole; zero: from no side.
Vec2 Side(const Observation& sensed, bool bumper, bool cliff) {
  Vec2 sum = Vec2::Zero();
  ForEachAlarm(sensed, bumper, cliff, [&](const Vec2& side) { sum += side; });
  return sum;
}

// How squarely one of them lies on this way, at most 1; alarms on opposite sides do not make up for
// each other.
double Ahead(const Observation& sensed, bool bumper, bool cliff, const Vec2& way_B) {
  double most = -1;
  ForEachAlarm(sensed, bumper, cliff,
               [&](const Vec2& side) { most = std::max(most, side.dot(way_B)); });
  return most;
}

}  // namespace

std::vector<Reading> RecoveryParams::Needs() const {
  std::vector<Reading> needs;
  if (bumper) needs.push_back(Reading::kBump);
  if (cliff) needs.push_back(Reading::kCliffs);
  return needs;
}

void RecoveryParams::Visit(ParamVisitor& v) {
  v("bumper", bumper, "react when the shell is pressed");
  v("cliff", cliff, "react when a cliff sensor sees no floor");
  v("back_off_m", back_off_m, Between(0.01, 2),
    "way back from what was met (m); at least the width of the robot's tightest turn");
  v("back_off_mps", back_off_mps, Positive(), "speed of going back (m/s)");
  v("then", then, {"replan", "go_on"},
    "replan: drive around what was met to where the plan goes on behind it; go_on: straight to the "
    "first place of the plan behind it that can be gone to so");
  v("most", most, Between(1, 1e6), "reactions an episode; after them the robot drives blindly");
}

void Recovery::Start(const RecoveryParams& params, const RobotSpec& robot) {
  params_ = params;
  robot_ = &robot;
  holonomic_ = IsHolonomic(robot);
  state_ = State::kIdle;
  ended_ = false;
  count_ = 0;
}

bool Recovery::Alarm(const Observation& sensed) const {
  return (params_.bumper && sensed.bump.pressed) || (params_.cliff && sensed.cliffs.any());
}

// Back along the way it came, which is known to be free; a robot that stood or turned goes away
// from what it met.
void Recovery::Begin(const Observation& sensed, const BodyTwist& commanded) {
  ++count_;
  met_drop_ = params_.cliff && sensed.cliffs.any();
  between_ = false;
  turn_ = 0;
  GoBack(std::max(params_.back_off_m, 2 * robot_->turn_radius_m));
  way_B_ = -Vec2(commanded.vx_mps, commanded.vy_mps);
  if (way_B_.norm() < kStanding_mps) {
    way_B_ = -Side(sensed, params_.bumper, params_.cliff);
    if (!holonomic_) way_B_.y() = 0;
    if (way_B_.norm() < 0.3 && std::abs(commanded.wz_radps) > kStanding_radps) {
      way_B_ = Vec2::Zero();
      turn_ = commanded.wz_radps > 0 ? -1 : 1;
    }
  }
  if (way_B_.norm() > 0) way_B_.normalize();
}

// So far, once it stands.
void Recovery::GoBack(double m) {
  back_m_ = m;
  left_s_ = 2 * std::max(params_.back_off_m, m) / params_.back_off_mps + 2;
  state_ = State::kBrake;
}

// Brakes at once; gathers speed as the robot can.
void Recovery::Approach(const BodyTwist& wanted, double dt_s) {
  const double dv = robot_->max_accel_mps2 * dt_s, dw = robot_->max_yaw_accel_radps2 * dt_s;
  const Vec2 now(twist_.vx_mps, twist_.vy_mps), to(wanted.vx_mps, wanted.vy_mps);
  const Vec2 change = to - now;
  const Vec2 v = now + change * std::min(1.0, dv / std::max(change.norm(), 1e-12));
  twist_ = {v.x(), v.y(), twist_.wz_radps + std::clamp(wanted.wz_radps - twist_.wz_radps, -dw, dw)};
}

bool Recovery::Update(const Observation& sensed, const Estimate& estimate, double dt_s,
                      Command& command) {
  ended_ = false;
  if (state_ == State::kIdle) {
    if (command.done || count_ >= params_.most || !Alarm(sensed)) return false;
    Begin(sensed, command.twist);
  }
  left_s_ -= dt_s;
  if (state_ == State::kBrake) {
    twist_ = {};  // the motors stop the wheels as fast as they can
    const BodyTwist& v = estimate.V_WB_B;
    if (std::hypot(v.vx_mps, v.vy_mps) < kStanding_mps || left_s_ < 0) {
      state_ = State::kBack;
      from_ = estimate.X_WB;
    }
  } else {
    const double speed_mps = std::min(params_.back_off_mps, robot_->max_speed_mps);
    const double turn_radps = std::min(speed_mps / std::max(robot_->circumscribed_radius_m, 1e-3),
                                       robot_->max_yaw_rate_radps);
    Approach({speed_mps * way_B_.x(), speed_mps * way_B_.y(), turn_ * turn_radps}, dt_s);
    const double gone_m = (estimate.X_WB.p() - from_.p()).norm() +
                          std::abs(WrapAngle(estimate.X_WB.yaw_rad - from_.yaw_rad)) *
                              (turn_ != 0 ? robot_->circumscribed_radius_m : 0);
    // It goes back no further into something else, nor for ever. From there all of the way back
    // again would lead into what it met before; to the middle it has just come along.
    const double ahead = between_ ? -1 : Ahead(sensed, params_.bumper, params_.cliff, way_B_);
    if (ahead > kBehind && gone_m < back_m_) {
      between_ = true;
      met_drop_ |= params_.cliff && sensed.cliffs.any();
      way_B_ = -way_B_;
      GoBack(gone_m / 2);
      twist_ = {};
    } else if (gone_m >= back_m_ || ahead > kAhead || left_s_ < 0) {
      state_ = State::kIdle;
      ended_ = true;
      twist_ = {};
    }
  }
  command.twist = twist_;
  command.hinges.radps = {};
  command.dwelling = false;
  command.tasks = {};
  command.reacting = true;
  command.turning = turn_ != 0;
  return true;
}

}  // namespace floorproof

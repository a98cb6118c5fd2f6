// SPDX-License-Identifier: Apache-2.0
#include "run/episode/robot_side.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "controllers/follower_params.h"
#include "env/core/driven_floor.h"

namespace floorproof {

RobotSide::RobotSide(const RobotSpec& robot, const HazardMap& known, Navigator& navigator,
                     const Parts& parts, double control_s)
    : robot_(robot),
      known_(known),
      navigator_(navigator),
      parts_(parts),
      control_s_(control_s),
      clearance_(ComputeClearance(known, robot.step_m)),
      drive_(MakePlugin(Drives(), robot.drive, "drive")),
      wheel_radps_(robot.wheels.size()) {
  drive_->Configure(robot);
  if (parts.mapper != nullptr) mapper_ = *parts.mapper;
  if (parts.recovery != nullptr) recovery_.emplace();
  if (parts.safety != nullptr)
    supervisor_ = std::make_unique<Supervisor>(*parts.safety, robot, known);
}

void RobotSide::Start(const Pose2& start, const Stream& draws) {
  parts_.estimator.Start({known_, robot_, start, draws});
  if (mapper_) mapper_->Start(known_.frame, robot_, !parts_.drives_by_map);
  if (recovery_) recovery_->Start(*parts_.recovery, robot_);
  Follow();
}

const Actuation& RobotSide::Control(const Observation& sensed) {
  if (supervisor_) Supervise(sensed);
  const auto wish = supervisor_ ? supervisor_->wish().kind : MotionWish::Kind::kPlan;
  if (wish == MotionWish::Kind::kTurn)
    Turn(supervisor_->wish().yaw_rad);
  else if (wish == MotionWish::Kind::kStand)
    command_.twist = {};
  else
    GoOn(sensed);
  return Actuate();
}

// It is watched by what it was told to do and what its sensors tell of that.
void RobotSide::Supervise(const Observation& sensed) {
  supervisor_->Update(
      {sensed.t_s, control_s_, actuation_.twist, wheel_radps_, sensed.wheel_rad, sensed.hinges,
       sensed.has_imu, sensed.gyro_radps, sensed.accel_mps2, sensed.scan, sensed.bump, sensed.power,
       estimate_},
      {supervisor_->wish().kind == MotionWish::Kind::kLine ? command_.done : at_end(),
       command_.dwelling || command_.turning || command_.reacting});
  parts_.tracker.Slow(supervisor_->speed_share());
  if (reconfigurations_ == supervisor_->reconfigurations()) return;
  reconfigurations_ = supervisor_->reconfigurations();
  drive_->Exclude(supervisor_->wheels_out());
  parts_.estimator.Exclude(supervisor_->wheels_out());
}

void RobotSide::GoOn(const Observation& sensed) {
  const bool held = supervisor_ && supervisor_->speed_share() == 0;
  const bool recovering =
      !held && recovery_ && recovery_->Update(sensed, estimate_, control_s_, command_);
  if (!recovering || recovery_->ended()) Navigate(sensed);
  if (recovering) return;
  command_ = parts_.tracker.Update(estimate_, sensed.t_s, control_s_);
  CountMissed();
}

// A mission that leads by lines judges itself whether it came there.
void RobotSide::CountMissed() {
  const bool line = supervisor_ && supervisor_->wish().kind == MotionWish::Kind::kLine;
  const MissedStops missed = parts_.tracker.Missed();
  const int more = missed.count - std::exchange(missed_on_path_, missed.count);
  if (line || more == 0) return;
  if (missed_.count == 0) missed_.first_W = missed.first_W;
  missed_.count += more;
  missed_.end = missed.end;
}

// On the spot to this heading, as fast as it may and can come to rest there.
void RobotSide::Turn(double yaw_rad) {
  const double left_rad = WrapAngle(yaw_rad - estimate_.X_WB.yaw_rad);
  const double rate = TurningRate(left_rad, robot_.max_yaw_rate_radps, robot_.max_yaw_accel_radps2);
  const double wanted = supervisor_->speed_share() * std::copysign(rate, left_rad);
  const double most = robot_.max_yaw_accel_radps2 * control_s_;
  const double now = command_.twist.wz_radps;
  command_.twist = {0, 0, std::clamp(wanted, now - most, now + most)};
  command_.turning = true;
  command_.dwelling = command_.done = false;
}

const Actuation& RobotSide::Stand() {
  command_.twist = {};
  return Actuate();
}

void RobotSide::GoOnFrom(std::size_t waypoint) {
  navigator_.GoOnFrom(waypoint);
  if (recovery_) recovery_->Drop();
  Follow();
  Actuate();
}

void RobotSide::Helped(const Pose2& X_WB, const Stream& draws, double t_s) {
  if (!supervisor_) return;
  if (supervisor_->asks_for_help()) {
    parts_.estimator.Start({known_, robot_, X_WB, draws});
    parts_.estimator.Exclude(supervisor_->wheels_out());
  }
  supervisor_->SetDown(t_s);
}

void RobotSide::Navigate(const Observation& sensed) {
  const bool recovered = recovery_ && recovery_->ended();
  const bool line = supervisor_ && supervisor_->wish().kind == MotionWish::Kind::kLine;
  switch (navigator_.Update({sensed.t_s, estimate_, known(), command_.segment, command_.done,
                             recovered, recovered && recovery_->met_drop(),
                             line ? &supervisor_->wish().line : nullptr})) {
    case PathChange::kNone:
      break;
    case PathChange::kAnew:
      Follow();
      break;
    case PathChange::kLonger:
      parts_.tracker.Extend(navigator_.path());
      command_.segment = 0;
      command_.tasks = {};
      ++paths_;
      break;
  }
  if (mapper_) mapper_->ForgetChanges();
}

void RobotSide::Perceive(const Observation& sensed, double dt_s) {
  estimate_ = parts_.estimator.Update(sensed, dt_s);
  if (mapper_) mapper_->Update(sensed, estimate_);
}

// A new path: what was commanded on the last one is over.
void RobotSide::Follow() {
  command_ = {};
  missed_on_path_ = 0;
  ++paths_;
  if (!parts_.drives_by_map) {
    parts_.tracker.Start(navigator_.path(), robot_, nullptr);
    return;
  }
  auto on_the_way = LevelChangesOnTheWay(known_, navigator_.path());
  if (on_the_way != on_the_way_) {
    on_the_way_ = std::move(on_the_way);
    clearance_ = ClearanceOnTheWay(known_, on_the_way_, robot_.step_m);
  }
  parts_.tracker.Start(navigator_.path(), robot_, &clearance_);
}

const Actuation& RobotSide::Actuate() {
  actuation_.twist = command_.twist;
  actuation_.hinges = command_.hinges;
  actuation_.hinges.TakeSteering(estimate_.hinges);
  drive_->ToWheels(actuation_.twist, actuation_.hinges, wheel_radps_);
  actuation_.wheel_radps = wheel_radps_;
  if (supervisor_) actuation_.cut = supervisor_->cut();
  return actuation_;
}

}  // namespace floorproof

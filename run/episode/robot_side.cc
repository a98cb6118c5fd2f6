// SPDX-License-Identifier: Apache-2.0
#include "run/episode/robot_side.h"

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
}

void RobotSide::Start(const Pose2& start, const Stream& draws) {
  parts_.estimator.Start({known_, robot_, start, draws});
  if (mapper_) mapper_->Start(known_.frame, robot_, !parts_.drives_by_map);
  if (recovery_) recovery_->Start(*parts_.recovery, robot_);
  Follow();
}

const Actuation& RobotSide::Control(const Observation& sensed) {
  Perceive(sensed);
  const bool recovering = recovery_ && recovery_->Update(sensed, estimate_, control_s_, command_);
  if (!recovering || recovery_->ended()) Navigate(sensed);
  if (!recovering) command_ = parts_.tracker.Update(estimate_, sensed.t_s, control_s_);
  return Actuate();
}

const Actuation& RobotSide::Stand(const Observation& sensed) {
  Perceive(sensed);
  command_.twist = {};
  return Actuate();
}

void RobotSide::GoOnFrom(std::size_t waypoint) {
  navigator_.GoOnFrom(waypoint);
  if (recovery_) recovery_->Drop();
  Follow();
  Actuate();
}

void RobotSide::Navigate(const Observation& sensed) {
  const bool recovered = recovery_ && recovery_->ended();
  switch (navigator_.Update({sensed.t_s, estimate_, known(), command_.segment, command_.done,
                             recovered, recovered && recovery_->met_drop()})) {
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

void RobotSide::Perceive(const Observation& sensed) {
  estimate_ = parts_.estimator.Update(sensed, control_s_);
  if (mapper_) mapper_->Update(sensed, estimate_);
}

// A new path: what was commanded on the last one is over.
void RobotSide::Follow() {
  command_ = {};
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
  drive_->ToWheels(actuation_.twist, actuation_.hinges, wheel_radps_);
  actuation_.wheel_radps = wheel_radps_;
  return actuation_;
}

}  // namespace floorproof

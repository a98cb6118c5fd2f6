// SPDX-License-Identifier: Apache-2.0
#include "env/faults/schedule.h"

#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

// Of a time that is a sum of steps: 6e-8 s after an hour. The shortest step is 500 times as long.
constexpr double kRounding_s = 1e-6;

}  // namespace

void FaultTiming::Visit(ParamVisitor& v) {
  v("onset_s", onset_s, NonNegative(), "when it breaks, in the episode's time (s)");
  v("duration_s", duration_s, Positive(), "how long it is broken (s); none: to the end");
  v("period_s", period_s, Positive(), "of a fault that comes and goes (s); none: it stays");
  v("duty", duty, {0, 1, true}, "share of each period in which it is broken, from its start");
}

bool FaultTiming::Holds(double t_s) const {
  const double since_s = t_s - onset_s + kRounding_s;
  if (since_s < 0 || (duration_s && since_s >= *duration_s)) return false;
  return !period_s || std::fmod(since_s, *period_s) < duty * *period_s;
}

void FaultSchedule::Start(const FaultContext& context) {
  for (const ScheduledFault& scheduled : faults_) scheduled.fault->Start(context);
  const auto& wheels = context.robot.wheels;
  built_ = {};
  built_.wheel_torque.assign(wheels.size(), 1);
  built_.wheel_stuck_radps.assign(wheels.size(), {});
  built_.wheel_friction.assign(wheels.size(), {});
  if (std::ranges::any_of(wheels, [](const WheelSpec& w) { return w.roller_radius_m > 0; }))
    built_.roller_drag.assign(wheels.size(), 0);
  holds_.clear();
}

const Alterations* FaultSchedule::Update(double t_s) {
  bool changed = holds_.size() != faults_.size();
  holds_.resize(faults_.size(), kSound);
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    State& state = holds_[i];
    const bool held = state != kSound, holds = faults_[i].timing.Holds(t_s);
    changed |= holds != held;
    state = !holds ? kSound : held ? kBroken : kBreaks;
  }
  if (!changed) return nullptr;
  now_ = built_;
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    if (holds_[i] == kSound) continue;
    const std::optional<Pose2> carried = now_.carried;
    faults_[i].fault->Break(now_);
    if (holds_[i] == kBroken) now_.carried = carried;  // that was when it began
  }
  return &now_;
}

}  // namespace floorproof

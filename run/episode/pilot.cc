// SPDX-License-Identifier: Apache-2.0
#include "run/episode/pilot.h"

#include "base/streams.h"
#include "planners/lines/rejoin.h"
#include "run/episode/path_error.h"

namespace floorproof {
namespace {

// Nearer to a wall of the map, what was seen is that wall, drawn where the robot thought it was.
constexpr double kSeenAway_m = 0.12;

}  // namespace

Pilot::Pilot(Scenario& scenario, const Scene& scene, const HazardMap& known, const PlanResult& plan)
    : s_(scenario),
      scene_(scene),
      known_(known),
      plan_(plan),
      robot_(scenario.robot.spec),
      control_s_(1.0 / scenario.episode.control_hz),
      clearance_(ComputeClearance(known, robot_.step_m)),
      drive_(MakePlugin(Drives(), robot_.drive, "drive")),
      path_(plan.path),
      wheel_radps_(robot_.wheels.size()) {
  drive_->Configure(robot_);
  if (s_.mapper) mapper_ = *s_.mapper;
  if (s_.recovery) recovery_.emplace();
}

Stream Pilot::StreamOf(const std::string& name) const {
  return {static_cast<std::uint64_t>(s_.episode.seed), s_.episode_id, name};
}

void Pilot::Start(Simulation& sim) {
  for (auto& [name, sensor] : s_.sensors)
    sensor->Start({scene_, s_.site.map, robot_, control_s_}, sim.data(), sim.sample(),
                  StreamOf("sensors." + name), sensed_);
  s_.estimator->Start({known_, robot_, s_.start, StreamOf("estimator")});
  if (mapper_) mapper_->Start(known_.frame, robot_);
  if (recovery_) recovery_->Start(*s_.recovery, robot_);
  s_.tracker->Start(path_, robot_, &clearance_);
}

void Pilot::OnStep(const Sample& truth) {
  for (auto& [name, sensor] : s_.sensors) sensor->OnStep(truth);
}

// Where it went is not asked again: the rest of the path, joined from where the robot thinks it is.
void Pilot::TakeNewPath() {
  const KnownMap& drawn = mapper_->map();
  const HazardMap known = WithSeen(known_, drawn, robot_.step_m, kSeenAway_m);
  path_ = Rejoin({known, drawn.marks, robot_, plan_.clear, path_, command_.segment, estimate_.X_WB,
                  s_.recovery->then == "replan"});
  s_.tracker->Start(path_, robot_, &clearance_);
  command_ = {};
}

void Pilot::GoOnFrom(std::size_t waypoint, Simulation& sim) {
  path_.erase(path_.begin(), path_.begin() + static_cast<std::ptrdiff_t>(waypoint));
  if (recovery_) recovery_->Drop();
  s_.tracker->Start(path_, robot_, &clearance_);
  command_ = {};
  Actuate(sim);
}

void Pilot::Sense(Simulation& sim) {
  const Sample& truth = sim.sample();
  sensed_.t_s = truth.t_s;
  for (auto& [name, sensor] : s_.sensors) sensor->Sense(sim.data(), truth, sensed_);
  estimate_ = s_.estimator->Update(sensed_, truth, control_s_);
  if (mapper_) mapper_->Update(sensed_, estimate_);
}

void Pilot::Actuate(Simulation& sim) {
  Sample& truth = sim.sample();
  truth.command = command_;
  truth.command.cross_track_half_width_m =
      HalfWidth(clearance_, path_, command_.segment, truth.p_WB.head<2>());
  drive_->ToWheels(truth.command.twist, truth.command.hinges, wheel_radps_);
  sim.SetWheelSpeeds(wheel_radps_);
  sim.SetHingeSpeeds(truth.command.hinges);
}

void Pilot::Control(Simulation& sim) {
  Sense(sim);
  const bool reacts = recovery_ && recovery_->Update(sensed_, estimate_, control_s_, command_);
  if (reacts && recovery_->ended()) TakeNewPath();
  if (!reacts) command_ = s_.tracker->Update(estimate_, sensed_.t_s, control_s_);
  Actuate(sim);
}

void Pilot::Stand(Simulation& sim) {
  Sense(sim);
  command_.twist = {};
  Actuate(sim);
}

}  // namespace floorproof

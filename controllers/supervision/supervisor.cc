// SPDX-License-Identifier: Apache-2.0
#include "controllers/supervision/supervisor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "controllers/odometry.h"

namespace floorproof {
namespace {

// From its highest speed, by its drivers.
double ComesToRest_s(const RobotSpec& robot) {
  constexpr double kLag_s = 0.7;  // of tracker, wheels and who watches them
  return robot.max_accel_mps2 > 0 ? robot.max_speed_mps / robot.max_accel_mps2 + kLag_s : 2;
}

// Where a node stands in the tree, from its task on.
std::vector<std::string> PathsOf(const Mission& mission) {
  std::vector<std::string> paths(mission.nodes.size());
  paths[0] = mission.name.empty() ? "mission" : mission.name;
  for (std::size_t i = 0; i < mission.nodes.size(); ++i)
    for (const std::size_t child : mission.nodes[i].children)
      paths[child] = (i == 0 ? "" : paths[i] + ".") + mission.nodes[child].name;
  return paths;
}

}  // namespace

Supervisor::Supervisor(const SafetyPlan& plan, const RobotSpec& robot, const HazardMap& known)
    : plan_(plan),
      monitors_(MakePlugins<NamedMonitor>(Monitors(), plan.monitors, "monitors")),
      robot_(robot),
      known_(known),
      comes_to_rest_s_(ComesToRest_s(robot)),
      wheels_(robot),
      drive_(MakePlugin(Drives(), robot.drive, "drive")),
      board_{.now = nullptr, .monitors = monitors_, .wheels = &wheels_, .wish = {}},
      run_(plan.mission,
           [&](const MissionNode& node) {
             std::vector<std::size_t> monitors;
             for (const std::string& name : MonitorsOf(node)) {
               const auto found = std::ranges::find(monitors_, name, &NamedMonitor::name);
               if (found != monitors_.end())
                 monitors.push_back(static_cast<std::size_t>(found - monitors_.begin()));
             }
             auto primitive = MakePrimitive(plan.mission, node);
             primitive->Prepare({robot, plan.mission.primitives[node.primitive].rating,
                                 plan.mission.weights, board_, std::move(monitors)});
             primitives_.resize(plan.mission.nodes.size());
             primitives_[static_cast<std::size_t>(&node - plan.mission.nodes.data())] =
                 primitive.get();
             return primitive;
           }),
      decision_(plan.mission.decision),
      logged_(plan.mission.nodes.size()),
      wheels_raised_(robot.wheels.size(), 0),
      all_wheels_(robot.wheels.size(), 1),
      paths_(PathsOf(plan.mission)) {
  primitives_.resize(plan.mission.nodes.size());
  drive_->Configure(robot);
  StartMonitors();
  for (const NamedMonitor& monitor : monitors_)
    raised_.emplace_back(monitor.monitor->alarms().size(), 0);
  radps_.assign(robot.wheels.size(), 0);
  rows_.reserve(256);
}

void Supervisor::StartMonitors() {
  for (const NamedMonitor& monitor : monitors_) {
    monitor.monitor->Start({robot_, *drive_, known_});
    for (std::size_t w = 0; w < wheels_.out().size(); ++w)
      if (wheels_.out()[w]) monitor.monitor->Ignore(w);
  }
}

void Supervisor::Update(const MonitorReadings& now, const Motion& motion) {
  board_.now = &now;
  board_.at_end = motion.at_end;
  board_.busy = motion.busy;
  board_.speed_share = share_;
  if (stopped_.empty()) Watch(now);
  const bool over = !stopped_.empty() || asks_;
  if (!over) Run(now.t_s);
  LogNodes(now.t_s);
  decision_.Update(now.t_s, run_.safety_states(), std::exchange(reconfigured_, {}));
  LogTransitions(now.t_s);
  if (!over && plan_.reaction.react) React(now.t_s);
  if (!plan_.reaction.react && decision_.state() == DecisionState::kReconfiguring)
    reconfigured_ = false;  // nothing is tried
  if (share_ != shares_.back().share) shares_.push_back({now.t_s, share_});
  if (share_ > 0) told_to_stand_s_ = now.t_s;
  if (share_ == 0) held_s_ += now.dt_s;
  cuts_all_ |= !stopped_.empty() && now.t_s - told_to_stand_s_ > comes_to_rest_s_;
  board_.now = nullptr;
}

void Supervisor::Run(double t_s) {
  for (const std::size_t skill : run_.skills()) {
    if (run_.status(skill) != NodeStatus::kRunning) continue;
    for (const std::size_t child : plan_.mission.nodes[skill].children)
      primitives_[child]->SetSkillTime(t_s - run_.begun_s(skill));
  }
  run_.Update(t_s);
}

void Supervisor::Watch(const MonitorReadings& now) {
  for (std::size_t m = 0; m < monitors_.size(); ++m) {
    monitors_[m].monitor->Update(now);
    const std::span<const Alarm> alarms = monitors_[m].monitor->alarms();
    for (std::size_t i = 0; i < alarms.size(); ++i) {
      int& raised = raised_[m][i];
      if (alarms[i].raised() && raised == 0) {
        alarms_.push_back({now.t_s,
                           monitors_[m].name,
                           monitors_[m].monitor->by_wheel() ? robot_.wheels[i].name : "",
                           {},
                           alarms[i].value(),
                           alarms[i].limit()});
        raised = static_cast<int>(alarms_.size());
      } else if (!alarms[i].raised() && raised > 0) {
        alarms_[static_cast<std::size_t>(raised) - 1].until_s = now.t_s;
        raised = 0;
      }
    }
  }
}

void Supervisor::React(double t_s) {
  const ReactionParams& reaction = plan_.reaction;
  if (run_.status(0) == NodeStatus::kFailed) return Stop(t_s, "the mission failed");
  switch (decision_.state()) {
    case DecisionState::kAbort:
      return Stop(t_s, std::string(Name(SupervisionPrimitive::kDefinitiveStop)));
    case DecisionState::kReconfiguring:
      reconfigured_ = Reconfigure(t_s, Availability::kEminent);
      return;
    case DecisionState::kNormal:
    case DecisionState::kFaultMode:
    case DecisionState::kAssessment:
      break;
  }
  const bool fault = decision_.state() != DecisionState::kNormal;
  const SafetyLevel level = fault ? this->level() : SafetyLevel::kHigh;
  if (level == SafetyLevel::kFatal)
    return Stop(t_s, std::string(Name(SupervisionPrimitive::kDefinitiveStop)));
  if (trial_since_s_ && fault) return Try(t_s);
  if (std::exchange(trial_since_s_, {})) GoOn(t_s, "all is well again");
  if (level >= SafetyLevel::kSerious || (fault && wait_until_s_)) return Wait(t_s);
  if (std::exchange(wait_until_s_, {})) GoOn(t_s, "all is well again");
  if (level >= SafetyLevel::kMedium) Reconfigure(t_s, Availability::kRedundant);
  const bool adapts = level == SafetyLevel::kWeak || t_s < cautious_until_s_;
  share_ = adapts ? reaction.adapt_share : 1;
  if (std::exchange(adapted_, adapts) != adapts)
    Say(t_s, 0,
        adapts ? fmt::format("adaptation: {:.0f} % of its speed", 100 * share_)
               : "its full speed again");
  // What comes back soon is the same trouble; what does not is another.
  if (fault) calm_since_s_ = t_s;
  if (t_s - calm_since_s_ > reaction.cautious_s + reaction.wait_s) waits_ = 0;
}

// Stands for a while, then looks at everything anew, and drives on with care.
void Supervisor::Wait(double t_s) {
  const ReactionParams& reaction = plan_.reaction;
  share_ = 0;
  calm_since_s_ = t_s;
  if (!wait_until_s_) {
    if (waits_ >= reaction.most_waits) return HandOver(t_s);
    ++waits_;
    wait_until_s_ = t_s + reaction.wait_s;
    return Say(t_s, 0, fmt::format("safety waiting, {} of {}", waits_, reaction.most_waits));
  }
  if (!Stands() && t_s - told_to_stand_s_ > comes_to_rest_s_)
    return Stop(t_s, "it does not stand when it is told to");
  if (t_s < *wait_until_s_) return;
  constexpr double kNow_s = 0.5;
  if (SeenSince(t_s - kNow_s)) {  // to try would be no trial
    if (t_s - told_to_stand_s_ >= reaction.patience_s) HandOver(t_s);
    return;
  }
  wait_until_s_.reset();
  trial_since_s_ = t_s;
  for (const NamedMonitor& monitor : monitors_) monitor.monitor->Retry();
  Say(t_s, 0, "it tries again");
}

// It drives with care, in fault mode as it is. What is seen again is waited for again; what is not
// is forgotten.
void Supervisor::Try(double t_s) {
  calm_since_s_ = t_s;
  if (SeenSince(*trial_since_s_)) {
    trial_since_s_.reset();
    return Wait(t_s);
  }
  share_ = plan_.reaction.adapt_share;
  if (t_s - *trial_since_s_ < plan_.reaction.cautious_s) return;
  trial_since_s_.reset();
  for (const NamedMonitor& monitor : monitors_) monitor.monitor->Rearm();
  GoOn(t_s, "nothing was seen again");
}

void Supervisor::GoOn(double t_s, const char* why) {
  cautious_until_s_ = t_s + plan_.reaction.cautious_s;
  Say(t_s, 0, why);
}

// Hardware: the drive's control without the wheels that are in alarm, their motors cut off, where
// that leaves it no worse than `most`. Software: there is nothing whose change would mend a fault
// (the paper halves the nominal velocity, which "does not change the Safety State"); adaptation
// does that.
bool Supervisor::Reconfigure(double t_s, Availability most) {
  std::ranges::fill(wheels_raised_, 0);
  bool any = false;
  for (const NamedMonitor& monitor : monitors_) {
    if (!monitor.monitor->by_wheel()) continue;
    const std::span<const Alarm> alarms = monitor.monitor->alarms();
    for (std::size_t w = 0; w < alarms.size(); ++w)
      if (alarms[w].raised()) {
        wheels_raised_[w] = 1;
        any = true;
      }
  }
  if (!any) return false;
  if (wheels_.Without(wheels_raised_) > most || !wheels_.Exclude(wheels_raised_)) {
    if (most == Availability::kEminent)
      Say(t_s, 0, "reconfiguration: the other wheels alone cannot drive it");
    return false;
  }
  drive_->Exclude(wheels_.out());
  ++reconfigurations_;
  std::string names;
  for (std::size_t w = 0; w < wheels_raised_.size(); ++w) {
    if (!wheels_raised_[w]) continue;
    names += (names.empty() ? "" : " ") + robot_.wheels[w].name;
    for (const NamedMonitor& monitor : monitors_) monitor.monitor->Ignore(w);
  }
  Say(t_s, 0, std::string(kDrivenWithout) + names);
  return true;
}

// Whether an alarm is of this time or later, and not of when it last drove.
bool Supervisor::SeenSince(double t_s) const {
  return std::ranges::any_of(monitors_, [&](const NamedMonitor& monitor) {
    return std::ranges::any_of(monitor.monitor->alarms(), [&](const Alarm& alarm) {
      return alarm.raised() && alarm.last_s() > t_s;
    });
  });
}

// By its wheels and its gyro.
bool Supervisor::Stands() {
  constexpr double kStands_mps = 0.03, kStands_radps = 0.1;
  const MonitorReadings& now = *board_.now;
  const BodyTwist V = RolledTwist(*drive_, now.wheel_rad, now.hinges, now.dt_s, radps_);
  return std::hypot(V.vx_mps, V.vy_mps) < kStands_mps && std::abs(V.wz_radps) < kStands_radps &&
         std::abs(now.gyro_radps.z()) < kStands_radps;
}

void Supervisor::HandOver(double t_s) {
  Say(t_s, 0, "autonomy adjustment: it hands over");
  if (!plan_.helped) return Stop(t_s, "it handed over, and nobody comes");
  asks_ = true;
}

// What it was about is over, and what its monitors remember is of elsewhere.
void Supervisor::SetDown(double t_s) {
  waits_ = 0;
  wait_until_s_.reset();
  trial_since_s_.reset();
  StartMonitors();
  GoOn(t_s,
       asks_ ? "a person has set it down and told it where it is" : "a person has set it down");
  asks_ = false;
}

void Supervisor::Stop(double t_s, const std::string& why) {
  share_ = 0;
  stopped_ = why;
  // What it stopped for is the last that the machine said of it.
  const auto& transitions = decision_.transitions();
  if (decision_.state() == DecisionState::kAbort)
    stopped_ += ": " + Reason(transitions.back(), plan_.mission.decision,
                              paths_[run_.skills()[transitions.back().worst]]);
  for (std::size_t i = 0; i < primitives_.size(); ++i) {
    if (primitives_[i] == nullptr || !run_.failure(i)) continue;
    const std::string wrong = "; " + WhatIsWrong(i);  // others may be watched by the same monitors
    if (stopped_.find(wrong) == std::string::npos) stopped_ += wrong;
  }
  Say(t_s, 0, stopped_);
}

// What the monitors of a primitive say, in words.
std::string Supervisor::WhatIsWrong(std::size_t node) const {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  for (const std::size_t m : primitives_[node]->monitors()) {
    const NamedMonitor& monitor = monitors_[m];
    const std::span<const Alarm> alarms = monitor.monitor->alarms();
    constexpr std::ptrdiff_t kSingly = 3;
    if (const auto raised = std::ranges::count_if(alarms, &Alarm::raised); raised > kSingly) {
      add(fmt::format("{} of {} wheels", monitor.name, raised));
      continue;
    }
    for (std::size_t i = 0; i < alarms.size(); ++i) {
      if (!alarms[i].raised()) continue;
      const std::string of = monitor.monitor->by_wheel() ? " of " + robot_.wheels[i].name : "";
      const std::string unit =
          monitor.monitor->unit().empty() ? "" : " " + std::string(monitor.monitor->unit());
      add(fmt::format("{}{}: {:.3g}{} is {} {:.3g}{}", monitor.name, of, alarms[i].value(), unit,
                      alarms[i].value() < alarms[i].limit() ? "below" : "above", alarms[i].limit(),
                      unit));
    }
  }
  if (const std::string_view why = primitives_[node]->why(); !why.empty()) add(std::string(why));
  const Failure failure = *run_.failure(node);
  return text + (failure.persistence == Persistence::kPermanent ? "; permanent" : "; intermittent");
}

// A row for each node whose risk has changed.
void Supervisor::LogNodes(double t_s) {
  for (std::size_t i = logged_.size(); i-- > 0;) {
    const MissionRun::Risk& risk = run_.risk(i);
    if (risk == logged_[i]) continue;
    logged_[i] = risk;
    if (risk.greatest == 0)
      Say(t_s, i, "as it should be");
    else if (primitives_[i] != nullptr)
      Say(t_s, i, WhatIsWrong(i));
    else
      Say(t_s, i,
          risk.sum == risk.greatest ? "by its worst"
                                    : fmt::format("by its worst; the sum is {:g}", risk.sum));
  }
}

void Supervisor::LogTransitions(double t_s) {
  const auto& transitions = decision_.transitions();
  for (; transitions_ < transitions.size(); ++transitions_) {
    const DecisionTransition& t = transitions[transitions_];
    Say(t_s, 0, Reason(t, plan_.mission.decision, paths_[run_.skills()[t.worst]]));
    rows_.back().machine = t.to;
  }
}

void Supervisor::Say(double t_s, std::size_t node, std::string reason) {
  const MissionRun::Risk& risk = run_.risk(node);
  rows_.push_back({t_s, paths_[node], risk.greatest, LevelOf(risk.greatest, plan_.mission.levels),
                   decision_.state(), std::move(reason), risk.sum});
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The paper's "Fault Supervision": runs the mission, lets the monitors watch it, weighs what they
// say, decides, and reacts. What it decides by is what the robot can know.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "controllers/safety/decision.h"
#include "controllers/safety/mission_run.h"
#include "controllers/supervision/safety_plan.h"

namespace floorproof {

// A change, as safety.csv tells it.
struct SafetyRow {
  double t_s = 0;
  std::string node;  // of the mission's tree, from its task on; the mission itself by its name
  double safety_state = 0;
  SafetyLevel level = SafetyLevel::kHigh;
  DecisionState machine = DecisionState::kNormal;
  std::string reason;
  double sum = 0;  // of its skills' safety states; safety_state is the greatest
};

// An alarm that was raised.
struct RaisedAlarm {
  double t_s = 0;
  std::string monitor, wheel;     // wheel: empty of one that watches no wheels
  std::optional<double> until_s;  // none: to the end
  double value = 0, limit = 0;    // compared, in the monitor's unit
};

// From this time on it was let drive at this share of its speed.
struct SpeedShare {
  double t_s = 0, share = 1;
};

// How the row begins that tells of wheels that it does without; their names follow.
inline constexpr std::string_view kDrivenWithout = "reconfiguration: driven without ";

class Supervisor {
 public:
  // All outlive it. Its monitors are started here: one supervisor a drive.
  Supervisor(const SafetyPlan& plan, const RobotSpec& robot, const HazardMap& known);
  // Its parts know each other by their places.
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  struct Motion {
    bool at_end = false;  // of the plan, or of the line that was asked for
    bool busy = false;    // Board::busy
  };
  // One control period, before the robot's side drives. Allocates only where something changes.
  void Update(const MonitorReadings& now, const Motion& motion);

  const MotionWish& wish() const { return board_.wish; }
  // Of its speed; 0: it is to stand.
  double speed_share() const { return share_; }
  // Wheels that are out of use, a flag each; it changes in Update alone.
  std::span<const char> wheels_out() const { return wheels_.out(); }
  int reconfigurations() const { return reconfigurations_; }
  // It has stopped for good: why, in words; empty: it has not.
  const std::string& stopped() const { return stopped_; }
  // Motors that are cut off their power, a flag a wheel: of wheels that are out of use, and all
  // once it has stopped for good; a driver that has gone wrong does not stop when it is told to.
  std::span<const char> cut() const { return cuts_all_ ? all_wheels_ : wheels_.out(); }
  bool cuts_all() const { return cuts_all_; }
  // It stands and asks for a person, until SetDown().
  bool asks_for_help() const { return asks_; }
  // A person has set it down elsewhere: what was alarming is looked at anew.
  void SetDown(double t_s);
  bool done() const { return run_.status(0) == NodeStatus::kDone; }

  DecisionState machine() const { return decision_.state(); }
  SafetyLevel level() const { return LevelOf(run_.risk(0).greatest, plan_.mission.levels); }
  std::span<const SafetyRow> rows() const { return rows_; }
  // In the order in which they were raised.
  std::span<const RaisedAlarm> alarms() const { return alarms_; }
  std::span<const SpeedShare> speed_shares() const { return shares_; }
  double held_s() const { return held_s_; }

 private:
  void StartMonitors();
  void Run(double t_s);
  void Watch(const MonitorReadings& now);
  void React(double t_s);
  void Wait(double t_s);
  void Try(double t_s);
  bool Reconfigure(double t_s, Availability most);
  void GoOn(double t_s, const char* why);
  void HandOver(double t_s);
  bool SeenSince(double t_s) const;
  bool Stands();
  void Stop(double t_s, const std::string& why);
  void LogNodes(double t_s);
  void LogTransitions(double t_s);
  void Say(double t_s, std::size_t node, std::string reason);
  std::string WhatIsWrong(std::size_t node) const;

  const SafetyPlan& plan_;
  const std::vector<NamedMonitor> monitors_;
  const RobotSpec& robot_;
  const HazardMap& known_;
  const double comes_to_rest_s_;
  WheelRedundancy wheels_;
  std::unique_ptr<Drive> drive_;  // that monitors ask
  Board board_;
  std::vector<RobotPrimitive*> primitives_;  // by node; of the others nullptr
  MissionRun run_;
  DecisionMachine decision_;
  std::optional<bool> reconfigured_;

  double share_ = 1;
  std::optional<double> wait_until_s_, trial_since_s_;
  double cautious_until_s_ = 0, calm_since_s_ = 0;
  double told_to_stand_s_ = 0;  // since then
  int waits_ = 0, reconfigurations_ = 0;
  bool asks_ = false, adapted_ = false, cuts_all_ = false;
  double held_s_ = 0;
  std::string stopped_;

  std::vector<std::vector<int>> raised_;  // by monitor and alarm: 1 + its place in alarms_, or 0
  std::vector<MissionRun::Risk> logged_;  // by node: in its last row
  std::size_t transitions_ = 0;           // that stand in the rows
  std::vector<char> wheels_raised_, all_wheels_;
  std::vector<double> radps_;
  std::vector<std::string> paths_;  // of the nodes
  std::vector<SafetyRow> rows_;
  std::vector<RaisedAlarm> alarms_;
  std::vector<SpeedShare> shares_ = {{}};
};

}  // namespace floorproof

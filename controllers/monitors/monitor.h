// SPDX-License-Identifier: Apache-2.0
// Monitors: what a robot notices of its own faults, from what its sensors tell and nothing else. A
// new one is one file in this folder and one line in list.inc.
//
// "safety-monitoring" (section 3.2) names five ways to find a fault: limit checking, trend
// checking, a model of the signal, a model of the process, multivariate data analysis. Each monitor
// says which is its own.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/params.h"
#include "base/registry.h"
#include "controllers/drive.h"
#include "controllers/monitors/alarm.h"
#include "env/core/hazard_map.h"
#include "env/core/observation.h"
#include "env/core/robot_spec.h"

namespace floorproof {

enum class MonitorKind { kLimit, kTrend, kSignalModel, kProcessModel, kMultivariate };
std::string_view Name(MonitorKind kind);

// What a robot can know in a control period. Nothing here says what is broken, or is the truth: but
// for the estimate of the estimator `truth`.
struct MonitorReadings {
  double t_s = 0, dt_s = 0;
  // What was commanded in the period that has just passed: of the body, and of each driven wheel.
  BodyTwist commanded;
  std::span<const double> commanded_radps;
  // What its sensors told of it.
  std::span<const double> wheel_rad;  // turns since the last period; empty: no encoders
  const HingeState& hinges;
  bool has_imu = false;
  Vec3 gyro_radps = Vec3::Zero(), accel_mps2 = Vec3::Zero();
  const LidarScan& scan;
  const Bump& bump;
  const PowerReading& power;
  const Estimate& estimate;  // where it thinks it is
};

// They outlive the episode.
struct MonitorContext {
  const RobotSpec& robot;
  const Drive& drive;
  const HazardMap& known;  // the map that the robot has
};

class Monitor : public Configurable {
 public:
  void Visit(ParamVisitor& v) final {
    VisitOwn(v);
    timing_.Visit(v);
  }
  virtual MonitorKind kind() const = 0;
  // Of what its alarms compare; empty: a share or a count.
  virtual std::string_view unit() const { return {}; }
  // What it goes by; without it the robot does without the monitor.
  virtual std::vector<Reading> Needs() const = 0;
  // It goes by where the robot thinks it is: nothing to a robot that is told the truth.
  virtual bool by_estimate() const { return false; }
  // It has an alarm for each driven wheel, in RobotSpec's order; else one.
  virtual bool by_wheel() const { return false; }

  // Before an episode. May allocate; Update may not.
  void Start(const MonitorContext& context) {
    alarms_.assign(by_wheel() ? context.robot.wheels.size() : 1, Alarm(timing_));
    StartOwn(context);
  }
  virtual void Update(const MonitorReadings& now) = 0;

  std::span<const Alarm> alarms() const { return alarms_; }
  // See Alarm::Retry, of all.
  void Retry() {
    for (Alarm& alarm : alarms_) alarm.Retry();
  }
  // See Alarm::Rearm, of all.
  void Rearm() {
    for (Alarm& alarm : alarms_) alarm.Rearm();
  }
  // Of a wheel that is out of use nothing more is said.
  void Ignore(std::size_t wheel) {
    if (by_wheel()) alarms_[wheel].Ignore();
  }

 protected:
  explicit Monitor(const AlarmTiming& timing) : timing_(timing) {}
  virtual void VisitOwn(ParamVisitor& v) = 0;
  virtual void StartOwn(const MonitorContext& context) = 0;
  Alarm& alarm(std::size_t i = 0) { return alarms_[i]; }

 private:
  AlarmTiming timing_;
  std::vector<Alarm> alarms_;
};

struct NamedMonitor {
  std::string name;
  std::unique_ptr<Monitor> monitor;
};

std::span<const PluginEntry<Monitor>> Monitors();

}  // namespace floorproof

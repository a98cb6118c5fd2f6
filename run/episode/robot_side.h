// SPDX-License-Identifier: Apache-2.0
// The robot's own side of an episode: from what its sensors told to what it commands. It knows the
// map that it was given and the one that it draws, never the true one, the scenario or the physics.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "controllers/drive.h"
#include "controllers/estimator.h"
#include "controllers/mapper.h"
#include "controllers/navigator.h"
#include "controllers/recovery.h"
#include "controllers/supervision/supervisor.h"
#include "controllers/tracker.h"
#include "env/core/observation.h"
#include "env/sim/plant.h"

namespace floorproof {

class RobotSide {
 public:
  struct Parts {
    Tracker& tracker;
    Estimator& estimator;
    const Mapper* mapper = nullptr;            // as configured; nullptr: it draws no map
    const RecoveryParams* recovery = nullptr;  // nullptr: it drives blindly
    const SafetyPlan* safety = nullptr;        // nullptr: nobody watches it
    // false: the map is its estimator's alone; it drives by what it draws itself.
    bool drives_by_map = true;
  };

  // All outlive it. `known`: the map that the robot has.
  RobotSide(const RobotSpec& robot, const HazardMap& known, Navigator& navigator,
            const Parts& parts, double control_s);

  // Before the first period. `start`: where it stands, which its estimator may know badly; `draws`:
  // the estimator's.
  void Start(const Pose2& start, const Stream& draws);
  // Once a control period, before it acts: estimate, map. `dt_s`: since the last time.
  void Perceive(const Observation& sensed, double dt_s);
  // One control period, of what was perceived: navigate, track or recover. What is returned holds
  // until the next call. Allocates only where the path changes.
  const Actuation& Control(const Observation& sensed);
  // The same of a robot that waits for help: its motors hold still.
  const Actuation& Stand();
  // It was set down at this waypoint of its path: whatever it was about is over. Its estimator is
  // not told. Allocates.
  void GoOnFrom(std::size_t waypoint);
  // And, where its supervision asked for it, it is told where it stands.
  void Helped(const Pose2& X_WB, const Stream& draws, double t_s);

  const Command& command() const { return command_; }
  const Actuation& actuation() const { return actuation_; }  // the drive may have slowed hinges
  const Path& path() const { return navigator_.path(); }
  int paths() const { return paths_; }  // how many it has been given to follow
  const Estimate& estimate() const { return estimate_; }
  // Whether it has driven all that its navigator leads along, or done its mission.
  bool done() const { return supervisor_ ? supervisor_->done() : at_end(); }
  // Whether the next Control() would find that, as far as it can be said before.
  bool WouldBeDone(double t_s) const {
    return !supervisor_ && !command_.reacting && navigator_.leads() != Navigator::Leads::kOn &&
           parts_.tracker.WouldBeDone(estimate_, t_s);
  }
  // nullptr: nobody watches it.
  const Supervisor* supervisor() const { return supervisor_.get(); }
  const Navigator& navigator() const { return navigator_; }
  // Of the known map, on the path that it follows.
  const ClearanceField& clearance() const { return clearance_; }
  const KnownMap* known() const { return mapper_ ? &mapper_->map() : nullptr; }
  // Of all paths that its navigator led along; of a mission's own lines none.
  const MissedStops& missed() const { return missed_; }
  int recoveries() const { return recovery_ ? recovery_->count() : 0; }

 private:
  bool at_end() const { return command_.done && navigator_.leads() != Navigator::Leads::kOn; }
  void Supervise(const Observation& sensed);
  void GoOn(const Observation& sensed);
  void CountMissed();
  void Turn(double yaw_rad);
  void Navigate(const Observation& sensed);
  void Follow();
  const Actuation& Actuate();

  const RobotSpec& robot_;
  const HazardMap& known_;
  Navigator& navigator_;
  Parts parts_;
  double control_s_;
  std::vector<std::size_t> on_the_way_;  // level changes, of which the clearance takes no notice
  ClearanceField clearance_;
  std::unique_ptr<Drive> drive_;
  std::optional<Mapper> mapper_;
  std::optional<Recovery> recovery_;
  std::unique_ptr<Supervisor> supervisor_;
  int reconfigurations_ = 0;  // that its drive and its estimator know of
  Estimate estimate_;
  Command command_;
  std::vector<double> wheel_radps_;
  Actuation actuation_;
  int paths_ = 0;
  MissedStops missed_;
  int missed_on_path_ = 0;  // of them, on the path that it follows
};

}  // namespace floorproof

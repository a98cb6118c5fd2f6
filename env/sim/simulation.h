// SPDX-License-Identifier: Apache-2.0
// Steps the physics and says, after each step, what truly happened.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "env/core/alterations.h"
#include "env/core/battery.h"
#include "env/core/blocks.h"
#include "env/core/motion.h"
#include "env/core/robot_spec.h"
#include "env/scene/scene.h"
#include "env/sim/contact_reader.h"
#include "env/sim/fine_steps.h"
#include "env/sim/live_geoms.h"
#include "env/sim/standstill.h"

namespace floorproof {

// A dcmotor's torque, N m, at the end of the last step. The engine's own is that of its begin,
// which is not what an implicit integrator applied: a stiff driver would seem to give a multiple of
// it while the motor speeds up. (A driver with a position gain: the engine's own.)
double MotorTorque(const mjModel* model, const mjData* data, int actuator);

class Simulation {
 public:
  // `scene`, `map` and `robot` outlive the simulation.
  Simulation(const Scene& scene, const HazardMap& map, const RobotSpec& robot);

  // At rest at the pose, settled on its wheels on the floor there; time 0, the battery new.
  void Reset(const Pose2& X_WB);
  // The same in the middle of an episode: lifted and set down, upright and at rest, in its start
  // shape, its motors told to stand still. Time and battery go on as they were, and the driven
  // wheels have not turned: no encoder notices.
  void SetDown(const Pose2& X_WB);
  // The same by what befalls it, its orders as they were: Truth::carried counts it.
  void CarryTo(const Pose2& X_WB);
  // Speeds that the wheels' motor drivers hold from now on, rad/s, RobotSpec's order.
  void SetWheelSpeeds(std::span<const double> wheel_radps);
  // Which motors of the wheels are cut off their power from now on, a flag each, or none at all:
  // they give nothing, and turn freely.
  void CutMotors(std::span<const char> cut);
  // The same for the motors of the hinges and of the fork that steers: the rates alone count.
  void SetHingeSpeeds(const HingeState& hinges);
  // One physics step; false when the state diverged (MuJoCo warned, or a number is not finite):
  // the simulation is over then, an `error`. Allocates nothing. Throws InternalError when the
  // engine itself fails.
  bool Step();
  // After a Step that returned false: which body diverged first, and when (divergence.h). If it was
  // while the robot settled after Reset or SetDown, the time is that since then.
  const std::string& divergence() const { return divergence_; }
  // The state after the last step.
  const Truth& truth() const { return truth_; }
  // From now on, in place of what was altered before; what sensors tell is others' affair. What was
  // altered stays so however often the live geoms are chosen anew, and no other simulation of the
  // scene sees it. Throws InternalError where a list is not as long as the robot has wheels, or it
  // has no rollers to drag. Allocates.
  void Alter(const Alterations& alterations);

  // Holds of the scene's walls and pairs what is near the robot (live_geoms.h). All its arrays are
  // this simulation's own.
  const mjModel* model() const { return live_.model(); }
  // For rigs that tilt gravity or brake wheels.
  mjModel* model() { return live_.model(); }
  mjData* data() { return data_.get(); }
  // By actuator, N m at the joint, as at the last step. The span holds as long as this does.
  std::span<const double> motor_nm() const { return motor_nm_; }
  // Into how many parts the last step was walked.
  int parts() const { return parts_; }
  // As at the last step, since Reset.
  const BatteryInUse& battery() const { return battery_; }

 private:
  void NoteDivergence();
  void Place(const Pose2& X_WB);
  void StandStill();
  void Settle(const Pose2& X_WB, double t_s);
  void ReadHinges();
  void ReadPose();
  void ReadPower(double dt_s);
  void SetDriverVoltages();
  void HoldStuckWheels();
  void AlterMotors();
  void AlterFriction();
  void AlterRollerBearings();
  void AlterPayload();

  const Scene& scene_;
  const HazardMap& map_;
  const RobotSpec& robot_;
  ModelPtr own_;  // a copy of the scene's model, as altered
  LiveGeoms live_;
  DataPtr data_;
  ContactReader contacts_;
  StandstillHold hold_;
  FineSteps fine_steps_;
  int parts_ = 1;
  std::vector<mjtNum> cvel_;  // scratch
  Truth truth_;
  std::string divergence_;
  Alterations altered_;
  std::vector<char> cut_;  // by wheel
  std::vector<double> motor_nm_;
  BatteryInUse battery_;
  bool voltage_changes_ = false;             // of the motors' drivers
  std::vector<int> wheel_bodies_;            // of the driven wheels, in actuator order
  std::vector<int> wheel_qpos_;              // addresses of their angles
  std::vector<int> hinge_qpos_, hinge_dof_;  // addresses of the hinges' joints
  int fork_qpos_ = 0, fork_dof_ = 0;         // and of the fork's, where the robot steers
  std::optional<HingeState> folded_;         // as it is set down; none: in its start shape
  BlockMotions blocks_;                      // of a robot with hinges; else at rest
  std::vector<Vec3> lowest_W_;               // point of each driven wheel
};

}  // namespace floorproof

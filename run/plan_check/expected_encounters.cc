// SPDX-License-Identifier: Apache-2.0
#include "run/plan_check/expected_encounters.h"

#include <optional>

#include "controllers/drive.h"
#include "controllers/ideal_robot.h"
#include "controllers/tracker.h"
#include "env/core/blocks.h"
#include "env/core/driven_floor.h"
#include "run/episode/encounter_meter.h"
#include "run/episode/time_limit.h"
#include "run/episode/tool_meter.h"
#include "run/scenario/floors.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

// Whether so much is covered that the drive ends (success.stop_at_coverage). Nothing is kept where
// the scenario names no such share.
class EnoughCovered {
 public:
  EnoughCovered(const Scenario& s, const HazardMap& floor)
      : enough_(s.spec.episode.stop_at_coverage) {
    if (!enough_) return;
    const RobotSpec& robot = s.world.robot.spec;
    area_ = ComputeSweepArea(floor, robot, robot.clear, robot.tool, s.world.start);
    tool_.emplace(area_, robot);
  }
  void Sweep(int shape, const Pose2& X_WB) {
    if (!tool_) return;
    tool_->Take(shape);
    tool_->Add(X_WB);
  }
  bool reached() const { return tool_ && tool_->swept().coverage() >= *enough_; }

 private:
  std::optional<double> enough_;
  SweepArea area_;
  std::optional<ToolMeter> tool_;
};

}  // namespace

std::vector<Encounter> ExpectedEncounters(const Scenario& s, const PlanResult& plan) {
  if (plan.path.empty()) return {};
  const RobotSpec& robot = s.world.robot.spec;
  const HazardMap known = KnownFloor(s.world), floor = TrueFloor(s.world);
  const ClearanceField clearance =
      ClearanceOnTheWay(known, LevelChangesOnTheWay(known, plan.path), robot.step_m);
  const auto tracker = MakePlugin(Trackers(), s.spec.tracker, "controller");
  tracker->Start(plan.path, robot, &clearance);
  EncounterMeter meter(floor, robot, IsHolonomic(robot));
  IdealRobot ideal(robot, s.world.start);
  const double period_s = 1.0 / s.spec.episode.control_hz;
  const double limit_s = PlanLimit_s(s.spec.episode, tracker->Duration());
  EnoughCovered enough(s, floor);
  Sample sample;
  for (std::int64_t period = 0; !sample.command.done && !enough.reached(); ++period) {
    sample.t_s = static_cast<double>(period) * period_s;
    if (sample.t_s >= limit_s) break;
    const Estimate& state = ideal.state();
    sample.command = tracker->Update(state, sample.t_s, period_s);
    sample.p_WB = {state.X_WB.x_m, state.X_WB.y_m, 0};
    sample.yaw_rad = state.X_WB.yaw_rad;
    sample.shape = robot.hinges.empty() ? 0 : ShapeOf(robot, state.hinges, kInShape_rad);
    const Vec2 v_W = state.X_WB.Rotate({state.V_WB_B.vx_mps, state.V_WB_B.vy_mps});
    sample.v_WB_W = {v_W.x(), v_W.y(), 0};
    meter.OnControl(sample, state, &plan.path);
    enough.Sweep(sample.shape, state.X_WB);
    ideal.Drive(sample.command, period_s);
  }
  return meter.Finish();
}

}  // namespace floorproof

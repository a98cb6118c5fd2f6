// SPDX-License-Identifier: Apache-2.0
// A pane of glass across the way that is on no map: the robot drives into it, goes back and around.
// It meets it by its bumper; a lidar would see it for a moment at best.
#include "validate/suite/bench_floor.h"

namespace floorproof {
namespace {

constexpr double kAtSpeed_m = 0.3, kBehind_m = 0.2, kAround_m = 0.5;

class PaneBump final : public Method {
 public:
  std::string_view shaped_after() const override {
    return "ISO 18646-2, obstacle detection and avoidance; ASTM F45, obstacles";
  }
  std::string_view task() const override {
    return "Its plan leads straight into a pane of glass that is on no map. It carries a bumper, "
           "goes "
           "back from the pane, marks the place, and drives around. Passed: it reaches the plan's "
           "end, and no detector fired: it was not thrown back.";
  }
  std::optional<SizeLadder> sizes(const RobotModel& robot) const override {
    return SpeedLadder(robot.spec);
  }

  MethodDrive LayOut(const MethodRun& run) const override {
    const RobotSpec& robot = run.robot.spec;
    const double reach_m = robot.circumscribed_radius_m;
    const double start_m = reach_m + kBehind_m;
    const double pane_m = start_m + reach_m + RunUp(robot, run.size) + kAtSpeed_m;
    const double end_m = pane_m + 3 * reach_m + kAround_m;
    BenchFloor floor(end_m + reach_m + kBehind_m, 6 * reach_m + 4 * kAround_m);
    const double middle_m = floor.width_m() / 2;
    const Pose2 X_WH{pane_m, middle_m + run.draw.offset_m, run.draw.angle_rad};
    floor.Line("type: glass, id: pane, known: false",
               {X_WH * Vec2(0, -reach_m), X_WH * Vec2(0, reach_m)});
    return {floor.Keys(run, {start_m, middle_m, 0}) +
                "react: {bumper: true, cliff: false, then: replan}\n",
            StraightPlan({start_m, middle_m}, {end_m, middle_m}, run.size)};
  }

  MethodVerdict Judge(const MethodRun& run, const EpisodeRecord& record) const override {
    const MethodVerdict verdict = Method::Judge(run, record);
    if (verdict.passed && record.metrics.reactions == 0) return {false, "never felt the pane"};
    return verdict;
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Method, PaneBump)

}  // namespace floorproof

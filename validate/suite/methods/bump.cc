// SPDX-License-Identifier: Apache-2.0
// A pane of glass across the way that is on no map. The robot meets it by its bumper; a lidar would
// see it for a moment at best.
#include <fmt/format.h>

#include "base/params.h"
#include "validate/suite/bench_floor.h"

namespace floorproof {
namespace {

constexpr double kAtSpeed_m = 0.3, kBehind_m = 0.2, kAside_m = 0.5;
constexpr double kBack_m = 0.5, kBack_mps = 0.05, kAfter_s = 3;

class PaneBump final : public Method {
 public:
  std::string_view shaped_after() const override {
    return "ISO 18646-2, obstacle detection and avoidance; ASTM F45, obstacles";
  }
  std::string_view task() const override {
    return "Its plan leads straight into a pane of glass that is on no map. It carries a bumper "
           "and goes back from what it touches. Passed: it felt the pane, and no detector fired: "
           "it was not thrown back.";
  }
  std::optional<SizeLadder> sizes(const RobotModel& robot) const override {
    return SpeedLadder(robot.spec);
  }

  MethodDrive LayOut(const MethodRun& run) const override {
    const RobotSpec& robot = run.robot.spec;
    const double reach_m = robot.circumscribed_radius_m;
    const double start_m = reach_m + kBehind_m;
    const double pane_m = start_m + reach_m + RunUp(robot, run.size) + kAtSpeed_m;
    const double end_m = pane_m + reach_m;
    BenchFloor floor(end_m + reach_m + kBehind_m, 4 * reach_m + 2 * kAside_m);
    const double middle_m = floor.width_m() / 2;
    const Pose2 X_WH{pane_m, middle_m + run.draw.offset_m, run.draw.angle_rad};
    floor.Line("type: glass, id: pane, known: false",
               {X_WH * Vec2(0, -reach_m), X_WH * Vec2(0, reach_m)});
    const double met_s = TimeTo(robot, pane_m - start_m - robot.inscribed_radius_m, run.size);
    return {floor.Keys(run, {start_m, middle_m, 0}) +
                fmt::format("react: {{bumper: true, cliff: false, back_off_m: {}, back_off_mps: "
                            "{}}}\ntime_limit_s: {}\n",
                            kBack_m, kBack_mps, FormatDouble(met_s + kAfter_s)),
            StraightPlan({start_m, middle_m}, {end_m, middle_m}, run.size)};
  }

  // It ends a while after the touch, on its way back.
  MethodVerdict Judge(const MethodRun&, const EpisodeRecord& record) const override {
    if (!record.events.empty()) return {false, HowItEnded(record)};
    if (record.metrics.reactions == 0) return {false, "never felt the pane"};
    return {true};
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Method, PaneBump)

}  // namespace floorproof

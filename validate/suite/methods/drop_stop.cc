// SPDX-License-Identifier: Apache-2.0
// An edge down, as of stairs, that is on no map. The robot sees it by the cliff sensors at its edge
// and brakes.
#include <fmt/format.h>

#include <cmath>

#include "base/params.h"
#include "validate/suite/bench_floor.h"

namespace floorproof {
namespace {

constexpr double kDepth_m = 0.15, kAtSpeed_m = 0.3, kBehind_m = 0.2, kBeyond_m = 0.5;
constexpr double kBack_m = 0.5, kBack_mps = 0.05, kAfter_s = 4;

class DropStop final : public Method {
 public:
  std::string_view shaped_after() const override {
    return "ISO 18646-2, obstacle detection and avoidance; IEC 62849, obstacle avoidance";
  }
  std::string_view task() const override {
    return "Its plan leads straight over an edge 150 mm deep that is on no map. It carries the "
           "eight cliff sensors of the sensor `cliff` at its edge, brakes where one sees no "
           "floor, and goes back. Passed: it saw the edge, and no detector fired.";
  }
  std::optional<SizeLadder> sizes(const RobotModel& robot) const override {
    return SpeedLadder(robot.spec);
  }

  MethodDrive LayOut(const MethodRun& run) const override {
    const RobotSpec& robot = run.robot.spec;
    const double reach_m = robot.circumscribed_radius_m, turn_rad = run.draw.angle_rad;
    const double start_m = reach_m + kBehind_m;
    const double edge_m =
        start_m + reach_m / std::cos(turn_rad) + RunUp(robot, run.size) + kAtSpeed_m;
    const double end_m = edge_m + reach_m + kBeyond_m;
    BenchFloor floor(end_m + reach_m, 4 * reach_m + 1);
    const double width_m = floor.width_m(), middle_m = width_m / 2;
    const double aside_m = middle_m * std::tan(turn_rad);
    floor.Polygon("type: step, id: drop, known: false, height_m: " + FormatDouble(-kDepth_m),
                  {{edge_m + aside_m, 0},
                   {floor.length_m(), 0},
                   {floor.length_m(), width_m},
                   {edge_m - aside_m, width_m}});
    const double seen_s =
        TimeTo(robot, edge_m + std::abs(aside_m) - start_m - robot.inscribed_radius_m, run.size);
    return {floor.Keys(run, {start_m, middle_m, 0}) +
                fmt::format("react: {{bumper: false, cliff: true, back_off_m: {}, back_off_mps: "
                            "{}}}\ntime_limit_s: {}\n",
                            kBack_m, kBack_mps, FormatDouble(seen_s + kAfter_s)),
            StraightPlan({start_m, middle_m}, {end_m, middle_m}, run.size)};
  }

  // It ends a while after the edge, on its way back: how it would go on is another question.
  MethodVerdict Judge(const MethodRun&, const EpisodeRecord& record) const override {
    if (!record.events.empty()) return {false, HowItEnded(record)};
    if (record.metrics.reactions == 0) return {false, "never saw the edge"};
    return {true};
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Method, DropStop)

}  // namespace floorproof

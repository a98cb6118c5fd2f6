// SPDX-License-Identifier: Apache-2.0
// A robot at its cruising speed is told to stop: its bumper says that it is pressed, as somebody's
// foot would. How far it goes on is read from the trace.
#include <fmt/format.h>

#include <algorithm>

#include "validate/suite/bench_floor.h"

namespace floorproof {
namespace {

constexpr double kAtSpeed_s = 1.5;  // at speed, before it is told
constexpr double kPressed_s = 0.1;
constexpr double kRoom_m = 2;  // to stop in
constexpr double kRest_mps = 0.02, kInTime_s = 5;
constexpr double kLeastShare = 0.8;  // of its speed, when it is told
constexpr double kBehind_m = 0.2;

double Speed(const MethodRun& run) { return run.draw.speed_share * run.robot.spec.cruise_mps; }
double Told(const MethodRun& run) {
  return Speed(run) / run.robot.spec.max_accel_mps2 + kAtSpeed_s;
}

class StoppingDistance final : public Method {
 public:
  std::string_view shaped_after() const override { return "ISO 18646-1, stopping characteristics"; }
  std::string_view task() const override {
    return "At its cruising speed its bumper is pressed for 0.1 s. Passed: it comes to rest "
           "within 5 s, and no detector fired. Measured: the way from there to where it stands.";
  }
  std::optional<MeasuredFigure> figure() const override {
    return MeasuredFigure{"way to a stop", "mm"};
  }

  MethodDrive LayOut(const MethodRun& run) const override {
    const RobotSpec& robot = run.robot.spec;
    const double reach_m = robot.circumscribed_radius_m, speed_mps = Speed(run);
    const double start_m = reach_m + kBehind_m;
    const double end_m = start_m + Told(run) * speed_mps + kRoom_m;
    BenchFloor floor(end_m + reach_m + kBehind_m, 4 * reach_m + 1);
    const double middle_m = floor.width_m() / 2;
    return {floor.Keys(run, {start_m, middle_m, run.draw.angle_rad}) +
                fmt::format("react: {{bumper: true, cliff: false, then: go_on}}\nfaults:\n"
                            "  - {{type: stuck_bumper, onset_s: {}, duration_s: {}}}\n",
                            Told(run), kPressed_s),
            StraightPlan({start_m, middle_m}, {end_m, middle_m}, speed_mps)};
  }

  MethodVerdict Judge(const MethodRun& run, const EpisodeRecord& record) const override {
    const auto told = std::ranges::lower_bound(record.trace, Told(run) - 1e-6, {}, &TraceRow::t_s);
    if (told == record.trace.end() || told->vx_mps < kLeastShare * Speed(run))
      return {false, record.events.empty() ? "was not at speed when told" : HowItEnded(record)};
    const auto rests = std::find_if(told, record.trace.end(),
                                    [](const TraceRow& row) { return row.vx_mps < kRest_mps; });
    if (rests == record.trace.end() || rests->t_s - told->t_s > kInTime_s)
      return {false, record.events.empty() ? "did not stop" : HowItEnded(record)};
    const double way_m = Vec2(rests->x_m - told->x_m, rests->y_m - told->y_m).norm();
    if (!record.events.empty()) return {false, HowItEnded(record), 1000 * way_m};
    return {true, "", 1000 * way_m};
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Method, StoppingDistance)

}  // namespace floorproof

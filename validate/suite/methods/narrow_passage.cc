// SPDX-License-Identifier: Apache-2.0
// Two blocks as high as walls, a metre long, with a passage between them.
#include <cmath>

#include "validate/suite/lap_room.h"

namespace floorproof {
namespace {

constexpr double kLong_m = 1, kBefore_m = 1, kBeside_m = 1, kBehind_m = 0.2;
constexpr int kRoom_mm = 300;  // beyond its own width, where the search begins

class NarrowPassage final : public Method {
 public:
  std::string_view shaped_after() const override {
    return "ISO 18646-2, narrow passage; ASTM F45, navigation in a defined area";
  }
  std::string_view task() const override {
    return "It drives through a passage a metre long at its cruising speed, by its lidar and a "
           "map, or without a lidar by its wheels; its first guess is off by the approach. "
           "Passed: it comes out, touched nothing, and no detector fired.";
  }
  std::optional<SizeLadder> sizes(const RobotModel& robot) const override {
    constexpr int kRound_mm = 10;
    const int own_mm = kRound_mm * static_cast<int>(std::ceil(1000 * WidthOf(robot) / kRound_mm));
    return SizeLadder{"width",
                      "mm",
                      {.per_unit = 1, .first = 1, .spacing = 30, .last = kRoom_mm + 1},
                      static_cast<double>(own_mm + kRoom_mm + 2)};
  }

  MethodDrive LayOut(const MethodRun& run) const override {
    const RobotSpec& robot = run.robot.spec;
    const double reach_m = robot.circumscribed_radius_m, width_m = run.size / 1000;
    const double start_m = reach_m + kBehind_m, in_m = start_m + reach_m + kBefore_m,
                 out_m = in_m + kLong_m, end_m = out_m + 2 * reach_m;
    BenchFloor floor(end_m + reach_m + kBehind_m, width_m + 2 * kBeside_m);
    const double middle_m = floor.width_m() / 2;
    const std::string keys = "type: blind_object, height_m: 1";
    const double low_m = middle_m - width_m / 2, high_m = middle_m + width_m / 2;
    floor.Polygon(keys + ", id: right", {{in_m, 0}, {out_m, 0}, {out_m, low_m}, {in_m, low_m}});
    floor.Polygon(
        keys + ", id: left",
        {{in_m, high_m}, {out_m, high_m}, {out_m, floor.width_m()}, {in_m, floor.width_m()}});
    return {floor.Keys(run, {start_m, middle_m, 0}) +
                EstimatorKeys(run.robot, {0, run.draw.offset_m}, run.draw.angle_rad),
            StraightPlan({start_m, middle_m}, {end_m, middle_m},
                         run.draw.speed_share * robot.cruise_mps)};
  }

  MethodVerdict Judge(const MethodRun& run, const EpisodeRecord& record) const override {
    const MethodVerdict verdict = Method::Judge(run, record);
    if (verdict.passed && record.metrics.contacts > 0) return {false, "touched a wall"};
    return verdict;
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Method, NarrowPassage)

}  // namespace floorproof

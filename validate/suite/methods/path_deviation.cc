// SPDX-License-Identifier: Apache-2.0
// A lap of a room, by what the robot carries.
#include "validate/suite/lap_room.h"

namespace floorproof {
namespace {

class PathDeviation final : public Method {
 public:
  std::string_view shaped_after() const override {
    return "ISO 18646-2, path deviation; ASTM F45, navigation";
  }
  std::string_view task() const override {
    return "It drives a lap of a furnished room at its cruising speed, by its lidar and a map, "
           "or without a lidar by its wheels; its first guess is off by the approach. Passed: it "
           "comes back, and no detector fired. Measured: the greatest distance of its true place "
           "from the path.";
  }
  std::optional<MeasuredFigure> figure() const override {
    return MeasuredFigure{"greatest distance from the path", "mm"};
  }

  MethodDrive LayOut(const MethodRun& run) const override {
    const LapRoom room =
        MakeLapRoom(run.robot.spec, run.draw.speed_share * run.robot.spec.cruise_mps);
    return {room.floor.Keys(run, room.start) +
                EstimatorKeys(run.robot, {0, run.draw.offset_m}, run.draw.angle_rad),
            room.lap};
  }

  MethodVerdict Judge(const MethodRun& run, const EpisodeRecord& record) const override {
    MethodVerdict verdict = Method::Judge(run, record);
    verdict.figure = 1000 * record.metrics.max_cross_track_m;
    return verdict;
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Method, PathDeviation)

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A robot that drives off while it is lost: it believes to stand elsewhere than it does.
#include <cmath>

#include "validate/suite/lap_room.h"

namespace floorproof {
namespace {

constexpr double kTurnShare = 1.0 / 9;  // of the drawn bearing: within 20 degrees
constexpr double kFound_m = 0.1;        // it knows its place to that when it is back

class Lost final : public Method {
 public:
  std::string_view shaped_after() const override {
    return "ISO 18646-2, pose accuracy; IEC 62849, navigation";
  }
  std::string_view task() const override {
    return "It drives a lap of a furnished room by its lidar and a map, its first guess off by "
           "so much in a drawn direction and by up to 20 degrees. Passed: it comes back, knows "
           "its place there to 0.1 m, and no detector fired.";
  }
  std::optional<SizeLadder> sizes(const RobotModel&) const override {
    return SizeLadder{"error", "m", {.per_unit = 10, .first = 1, .spacing = 4, .last = 21}};
  }
  std::string WhyNot(const RobotModel& robot) const override {
    return HasLidar(robot) ? "" : kNoLidar;
  }

  MethodDrive LayOut(const MethodRun& run) const override {
    const LapRoom room =
        MakeLapRoom(run.robot.spec, run.draw.speed_share * run.robot.spec.cruise_mps);
    const double bearing_rad = run.draw.bearing_rad;
    return {
        room.floor.Keys(run, room.start) +
            EstimatorKeys(run.robot, run.size * Vec2(std::cos(bearing_rad), std::sin(bearing_rad)),
                          kTurnShare * bearing_rad),
        room.lap};
  }

  MethodVerdict Judge(const MethodRun&, const EpisodeRecord& record) const override {
    if (record.outcome != Outcome::kSuccess) return {false, HowItEnded(record)};
    const TraceRow& end = record.trace.back();
    const double off_m = std::hypot(end.est_x_m - end.x_m, end.est_y_m - end.y_m);
    if (off_m > kFound_m) return {false, "came back without knowing where it is"};
    return {true};
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Method, Lost)

}  // namespace floorproof

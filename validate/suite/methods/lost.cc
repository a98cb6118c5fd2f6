// SPDX-License-Identifier: Apache-2.0
// A robot that drives off while it is lost: it believes to stand elsewhere than it does.
#include <cmath>

#include "validate/suite/lap_room.h"

namespace floorproof {
namespace {

constexpr double kTurnShare = 1.0 / 9;  // of the drawn bearing: within 20 degrees

class Lost final : public Method {
 public:
  std::string_view shaped_after() const override {
    return "ISO 18646-2, pose accuracy; IEC 62849, navigation";
  }
  std::string_view task() const override {
    return "It drives a lap of a furnished room by its lidar and a map, its first guess off by "
           "so much in a drawn direction and by up to 20 degrees. Passed: it finds itself and "
           "comes back, and no detector fired.";
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
};

}  // namespace

FP_DEFINE_PLUGIN(Method, Lost)

}  // namespace floorproof

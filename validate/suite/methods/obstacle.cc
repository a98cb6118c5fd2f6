// SPDX-License-Identifier: Apache-2.0
// A small room that the robot has no map of, with one thing in it: a box that its lidar sees, or a
// pane that it sees only from straight ahead.
#include <cmath>

#include "validate/suite/bench_floor.h"

namespace floorproof {
namespace {

constexpr double kTime_s = 180;

class Obstacle : public Method {
 public:
  std::string_view shaped_after() const override {
    return "ISO 18646-2, obstacle detection and avoidance; ASTM F45, obstacles";
  }
  std::string WhyNot(const RobotModel& robot) const override {
    if (robot.spec.turn_radius_m > 0)
      return "planners of unknown floors turn on the spot, which its drive cannot";
    return HasLidar(robot) ? "" : kNoLidar;
  }

  MethodDrive LayOut(const MethodRun& run) const override {
    const double reach_m = run.robot.spec.circumscribed_radius_m;
    BenchFloor floor(Length(reach_m), 5 * reach_m + 0.5);
    const Vec2 middle(0.55 * floor.length_m(), floor.width_m() / 2);
    Place(floor, {middle.x(), middle.y() + run.draw.offset_m, run.draw.angle_rad});
    return {floor.Keys(run, {1.5 * reach_m, floor.width_m() / 2, run.draw.bearing_rad}) +
                "plan: frontier_coverage\nmapper: {glass: true}\ntime_limit_s: " +
                std::to_string(static_cast<int>(kTime_s)) + "\n",
            {}};
  }

  // It covers the room as long as it is let. Who stands still touches nothing, and has not passed.
  MethodVerdict Judge(const MethodRun& run, const EpisodeRecord& record) const override {
    const bool drove = record.outcome == Outcome::kSuccess || record.outcome == Outcome::kTimeout;
    if (!drove || !record.events.empty()) return {false, HowItEnded(record)};
    if (record.metrics.contacts > 0) return {false, "touched it"};
    if (record.metrics.path_length_m < Length(run.robot.spec.circumscribed_radius_m))
      return {false, "drove less than the room is long"};
    return {true};
  }

 protected:
  // Of the room.
  static double Length(double reach_m) { return 7 * reach_m + 0.5; }
  virtual void Place(BenchFloor& floor, const Pose2& X_WH) const = 0;
};

class ObstacleBlind final : public Obstacle {
  std::string_view task() const override {
    return "It covers a small room that it has no map of, for 180 s at most, by its lidar, "
           "mapper, bumper and the planner frontier_coverage; a box of 0.3 m stands in the room. "
           "Passed: it drove the room's length at least and touched nothing, and no detector "
           "fired.";
  }
  void Place(BenchFloor& floor, const Pose2& X_WH) const override {
    constexpr double kHalf_m = 0.15;
    floor.Polygon("type: blind_object, id: box, height_m: 0.5, known: false",
                  {X_WH * Vec2(-kHalf_m, -kHalf_m), X_WH * Vec2(kHalf_m, -kHalf_m),
                   X_WH * Vec2(kHalf_m, kHalf_m), X_WH * Vec2(-kHalf_m, kHalf_m)});
  }
};

class ObstacleGlass final : public Obstacle {
  std::string_view task() const override {
    return "The same with a pane of glass 1 m wide, which a lidar sees only from straight ahead. "
           "Passed: it drove the room's length at least and touched nothing, and no detector "
           "fired.";
  }
  void Place(BenchFloor& floor, const Pose2& X_WH) const override {
    floor.Line("type: glass, id: pane, known: false", {X_WH * Vec2(0, -0.5), X_WH * Vec2(0, 0.5)});
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Method, ObstacleBlind)
FP_DEFINE_PLUGIN(Method, ObstacleGlass)

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "tests/controllers/driving.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "controllers/ideal_robot.h"
#include "tests/robots.h"

namespace floorproof {
namespace {

constexpr double kPhysicsS = 0.004;

// The time for a way (or angle) from rest to rest.
double TrapezoidTime(double way, double top_speed, double accel) {
  if (way >= top_speed * top_speed / accel) return way / top_speed + top_speed / accel;
  return 2 * std::sqrt(way / accel);
}

}  // namespace

RobotSpec RoundRobot() {
  RobotSpec robot;
  robot.name = "round";
  robot.drive = "differential";
  for (const double side : {1.0, -1.0}) {
    WheelSpec wheel;
    wheel.name = side > 0 ? "left" : "right";
    wheel.p_BW = {0, side * 0.12, 0.05};
    wheel.radius_m = 0.05;
    wheel.max_speed_radps = 12;
    robot.wheels.push_back(wheel);
  }
  robot.clear = {Shape2::Kind::kCircle, 0.18, {}};
  robot.inscribed_radius_m = 0.18;
  robot.cruise_mps = 0.25;
  robot.max_speed_mps = 0.4;
  robot.max_accel_mps2 = 0.5;
  robot.max_yaw_rate_radps = 1.2;
  robot.max_yaw_accel_radps2 = 3;
  return robot;
}

RobotSpec HolonomicRobot() {
  RobotSpec robot = RoundRobot();
  robot.name = "holonomic";
  robot.drive = "mecanum";
  robot.wheels.clear();
  for (const double x : {0.1, -0.1})
    for (const double y : {0.12, -0.12}) {
      WheelSpec wheel;
      wheel.name = std::string(x > 0 ? "front" : "rear") + (y > 0 ? " left" : " right");
      wheel.p_BW = {x, y, 0.05};
      wheel.radius_m = 0.05;
      wheel.roller_radius_m = 0.01;
      wheel.roller_angle_rad = x * y > 0 ? kPi / 4 : -kPi / 4;
      wheel.max_speed_radps = 20;
      robot.wheels.push_back(wheel);
    }
  return robot;
}

std::vector<std::string> TestRobotNames() {
  std::vector<std::string> names = {RoundRobot().name, HolonomicRobot().name};
  for (const std::string& name : RobotNames()) names.push_back(name);
  return names;
}

const RobotSpec& TestRobot(const std::string& name) {
  static std::map<std::string, RobotSpec> read = {{RoundRobot().name, RoundRobot()},
                                                  {HolonomicRobot().name, HolonomicRobot()}};
  const auto found = read.find(name);
  if (found != read.end()) return found->second;
  return read.emplace(name, ReadRobot(FindRobotFile(name, {})).spec).first->second;
}

std::vector<RobotSpec> TestRobots() {
  std::vector<RobotSpec> robots;
  for (const std::string& name : TestRobotNames()) robots.push_back(TestRobot(name));
  return robots;
}

std::string DriveOf(const std::string& name) {
  for (const RobotSpec& robot : {RoundRobot(), HolonomicRobot()})
    if (robot.name == name) return robot.drive;
  return CustomText(name, "drive");
}

Path MakePath(const std::vector<Vec2>& points) {
  Path path;
  for (const Vec2& p : points) {
    Waypoint waypoint;
    waypoint.p_W = p;
    path.push_back(waypoint);
  }
  return path;
}

double Driven::CrossTrackAfter(double t_s) const {
  double largest_m = 0;
  for (const Step& step : steps)
    if (step.t_s >= t_s) largest_m = std::max(largest_m, step.cross_track_m);
  return largest_m;
}

bool Driven::SegmentsNeverDecrease() const {
  return std::ranges::is_sorted(steps, {}, &Step::segment);
}

Driven DriveAlong(Tracker& dut, const Path& path, const DriveOptions& options,
                  const ClearanceField* clearance, const RobotSpec& robot) {
  Pose2 X_WB;
  if (options.start) {
    X_WB = *options.start;
  } else if (!path.empty()) {
    const Vec2 way = path[std::min<std::size_t>(1, path.size() - 1)].p_W - path[0].p_W;
    X_WB = {path[0].p_W.x(), path[0].p_W.y(), std::atan2(way.y(), way.x())};
  }

  Driven driven;
  dut.Start(path, robot, clearance);
  IdealRobot ideal(robot, X_WB, options.wheel_lag_s);
  const int substeps = std::max(1, static_cast<int>(std::lround(options.control_s / kPhysicsS)));
  for (int period = 0; !driven.done; ++period) {
    const double t_s = period * options.control_s;
    if (t_s > options.time_limit_s) return driven;
    X_WB = ideal.state().X_WB;
    if (options.push) {
      options.push(t_s, X_WB);
      ideal.MoveTo(X_WB);
    }
    const Command command = dut.Update(ideal.state(), t_s, options.control_s);
    Driven::Step step{t_s, X_WB, command.twist, command.segment, command.dwelling, command.turning,
                      0,   {}};
    for (const WaypointTask& task : command.tasks) step.tasks.push_back(task.id);
    if (!path.empty())
      step.cross_track_m =
          DistanceToSegment(path[command.segment].p_W,
                            path[std::min(command.segment + 1, path.size() - 1)].p_W, X_WB.p());
    driven.steps.push_back(step);
    driven.max_cross_track_m = std::max(driven.max_cross_track_m, step.cross_track_m);
    driven.time_s = t_s;
    driven.done = command.done;
    driven.missed = dut.Missed();
    ideal.Drive(command, options.control_s, substeps);
  }
  return driven;
}

double IdealTime(const Path& path, const RobotSpec& robot) {
  constexpr double kCornerRad = 50 * kPi / 180;
  double time_s = 0, straight_m = 0;
  Vec2 before = Vec2::Zero();
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec2 way = path[i].p_W - path[i - 1].p_W;
    const double angle_rad = std::abs(std::atan2(Cross(before, way), before.dot(way)));
    if (straight_m > 0 && angle_rad > kCornerRad) {
      time_s += TrapezoidTime(straight_m, robot.cruise_mps, robot.max_accel_mps2) +
                TrapezoidTime(angle_rad, robot.max_yaw_rate_radps, robot.max_yaw_accel_radps2);
      straight_m = 0;
    }
    straight_m += way.norm();
    before = way;
  }
  return time_s + TrapezoidTime(straight_m, robot.cruise_mps, robot.max_accel_mps2);
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Whatever polyline a plan is, its tracker drives it: bends, zigzags, reversals, arcs drawn by the
// centimetre, points far finer than the robot can turn; with yaw stated and without. The robot
// arrives, keeps near the path, is never judged stuck, and takes about the time foretold. A robot
// that cannot turn on the spot gets the plan as planners make it for such a robot.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "base/streams.h"
#include "env/failures/detector.h"
#include "planners/lines/turn_curves.h"
#include "planners/lines/turned_plan.h"
#include "run/episode/plan_progress.h"
#include "tests/controllers/driving.h"

namespace floorproof {
namespace {

struct Line {
  std::string name;
  Path path;
};

// From the origin, legs of these lengths, each turned by this angle to the one before.
Path Legs(const std::vector<double>& lengths_m, const std::vector<double>& turns_deg) {
  std::vector<Vec2> points = {{0, 0}};
  double heading_rad = 0;
  for (std::size_t i = 0; i < lengths_m.size(); ++i) {
    if (i > 0) heading_rad += turns_deg[(i - 1) % turns_deg.size()] * kPi / 180;
    points.push_back(points.back() +
                     lengths_m[i] * Vec2(std::cos(heading_rad), std::sin(heading_rad)));
  }
  return MakePath(points);
}

// A straight, an arc by legs of `leg_m`, a straight.
Path Arc(double radius_m, double turn_deg, double leg_m) {
  std::vector<double> lengths = {0.5}, turns;
  const int n = std::max(1, static_cast<int>(std::lround(radius_m * turn_deg * kPi / 180 / leg_m)));
  for (int i = 0; i < n; ++i) {
    lengths.push_back(leg_m);
    turns.push_back(turn_deg / (n + 1));
  }
  lengths.push_back(0.5);
  turns.push_back(turn_deg / (n + 1));
  return Legs(lengths, turns);
}

std::vector<Line> Lines() {
  std::vector<Line> lines;
  lines.push_back({"jog", MakePath({{0, 0}, {1, 0}, {1.025, 0.025}, {2, 0.025}})});
  for (const int deg : {5, 14, 16, 20, 30, 45, 49, 51, 60, 90, 120, 150, 179, 180})
    for (const double short_m : {0.01, 0.035, 0.1}) {
      const std::string name = fmt::format("{} deg, {} m", deg, short_m);
      lines.push_back({"one way, " + name, Legs({0.6, short_m, 0.6}, {1.0 * deg})});
      lines.push_back(
          {"there and back, " + name, Legs({0.6, short_m, 0.6}, {1.0 * deg, -1.0 * deg})});
    }
  for (const double radius_m : {0.02, 0.03, 0.05, 0.08, 0.2})
    for (const int deg : {45, 90, 180, 350})
      lines.push_back(
          {fmt::format("arc of {} m, {} deg", radius_m, deg), Arc(radius_m, deg, 0.01)});
  for (const int deg : {20, 45, 70, 90, 135, 170})
    for (const double leg_m : {0.01, 0.02, 0.05})
      lines.push_back({fmt::format("zigzag of {} deg, {} m", deg, leg_m),
                       Legs(std::vector<double>(30, leg_m), {1.0 * deg, -1.0 * deg})});
  std::vector<Vec2> spiral, ripple;
  for (int i = 0; i < 400; ++i)
    spiral.emplace_back(0.0015 * i * std::cos(0.06 * i), 0.0015 * i * std::sin(0.06 * i));
  for (int i = 0; i < 300; ++i) ripple.emplace_back(0.004 * i, 0.006 * std::sin(1.1 * i));
  lines.push_back({"spiral", MakePath(spiral)});
  lines.push_back({"ripple", MakePath(ripple)});
  for (std::uint64_t k = 0; k < 40; ++k) {
    Stream draw(7, k, "polyline");
    std::vector<double> lengths, turns;
    const int n = 8 + static_cast<int>(20 * draw.Uniform());
    for (int i = 0; i < n; ++i) {
      lengths.push_back(0.01 * std::pow(60.0, draw.Uniform()));  // 1 cm to 60 cm
      turns.push_back(360 * draw.Uniform() - 180);
    }
    lines.push_back({fmt::format("random {}", k), Legs(lengths, turns)});
  }
  return lines;
}

// The plan's yaw: none, one, or another at each waypoint.
enum class Yaw { kOpen, kHeld, kChanging };
Path With(Path path, Yaw yaw) {
  if (yaw == Yaw::kOpen) return path;
  for (std::size_t i = 0; i < path.size(); ++i)
    path[i].yaw_rad = yaw == Yaw::kHeld ? 0.0 : 0.7 * static_cast<double>(i % 5);
  return path;
}

// On a wide, empty floor.
Path Fit(const Path& path, const RobotSpec& robot) {
  if (robot.turn_radius_m == 0) return path;
  ClearanceField open;
  open.frame = {40, 40, 1, {-20, -20, 0}};
  open.distance_m = Grid<float>(40, 40, 20);
  const Vec2 way = path[1].p_W - path[0].p_W;
  const Pose2 start{path[0].p_W.x(), path[0].p_W.y(), std::atan2(way.y(), way.x())};
  return WithTurns(path, {open, 0, 0, kTurnReserve * robot.turn_radius_m, 0, start}).path;
}

double ShortestLeg(const Path& path) {
  double shortest_m = 1;
  for (std::size_t i = 1; i < path.size(); ++i)
    shortest_m = std::min(shortest_m, (path[i].p_W - path[i - 1].p_W).norm());
  return shortest_m;
}

class Polylines : public testing::TestWithParam<std::string> {};

// Judges the drive as an episode would. Empty: it did not fail.
std::string Stuck(const Driven& driven, const Path& path, const RobotSpec& robot) {
  const auto detector = MakePlugin(Detectors(), "stuck", "failures");
  static const HazardMap map;
  detector->Start({map, robot, 0.02});
  PlanProgress progress;
  for (std::size_t i = 0; i < driven.steps.size(); ++i) {
    const Driven::Step& step = driven.steps[i];
    Sample sample;
    sample.t_s = step.t_s;
    sample.p_WB = {step.X_WB.x_m, step.X_WB.y_m, 0};
    sample.yaw_rad = step.X_WB.yaw_rad;
    sample.command.twist = step.twist;
    sample.command.dwelling = step.dwelling;
    sample.command.turning = step.turning;
    if (i > 0)
      sample.V_WB_B.wz_radps =
          WrapAngle(step.X_WB.yaw_rad - driven.steps[i - 1].X_WB.yaw_rad) / 0.02;
    sample.progress_m = progress.Update(path, 1, step.segment, step.X_WB.p());
    if (detector->Update(sample))
      return fmt::format("stuck at {} s, x {} y {}", sample.t_s, step.X_WB.x_m, step.X_WB.y_m);
  }
  return "";
}

TEST_P(Polylines, AreDriven) {
  const RobotSpec& robot = TestRobot(GetParam());
  const auto drive = MakePlugin(Drives(), robot.drive, "drive");
  for (const Line& line : Lines())
    for (const Yaw yaw : {Yaw::kOpen, Yaw::kHeld, Yaw::kChanging}) {
      if (yaw != Yaw::kOpen && !drive->holonomic()) continue;
      SCOPED_TRACE(fmt::format("{}, yaw {}", line.name, static_cast<int>(yaw)));
      const Path path = Fit(With(line.path, yaw), robot);
      if (path.empty()) continue;  // shorter than any turn
      const auto dut = MakePlugin(Trackers(), DefaultTracker(robot.drive), "controller");
      dut->Start(path, robot, nullptr);
      const double foretold_s = dut->Duration();
      DriveOptions options;
      options.time_limit_s = 60 + 3 * foretold_s;  // as an episode's
      const Driven driven = DriveAlong(*dut, path, options, nullptr, robot);
      ASSERT_TRUE(driven.done) << "at x " << driven.steps.back().X_WB.x_m << " y "
                               << driven.steps.back().X_WB.y_m;
      EXPECT_LT((driven.steps.back().X_WB.p() - path.back().p_W).norm(), 0.05);
      EXPECT_LT(driven.max_cross_track_m, 0.1);
      EXPECT_EQ(Stuck(driven, path, robot), "");
      EXPECT_LT(driven.time_s, 1.4 * foretold_s + 3);
      // Legs as short as a corner's tolerance may be passed over.
      if (ShortestLeg(path) > 0.015) {
        EXPECT_GT(driven.time_s, 0.6 * foretold_s - 3);
      }
    }
}

INSTANTIATE_TEST_SUITE_P(All, Polylines, testing::ValuesIn(TestRobotNames()),
                         [](const auto& suite) { return suite.param; });

}  // namespace
}  // namespace floorproof

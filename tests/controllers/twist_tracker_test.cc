// SPDX-License-Identifier: Apache-2.0
#include "controllers/twist_tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/controllers/driving.h"

namespace floorproof {
namespace {

// Asks for what a test says, and counts how often it is asked.
class Asking final : public TwistTracker {
 public:
  using Answer = std::function<BodyTwist(const Estimate&, const Vec2& target_W, double speed_mps)>;
  explicit Asking(Answer answer, bool free = false)
      : TwistTracker(free), answer_(std::move(answer)) {}
  int asked = 0;

 private:
  BodyTwist Twist(const Situation& now) override {
    ++asked;
    return answer_(now.estimate, now.target_W, now.speed_mps);
  }
  Answer answer_;
};

Asking::Answer Constantly(const BodyTwist& twist) {
  return [twist](const Estimate&, const Vec2&, double) { return twist; };
}

// Heads for the point ahead: enough of a tracker to come to the end of a plan.
BodyTwist TowardsTarget(const Estimate& estimate, const Vec2& target_W, double speed_mps) {
  const Vec2 ahead = estimate.X_WB.Inverse() * target_W;
  const double off_rad = std::atan2(ahead.y(), ahead.x());
  return {std::abs(off_rad) < 0.5 ? speed_mps : 0, 0, 2 * off_rad};
}

// The largest step from one commanded twist to the next.
struct Steps {
  double speed_mps = 0, change_mps = 0, rate_radps = 0, rate_change_radps = 0;
};
Steps LargestSteps(TwistTracker& dut, int periods, double dt_s) {
  Steps most;
  BodyTwist last;
  for (int i = 0; i < periods; ++i) {
    const BodyTwist now = dut.Update({}, i * dt_s, dt_s).twist;
    most.speed_mps = std::max(most.speed_mps, std::hypot(now.vx_mps, now.vy_mps));
    most.change_mps =
        std::max(most.change_mps, std::hypot(now.vx_mps - last.vx_mps, now.vy_mps - last.vy_mps));
    most.rate_radps = std::max(most.rate_radps, std::abs(now.wz_radps));
    most.rate_change_radps =
        std::max(most.rate_change_radps, std::abs(now.wz_radps - last.wz_radps));
    last = now;
  }
  return most;
}

// Whatever is asked for, to and fro, along any direction.
TEST(TwistTracker, NeverLeavesTheRobotsLimits) {
  const RobotSpec robot = HolonomicRobot();
  constexpr double kDt_s = 0.02;
  for (const BodyTwist& wish : {BodyTwist{50, 0, 0}, BodyTwist{-50, 50, 90}, BodyTwist{0, 3, -9}}) {
    int call = 0;
    Asking dut([&](const Estimate&, const Vec2&, double) {
      const double sign = call++ / 100 % 2 == 0 ? 1 : -1;
      return BodyTwist{sign * wish.vx_mps, sign * wish.vy_mps, sign * wish.wz_radps};
    });
    dut.Start(MakePath({{0, 0}, {5, 0}}), robot, nullptr);
    const Steps most = LargestSteps(dut, 400, kDt_s);
    EXPECT_NEAR(most.speed_mps, wish.vx_mps == 0 && wish.vy_mps == 0 ? 0 : robot.max_speed_mps,
                1e-9);
    EXPECT_LE(most.change_mps, robot.max_accel_mps2 * kDt_s + 1e-9);
    EXPECT_LE(most.rate_radps, robot.max_yaw_rate_radps + 1e-9);
    EXPECT_LE(most.rate_change_radps, robot.max_yaw_accel_radps2 * kDt_s + 1e-9);
  }
}

TEST(TwistTracker, SlowedItAsksForThatShareOfWhatTheRobotCanDo) {
  const RobotSpec robot = RoundRobot();
  Asking dut(Constantly({9, 0, 9}));
  dut.Start(MakePath({{0, 0}, {5, 0}}), robot, nullptr);
  dut.Slow(0.5);
  const Steps half = LargestSteps(dut, 400, 0.02);
  EXPECT_NEAR(half.speed_mps, 0.5 * robot.max_speed_mps, 1e-9);
  EXPECT_NEAR(half.rate_radps, 0.5 * robot.max_yaw_rate_radps, 1e-9);
  dut.Slow(0);
  LargestSteps(dut, 400, 0.02);
  EXPECT_NEAR(dut.Update({}, 16, 0.02).twist.vx_mps, 0, 1e-12);
}

TEST(TwistTracker, StandsAtADwellAndEndsAtTheEnd) {
  Path path = MakePath({{0, 0}, {1, 0}, {2, 0}});
  path[1].dwell_s = 3;
  Asking dut(TowardsTarget);
  const Driven driven = DriveAlong(dut, path);
  EXPECT_TRUE(driven.done);
  const auto dwelling = std::ranges::count_if(driven.steps, &Driven::Step::dwelling);
  EXPECT_NEAR(static_cast<double>(dwelling) * 0.02, 3, 0.05);
  for (const Driven::Step& step : driven.steps)
    EXPECT_LE(step.dwelling ? std::abs(step.X_WB.x_m - 1) : 0, 0.15) << step.t_s;
  // Nobody is asked what to do where nothing is to be done.
  EXPECT_LE(dut.asked, static_cast<int>(driven.steps.size()) - static_cast<int>(dwelling));
  EXPECT_NEAR(driven.steps.back().X_WB.x_m, 2, 0.1);
}

TEST(TwistTracker, RefusesAPlanThatChangesTheRobotsShape) {
  RobotSpec robot = RoundRobot();
  robot.hinges.emplace_back();
  Path path = MakePath({{0, 0}, {1, 0}});
  Asking dut(Constantly({}));
  dut.Start(path, robot, nullptr);
  path[1].shape = "I";
  EXPECT_THROW(dut.Start(path, robot, nullptr), InputError);
}

// One waypoint, and the robot on it: a plan that is done; or nobody's plan.
TEST(TwistTracker, OnlyAFreeOneGoesOnWhereThePathEnds) {
  const Path here = MakePath({{0, 0}});
  for (const bool free : {false, true}) {
    Asking dut(Constantly({0.1, 0, 0}), free);
    dut.Start(here, RoundRobot(), nullptr);
    Command last;
    for (int i = 0; i < 50; ++i) last = dut.Update({}, i * 0.02, 0.02);
    EXPECT_EQ(last.done, !free);
    EXPECT_EQ(dut.asked, free ? 50 : 0);
    EXPECT_NEAR(last.twist.vx_mps, free ? 0.1 : 0, 1e-12);
  }
}

}  // namespace
}  // namespace floorproof

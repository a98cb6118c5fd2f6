// SPDX-License-Identifier: Apache-2.0
// Recovery behaviour of a robot that moves exactly as it is told, when its sensors report trouble.
#include "controllers/recovery.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "controllers/odometry.h"
#include "tests/controllers/driving.h"

namespace floorproof {
namespace {

constexpr double kDt_s = 0.02;

RobotSpec Differential() {
  RobotSpec robot = RoundRobot();
  robot.circumscribed_radius_m = 0.18;
  return robot;
}
RobotSpec Holonomic() {
  RobotSpec robot = HolonomicRobot();
  robot.circumscribed_radius_m = 0.18;
  return robot;
}

// Eight places round the edge, as env/sensors has them.
CliffRing Ring() {
  CliffRing ring;
  ring.n = CliffRing::kMax;
  for (std::size_t i = 0; i < CliffRing::kMax; ++i) {
    const double a = 2 * kPi * static_cast<double>(i) / CliffRing::kMax;
    ring.p_B[i] = {0.17 * std::cos(a), 0.17 * std::sin(a)};
  }
  return ring;
}

struct Rig {
  explicit Rig(const RobotSpec& spec, const RecoveryParams& params = {}) : robot(spec) {
    sensed.cliffs = Ring();
    dut.Start(params, robot);
  }

  void Press(double bearing_rad) { sensed.bump = {true, bearing_rad}; }
  void Release() { sensed.bump.pressed = false; }
  void Drop(double bearing_rad, bool drop = true) {
    const auto i = static_cast<std::size_t>(std::lround(bearing_rad / (kPi / 4)) & 7);
    sensed.cliffs.drop[i] = drop;
  }

  // One control period of a robot whose tracker wants `tracked`; true: it reacted.
  bool Step() {
    const Estimate estimate{X_WB, V, {}};
    const bool reacts = dut.Update(sensed, estimate, kDt_s, command);
    if (!reacts) command.twist = tracked;
    ended += dut.ended();
    V = held ? BodyTwist{} : command.twist;
    X_WB = Moved(X_WB, V, kDt_s);
    if (reacts) twists.push_back(command.twist);
    return reacts;
  }

  // Until it no longer reacts, or 60 s. Returns the time that it took.
  double React(const std::function<void()>& each = {}) {
    int n = 0;
    twists.clear();
    ended = 0;
    while (n < 3000 && ended == 0 && (Step() || n == 0)) {
      if (each) each();
      ++n;
    }
    return n * kDt_s;
  }

  RobotSpec robot;
  Recovery dut;
  Observation sensed;
  BodyTwist tracked, V;
  Command command;
  Pose2 X_WB{1, 2, 0.7};
  bool held = false;
  int ended = 0;
  std::vector<BodyTwist> twists;  // commanded while it reacted
};

double Speed(const BodyTwist& v) { return std::hypot(v.vx_mps, v.vy_mps); }

TEST(Recovery, WithoutAlarmTheTrackersCommandStands) {
  Rig dut(Differential());
  dut.command.twist = {0.2, 0, 0.1};
  dut.command.dwelling = true;
  dut.command.hinges.n = 1;
  dut.command.hinges.radps[0] = 0.3;
  for (int i = 0; i < 50; ++i) {
    EXPECT_FALSE(dut.dut.Update(dut.sensed, {}, kDt_s, dut.command));
    EXPECT_FALSE(dut.dut.ended());
  }
  EXPECT_EQ(dut.command.twist.vx_mps, 0.2);
  EXPECT_EQ(dut.command.twist.wz_radps, 0.1);
  EXPECT_EQ(dut.command.hinges.radps[0], 0.3);
  EXPECT_TRUE(dut.command.dwelling);
  EXPECT_EQ(dut.dut.count(), 0);
}

struct Way {
  const char* name;
  bool holonomic;
  BodyTwist commanded;
};
class GoingBack : public ::testing::TestWithParam<Way> {};

// Where the wall was met the robot has come from the other side, whatever its own front is.
TEST_P(GoingBack, ItGoesBackAgainstTheWayItWasCommanded) {
  const auto& [name, holonomic, commanded] = GetParam();
  for (const double back_off_m : {0.05, 0.15, 0.4}) {
    RecoveryParams params;
    params.back_off_m = back_off_m;
    Rig dut(holonomic ? Holonomic() : Differential(), params);
    dut.tracked = commanded;
    for (int i = 0; i < 20; ++i) dut.Step();
    const Pose2 met = dut.X_WB;
    dut.Press(std::atan2(commanded.vy_mps, commanded.vx_mps));
    const double took_s = dut.React([&] { dut.Release(); });

    const Vec2 came = Vec2(commanded.vx_mps, commanded.vy_mps).normalized();
    const Vec2 gone_B = met.Inverse() * dut.X_WB.p();
    EXPECT_NEAR(gone_B.dot(came), -back_off_m, params.back_off_mps * kDt_s + 1e-9);
    EXPECT_NEAR(Cross(gone_B, came), 0, 1e-9);
    EXPECT_NEAR(dut.X_WB.yaw_rad, met.yaw_rad, 1e-9);
    EXPECT_EQ(dut.ended, 1);
    EXPECT_EQ(dut.dut.count(), 1);
    for (const BodyTwist& v : dut.twists) EXPECT_LE(Speed(v), params.back_off_mps + 1e-9);
    EXPECT_GT(took_s, back_off_m / params.back_off_mps);
    EXPECT_LT(took_s, back_off_m / params.back_off_mps + 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Recovery, GoingBack,
                         ::testing::Values(Way{"Forwards", false, {0.2, 0, 0}},
                                           Way{"Backwards", false, {-0.2, 0, 0}},
                                           Way{"HolonomicForwards", true, {0.2, 0, 0}},
                                           Way{"Left", true, {0, 0.2, 0}},
                                           Way{"Aslant", true, {-0.1, 0.15, 0}}),
                         [](const auto& way) { return std::string(way.param.name); });

// Motors stop the wheels at once; how fast it may gather speed is the robot's.
TEST(Recovery, ItBrakesAtOnceAndGathersSpeedAsTheRobotCan) {
  for (const double accel_mps2 : {0.1, 0.5}) {
    RobotSpec robot = Differential();
    robot.max_accel_mps2 = accel_mps2;
    Rig dut(robot);
    dut.tracked = {0.3, 0, 0};
    for (int i = 0; i < 5; ++i) dut.Step();
    dut.Press(0);
    dut.React([&] { dut.Release(); });
    ASSERT_GT(dut.twists.size(), 10u);
    EXPECT_EQ(Speed(dut.twists[0]), 0);
    for (std::size_t i = 1; i + 1 < dut.twists.size(); ++i)
      EXPECT_LE(std::abs(dut.twists[i].vx_mps - dut.twists[i - 1].vx_mps),
                accel_mps2 * kDt_s + 1e-12);
    EXPECT_EQ(Speed(dut.twists.back()), 0) << "it stands when it has gone back";
  }
}

TEST(Recovery, ItTurnsBackNoFasterThanTheRobotCan) {
  RobotSpec robot = Differential();
  robot.max_yaw_accel_radps2 = 0.5;
  robot.max_yaw_rate_radps = 0.3;
  Rig dut(robot);
  dut.tracked = {0, 0, 0.3};
  for (int i = 0; i < 5; ++i) dut.Step();
  dut.Drop(kPi / 2);
  dut.React([&] { dut.Drop(kPi / 2, false); });
  ASSERT_GT(dut.twists.size(), 10u);
  double least = 0;
  for (std::size_t i = 1; i + 1 < dut.twists.size(); ++i) {
    EXPECT_LE(std::abs(dut.twists[i].wz_radps - dut.twists[i - 1].wz_radps), 0.5 * kDt_s + 1e-12);
    least = std::min(least, dut.twists[i].wz_radps);
  }
  EXPECT_NEAR(least, -0.3, 1e-9);
}

TEST(Recovery, ItGoesNoFasterThanTheRobotCan) {
  RecoveryParams params;
  params.back_off_m = 2;
  params.back_off_mps = 50;
  Rig dut(Differential(), params);
  dut.tracked = {0.2, 0, 0};
  dut.Step();
  dut.Press(0);
  dut.React([&] { dut.Release(); });
  double fastest = 0;
  for (const BodyTwist& v : dut.twists) fastest = std::max(fastest, Speed(v));
  EXPECT_NEAR(fastest, dut.robot.max_speed_mps, 1e-9);
}

// A heavy robot slides on after its wheels have stopped: it goes back from where it came to rest.
TEST(Recovery, ItWaitsUntilItStands) {
  Rig dut(Differential());
  dut.command.twist = {0.3, 0, 0};
  dut.Press(0);
  for (const double v_mps : {0.3, 0.2, 0.1, 0.03}) {
    dut.X_WB = Moved(dut.X_WB, {v_mps, 0, 0}, kDt_s);
    EXPECT_TRUE(dut.dut.Update(dut.sensed, {dut.X_WB, {v_mps, 0, 0}, {}}, kDt_s, dut.command));
    EXPECT_EQ(Speed(dut.command.twist), 0) << v_mps;
  }
  const Pose2 rest = dut.X_WB;
  dut.React();
  EXPECT_NEAR((rest.Inverse() * dut.X_WB.p()).x(), -0.15, 0.003);
}

// How far it got from where it met the first, and where it ended.
struct Between {
  double farthest_m = 0, end_m = 0;
};
// `behind` presses or shows what is behind, once it has gone 0.05 m; held: for as long as it is
// there, else for one period.
Between GoesBackBetween(const RobotSpec& robot, bool held, const std::function<void(Rig&)>& behind,
                        const std::function<void(Rig&)>& ahead,
                        const std::function<void(Rig&)>& release) {
  Rig dut(robot);
  dut.tracked = {0.2, 0, 0};
  for (int i = 0; i < 5; ++i) dut.Step();
  const Pose2 met = dut.X_WB;
  Between got;
  bool shown = false;
  ahead(dut);
  dut.React([&] {
    const double gone_m = (dut.X_WB.p() - met.p()).norm();
    got.farthest_m = std::max(got.farthest_m, gone_m);
    release(dut);
    if (gone_m < 0.05 || (shown && !held)) return;
    shown = true;
    behind(dut);
  });
  EXPECT_EQ(dut.ended, 1);
  EXPECT_EQ(dut.dut.count(), 1);
  got.end_m = (dut.X_WB.p() - met.p()).norm();
  // Later it goes back as far as ever.
  dut.Release();
  dut.sensed.cliffs = Ring();
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(dut.Step());
  const Pose2 again = dut.X_WB;
  dut.Press(0);
  dut.React([&] { dut.Release(); });
  EXPECT_NEAR((again.Inverse() * dut.X_WB.p()).x(), -0.15, 0.005);
  return got;
}

// Between a table and a wall that are nearer to each other than it goes back: it does not go to and
// fro between them, but to the middle, so that it can turn and leave; however short the touch.
TEST(Recovery, BetweenTwoThingsItGoesToTheMiddle) {
  for (const RobotSpec& robot : {Differential(), Holonomic()})
    for (const bool held : {true, false})
      for (const bool bump : {true, false}) {
        const Between got = GoesBackBetween(
            robot, held, [&](Rig& r) { bump ? r.Press(kPi) : r.Drop(kPi); },
            [](Rig& r) { r.Press(0); },
            [](Rig& r) {
              r.Release();
              r.Drop(kPi, false);
            });
        EXPECT_NEAR(got.farthest_m, 0.05, 0.005);
        EXPECT_NEAR(got.end_m, 0.025, 0.005);
      }
}

// On a plank: no floor ahead, and before it has gone far none behind. Two alarms on opposite sides
// do not make up for each other, and that ahead may still be seen from the middle.
TEST(Recovery, OnAPlankItGoesToTheMiddle) {
  const auto edge = [](Rig& r, double side) {
    for (const double a : {-kPi / 4, 0.0, kPi / 4}) r.Drop(side + a);
  };
  const Between got = GoesBackBetween(
      Differential(), true, [&](Rig& r) { edge(r, kPi); }, [&](Rig& r) { edge(r, 0); },
      [](Rig&) {});
  EXPECT_NEAR(got.farthest_m, 0.05, 0.005);
  EXPECT_NEAR(got.end_m, 0.025, 0.005);
}

// What presses from aside ends the way back: it is not behind.
TEST(Recovery, ItGoesNoFurtherAlongWhatIsBesideIt) {
  const Between got = GoesBackBetween(
      Holonomic(), true, [](Rig& r) { r.Press(100 * kPi / 180); }, [](Rig& r) { r.Press(0); },
      [](Rig& r) { r.Release(); });
  EXPECT_NEAR(got.farthest_m, 0.05, 0.005);
  EXPECT_NEAR(got.end_m, 0.05, 0.005);
}

// What it drove into still touches it for the first of the way back; that is nothing behind.
TEST(Recovery, WhatItMetDoesNotKeepItFromGoingBack) {
  for (const double bearing_rad : {0.0, 1.2, -1.2}) {
    Rig dut(Differential());
    dut.tracked = {0.2, 0, 0};
    for (int i = 0; i < 5; ++i) dut.Step();
    const Pose2 met = dut.X_WB;
    dut.Press(bearing_rad);
    dut.React();
    EXPECT_NEAR((dut.X_WB.p() - met.p()).norm(), 0.15, 0.003);
  }
}

TEST(Recovery, ARobotThatCannotMoveGivesUp) {
  RecoveryParams params;
  Rig dut(Differential(), params);
  dut.tracked = {0.2, 0, 0};
  dut.Step();
  dut.held = true;
  dut.Press(0);
  const double took_s = dut.React();
  EXPECT_EQ(dut.ended, 1);
  EXPECT_GT(took_s, params.back_off_m / params.back_off_mps);
  EXPECT_LT(took_s, 2 * params.back_off_m / params.back_off_mps + 3);
}

// Pushed along by a person: it never stands, and does not brake for ever.
TEST(Recovery, ARobotThatCannotStopGivesUp) {
  Rig dut(Differential());
  dut.command.twist = {0.2, 0, 0};
  dut.Press(0);
  int n = 0;
  do {
    dut.X_WB = Moved(dut.X_WB, {0.3, 0, 0}, kDt_s);
    dut.dut.Update(dut.sensed, {dut.X_WB, {0.3, 0, 0}, {}}, kDt_s, dut.command);
  } while (!dut.dut.ended() && ++n < 3000);
  EXPECT_LT(n * kDt_s, 10);
}

TEST(Recovery, EachReactionEndsOnceAndTheTrackerGoesOn) {
  Rig dut(Differential());
  dut.tracked = {0.2, 0, 0};
  for (int meeting = 1; meeting <= 3; ++meeting) {
    for (int i = 0; i < 20; ++i) EXPECT_FALSE(dut.Step());
    dut.Press(0);
    dut.React([&] { dut.Release(); });
    EXPECT_EQ(dut.ended, 1);
    EXPECT_EQ(dut.dut.count(), meeting);
    EXPECT_FALSE(dut.Step());
    EXPECT_FALSE(dut.dut.ended());
  }
}

TEST(Recovery, AfterSoManyItDrivesBlindly) {
  RecoveryParams params;
  params.most = 2;
  Rig dut(Differential(), params);
  dut.tracked = {0.2, 0, 0};
  for (int meeting = 0; meeting < 2; ++meeting) {
    for (int i = 0; i < 20; ++i) dut.Step();
    dut.Press(0);
    dut.React([&] { dut.Release(); });
    EXPECT_EQ(dut.ended, 1);
  }
  dut.Press(0);
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(dut.Step());
  EXPECT_EQ(dut.dut.count(), 2);

  dut.dut.Start(params, dut.robot);  // another episode
  EXPECT_TRUE(dut.Step());
  EXPECT_EQ(dut.dut.count(), 1);
}

TEST(Recovery, WhatItIsNotToReactToItDoesNot) {
  RecoveryParams no_bumper, no_cliff;
  no_bumper.bumper = false;
  no_cliff.cliff = false;
  Rig bumped(Differential(), no_bumper), dropped(Differential(), no_cliff);
  bumped.Press(0);
  dropped.Drop(0);
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(bumped.Step());
    EXPECT_FALSE(dropped.Step());
  }
  bumped.Drop(0);
  dropped.Press(0);
  EXPECT_TRUE(bumped.Step());
  EXPECT_TRUE(dropped.Step());
}

TEST(Recovery, AtItsGoalItStandsStill) {
  Rig dut(Differential());
  dut.command.done = true;
  dut.Press(0);
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(dut.Step());
}

// While it reacts it neither dwells nor folds.
TEST(Recovery, ItHoldsItsShape) {
  Rig dut(Differential());
  dut.command.twist = {0.2, 0, 0};
  dut.command.dwelling = true;
  dut.command.segment = 7;
  dut.command.hinges.n = 1;
  dut.command.hinges.rad[0] = 0.5;
  dut.command.hinges.radps[0] = 0.3;
  dut.Press(0);
  ASSERT_TRUE(dut.Step());
  EXPECT_FALSE(dut.command.dwelling);
  EXPECT_EQ(dut.command.hinges.radps[0], 0);
  EXPECT_EQ(dut.command.hinges.rad[0], 0.5);
  EXPECT_EQ(dut.command.segment, 7u);
}

// Touched while it stands, it goes away from what touches it, as far as its drive can.
TEST(Recovery, AStandingRobotGoesAwayFromWhatTouchesIt) {
  const auto gone = [](const RobotSpec& robot, double bearing_rad) {
    Rig dut(robot);
    const Pose2 stood = dut.X_WB;
    dut.Press(bearing_rad);
    dut.React([&] { dut.Release(); });
    EXPECT_EQ(dut.ended, 1);
    return Vec2(stood.Inverse() * dut.X_WB.p());
  };
  EXPECT_LT((gone(Differential(), 0) - Vec2(-0.15, 0)).norm(), 0.003);
  EXPECT_LT((gone(Differential(), kPi) - Vec2(0.15, 0)).norm(), 0.003);
  EXPECT_LT((gone(Differential(), 0.8) - Vec2(-0.15, 0)).norm(), 0.003);
  for (const double bearing_rad : {0.0, 1.0, kPi / 2, kPi, -2.0}) {
    const Vec2 away(-0.15 * std::cos(bearing_rad), -0.15 * std::sin(bearing_rad));
    EXPECT_LT((gone(Holonomic(), bearing_rad) - away).norm(), 0.003) << bearing_rad;
  }
}

// A differential robot cannot go sideways: it turns back the way it came. A holonomic one can.
TEST(Recovery, ATurningRobotWhoseSideSeesADropTurnsBack) {
  for (const double sense : {1.0, -1.0})
    for (const double side : {kPi / 2, -kPi / 2}) {
      Rig dut(Differential());
      dut.tracked = {0, 0, 0.5 * sense};
      for (int i = 0; i < 20; ++i) dut.Step();
      const Pose2 met = dut.X_WB;
      dut.Drop(side);
      dut.React([&] { dut.Drop(side, false); });
      EXPECT_EQ(dut.ended, 1);
      EXPECT_LT((dut.X_WB.p() - met.p()).norm(), 1e-9);
      // Its edge has gone back_off_m.
      EXPECT_NEAR(WrapAngle(dut.X_WB.yaw_rad - met.yaw_rad) * 0.18, -sense * 0.15, 0.003);

      Rig other(Holonomic());
      other.tracked = {0, 0, 0.5 * sense};
      for (int i = 0; i < 20; ++i) other.Step();
      const Pose2 there = other.X_WB;
      other.Drop(side);
      other.React([&] { other.Drop(side, false); });
      EXPECT_LT(((there.Inverse() * other.X_WB.p()) - Vec2(0, side > 0 ? -0.15 : 0.15)).norm(),
                0.003);
    }
}

// The alarm may stay: each period of it is then no reaction of its own.
TEST(Recovery, APressedBumperIsOneReactionUntilItHasGoneBack) {
  Rig dut(Differential());
  dut.tracked = {0.2, 0, 0};
  dut.Step();
  dut.Press(0);
  dut.React();
  EXPECT_EQ(dut.dut.count(), 1);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What every registered drive, estimator and tracker promises: drives and trackers on every
// registered robot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <set>

#include "controllers/drive.h"
#include "controllers/estimator.h"
#include "tests/controllers/allocation_guard.h"
#include "tests/controllers/driving.h"

namespace floorproof {

void PrintTo(const PluginEntry<Estimator>& entry, std::ostream* os) { *os << entry.name; }

namespace {

// A drive under each robot that stands on it.
class DriveConformance : public testing::TestWithParam<std::string> {
 protected:
  DriveConformance() : dut_(MakePlugin(Drives(), robot().drive, "drive")) {
    dut_->Configure(robot());
  }
  static const RobotSpec& robot() { return TestRobot(GetParam()); }
  // What the wheels roll that are told this twist.
  BodyTwist Rolled(const BodyTwist& twist) const {
    std::vector<double> wheels(robot().wheels.size());
    dut_->ToWheels(twist, wheels);
    return dut_->ToTwist(wheels);
  }
  std::unique_ptr<Drive> dut_;
};

constexpr double kSlow_mps = 0.05, kSlow_radps = 0.1;  // far below what any motor can do

TEST_P(DriveConformance, DrivesStraightOn) {
  const BodyTwist rolled = Rolled({kSlow_mps, 0, 0});
  EXPECT_NEAR(rolled.vx_mps, kSlow_mps, 1e-12);
  EXPECT_NEAR(rolled.vy_mps, 0, 1e-12);
  EXPECT_NEAR(rolled.wz_radps, 0, 1e-12);
}

TEST_P(DriveConformance, MovesAsideIfItSaysThatItIsHolonomic) {
  const BodyTwist rolled = Rolled({0, kSlow_mps, 0});
  EXPECT_NEAR(rolled.vy_mps, dut_->holonomic() ? kSlow_mps : 0, 1e-12);
  EXPECT_NEAR(rolled.wz_radps, 0, 1e-12);
}

TEST_P(DriveConformance, TurnsOnTheSpotIfItSaysSo) {
  const BodyTwist rolled = Rolled({0, 0, kSlow_radps});
  const bool turns =
      std::abs(rolled.wz_radps - kSlow_radps) < 1e-12 && std::abs(rolled.vx_mps) < 1e-12;
  EXPECT_EQ(turns, dut_->turns_on_the_spot());
}

// What wheels turn that are out of use is not believed; without too many it cannot do.
TEST_P(DriveConformance, WheelsOutOfUseSayNothing) {
  const std::size_t n = robot().wheels.size();
  std::vector<char> out(n, 0);
  EXPECT_TRUE(dut_->Exclude(out));
  out[0] = 1;
  std::vector<double> wheels(n);
  const BodyTwist twist{0.05, dut_->holonomic() ? 0.03 : 0, 0.1};
  dut_->ToWheels(twist, wheels);
  const BodyTwist all = dut_->ToTwist(wheels);
  wheels[0] += 5;
  if (dut_->Exclude(out)) {
    const BodyTwist rest = dut_->ToTwist(wheels);
    EXPECT_NEAR(rest.vx_mps, all.vx_mps, 1e-12);
    EXPECT_NEAR(rest.vy_mps, all.vy_mps, 1e-12);
    EXPECT_NEAR(rest.wz_radps, all.wz_radps, 1e-12);
  }
  EXPECT_FALSE(dut_->Exclude(std::vector<char>(n, 1)));
  EXPECT_TRUE(dut_->Exclude(std::vector<char>(n, 0))) << "they may come back";
  EXPECT_NE(dut_->ToTwist(wheels).vx_mps, all.vx_mps);
}

TEST_P(DriveConformance, SomeTrackerCommandsIt) {
  EXPECT_THAT(PluginNames(Trackers()), testing::Contains(DefaultTracker(robot().drive)));
}

INSTANTIATE_TEST_SUITE_P(All, DriveConformance, testing::ValuesIn(TestRobotNames()),
                         [](const auto& suite) { return suite.param; });

// Each tracker, on each robot that it commands.
struct Tracked {
  PluginEntry<Tracker> tracker;
  std::string robot;
};
void PrintTo(const Tracked& tracked, std::ostream* os) {
  *os << tracked.tracker.name << " on " << tracked.robot;
}
std::vector<Tracked> AllTracked() {
  std::vector<Tracked> all;
  for (const auto& entry : Trackers())
    for (const std::string& robot : TestRobotNames())
      if (entry.make()->Commands(*MakePlugin(Drives(), DriveOf(robot), "drive")))
        all.push_back({entry, robot});
  return all;
}

// Rows and corners; of as many waypoints, bends for a robot that cannot turn on the spot.
Path RowsFor(const RobotSpec& robot) {
  if (robot.turn_radius_m > 0)
    return MakePath({{0, 0}, {1.5, 0}, {2.5, 0.3}, {3.5, 0.3}, {4.5, 0.6}, {5.5, 0.6}, {6.5, 0.8}});
  return MakePath({{0, 0}, {1.5, 0}, {1.5, 0.3}, {0, 0.3}, {0, 0.6}, {0.7, 0.6}, {1.2, 0.8}});
}

class TrackerConformance : public testing::TestWithParam<Tracked> {
 protected:
  static std::unique_ptr<Tracker> Make() { return GetParam().tracker.make(); }
  static const RobotSpec& robot() { return TestRobot(GetParam().robot); }
  const Path rows_ = RowsFor(robot());
};

TEST(Trackers, EachCommandsSomeRegisteredDrive) {
  for (const auto& entry : Trackers())
    EXPECT_TRUE(std::ranges::any_of(Drives(), [&](const auto& drive) {
      return entry.make()->Commands(*drive.make());
    })) << entry.name;
}

TEST_P(TrackerConformance, ReachesTheEndOfAPathInOrder) {
  const auto dut = Make();
  const Driven driven = DriveAlong(*dut, rows_, {}, nullptr, robot());
  ASSERT_TRUE(driven.done);
  EXPECT_TRUE(driven.SegmentsNeverDecrease());
  EXPECT_EQ(driven.steps.back().segment, rows_.size() - 2);
  EXPECT_LT((driven.steps.back().X_WB.p() - rows_.back().p_W).norm(), 0.05);
  EXPECT_LT(driven.max_cross_track_m, 0.10);
}

// A motor with a proportional speed loop falls short of every command by as much, and stands still
// at less.
TEST_P(TrackerConformance, ComesToAStopAgainstMotorsThatFallShort) {
  constexpr double kShort_mps = 0.06, kShort_radps = 0.2;
  const bool turns = robot().turn_radius_m == 0;
  const Path path =
      turns ? MakePath({{0, 0}, {1, 0}, {1, 0.5}}) : MakePath({{0, 0}, {1, 0}, {1.5, 0}});
  DriveOptions options;
  options.start = Pose2{0, 0, turns ? 1.0 : 0.0};  // turns there first
  options.time_limit_s = 60;
  Pose2 last = *options.start;
  options.push = [&](double, Pose2& X_WB) {
    const Vec2 moved_W = X_WB.p() - last.p();
    const double way_m = std::max(0.0, moved_W.norm() - kShort_mps * options.control_s);
    const double turned_rad = WrapAngle(X_WB.yaw_rad - last.yaw_rad);
    const double turn_rad = std::max(0.0, std::abs(turned_rad) - kShort_radps * options.control_s);
    const Vec2 now_W = last.p() + way_m * moved_W.normalized();
    X_WB = last = {now_W.x(), now_W.y(), last.yaw_rad + std::copysign(turn_rad, turned_rad)};
  };
  const auto dut = Make();
  const Driven driven = DriveAlong(*dut, path, options, nullptr, robot());
  ASSERT_TRUE(driven.done);
  const auto& end = driven.steps.back();
  EXPECT_LT((end.X_WB.p() - path.back().p_W).norm(), 0.03);
  EXPECT_LT(std::hypot(end.twist.vx_mps, end.twist.vy_mps), kShort_mps + 0.06);
}

TEST_P(TrackerConformance, KeepsTheRobotsLimits) {
  const auto dut = Make();
  const Driven driven = DriveAlong(*dut, rows_, {}, nullptr, robot());
  constexpr double kDt = 0.02, kSlack = 1e-9;
  BodyTwist last;
  for (const auto& step : driven.steps) {
    EXPECT_LE(std::hypot(step.twist.vx_mps, step.twist.vy_mps), robot().max_speed_mps + kSlack);
    EXPECT_LE(std::abs(step.twist.wz_radps), robot().max_yaw_rate_radps + kSlack);
    EXPECT_LE(std::hypot(step.twist.vx_mps - last.vx_mps, step.twist.vy_mps - last.vy_mps),
              robot().max_accel_mps2 * kDt + kSlack);
    EXPECT_LE(std::abs(step.twist.wz_radps - last.wz_radps),
              robot().max_yaw_accel_radps2 * kDt + kSlack);
    last = step.twist;
  }
}

TEST_P(TrackerConformance, IsSlowedAndHeldByItsSupervision) {
  const auto dut = Make();
  const double whole_s = DriveAlong(*dut, rows_, {}, nullptr, robot()).steps.back().t_s;
  DriveOptions options;
  double share = 0.5;
  Pose2 held;
  options.push = [&](double t_s, Pose2& X_WB) {
    if (t_s > 10 && t_s < 20) share = 0;
    if (t_s > 20) share = 0.5;
    if (t_s < 13) held = X_WB;
    if (t_s < 20) {
      EXPECT_LT((X_WB.p() - held.p()).norm(), 1e-3) << t_s;
    }
    dut->Slow(share);
  };
  const Driven driven = DriveAlong(*dut, rows_, options, nullptr, robot());
  ASSERT_TRUE(driven.done);
  for (const auto& step : driven.steps) {
    if (step.t_s < 1) continue;
    EXPECT_LE(std::hypot(step.twist.vx_mps, step.twist.vy_mps), robot().cruise_mps / 2 + 1e-9);
  }
  EXPECT_LT(driven.max_cross_track_m, 0.10);
  EXPECT_GT(driven.steps.back().t_s, 10 + 1.5 * whole_s);
  EXPECT_LT(driven.steps.back().t_s, 12 + 2.2 * whole_s);
}

TEST_P(TrackerConformance, StartForgetsThePathBefore) {
  const auto dut = Make();
  const Driven once = DriveAlong(*dut, rows_, {}, nullptr, robot());
  const Driven again = DriveAlong(*dut, rows_, {}, nullptr, robot());
  ASSERT_EQ(once.steps.size(), again.steps.size());
  for (std::size_t i = 0; i < once.steps.size(); ++i)
    EXPECT_EQ(once.steps[i].twist.vx_mps, again.steps[i].twist.vx_mps);
}

// What is to be done at a waypoint is done in its dwell: the tracker says so from its beginning to
// its end, and at no other time.
TEST_P(TrackerConformance, TellsTheTasksOfTheDwellThatGoesOn) {
  const auto dut = Make();
  Path path = rows_;
  path[1].dwell_s = path[4].dwell_s = path[6].dwell_s = 1;
  path[1].task = WaypointTask{.id = 7};
  path[4].task = WaypointTask{.id = 5};
  path[6].task = WaypointTask{.id = 9};  // at the end
  const Driven driven = DriveAlong(*dut, path, {}, nullptr, robot());
  ASSERT_TRUE(driven.done);
  std::vector<int> order;
  for (const auto& step : driven.steps) {
    EXPECT_EQ(step.tasks.size(), step.dwelling ? 1u : 0u) << step.t_s;
    if (!step.dwelling) continue;
    const int id = step.tasks.front();
    if (order.empty() || order.back() != id) order.push_back(id);
    const Vec2& place = path[id == 7 ? 1 : id == 5 ? 4 : 6].p_W;
    EXPECT_LT((step.X_WB.p() - place).norm(), 0.05) << id;
  }
  EXPECT_EQ(order, (std::vector<int>{7, 5, 9}));
}

// So whoever breaks off there has the waypoint ahead of it, and the dwell is not forgotten.
TEST_P(TrackerConformance, WhatLedToADwellIsTrackedUntilItIsOver) {
  const auto dut = Make();
  Path path = rows_;
  path[2].dwell_s = path[4].dwell_s = 1;
  path[2].yaw_rad = -2;  // some turn to it first
  path[4].task = WaypointTask{.id = 5};
  const Driven driven = DriveAlong(*dut, path, {}, nullptr, robot());
  ASSERT_TRUE(driven.done);
  EXPECT_TRUE(driven.SegmentsNeverDecrease());
  std::set<std::size_t> dwelt;
  bool after = false;  // a dwell, and not moved on yet
  for (const auto& step : driven.steps) {
    if (step.dwelling) dwelt.insert(step.segment);
    if (after && !step.dwelling) {
      EXPECT_TRUE(step.segment == 2 || step.segment == 4) << step.segment;
    }
    after = step.dwelling;
  }
  EXPECT_EQ(dwelt, (std::set<std::size_t>{1, 3}));
}

TEST_P(TrackerConformance, AWayThatGoesOnFromADwellIsDrivenFromThere) {
  const auto dut = Make();
  Path path = MakePath({{0, 0}, {0.5, 0}, {1, 0}});
  path[1].dwell_s = 2;
  const Driven plain = DriveAlong(*dut, path, {}, nullptr, robot());
  Path longer = path;
  longer.push_back(longer.back());
  longer.back().p_W = {1.5, 0};
  int periods = 0;
  DriveOptions options;
  options.push = [&](double, Pose2& X_WB) {
    if (X_WB.x_m > 0.48 && ++periods == 50) dut->Extend(longer);  // in the dwell
  };
  const Driven driven = DriveAlong(*dut, path, options, nullptr, robot());
  EXPECT_TRUE(driven.done);
  EXPECT_NEAR(driven.steps.back().X_WB.x_m, 1.5, 0.02);
  const auto dwelt = [](const Driven& d) {
    return std::ranges::count_if(d.steps, [](const auto& step) { return step.dwelling; });
  };
  EXPECT_EQ(dwelt(driven), dwelt(plain));
}

TEST_P(TrackerConformance, UpdateAllocatesNothing) {
  const auto dut = Make();
  // Poses to replay, without the test's own vectors.
  const Driven driven = DriveAlong(*dut, rows_, {}, nullptr, robot());
  dut->Start(rows_, robot(), nullptr);
  const auto before = AllocationCount();
  for (const auto& step : driven.steps) dut->Update({step.X_WB, {}}, step.t_s, 0.02);
  EXPECT_EQ(AllocationCount(), before);
}

TEST_P(TrackerConformance, AWayThatGoesOnIsDrivenWithoutAStop) {
  const auto dut = Make();
  bool longer = false;
  DriveOptions options;
  options.push = [&](double, Pose2& X_WB) {
    if (longer || X_WB.x_m < 0.6) return;
    longer = true;
    dut->Extend(MakePath({{0, 0}, {1, 0}, {2, 0}}));
  };
  const Driven driven = DriveAlong(*dut, MakePath({{0, 0}, {1, 0}}), options, nullptr, robot());
  EXPECT_TRUE(driven.done);
  EXPECT_NEAR(driven.steps.back().X_WB.x_m, 2, 0.02);
  for (const auto& step : driven.steps) {
    if (step.X_WB.x_m < 0.6 || step.X_WB.x_m > 1.5) continue;
    EXPECT_GT(step.twist.vx_mps, 0.95 * robot().cruise_mps) << step.X_WB.x_m;
  }
}

// In the middle of a turn on the spot, or on the way to one.
TEST_P(TrackerConformance, AWayThatGoesOnAroundACornerIsKeptTo) {
  if (robot().turn_radius_m > 0) GTEST_SKIP() << "it passes corners wide";
  for (const bool turning : {true, false}) {
    const auto dut = Make();
    bool longer = false;
    DriveOptions options;
    options.push = [&](double, Pose2& X_WB) {
      if (longer || (turning ? X_WB.yaw_rad < 0.5 : X_WB.y_m < 0.6)) return;
      longer = true;
      dut->Extend(MakePath({{1, 0}, {1, 1}, {2, 1}}));
    };
    const Driven driven =
        DriveAlong(*dut, MakePath({{0, 0}, {1, 0}, {1, 1}}), options, nullptr, robot());
    EXPECT_TRUE(longer);
    EXPECT_TRUE(driven.done);
    EXPECT_LT((driven.steps.back().X_WB.p() - Vec2(2, 1)).norm(), 0.02);
    double off_m = 0;
    for (const auto& step : driven.steps) {
      const Vec2 p_W = step.X_WB.p();
      off_m = std::max(off_m, std::min({DistanceToSegment({0, 0}, {1, 0}, p_W),
                                        DistanceToSegment({1, 0}, {1, 1}, p_W),
                                        DistanceToSegment({1, 1}, {2, 1}, p_W)}));
    }
    EXPECT_LT(off_m, 0.03);
  }
}

TEST_P(TrackerConformance, SaysWhichLimitARobotLacks) {
  const auto dut = Make();
  RobotSpec lame = robot();
  lame.max_accel_mps2 = 0;
  EXPECT_THROW(dut->Start(rows_, lame, nullptr), InputError);
}

TEST_P(TrackerConformance, ParametersAreDocumented) {
  const auto dut = Make();
  for (const ParamDoc& doc : DocumentParams(*dut)) EXPECT_FALSE(doc.help.empty()) << doc.name;
}

INSTANTIATE_TEST_SUITE_P(All, TrackerConformance, testing::ValuesIn(AllTracked()),
                         [](const auto& suite) {
                           return std::string(suite.param.tracker.name) + "_" + suite.param.robot;
                         });

TEST(DefaultTracker, CommandsItsDrive) {
  EXPECT_EQ(DefaultTracker("differential"), "regulated_pursuit");
  EXPECT_EQ(DefaultTracker("mecanum"), "holonomic_follower");
  EXPECT_EQ(DefaultTracker("skid_steer"), "regulated_pursuit");
  EXPECT_EQ(DefaultTracker("tricycle"), "steered_pursuit");
  EXPECT_THROW(DefaultTracker("legs"), InputError);
}

// What robots stand on, and what their sensors say while they stand still: a scan of a square room.
struct Standing {
  HazardMap map;
  RobotSpec robot = RoundRobot();
  Observation sensed;
  Truth truth;

  Standing() {
    map.frame = {60, 60, 0.1, {}};
    map.occupancy = Grid<CellState>(60, 60, CellState::kOccupied);
    for (int iy = 5; iy < 55; ++iy)
      for (int ix = 5; ix < 55; ++ix) map.occupancy(ix, iy) = CellState::kFree;
    truth.p_WB = {2, 2.5, 0};
    sensed.wheel_rad.assign(robot.wheels.size(), 0);
    sensed.has_imu = true;
    sensed.scan.fresh = true;
    sensed.scan.height_m = 0.3;
    for (int i = 0; i < 36; ++i) {
      const double a = i * kPi / 18, c = std::cos(a), s = std::sin(a);
      sensed.scan.angle_rad.push_back(a);
      sensed.scan.range_m.push_back(std::min(c >= 0 ? 3.5 / c : -1.5 / c, s >= 0 ? 3 / s : -2 / s));
    }
  }
  EstimatorContext Context(std::uint64_t seed = 1) {
    return {map, robot, truth.X_WB(), Stream(seed, 0, "estimator")};
  }
};

class EstimatorConformance : public testing::TestWithParam<PluginEntry<Estimator>> {};

TEST_P(EstimatorConformance, StartForgetsTheEpisodeBefore) {
  const auto dut = GetParam().make();
  Standing at;
  const auto last = [&] {
    dut->Start(at.Context());
    Estimate estimate;
    for (int i = 0; i < 20; ++i) {
      at.sensed.wheel_rad.assign(at.robot.wheels.size(), 0.05);
      estimate = dut->Update(at.sensed, 0.02);
    }
    return estimate.X_WB;
  };
  const Pose2 once = last(), again = last();
  EXPECT_EQ(once.x_m, again.x_m);
  EXPECT_EQ(once.y_m, again.y_m);
  EXPECT_EQ(once.yaw_rad, again.yaw_rad);
}

TEST_P(EstimatorConformance, UpdateAllocatesNothing) {
  const auto dut = GetParam().make();
  Standing at;
  dut->Start(at.Context());
  at.sensed.wheel_rad.assign(at.robot.wheels.size(), 0.05);
  dut->Update(at.sensed, 0.02);  // the first scan tells how high the lidar is
  const auto before = AllocationCount();
  for (int i = 0; i < 50; ++i) dut->Update(at.sensed, 0.02);
  EXPECT_EQ(AllocationCount(), before);
}

TEST_P(EstimatorConformance, StandingStillItStaysWhereItIs) {
  const auto dut = GetParam().make();
  Standing at;
  dut->Start(at.Context());
  Estimate estimate;
  for (int i = 0; i < 100; ++i) estimate = dut->Update(at.sensed, 0.02);
  EXPECT_LT((estimate.X_WB.p() - at.truth.X_WB().p()).norm(), 0.1);
  EXPECT_LT(std::abs(estimate.X_WB.yaw_rad), 0.1);
  EXPECT_LT(estimate.position_std_m, 0.3);
  EXPECT_EQ(estimate.V_WB_B.vx_mps, 0);
}

TEST_P(EstimatorConformance, ParametersAreDocumented) {
  const auto dut = GetParam().make();
  for (const ParamDoc& doc : DocumentParams(*dut)) EXPECT_FALSE(doc.help.empty()) << doc.name;
}

INSTANTIATE_TEST_SUITE_P(All, EstimatorConformance, testing::ValuesIn(Estimators()),
                         [](const auto& suite) { return std::string(suite.param.name); });

TEST(TruthEstimator, IsTheTruth) {
  const auto dut = MakePlugin(Estimators(), "truth", "estimator");
  Standing at;
  dut->Start(at.Context());
  Observation sensed;
  sensed.truth = TruePose{{1, -2, 0.4}, {0.1, 0.02, -0.5}, {}};
  const Estimate estimate = dut->Update(sensed, 0.02);
  EXPECT_EQ(estimate.X_WB.x_m, 1);
  EXPECT_EQ(estimate.X_WB.y_m, -2);
  EXPECT_EQ(estimate.X_WB.yaw_rad, 0.4);
  EXPECT_EQ(estimate.V_WB_B.wz_radps, -0.5);
  EXPECT_EQ(dut->Update({}, 0.02).X_WB.x_m, 1) << "what it knew last, where the sensor is silent";
}

TEST(OdometryEstimator, BelievesItsWheels) {
  const auto dut = MakePlugin(Estimators(), "odometry", "estimator");
  Standing at;
  ReadParams(ParseYaml("{start_error_x_m: 0.1, start_error_yaw_deg: 90}", "params"), "", *dut);
  dut->Start(at.Context());
  at.sensed.wheel_rad.assign(at.robot.wheels.size(), 0.1);
  Estimate estimate;
  for (int i = 0; i < 50; ++i) estimate = dut->Update(at.sensed, 0.02);
  const double way_m = 50 * 0.1 * at.robot.wheels[0].radius_m;
  EXPECT_NEAR(estimate.X_WB.x_m, 2.1, 1e-9) << "a heading wrong by 90 deg, and x by 0.1";
  EXPECT_NEAR(estimate.X_WB.y_m, 2.5 + way_m, 1e-9);
  EXPECT_NEAR(estimate.V_WB_B.vx_mps, 0.1 * at.robot.wheels[0].radius_m / 0.02, 1e-9);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// When a planner of unknown floors is asked, and what it is told.
#include "run/episode/online_navigator.h"

#include <gmock/gmock.h>

namespace floorproof {
namespace {

using Kind = OnlineStep::Kind;
using ::testing::ElementsAre;

// Says what it was told to say, and keeps what it was told.
class ScriptedPlanner final : public OnlinePlanner {
 public:
  struct Asked {
    Vec2 p_W;
    std::size_t changed;
    bool bumped, dropped, missed, stopped;
  };
  void Visit(ParamVisitor&) override {}
  const OnlineParams& params() const override { return params_; }
  void Start(const OnlineTask& task) override { tasks.push_back(task); }
  OnlineStep Next(const OnlineInput& input) override {
    asked.push_back({input.estimate.X_WB.p(), input.changed.size(), input.bumped, input.dropped,
                     input.missed, input.stopped});
    if (asked.size() > says.size()) return {Kind::kDone, {}, "all is done"};
    return says[asked.size() - 1];
  }

  OnlineParams params_;
  std::vector<OnlineStep> says;
  std::vector<OnlineTask> tasks;
  std::vector<Asked> asked;
};

class OnlineNavigatorTest : public ::testing::Test {
 protected:
  OnlineNavigatorTest() : known_({20, 20, 0.5, {}}) { known_.changed.emplace(); }

  // A period: where the robot is, on which segment.
  PathChange At(const Vec2& p_W, std::size_t segment = 0, bool at_end = false) {
    return Update({p_W.x(), p_W.y(), 0}, segment, at_end, false, false);
  }
  PathChange Recovered(const Vec2& p_W, std::size_t segment, bool drop) {
    return Update({p_W.x(), p_W.y(), 0}, segment, false, true, drop);
  }
  PathChange Update(const Pose2& X_WB, std::size_t segment, bool at_end, bool recovered,
                    bool drop) {
    Estimate estimate;
    estimate.X_WB = X_WB;
    estimate.V_WB_B.vx_mps = speed_mps_;
    t_s_ += 0.02;
    const PathChange change =
        dut_.Update({t_s_, estimate, &known_, segment, at_end, recovered, drop});
    known_.changed->clear();
    return change;
  }
  // Past the look around.
  void Begin() {
    while (planner_.asked.empty()) At({0, 0}, 0, true);
  }
  std::vector<Vec2> Path() const {
    std::vector<Vec2> path;
    for (const Waypoint& w : dut_.path()) path.push_back(w.p_W);
    return path;
  }

  ScriptedPlanner planner_;
  static Extent Disc(double radius_m) { return {Vec2::Constant(radius_m), true}; }
  OnlineNavigator dut_{planner_, {Disc(0.18), Disc(0.2), Disc(0.15), 0.3, 0.4, 0.5}, {0, 0}, 7};
  void See(const Vec2& p_W) {
    const Cell c = known_.frame.ToCell(p_W);
    known_.Add(c.ix, c.iy, 8, 4);
  }
  KnownMap known_;
  double t_s_ = 0, speed_mps_ = 0;
};

TEST_F(OnlineNavigatorTest, LooksAroundBeforeItAsks) {
  planner_.says = {{Kind::kTarget, {1, 0}}};
  for (int i = 0; i < 40; ++i) {
    known_.Add(i % 20, 3 + i / 20, -4, 4);
    EXPECT_EQ(At({0, 0}, 0, true), PathChange::kNone);
  }
  EXPECT_EQ(dut_.leads(), Navigator::Leads::kOn);
  Begin();
  EXPECT_NEAR(t_s_, 1.02, 0.021);
  ASSERT_EQ(planner_.tasks.size(), 1u);
  EXPECT_EQ(planner_.tasks[0].seed, 7u);
  EXPECT_EQ(planner_.tasks[0].tool_width_m, 0.3);
  EXPECT_EQ(planner_.asked[0].changed, 40u);
  EXPECT_THAT(Path(), ElementsAre(Vec2(0, 0), Vec2(1, 0)));
  EXPECT_EQ(dut_.path()[1].yaw_rad, 0.5);
}

TEST_F(OnlineNavigatorTest, AsksShortlyBeforeTheTargetWithItAsThePlace) {
  planner_.says = {{Kind::kTarget, {1, 0}}, {Kind::kTarget, {1, 1}}, {Kind::kTarget, {0, 1}}};
  Begin();
  EXPECT_EQ(At({0.4, 0}), PathChange::kNone);
  known_.Add(3, 3, -4, 4);
  EXPECT_EQ(At({0.45, 0}), PathChange::kNone);
  EXPECT_EQ(At({0.6, 0}), PathChange::kLonger);
  ASSERT_EQ(planner_.asked.size(), 2u);
  EXPECT_EQ(planner_.asked[1].p_W, Vec2(1, 0));
  EXPECT_EQ(planner_.asked[1].changed, 1u);
  EXPECT_FALSE(planner_.asked[1].bumped || planner_.asked[1].dropped || planner_.asked[1].missed);
  EXPECT_THAT(Path(), ElementsAre(Vec2(0, 0), Vec2(1, 0), Vec2(1, 1)));
  // One target ahead, no more.
  EXPECT_EQ(At({0.9, 0}), PathChange::kNone);
  EXPECT_EQ(At({1, 0.2}, 1), PathChange::kNone);
  EXPECT_EQ(At({1, 0.6}, 1), PathChange::kLonger);
  EXPECT_THAT(Path(), ElementsAre(Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)));
  EXPECT_EQ(dut_.plan().size(), 4u);
}

TEST_F(OnlineNavigatorTest, AfterAReactionItAsksFromWhereTheRobotIs) {
  planner_.says = {{Kind::kTarget, {1, 0}},
                   {Kind::kTarget, {1, 1}},
                   {Kind::kTarget, {0, 0.5}},
                   {Kind::kTarget, {-1, 0.5}}};
  Begin();
  At({0.6, 0});
  EXPECT_EQ(Recovered({0.5, 0}, 0, false), PathChange::kAnew);
  ASSERT_EQ(planner_.asked.size(), 3u);
  EXPECT_EQ(planner_.asked[2].p_W, Vec2(0.5, 0));
  EXPECT_TRUE(planner_.asked[2].bumped && !planner_.asked[2].dropped);
  EXPECT_TRUE(planner_.asked[2].missed) << "it was asked with (1, 0) as the robot's place";
  EXPECT_FALSE(planner_.asked[2].stopped);
  EXPECT_THAT(Path(), ElementsAre(Vec2(0.5, 0), Vec2(0, 0.5)));

  At({0.2, 0.3});
  EXPECT_EQ(planner_.asked[3].p_W, Vec2(0, 0.5));
  EXPECT_EQ(Recovered({-0.3, 0.5}, 1, true), PathChange::kAnew);
  EXPECT_TRUE(planner_.asked[4].dropped && !planner_.asked[4].bumped);
  EXPECT_FALSE(planner_.asked[4].missed) << "(0, 0.5) was reached";
}

// Cells of 0.1 m: what is seen across the way to (1.5, 1).
class OnlineNavigatorSeesTest : public OnlineNavigatorTest {
 protected:
  OnlineNavigatorSeesTest() {
    known_ = KnownMap({30, 30, 0.1, {}});
    known_.changed.emplace();
    planner_.says.assign(9, {Kind::kTarget, {1.5, 1}});
    while (planner_.asked.empty()) At({0.5, 1}, 0, true);
  }
};

TEST_F(OnlineNavigatorSeesTest, WhatComesIntoSightAcrossTheWayStopsTheRobot) {
  speed_mps_ = 0.25;
  planner_.says[1] = {Kind::kTarget, {0.7, 2}};
  See({1.25, 1.15});
  EXPECT_EQ(At({0.6, 1}), PathChange::kLonger);
  ASSERT_EQ(planner_.asked.size(), 2u);
  EXPECT_TRUE(planner_.asked[1].stopped && !planner_.asked[1].missed);
  // 0.25 m/s: 0.0375 m until it brakes, and 0.25^2 / (2 * 0.4) m.
  EXPECT_NEAR((planner_.asked[1].p_W - Vec2(0.716, 1)).norm(), 0, 1e-3);
  EXPECT_THAT(Path(), ElementsAre(Vec2(0.5, 1), planner_.asked[1].p_W, Vec2(0.7, 2)));
  EXPECT_TRUE(dut_.path()[1].stops);
  EXPECT_EQ(dut_.plan().size(), 3u) << "what was not reached is no part of what was driven";
  // A robot that stands goes on from where it is.
  speed_mps_ = 0;
  See({0.75, 1.65});
  EXPECT_EQ(At({0.7, 1.1}, 1), PathChange::kAnew);
  EXPECT_EQ(Path().front(), Vec2(0.7, 1.1));
  EXPECT_TRUE(planner_.asked.back().stopped);
}

TEST_F(OnlineNavigatorSeesTest, StoppedShortOfThePlaceThatWasAskedForItWasMissed) {
  speed_mps_ = 0.25;
  planner_.says[1] = {Kind::kTarget, {2.5, 1}};
  EXPECT_EQ(At({1.1, 1}), PathChange::kLonger);
  See({1.45, 1.05});
  planner_.says[2] = {Kind::kTarget, {0.6, 1}};
  EXPECT_EQ(At({1.12, 1}), PathChange::kLonger);
  ASSERT_EQ(planner_.asked.size(), 3u);
  EXPECT_TRUE(planner_.asked[2].stopped && planner_.asked[2].missed);
  ASSERT_EQ(dut_.plan().size(), 3u);
  EXPECT_NEAR(dut_.plan()[1].p_W.x(), 1.236, 1e-3);
}

TEST_F(OnlineNavigatorSeesTest, WhereTheLegIsTooShortItStopsOnTheNext) {
  speed_mps_ = 0.25;
  planner_.says[1] = {Kind::kTarget, {1.5, 2.5}};
  EXPECT_EQ(At({1.1, 1}), PathChange::kLonger);
  See({1.55, 2.05});
  EXPECT_EQ(At({1.45, 1}), PathChange::kLonger);
  EXPECT_TRUE(planner_.asked[2].stopped && !planner_.asked[2].missed) << "(1.5, 1) is passed";
  EXPECT_NEAR((planner_.asked[2].p_W - Vec2(1.5, 1.066)).norm(), 0, 1e-3);
}

TEST_F(OnlineNavigatorSeesTest, OnItsLastWayToo) {
  speed_mps_ = 0.25;
  planner_.says.resize(1);
  EXPECT_EQ(At({1.1, 1}), PathChange::kNone);
  EXPECT_EQ(dut_.leads(), Navigator::Leads::kToEnd);
  planner_.says.assign(9, {Kind::kTarget, {0.5, 1}});
  See({1.45, 1.05});
  EXPECT_EQ(At({1.12, 1}), PathChange::kLonger);
  EXPECT_EQ(dut_.leads(), Navigator::Leads::kOn);
}

TEST_F(OnlineNavigatorSeesTest, WhatLiesBesideTheWayOrBehindDoesNot) {
  speed_mps_ = 0.25;
  See({1.25, 1.35});  // 0.3 m beside; the body reaches 0.18 m
  See({0.25, 1.05});
  EXPECT_EQ(At({0.6, 1}), PathChange::kNone);
  See({0.65, 1.05});  // where it is: it cannot keep off
  EXPECT_EQ(At({0.6, 1}), PathChange::kNone);
  EXPECT_EQ(planner_.asked.size(), 1u);
}

// 0.23 m from the way, its corner 0.16 m: the body reaches 0.18 m.
TEST_F(OnlineNavigatorSeesTest, TheCornerOfACellIsMetToo) {
  speed_mps_ = 0.25;
  planner_.says[1] = {Kind::kTarget, {2.5, 2.05}};
  EXPECT_EQ(At({1.1, 1}), PathChange::kLonger);
  See({2.15, 1.35});
  EXPECT_EQ(At({1.15, 1}), PathChange::kLonger);
  ASSERT_EQ(planner_.asked.size(), 3u);
  EXPECT_TRUE(planner_.asked[2].stopped);
}

// Trackers cut bends. The path keeps clear of what is beside it; the robot has come off the path.
TEST_F(OnlineNavigatorSeesTest, ARobotThatComesOffItsWayStopsBeforeWhatIsBesideIt) {
  See({0.95, 1.25});  // 0.2 m from the path
  for (const double aside_m : {0.0, 0.01, 0.03}) {
    speed_mps_ = 0;
    EXPECT_EQ(At({0.7, 1 + aside_m}), PathChange::kNone) << "it stands";
    speed_mps_ = 0.25;
    EXPECT_EQ(At({0.55, 1 + aside_m}), PathChange::kNone) << "it can still turn away";
    EXPECT_EQ(planner_.asked.size(), 1u);
    EXPECT_EQ(At({0.74, 1 + aside_m}), aside_m > 0.02 ? PathChange::kLonger : PathChange::kNone);
  }
  ASSERT_EQ(planner_.asked.size(), 2u);
  EXPECT_TRUE(planner_.asked[1].stopped);
  EXPECT_NEAR(planner_.asked[1].p_W.x(), 0.856, 1e-3);
}

TEST_F(OnlineNavigatorSeesTest, ABendBesideSomethingIsAStop) {
  planner_.says[1] = {Kind::kTarget, {2.2, 1.7}};
  EXPECT_EQ(At({1.1, 1}), PathChange::kLonger);
  ASSERT_EQ(dut_.path().size(), 3u);
  EXPECT_FALSE(dut_.path()[1].stops) << "there is room to cut it";
  EXPECT_EQ(At({1.2, 1}), PathChange::kNone);
  See({1.65, 0.75});
  EXPECT_EQ(At({1.2, 1}), PathChange::kLonger) << "it came into sight later";
  EXPECT_TRUE(dut_.path()[1].stops);
  EXPECT_EQ(planner_.asked.size(), 2u);
}

TEST_F(OnlineNavigatorTest, TheDriveEndsWithTheLastPath) {
  planner_.says = {{Kind::kTarget, {1, 0}}};
  Begin();
  EXPECT_EQ(dut_.leads(), Navigator::Leads::kOn);
  EXPECT_EQ(At({0.8, 0}), PathChange::kNone);
  EXPECT_EQ(dut_.leads(), Navigator::Leads::kToEnd);
  EXPECT_EQ(dut_.why(), "all is done");
  At({0.9, 0});
  At({1, 0}, 0, true);
  EXPECT_EQ(planner_.asked.size(), 2u) << "it is not asked again";
}

TEST_F(OnlineNavigatorTest, NowhereToGoIsSaid) {
  planner_.says = {{Kind::kNowhere, {}, "there is no floor"}};
  Begin();
  EXPECT_EQ(dut_.leads(), Navigator::Leads::kNowhere);
  EXPECT_EQ(dut_.why(), "there is no floor");
}

TEST_F(OnlineNavigatorTest, APlannerThatStaysWhereItIsDoesNotKeepTheRobotForEver) {
  planner_.says.assign(1000, {Kind::kTarget, {0, 0}});
  Begin();
  for (int i = 0; i < 200; ++i) At({0, 0}, 0, true);
  EXPECT_EQ(dut_.leads(), Navigator::Leads::kNowhere);
  EXPECT_EQ(planner_.asked.size(), 100u);
}

TEST_F(OnlineNavigatorTest, SetDownAtTheNextTargetItGoesOnFromThere) {
  planner_.says = {{Kind::kTarget, {1, 0}}, {Kind::kTarget, {1, 1}}, {Kind::kTarget, {0, 1}}};
  Begin();
  At({0.6, 0});
  dut_.GoOnFrom(1);
  EXPECT_THAT(Path(), ElementsAre(Vec2(1, 0), Vec2(1, 1)));
  EXPECT_EQ(Recovered({1, 0.1}, 0, false), PathChange::kAnew);
  EXPECT_FALSE(planner_.asked.back().missed);
}

}  // namespace
}  // namespace floorproof

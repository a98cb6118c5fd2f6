// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/failures/synthetic.h"

namespace floorproof {
namespace {

std::vector<Event> Events(const Trace& trace, const std::string& yaml = "") {
  return Judge(*MakeDetector("roll_over", yaml), trace);
}

Trace Changed(const std::function<void(Sample&)>& change, double duration_s) {
  return With(Drive({{8, {0.2, 0, 0}}}), change, 2, 2 + duration_s);
}

Trace Tilted(double tilt_rad, double duration_s) {
  return Changed([=](Sample& s) { s.tilt_rad = tilt_rad; }, duration_s);
}

Trace Dropped(double drop_m, int hazard = -1) {
  return Changed(
      [=](Sample& s) {
        s.drop_m = drop_m;
        s.drop_W = s.p_WB.head<2>();
        s.drop_hazard = hazard;
      },
      0.2);
}

constexpr double kLimit_rad = 70 * kPi / 180;

// The robot's static tip angle is 0.6 rad: it may rear up by more and come back, or rest on its
// belly's edge.
TEST(RollOver, TiltCountsBeyondItsLimitWhereverItWouldTip) {
  EXPECT_TRUE(Events(Tilted(kLimit_rad - 0.001, 1)).empty());
  EXPECT_EQ(Events(Tilted(kLimit_rad + 0.001, 1)).size(), 1u);
  EXPECT_TRUE(Events(Tilted(0.34, 1), "{tilt_limit_deg: 20}").empty());
  EXPECT_EQ(Events(Tilted(0.36, 1), "{tilt_limit_deg: 20}").size(), 1u);
}

TEST(RollOver, TiltMustLast) {
  EXPECT_TRUE(Events(Tilted(1.3, 0.096)).empty());
  const auto events = Events(Tilted(1.3, 1));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_NEAR(events[0].t_s, 2.1, 1.5 * kStepS);
  EXPECT_EQ(events[0].kind, "");
  EXPECT_EQ(events[0].effect, "E5");
}

// The centre of mass ahead of the support by -margin_m; the body leans forward by lean_rad.
std::function<void(Sample&)> Outside(double margin_m, double lean_rad, int contacts = 2) {
  return [=](Sample& s) {
    s.support_margin_m = margin_m;
    s.off_support_W = {1, 0};
    s.pitch_rad = lean_rad;
    s.wheel_contacts = contacts;
  };
}

TEST(RollOver, TippedWhenTheMassLeavesTheSupport) {
  EXPECT_TRUE(Events(Changed(Outside(0.001, 0.1), 2)).empty());
  EXPECT_TRUE(Events(Changed(Outside(-0.02, 0.1), 0.49)).empty());
  const auto events = Events(Changed(Outside(-0.02, 0.1), 2));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "tipped");
  EXPECT_LT(events[0].value, events[0].threshold);
  EXPECT_NEAR(events[0].t_s, 2.5, 1.5 * kStepS);
  EXPECT_TRUE(Events(Changed(Outside(-0.02, 0.1, 0), 2)).empty()) << "in the air";
}

// The robot's support at rest is 0.08 m * tan 0.6.
TEST(RollOver, AShallowWayOutsideIsNone) {
  const double deep_m = 0.1 * 0.08 * std::tan(0.6);
  EXPECT_TRUE(Events(Changed(Outside(-0.99 * deep_m, 0.1), 2)).empty());
  EXPECT_EQ(Events(Changed(Outside(-1.01 * deep_m, 0.1), 2)).size(), 1u);
  EXPECT_EQ(Events(Changed(Outside(-1.01 * deep_m, 0.1), 2), "{tipped_share: 0.2}").size(), 0u);
  // On two points, exactly above the line between them but for noise.
  EXPECT_TRUE(Events(Changed(Outside(-3.4e-9, 0.085), 2), "{tipped_share: 0}").empty());
}

// Over a bump: nose up, its mass ahead of the wheels, it comes down to level; or it leans out and
// swings back.
TEST(RollOver, ComingBackToLevelIsNoTip) {
  EXPECT_TRUE(Events(Changed(Outside(-0.02, -0.1), 2)).empty());
  const auto swinging = [](Sample& s) { Outside(-0.02, 0.1 - 0.05 * (s.t_s - 2))(s); };
  EXPECT_TRUE(Events(Changed(swinging, 1.5)).empty());
  const auto growing = [](Sample& s) { Outside(-0.02, 0.1 + 0.05 * (s.t_s - 2))(s); };
  EXPECT_EQ(Events(Changed(growing, 1.5)).size(), 1u);
}

TEST(RollOver, FellWhenAWheelDrops) {
  EXPECT_TRUE(Events(Dropped(0.029)).empty());
  const auto events = Events(Dropped(0.031));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "fell");
  EXPECT_DOUBLE_EQ(events[0].value, 0.031);
  EXPECT_DOUBLE_EQ(events[0].threshold, 0.030);
  EXPECT_TRUE(Events(Dropped(0.031), "{fall_m: 0.05}").empty());
}

// A robot comes down from what it climbs.
TEST(RollOver, ADropByTheRobotsOwnStepIsNoFall) {
  const HazardMap map = TestMap();
  RobotSpec robot = TestRobot();
  const auto events = [&](double drop_m) {
    const auto dut = MakeDetector("roll_over");
    dut->Start({map, robot, kStepS});
    int n = 0;
    for (const Sample& s : Dropped(drop_m)) n += dut->Update(s) ? 1 : 0;
    return n;
  };
  EXPECT_EQ(events(0.045), 1);
  robot.step_m = 0.05;
  EXPECT_EQ(events(0.045), 0);
  EXPECT_EQ(events(0.051), 1);
}

TEST(RollOver, AHardLandingIsAFall) {
  const auto landed = [](double v_mps) {
    return Events(Changed([=](Sample& s) { s.landing_mps = v_mps; }, kStepS));
  };
  EXPECT_TRUE(landed(1.40).empty());
  const auto events = landed(1.43);  // 1.02 J/kg
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "landed");
  EXPECT_NEAR(events[0].value, 1.02, 0.01);
}

// Where it stood, or the gap into which it went.
TEST(RollOver, NamesWhatItFellFrom) {
  EXPECT_EQ(Events(Dropped(0.1, kStepHazard)).at(0).hazard, "sill");
  EXPECT_EQ(Events(Dropped(0.1)).at(0).hazard, "");
  HazardMap map;
  Hazard pit;
  pit.id = "pit";
  pit.height_m = -0.15;
  pit.footprint = {Rectangle({0, -5}, {5, 5})};
  map.hazards = {pit};
  const RobotSpec robot = TestRobot();
  const auto dut = MakeDetector("roll_over");
  dut->Start({map, robot, kStepS});
  std::string hazard = "?";
  for (const Sample& s : Dropped(0.1))
    if (dut->Update(s)) hazard = dut->event().hazard;
  EXPECT_EQ(hazard, "pit");
}

// A robot that starts at x < 1; the base floor is one of the two levels, or none of them.
//
//   ____________
//   start       |__________  lower by drop_m
//        x < 1     x > 1
HazardMap TwoLevels(double start_m, double drop_m) {
  HazardMap map;
  const auto add = [&map](const char* id, double height_m, const Polygon& where) {
    if (height_m == 0) return;
    Hazard level;
    level.id = id;
    level.hazard_class = HazardClass::kLevelChange;
    level.height_m = height_m;
    level.footprint = {where};
    level.solids = {{height_m < 0 ? Solid::Kind::kCut : Solid::Kind::kPrism,
                     where,
                     {},
                     std::min(height_m, 0.0),
                     std::max(height_m, 0.0)}};
    map.hazards.push_back(level);
  };
  add("start", start_m, Rectangle({-5, -5}, {1, 5}));
  add("lower", start_m - drop_m, Rectangle({1, -5}, {9, 5}));
  return map;
}

// It leans forward on its rear wheels: the level that carries them did not tip it, but would have
// by its edge, or if the robot had not been set down on it.
TEST(RollOver, ALevelIsToBlameWhereItIsNotTheFloorOfTheStart) {
  const auto judge = [](double start_x_m, double aside_n) {
    const HazardMap map = TwoLevels(0.1, 0.1);
    const RobotSpec robot = TestRobot();
    const auto dut = MakeDetector("roll_over");
    dut->Start({map, robot, kStepS});
    std::string hazard = "?";
    for (Sample& s : Trace(Drive({{2, {0, 0, 0}}}))) {
      s.p_WB.x() = start_x_m;
      s.p_WB.z() = s.wheel_floor_z_m = 0.1;
      s.tilt_rad = 1.3;
      s.pitch_rad = 0.7;
      const Vec3 push_W_n(aside_n, 0, 98);
      PushedBy(s, 0, push_W_n);
      s.touches[0].normal.moment_W_nm = Vec3(-0.1, 0, 0).cross(push_W_n);
      if (dut->Update(s)) hazard = dut->event().hazard;
    }
    return hazard;
  };
  EXPECT_EQ(judge(0, 0), "");
  EXPECT_EQ(judge(0, 20), "start");
  EXPECT_EQ(judge(2, 0), "start") << "it came from the base floor";
}

TEST(RollOver, OneEventForOneFallAndAnotherForTheNext) {
  Trace trace = Tilted(1.3, 1);
  for (const double t_s : {2.5, 3.3})  // one wheel after the other
    trace = With(
        trace, [](Sample& s) { s.drop_m = 0.2; }, t_s, t_s + 0.1);
  EXPECT_EQ(Events(trace).size(), 1u);
  EXPECT_EQ(Events(With(
                       trace, [](Sample& s) { s.tilt_rad = 1.3; }, 5, 6))
                .size(),
            2u);
}

// Nose down on a sill that lifts its rear: behind the centre of mass an upward push tilts it on,
// before it an upward push holds it.
TEST(RollOver, NamesWhatTiltsIt) {
  const auto judge = [](double sill_x_m, double door_x_m) {
    const auto push = [](Sample& s, int hazard, double x_m) {
      PushedBy(s, hazard, {0, 0, 50});
      s.touches[static_cast<std::size_t>(s.num_touches - 1)].normal.moment_W_nm =
          Vec3(x_m, 0, 0).cross(Vec3(0, 0, 50));
    };
    const auto events = Events(Changed(
        [&](Sample& s) {
          s.tilt_rad = 1.3;
          s.pitch_rad = 0.7;
          push(s, kStepHazard, sill_x_m);
          push(s, kGlassHazard, door_x_m);
        },
        1));
    EXPECT_EQ(events.size(), 1u);
    return events.empty() ? "?" : events[0].hazard;
  };
  EXPECT_EQ(judge(-0.1, 0.3), "sill");
  EXPECT_EQ(judge(-0.1, -0.05), "sill");
  EXPECT_EQ(judge(0.3, -0.1), "door");
}

// A mat lies under its rear wheels, and it leans over the edge of a pit.
TEST(RollOver, NamesTheGapThatItHasGoneInto) {
  HazardMap map;
  for (const double height_m : {0.001, -0.15}) {
    Hazard hazard;
    hazard.id = height_m > 0 ? "mat" : "pit";
    hazard.height_m = height_m;
    hazard.footprint = {height_m > 0 ? Rectangle({-5, -5}, {0.1, 5})
                                     : Rectangle({0.1, -5}, {5, 5})};
    map.hazards.push_back(hazard);
  }
  const RobotSpec robot = TestRobot();
  const auto judge = [&](double pitch_rad) {
    const auto dut = MakeDetector("roll_over");
    dut->Start({map, robot, kStepS});
    for (Sample s : Drive({{2, {0, 0, 0}}})) {
      s.tilt_rad = 1.3;
      s.pitch_rad = pitch_rad;
      PushedBy(s, 0, {0, 0, 98});
      s.touches[0].normal.moment_W_nm = Vec3(-0.1, 0, 0).cross(Vec3(0, 0, 98));
      if (dut->Update(s)) return dut->event().hazard;
    }
    return std::string("?");
  };
  EXPECT_EQ(judge(0.7), "pit");
  EXPECT_EQ(judge(-0.7), "") << "it fell the other way, where there is no gap";
}

TEST(RollOver, AWheelThatLiftsForAMomentCostsNoMargin) {
  const auto dut = MakeDetector("roll_over");
  Judge(*dut, With(Drive({{8, {0.2, 0, 0}}}), Outside(-0.1, 0.1), 2, 2.02));
  EXPECT_DOUBLE_EQ(dut->margin(), kLimit_rad);
  Judge(*dut, With(Drive({{8, {0.2, 0, 0}}}), Outside(-0.1, 0.1), 2, 4));
  EXPECT_LT(dut->margin(), 0);
  const auto lean = [](Sample& s) { s.support_margin_m = 0.02; };  // of 0.05 m at rest
  Judge(*dut, With(Drive({{8, {0.2, 0, 0}}}), lean, 2, 6));
  const double deep_m = 0.1 * 0.08 * std::tan(0.6);
  EXPECT_NEAR(dut->margin(), (0.02 + deep_m) / (0.05 + deep_m) * kLimit_rad, 1e-9);
}

TEST(RollOver, MarginIsTheTiltStillLeft) {
  const auto dut = MakeDetector("roll_over");
  Judge(*dut, Tilted(0.25, 1));
  EXPECT_DOUBLE_EQ(dut->margin(), kLimit_rad - 0.25);
  Judge(*dut, Tilted(1.3, 0.05));
  EXPECT_EQ(dut->margin(), 0);
  Judge(*dut, Tilted(1.3, 1));
  EXPECT_NEAR(dut->margin(), kLimit_rad - 1.3, 1e-12);
  Judge(*dut, Dropped(0.015));  // half of what makes a fall
  EXPECT_NEAR(dut->margin(), kLimit_rad / 2, 1e-12);
}

}  // namespace
}  // namespace floorproof

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

Trace Sunk(double z_m) {
  return Changed([=](Sample& s) { s.wheel_floor_z_m = s.p_WB.z() = z_m; }, 1);
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

TEST(RollOver, FellWhenTheWheelsSinkBelowThePlansFloor) {
  EXPECT_TRUE(Events(Sunk(-0.029)).empty());
  const auto events = Events(Sunk(-0.031));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "fell");
  EXPECT_LT(events[0].value, events[0].threshold);
  EXPECT_EQ(Events(Sunk(-0.031), "{fall_m: 0.05}").size(), 0u);
}

TEST(RollOver, AKnownLowFloorThatIsDrivenOverIsThePlans) {
  //      0 ______            ______
  //              |__________|        -12 mm, driven over
  std::string hazard;
  bool starts_in_it = false;
  const auto judge = [&](double height_m, bool known, double wheel_z_m) {
    HazardMap map;
    Hazard pit;
    pit.id = "pit";
    pit.hazard_class = HazardClass::kLevelChange;
    pit.known = known;
    pit.height_m = height_m;
    pit.footprint = {Rectangle({-5, -5}, {5, 5})};
    map.hazards = {pit};
    const RobotSpec robot = TestRobot();
    const auto dut = MakeDetector("roll_over");
    dut->Start({map, robot, kStepS});
    int events = 0;
    Trace trace = Sunk(wheel_z_m);
    if (starts_in_it) {
      for (Sample& s : trace)
        if (s.wheel_floor_z_m == 0) s.wheel_floor_z_m = height_m;
    } else {
      trace.front().p_WB.x() -= 20;
      trace.front().wheel_floor_z_m = 0;
    }
    for (const Sample& s : trace) {
      if (!dut->Update(s)) continue;
      ++events;
      hazard = dut->event().hazard;
    }
    return events;
  };
  EXPECT_EQ(judge(-0.012, true, -0.040), 0);
  EXPECT_EQ(judge(-0.012, true, -0.043), 1);
  EXPECT_EQ(judge(-0.012, false, -0.040), 1) << "the plan did not know of it";
  EXPECT_EQ(judge(-0.150, true, -0.150), 1) << "the plan keeps off a drop beyond step_m";
  EXPECT_EQ(hazard, "pit") << "it lies below, though nothing touches it";
  EXPECT_EQ(judge(0.012, true, -0.017), 0) << "a raised floor all around";
  EXPECT_EQ(judge(0.012, true, -0.019), 1);
  starts_in_it = true;
  for (const bool known : {false, true}) {
    EXPECT_EQ(judge(-0.150, known, -0.150), 0) << "it was set down there";
    EXPECT_EQ(judge(-0.150, known, -0.190), 1) << "and fell deeper";
    EXPECT_EQ(judge(0.150, known, 0.150), 0);
    EXPECT_EQ(judge(0.150, known, 0.110), 1) << "the raised floor is its floor";
  }
}

// A robot that starts at x < 1 and goes over an edge at x = 1. The base floor is one of the two
// levels, or none of them.
//
//   ____________
//   start       |__________  lower by drop_m
//        x < 1     x > 1
struct Edge {
  double start_m = 0, drop_m = 0;
  bool known = false;
  bool whole_platform = false;  // the level of the start lies below the other one as well
};

HazardMap TwoLevels(const Edge& edge) {
  HazardMap map;
  const auto add = [&map](const char* id, double height_m, const Polygon& where, bool known) {
    if (height_m == 0) return;
    Hazard level;
    level.id = id;
    level.hazard_class = HazardClass::kLevelChange;
    level.known = known;
    level.height_m = height_m;
    level.footprint = {where};
    level.solids = {{height_m < 0 ? Solid::Kind::kCut : Solid::Kind::kPrism,
                     where,
                     {},
                     std::min(height_m, 0.0),
                     std::max(height_m, 0.0)}};
    map.hazards.push_back(level);
  };
  add("start", edge.start_m, Rectangle({-5, -5}, {edge.whole_platform ? 9.0 : 1.0, 5}), true);
  add("lower", edge.start_m - edge.drop_m, Rectangle({1, -5}, {9, 5}), edge.known);
  return map;
}

std::vector<Event> GoesOver(const Edge& edge) {
  const HazardMap map = TwoLevels(edge);
  const RobotSpec robot = TestRobot();
  const auto dut = MakeDetector("roll_over");
  dut->Start({map, robot, kStepS});
  std::vector<Event> events;
  for (Sample& s : Trace(Drive({{10, {0.2, 0, 0}}}))) {
    const bool over = s.p_WB.x() > 1;
    s.p_WB.z() = s.wheel_floor_z_m = edge.start_m - (over ? edge.drop_m : 0);
    if (dut->Update(s)) events.push_back(dut->event());
  }
  return events;
}

TEST(RollOver, AFallIsTheSameFromWhateverFloorItStarts) {
  for (const double start_m : {0.0, 0.1, 0.05, 0.2, -0.1, -0.05})
    for (const bool known : {false, true}) {
      const double drop_m = 0.1;
      const auto events = GoesOver({start_m, drop_m, known});
      const bool to_base = std::abs(start_m - drop_m) < 1e-9;
      ASSERT_EQ(events.size(), 1u) << "from " << start_m;
      EXPECT_EQ(events[0].kind, "fell");
      EXPECT_EQ(events[0].hazard, to_base ? "base_floor" : "lower") << "from " << start_m;
      EXPECT_NEAR(events[0].threshold, start_m - 0.03, 1e-12);
      EXPECT_TRUE(GoesOver({start_m, 0.029, known}).empty()) << "from " << start_m;
      EXPECT_TRUE(GoesOver({start_m, -0.1, known}).empty()) << "up is no fall";
    }
  EXPECT_EQ(GoesOver({0.1, 0.08, true, true}).size(), 1u) << "a hole in a platform";
  EXPECT_EQ(GoesOver({0.1, 0.08, true, true})[0].hazard, "lower");
}

TEST(RollOver, LevelsNearTheStartsAreThePlansWhereverThatLies) {
  for (const double start_m : {0.0, 0.1, -0.1})
    for (const double drop_m : {0.012, -0.012}) {
      // Beyond the edge, 29 mm deeper than a level that the plan drives over is none.
      const auto deeper = [&](double by_m) {
        const HazardMap map = TwoLevels({start_m, drop_m, true});
        const RobotSpec robot = TestRobot();
        const auto dut = MakeDetector("roll_over");
        dut->Start({map, robot, kStepS});
        bool fell = false;
        for (Sample& s : Trace(Drive({{10, {0.2, 0, 0}}}))) {
          s.wheel_floor_z_m = start_m - (s.p_WB.x() > 1 ? drop_m + by_m : 0);
          fell |= dut->Update(s);
        }
        return fell;
      };
      EXPECT_FALSE(deeper(0.029)) << start_m << " " << drop_m;
      EXPECT_TRUE(deeper(0.031)) << start_m << " " << drop_m;
    }
}

// It leans forward on its rear wheels: the level that carries them did not tip it, but would have
// by its edge, or if the robot had not been set down on it.
TEST(RollOver, ALevelIsToBlameWhereItIsNotTheFloorOfTheStart) {
  const auto judge = [](double start_x_m, double aside_n) {
    const HazardMap map = TwoLevels({0.1, 0.1});
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
  trace = With(
      trace, [](Sample& s) { s.wheel_floor_z_m = -0.2; }, 2.5, 3);
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
  Judge(*dut, Sunk(-0.015));  // half of what makes a fall
  EXPECT_NEAR(dut->margin(), kLimit_rad / 2, 1e-12);
}

}  // namespace
}  // namespace floorproof

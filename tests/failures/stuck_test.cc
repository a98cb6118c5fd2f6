// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/failures/synthetic.h"

namespace floorproof {
namespace {

// Moves as `piece` says while `command` is asked for.
Trace Commanded(const Piece& piece, const BodyTwist& command) {
  return With(Drive({piece}), [&](Sample& s) { s.command.twist = command; });
}

std::size_t Count(const Trace& trace, const std::string& yaml = "") {
  return Judge(*MakeDetector("stuck", yaml), trace).size();
}

Trace Append(Trace a, const Trace& b) {
  const Sample last = a.back();
  for (Sample sample : b) {
    sample.t_s += last.t_s;
    const Pose2 X_WB = last.X_WB() * sample.X_WB();
    sample.p_WB = {X_WB.x_m, X_WB.y_m, 0};
    sample.yaw_rad = X_WB.yaw_rad;
    a.push_back(sample);
  }
  return a;
}

TEST(Stuck, ThresholdScalesWithTheCommandedSpeed) {
  // r = min(0.5, 0.25 * v_cmd * 10 s): 0.25 m at 0.1 m/s, 0.5 m from 0.2 m/s on.
  EXPECT_EQ(Count(Commanded({10.2, {0.0245, 0, 0}}, {0.1, 0, 0})), 1u);
  EXPECT_EQ(Count(Commanded({10.2, {0.0255, 0, 0}}, {0.1, 0, 0})), 0u);
  EXPECT_EQ(Count(Commanded({10.2, {0.049, 0, 0}}, {0.4, 0, 0})), 1u);
  EXPECT_EQ(Count(Commanded({10.2, {0.051, 0, 0}}, {0.4, 0, 0})), 0u);
}

// Rows of 0.4 m in a corner: 2 m of way within the window, 0.4 m of displacement at most.
TEST(Stuck, WindingAboutAsToldIsProgress) {
  std::vector<Piece> rows;
  for (int row = 0; row < 10; ++row) rows.push_back({2, {row % 2 ? -0.2 : 0.2, 0.005, 0}});
  EXPECT_EQ(Count(Drive(rows)), 0u);
  Trace held = Drive(rows);
  for (Sample& s : held) s.p_WB *= 0.05;
  EXPECT_EQ(Count(held), 1u);
}

TEST(Stuck, NeedsTheWholeWindow) {
  EXPECT_EQ(Count(Commanded({9.9, {}}, {0.2, 0, 0})), 0u);
  const auto events = Judge(*MakeDetector("stuck"), Commanded({12, {}}, {0.2, 0, 0}));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_NEAR(events[0].t_s, 10, 2 * kStepS);
  EXPECT_EQ(events[0].value, 0);
  EXPECT_EQ(events[0].threshold, 0.5);
  EXPECT_EQ(Count(Commanded({4, {}}, {0.2, 0, 0}), "{window_s: 3}"), 1u);
}

TEST(Stuck, TurningIsProgress) {
  EXPECT_EQ(Count(Commanded({10.2, {0, 0, 0.048}}, {0.2, 0, 0.2})), 1u);
  EXPECT_EQ(Count(Commanded({10.2, {0, 0, 0.052}}, {0.2, 0, 0.2})), 0u);
}

TEST(Stuck, ACommandedTurnOnTheSpotIsAMove) {
  EXPECT_EQ(Count(Commanded({11, {}}, {0, 0, 0.5})), 1u);
  EXPECT_EQ(Count(Commanded({11, {0, 0, 0.5}}, {0, 0, 0.5})), 0u);
  // A slow turn is judged by what was asked: 0.06 rad/s * 10 s * 0.25 = 0.15 rad.
  EXPECT_EQ(Count(Commanded({11, {0, 0, 0.06}}, {0, 0, 0.06})), 0u);
  EXPECT_EQ(Count(Commanded({11, {0, 0, 0.01}}, {0, 0, 0.06})), 1u);
}

TEST(Stuck, StandingOnPurposeStopsTheClock) {
  Trace dwell = Drive({{60, {}, true}});
  EXPECT_EQ(Count(dwell), 0u);
  const Trace blocked = Commanded({6, {}}, {0.2, 0, 0});
  const auto events = Judge(*MakeDetector("stuck"), Append(Append(blocked, dwell), blocked));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_NEAR(events[0].t_s, 70, 2 * kStepS);
}

TEST(Stuck, DrivingOutAndBackIsProgress) {
  EXPECT_EQ(Count(Drive({{5, {0.3, 0, 0}}, {5.2, {-0.3, 0, 0}}})), 0u);
}

TEST(Stuck, RearmsAfterProgress) {
  const Trace blocked = Commanded({11, {}}, {0.2, 0, 0});
  EXPECT_EQ(Count(Commanded({45, {}}, {0.2, 0, 0})), 1u);
  EXPECT_EQ(Count(Append(Append(blocked, Drive({{11, {0.2, 0, 0}}})), blocked)), 2u);
}

TEST(Stuck, HighCentredWhenTheBellyCarriesWeight) {
  const Trace blocked = Commanded({11, {}}, {0.2, 0, 0});
  const auto belly = [](double load_n) {
    return [load_n](Sample& s) {
      s.belly_load_n = load_n;
      s.belly_hazard = kStepHazard;
    };
  };
  const auto hung = Judge(*MakeDetector("stuck"), With(blocked, belly(0.12 * 98.1)));
  ASSERT_EQ(hung.size(), 1u);
  EXPECT_EQ(hung[0].kind, "high_centred");
  EXPECT_EQ(hung[0].hazard, "sill");
  const auto grazed = Judge(*MakeDetector("stuck"), With(blocked, belly(0.08 * 98.1)));
  ASSERT_EQ(grazed.size(), 1u);
  EXPECT_EQ(grazed[0].kind, "");
}

TEST(Stuck, NamesWhatHoldsIt) {
  const Trace trace = Append(Drive({{20, {0.2, 0, 0}}}), Commanded({11, {}}, {0.2, 0, 0}));
  const auto judge = [&](const std::function<void(Sample&)>& met, double from_s, double to_s) {
    const auto events = Judge(*MakeDetector("stuck"), With(trace, met, from_s, to_s));
    EXPECT_EQ(events.size(), 1u);
    return events.empty() ? "?" : events[0].hazard;
  };
  const auto by = [](int hazard, const Vec3& force_W_n) {
    return [=](Sample& s) { PushedBy(s, hazard, force_W_n); };
  };
  EXPECT_EQ(judge(by(kStepHazard, {-20, 0, 0}), 20, 31), "sill");
  EXPECT_EQ(judge(by(kStepHazard, {-20, 0, 0}), 2, 10), "") << "long before";
  EXPECT_EQ(judge(by(kStepHazard, {20, 0, 60}), 20, 31), "") << "it helped";
  EXPECT_EQ(judge(by(kStepHazard, {0, 0, 98}), 20, 31), "") << "it carried the robot, no more";
  // A mat under the wheels, and the wall that they push against.
  EXPECT_EQ(judge(
                [](Sample& s) {
                  PushedBy(s, kStepHazard, {0, 0, 98});
                  s.touches[0].friction.force_W_n = {60, 0, 0};
                  PushedBy(s, -1, {-60, 0, 0});
                  s.near_hazard = kStepHazard;
                },
                20, 31),
            "wall");
}

// Told to turn on the spot, by a leg beside its front.
TEST(Stuck, NamesWhatHoldsItsTurn) {
  const Trace trace = Commanded({11, {}}, {0, 0, 0.5});
  const auto judge = [&](double moment_nm) {
    const auto leg = [=](Sample& s) {
      PushedBy(s, kGlassHazard, {-20, 0, 0});
      s.touches[0].normal.moment_W_nm.z() = moment_nm;
    };
    const auto events = Judge(*MakeDetector("stuck"), With(trace, leg));
    EXPECT_EQ(events.size(), 1u);
    return events.empty() ? "?" : events[0].hazard;
  };
  EXPECT_EQ(judge(-3), "door");
  EXPECT_EQ(judge(3), "");
}

// What lacks grip or a floor pushes nothing.
TEST(Stuck, NamesAGapOrIceWhereNothingPushes) {
  HazardMap map = TestMap();
  const RobotSpec robot = TestRobot();
  const auto judge = [&] {
    const auto dut = MakeDetector("stuck");
    dut->Start({map, robot, kStepS});
    for (Sample s : Commanded({11, {}}, {0.2, 0, 0})) {
      s.near_hazard = kStepHazard;
      if (dut->Update(s)) return dut->event().hazard;
    }
    return std::string("?");
  };
  EXPECT_EQ(judge(), "") << "a sill that is only near";
  map.hazards[kStepHazard].material.friction = map.floor_friction / 4;
  EXPECT_EQ(judge(), "sill");
  map.hazards[kStepHazard].material.friction.reset();
  map.hazards[kStepHazard].height_m = -0.05;
  EXPECT_EQ(judge(), "sill");
}

TEST(Stuck, MarginIsTheProgressBeyondTheThreshold) {
  const auto dut = MakeDetector("stuck");
  Judge(*dut, Drive({{20, {0.04, 0, 0}}}));
  EXPECT_NEAR(dut->margin(), 0.4 - 0.1, 1e-3);
  Judge(*dut, Commanded({11, {0.01, 0, 0}}, {0.2, 0, 0}));
  EXPECT_NEAR(dut->margin(), 0.1 - 0.5, 1e-3);
}

}  // namespace
}  // namespace floorproof

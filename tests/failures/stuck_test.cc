// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "tests/failures/synthetic.h"

namespace floorproof {
namespace {

// Moves as `piece` says while `command` is asked for.
Trace Commanded(const Piece& piece, const BodyTwist& command) {
  return With(Drive({piece}), [&](Sample& s) {
    s.command.twist = command;
    s.command.turning = command.vx_mps == 0 && command.vy_mps == 0;
  });
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
    sample.progress_m += last.progress_m;
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
  for (Sample& s : held) {
    s.p_WB *= 0.05;
    s.progress_m *= 0.05;
  }
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

// The plan runs along x from the origin.
Trace AlongX(Trace trace) {
  for (Sample& s : trace) s.progress_m = s.p_WB.x() - std::abs(s.p_WB.y());
  return trace;
}

// Whoever is to move gains nothing by turning, or by turning to and fro.
TEST(Stuck, SwayingIsNoProgress) {
  EXPECT_EQ(Count(Commanded({10.2, {0, 0, 0.2}}, {0.2, 0, 0.2})), 1u);
  std::vector<Piece> sway;
  for (int i = 0; i < 24; ++i) sway.push_back({1, {0.05, 0, i % 2 ? 1.2 : -1.2}});
  Trace held = With(Drive(sway), [](Sample& s) {
    s.command.twist = {0.2, 0, 0.3};
    s.command.turning = false;
    s.p_WB.x() = 0.05 * std::sin(s.yaw_rad);
    s.p_WB.y() = 0.05 * std::cos(s.yaw_rad);
  });
  EXPECT_EQ(Count(AlongX(held)), 1u);
}

TEST(Stuck, CirclingIsNoProgress) {
  for (const double radius_m : {0.05, 0.15}) {
    const Trace circles = AlongX(Drive({{30, {0.25, 0, 0.25 / radius_m}}}));
    EXPECT_EQ(Count(circles), 1u) << radius_m;
  }
}

TEST(Stuck, PushingForwardAndFallingBackIsNoProgress) {
  for (const double way_m : {0.02, 0.1}) {
    std::vector<Piece> pieces;
    for (double t_s = 0; t_s < 24; t_s += way_m / 0.2 + way_m / 0.1)
      pieces.insert(pieces.end(), {{way_m / 0.2, {0.2, 0, 0}}, {way_m / 0.1, {-0.1, 0, 0}}});
    const Trace pushing = With(Drive(pieces), [](Sample& s) { s.command.twist = {0.2, 0, 0}; });
    EXPECT_EQ(Count(AlongX(pushing)), 1u) << way_m;
  }
}

// Going back as it is told stops the clock.
Trace Reacting(Trace trace) {
  return With(std::move(trace), [](Sample& s) { s.command.reacting = s.command.twist.vx_mps < 0; });
}

// Along a pane that it cannot see, a robot meets it again and again, and gets on.
TEST(Stuck, SomeReactionsInAWindowAreNoFailure) {
  std::vector<Piece> pieces = {{2, {0.25, 0, 0}}};
  for (int i = 0; i < 5; ++i)
    pieces.insert(pieces.end(), {{0.7, {0.25, 0, 0}}, {1.5, {-0.1, 0, 0}}});
  pieces.push_back({8, {0.25, 0, 0}});
  EXPECT_EQ(Count(Reacting(AlongX(Drive(pieces)))), 0u);
  EXPECT_EQ(Count(AlongX(Drive(pieces))), 1u) << "its tracker led it to and fro";
}

TEST(Stuck, ReactingForEverIsOne) {
  std::vector<Piece> pieces;
  for (int i = 0; i < 25; ++i)
    pieces.insert(pieces.end(), {{0.6, {0.25, 0, 0}}, {1.5, {-0.1, 0, 0}}});
  EXPECT_EQ(Count(Reacting(AlongX(Drive(pieces)))), 1u);
}

// Held where it is to go back, or to turn back.
TEST(Stuck, ARobotThatCannotGoBackIsHeld) {
  for (const BodyTwist& back : {BodyTwist{-0.1, 0, 0}, BodyTwist{0, 0, 0.6}}) {
    const Trace held =
        With(Commanded({12, {}}, back), [](Sample& s) { s.command.reacting = true; });
    EXPECT_EQ(Count(held), 1u);
    const Trace goes = With(Commanded({12, back}, back), [](Sample& s) {
      s.command.reacting = true;
      s.progress_m = 0;
    });
    EXPECT_EQ(Count(goes), 0u);
  }
}

// Back from what it met, around it, and on: less way gained than driven, but gained.
TEST(Stuck, AReactionIsNoFailure) {
  const Trace around = AlongX(Drive({{2, {0.25, 0, 0}},
                                     {1.5, {-0.1, 0, 0}},
                                     {1.3, {0, 0, 1.2}},
                                     {1, {0.25, 0, 0}},
                                     {1.3, {0, 0, -1.2}},
                                     {8, {0.25, 0, 0}}}));
  EXPECT_EQ(Count(around), 0u);
}

// It is not where its plan is, but nothing holds it: that is veering off.
TEST(Stuck, GoingElsewhereIsNotStuck) {
  for (const double speed_mps : {0.02, 0.25})
    EXPECT_EQ(Count(AlongX(Commanded({60, {0, speed_mps, 0}}, {0, speed_mps, 0}))), 0u);
  // Sliding aside at a share of what was asked for is another thing.
  EXPECT_EQ(Count(AlongX(Commanded({20, {0, 0.05, 0}}, {0.25, 0, 0}))), 1u);
}

// However slow the plan: who obeys gets on, and who is held is found, later in proportion.
TEST(Stuck, SlowPlansAreJudgedOverALongerTime) {
  for (const double speed_mps : {0.001, 0.005, 0.01, 0.02, 0.05}) {
    const double window_s = std::max(10.0, 10 * 0.02 / speed_mps);
    const auto dut = MakeDetector("stuck");
    EXPECT_TRUE(Judge(*dut, Drive({{3 * window_s, {speed_mps, 0, 0}}})).empty());
    EXPECT_GT(dut->margin(), 0.1) << "well above the threshold";
    const auto held = Judge(*dut, Commanded({1.1 * window_s, {}}, {speed_mps, 0, 0}));
    ASSERT_EQ(held.size(), 1u) << speed_mps;
    EXPECT_NEAR(held[0].t_s, window_s, 0.03 * window_s);
    EXPECT_GE(held[0].threshold, 0.05 - 1e-6);
  }
}

// One place of a plan asks for a turn or two, and not for one after the other.
TEST(Stuck, BeingTurnedAwayAgainAndAgainIsNoProgress) {
  EXPECT_EQ(Count(Drive({{6, {0, 0, 1}}, {3, {0.2, 0, 0}}, {6, {0, 0, -1}}, {3, {0.2, 0, 0}}})),
            0u);
  std::vector<Piece> turns;
  for (int i = 0; i < 20; ++i)
    turns.insert(turns.end(),
                 {{1.5, {0, 0, i % 2 ? 1.0 : -1.0}}, {0.2, {0.1, 0, 0}}, {0.2, {-0.1, 0, 0}}});
  EXPECT_EQ(Count(AlongX(Drive(turns))), 1u);
}

// Blocks that turn on their hinges as told get on; one that is held does not.
TEST(Stuck, FoldingIsProgress) {
  const auto fold = [](double done_radps) {
    return With(Drive({{15, {}}}), [done_radps](Sample& s) {
      s.command.turning = true;
      s.command.twist = {0.003, 0, 0};  // holding its place
      s.hinges.n = s.command.hinges.n = 3;
      s.command.hinges.radps[1] = -0.3;
      s.hinges.radps[1] = done_radps;
    });
  };
  EXPECT_EQ(Count(fold(-0.3)), 0u);
  EXPECT_EQ(Count(fold(0)), 1u);
  EXPECT_EQ(Count(fold(0.3)), 1u) << "the wrong way";
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

// The evidence says for how long it stood where it is, a dwell on purpose not counted.
TEST(Stuck, TheEvidenceSaysForHowLongItStood) {
  const auto evidence = [](const Event& event, std::string_view name) {
    for (const auto& [key, value] : event.evidence)
      if (key == name) return value;
    return -1.0;
  };
  const Trace drive = Drive({{6, {0.25, 0, 0}}});
  const Trace blocked = Commanded({20, {}}, {0.25, 0, 0});
  for (const bool dwells : {false, true}) {
    const Trace trace = dwells ? Append(Append(Append(drive, Commanded({3, {}}, {0.25, 0, 0})),
                                               Drive({{30, {}, true}})),
                                        blocked)
                               : Append(drive, blocked);
    const auto events = Judge(*MakeDetector("stuck"), trace);
    ASSERT_EQ(events.size(), 1u);
    // The last 2 s of driving gain the 0.5 m that it owes in 10 s.
    EXPECT_NEAR(evidence(events[0], "still_s"), 8, 0.3) << dwells;
    EXPECT_NEAR(evidence(events[0], "commanded_s"), 10, 0.1) << dwells;
    EXPECT_EQ(evidence(events[0], "turning"), 0);
  }
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

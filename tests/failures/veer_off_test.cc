// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/failures/synthetic.h"

namespace floorproof {
namespace {

// Off by cross_track_m for off_s, in a lane of that half width.
Trace Off(double cross_track_m, double off_s, double half_width_m) {
  Trace trace = Drive({{8, {0.2, 0, 0}}});
  for (Sample& s : trace) s.cross_track_half_width_m = half_width_m;
  return With(
      trace, [&](Sample& s) { s.cross_track_m = cross_track_m; }, 2, 2 + off_s);
}

std::size_t Count(const Trace& trace, const std::string& yaml = "") {
  return Judge(*MakeDetector("veer_off", yaml), trace).size();
}

TEST(VeerOff, TheBoundIsHalfAMetreOrHalfTheLane) {
  EXPECT_EQ(Count(Off(0.499, 1, 2.0)), 0u);
  EXPECT_EQ(Count(Off(0.501, 1, 2.0)), 1u);
  EXPECT_EQ(Count(Off(0.299, 1, 0.3)), 0u);
  EXPECT_EQ(Count(Off(0.301, 1, 0.3)), 1u);
  EXPECT_EQ(Count(Off(0.499, 1, 0.0)), 0u);  // the lane's width is not known
  EXPECT_EQ(Count(Off(0.501, 1, 0.0)), 1u);
  EXPECT_EQ(Count(Off(0.301, 1, 2.0), "{max_cross_track_m: 0.3}"), 1u);
}

TEST(VeerOff, MustLast) {
  EXPECT_EQ(Count(Off(0.6, 0.196, 2.0)), 0u);
  EXPECT_EQ(Count(Off(0.6, 0.208, 2.0)), 1u);
  EXPECT_EQ(Count(Off(0.6, 0.5, 2.0), "{duration_s: 0.6}"), 0u);
  EXPECT_EQ(Count(Off(0.6, kStepS, 2.0), "{duration_s: 0}"), 1u);
}

TEST(VeerOff, ReportsWhenTheDurationIsOver) {
  const auto events = Judge(*MakeDetector("veer_off"), Off(0.6, 1, 2.0));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_NEAR(events[0].t_s, 2.2, 1.5 * kStepS);
  EXPECT_EQ(events[0].value, 0.6);
  EXPECT_EQ(events[0].threshold, 0.5);
  EXPECT_EQ(events[0].hazard, "");
}

TEST(VeerOff, RearmsOnceBackInTheLane) {
  Trace trace = Off(0.6, 1, 2.0);
  trace = With(
      trace, [](Sample& s) { s.cross_track_m = 0.6; }, 4, 5);
  EXPECT_EQ(Count(trace), 2u);
}

TEST(VeerOff, NamesWhatPushedItOff) {
  const auto judge = [](const std::function<void(Sample&)>& met, double from_s, double to_s) {
    Trace trace = With(Off(0.6, 1, 2.0), [](Sample& s) { s.off_track_W = {0, s.cross_track_m}; });
    const auto events = Judge(*MakeDetector("veer_off"), With(trace, met, from_s, to_s));
    EXPECT_EQ(events.size(), 1u);
    return events.empty() ? "?" : events[0].hazard;
  };
  const auto by = [](int hazard, const Vec3& force_W_n) {
    return [=](Sample& s) { PushedBy(s, hazard, force_W_n); };
  };
  EXPECT_EQ(judge(by(kGlassHazard, {0, 30, 0}), 2.0, 2.3), "door");
  EXPECT_EQ(judge(by(-1, {0, 30, 0}), 2.0, 2.3), "wall");
  EXPECT_EQ(judge(by(kGlassHazard, {0, -30, 0}), 2.0, 2.3), "") << "it pushed the other way";
  EXPECT_EQ(judge(by(kStepHazard, {0, 0, 98}), 2.0, 2.3), "") << "it only carried the robot";
  EXPECT_EQ(judge(
                [&](Sample& s) {
                  PushedBy(s, kStepHazard, {0, 5, 98});
                  PushedBy(s, kGlassHazard, {0, 30, 0});
                },
                2.0, 2.3),
            "door");
}

TEST(VeerOff, MarginIsTheLeastDistanceToTheBound) {
  const auto dut = MakeDetector("veer_off");
  Judge(*dut, Off(0.2, 1, 2.0));
  EXPECT_DOUBLE_EQ(dut->margin(), 0.3);
  Judge(*dut, Off(0.9, 0.1, 2.0));  // met for too short a time to fail
  EXPECT_EQ(dut->margin(), 0);
  Judge(*dut, Off(0.9, 1, 2.0));
  EXPECT_DOUBLE_EQ(dut->margin(), -0.4);
}

// 100 mm off is nearer to failing where 300 mm are allowed than 150 mm off where 500 are; a narrow
// lane that is kept is no margin lost.
TEST(VeerOff, MarginIsAShareOfTheBoundThatHoldsThere) {
  const auto dut = MakeDetector("veer_off");
  Trace trace = Off(0, 1, 2.0);
  const auto in = [&](double half_width_m, double off_m, double from_s, double to_s) {
    trace = With(
        trace,
        [=](Sample& s) {
          s.cross_track_half_width_m = half_width_m;
          s.cross_track_m = off_m;
        },
        from_s, to_s);
  };
  in(0.3, 0, 0, 1);
  Judge(*dut, trace);
  EXPECT_EQ(dut->margin_share(), 1);
  in(0.3, 0.1, 1, 2);
  in(0.8, 0.15, 2, 3);
  Judge(*dut, trace);
  EXPECT_NEAR(dut->margin(), 0.2, 1e-12);
  EXPECT_NEAR(dut->margin_share(), 0.2 / 0.3, 1e-12);
}

}  // namespace
}  // namespace floorproof

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

TEST(VeerOff, NamesTheHazardMetShortlyBefore) {
  const auto touch = [](Sample& s) {
    s.num_contacts = 1;
    s.contacts[0].hazard = kGlassHazard;
  };
  const auto soon = Judge(*MakeDetector("veer_off"), With(Off(0.6, 1, 2.0), touch, 1.0, 1.1));
  ASSERT_EQ(soon.size(), 1u);
  EXPECT_EQ(soon[0].hazard, "door");
  const auto at_wall =
      Judge(*MakeDetector("veer_off"),
            With(
                Off(0.6, 1, 2.0), [](Sample& s) { s.num_contacts = 1; }, 1.0, 1.1));
  ASSERT_EQ(at_wall.size(), 1u);
  EXPECT_EQ(at_wall[0].hazard, "wall");
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

}  // namespace
}  // namespace floorproof

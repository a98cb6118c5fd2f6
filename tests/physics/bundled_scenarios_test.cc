// SPDX-License-Identifier: Apache-2.0
// The bundled scenarios after Figure 1 of "htetro-fmea-coverage": each fails as its own comment and
// docs/gallery.md say, at the place where the hazard is.
#include <ostream>

#include "run/scenario/scenario_file.h"
#include "tests/places.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

// What is expected of an event: the robot's centre stands where its own size and the hazard's place
// put it.
struct Expected {
  FailureMode mode;
  const char* kind;
  const char* hazard;  // that its id begins with
  double x_m, y_m;
  double tolerance_m = 0.05;
};
struct Bundled {
  const char* name;
  std::vector<Expected> events;
  friend void PrintTo(const Bundled& b, std::ostream* out) { *out << b.name; }
};

// hTetro: from its centre to its shell, and to the middle rows of wheels across; half a wheel's
// width.
constexpr double kFront_m = 0.25, kRowAcross_m = 0.03, kWheelHalfWidth_m = 0.0125;

Scenario ReadBundled(const std::string& name) {
  return ReadScenario(SourceFile("models/scenarios") / ("fig1_" + name + ".yaml"), {});
}

class BundledScenarios : public ScenarioTest, public ::testing::WithParamInterface<Bundled> {};

TEST_P(BundledScenarios, FailsAsItSays) {
  const EpisodeRecord dut = Drive(ReadBundled(GetParam().name));
  EXPECT_EQ(dut.outcome, Outcome::kFailure) << dut.message;
  ASSERT_EQ(dut.events.size(), GetParam().events.size());
  for (std::size_t i = 0; i < dut.events.size(); ++i) {
    const Event& event = dut.events[i];
    const Expected& expected = GetParam().events[i];
    SCOPED_TRACE(i);
    EXPECT_EQ(Name(event.mode), Name(expected.mode));
    EXPECT_EQ(event.kind, expected.kind);
    EXPECT_TRUE(event.hazard.starts_with(expected.hazard)) << event.hazard;
    EXPECT_NEAR(event.x_m, expected.x_m, expected.tolerance_m);
    EXPECT_NEAR(event.y_m, expected.y_m, expected.tolerance_m);
  }
}

constexpr FailureMode kVeerOff = FailureMode::kVeerOff, kStuck = FailureMode::kStuck,
                      kRollOver = FailureMode::kRollOver, kBounceBack = FailureMode::kBounceBack;
INSTANTIATE_TEST_SUITE_P(
    Figure1, BundledScenarios,
    ::testing::Values(
        Bundled{"glass_door",
                {{kBounceBack, "reversed", "glass-door", 3.75 - 0.005 - kFront_m, 2.5}}},
        // Between the front legs, against both rear ones; which is named is a draw.
        Bundled{"chair_legs", {{kStuck, "", "rear-leg-", 3.46 - kFront_m, 2.5}}},
        // It falls when its centre is over the edge; its wheels pull it on, down the treads.
        Bundled{"staircase_edge", {{kRollOver, "fell", "stair-1", 3.0, 2.5}}},
        // Over the sill at x = 2.2 m, not up the first step.
        Bundled{"entrance_steps",
                {{kBounceBack, "reversed", "step-1", 3.2 - kFront_m, 2.5},
                 {kStuck, "", "step-1", 3.2 - kFront_m, 2.5}}},
        // Half a metre off its lane, its corner at the partition: where, hangs on how far round it
        // is pushed, between not at all and the partition's 10 degrees.
        Bundled{"wall_brush", {{kVeerOff, "", "partition", 4.63, 2.5 + 0.5, 0.14}}},
        // Forward over it on the lane at y = 1.75 m; sideways its second row stands at the foot.
        Bundled{"cable_cover",
                {{kStuck, "", "cover", 3.0 + 0.0497 + kWheelHalfWidth_m + kRowAcross_m, 2.75}}},
        // Its first row is past the first cobbles, which begin at 2.2 m; its belly hangs on them.
        Bundled{"rough_floor", {{kStuck, "high_centred", "cobbles", 2.23, 2.45, 0.1}}}),
    [](const auto& suite) { return std::string(suite.param.name); });

class WallBrush : public ScenarioTest {};

// What pushes it off is the partition, whose face rises by 10 degrees from (1.80, 2.23).
TEST_F(WallBrush, ItsFrontRightCornerIsAtThePartition) {
  const EpisodeRecord dut = Drive(ReadBundled("wall_brush"));
  ASSERT_FALSE(dut.events.empty());
  const Pose2 X_WB{dut.events[0].x_m, dut.events[0].y_m, dut.events[0].yaw_rad};
  const Vec2 corner_W = X_WB * Vec2(kFront_m, -kFront_m);
  const double face_m = 2.23 + std::tan(10 * kPi / 180) * (corner_W.x() - 1.80);
  EXPECT_NEAR(corner_W.y(), face_m, 0.005);
}

class RiskEdge : public ScenarioTest {};

// The film of docs/gallery.md: held by the cover, helped without being told, over the edge.
TEST_F(RiskEdge, IsHeldHelpedAndGoesOverTheEdge) {
  const EpisodeRecord dut =
      Drive(ReadScenario(SourceFile("models/scenarios/risk_edge.yaml"), {{"time_limit_s", "60"}}));
  ASSERT_EQ(dut.events.size(), 2u);
  EXPECT_EQ(dut.events[0].mode, kStuck);
  EXPECT_TRUE(dut.events[0].hazard.starts_with("cable_cover")) << dut.events[0].hazard;
  EXPECT_EQ(dut.events[1].mode, kRollOver);
  EXPECT_EQ(dut.events[1].kind, "fell");
  EXPECT_TRUE(dut.events[1].hazard.starts_with("step")) << dut.events[1].hazard;
}

}  // namespace
}  // namespace floorproof

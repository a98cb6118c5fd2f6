// SPDX-License-Identifier: Apache-2.0
// What BELUGA's own physics says of hazards that lie across its path.
#include <gmock/gmock.h>

#include "env/core/streams.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

class Hazards : public ScenarioTest {
 protected:
  Hazards() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n7,2.5\n"); }

  // A strip across the room from x = 4 m, of this type and keys.
  static std::string Across(const std::string& keys) {
    return "{id: it, known: false, " + keys +
           ", polygon_m: [[4, 0.5], [5, 0.5], [5, 4.5], [4, 4.5]]}";
  }
};

TEST_F(Hazards, AStepOf40mmHoldsTheRobotAndIsNamed) {
  const EpisodeRecord dut = Drive(Read(RoomScenario(Across("type: step, height_m: 0.040"))));
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  ASSERT_EQ(dut.events.size(), 1u);
  EXPECT_EQ(dut.events[0].mode, FailureMode::kStuck);
  EXPECT_EQ(dut.events[0].hazard, "it");
  // Its round front stands at the face: centre a radius before it.
  EXPECT_NEAR(dut.events[0].x_m, 4 - 0.18, 0.05);
  EXPECT_NEAR(dut.events[0].y_m, 2.5, 0.05);
}

class LowSteps : public Hazards, public ::testing::WithParamInterface<double> {};

// Up to its step_m the robot goes up and down again as if nothing were there.
TEST_P(LowSteps, AreCrossedWithoutAnEvent) {
  const std::string height = std::to_string(GetParam());
  const EpisodeRecord dut = Drive(Read(RoomScenario(Across("type: step, height_m: " + height))));
  EXPECT_EQ(dut.outcome, Outcome::kSuccess) << (dut.events.empty() ? "" : dut.events[0].kind);
  EXPECT_TRUE(dut.events.empty());
  EXPECT_LT(dut.metrics.max_cross_track_m, 0.05);
  float highest = 0;
  for (const auto& row : dut.trace) highest = std::max(highest, row.z_m);
  EXPECT_NEAR(highest, GetParam(), 0.003) << "it was on the step";
}
INSTANTIATE_TEST_SUITE_P(Heights, LowSteps, ::testing::Values(0.002, 0.006, 0.010));

TEST_F(Hazards, ADropOf150mmIsAFall) {
  const EpisodeRecord dut = Drive(Read(RoomScenario(Across("type: step, height_m: -0.150"))));
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  ASSERT_FALSE(dut.events.empty());
  EXPECT_EQ(dut.events[0].mode, FailureMode::kRollOver);
  EXPECT_EQ(dut.events[0].hazard, "it");
  EXPECT_GT(dut.events[0].x_m, 3.8);
  EXPECT_LT(dut.events[0].x_m, 4.5);
}

TEST_F(Hazards, ASmallDropIsDrivenDown) {
  const EpisodeRecord dut = Drive(Read(RoomScenario(Across("type: step, height_m: -0.006"))));
  EXPECT_EQ(dut.outcome, Outcome::kSuccess);
  EXPECT_TRUE(dut.events.empty());
}

// The planner goes round what it knows of; the same step unseen is met.
TEST_F(Hazards, WhatIsKnownIsAvoided) {
  const std::string plank =
      "{id: it, type: step, height_m: 0.04, polygon_m: [[4, 1.5], [4.3, 1.5], [4.3, 3.5], [4, "
      "3.5]]";
  const EpisodeRecord known =
      Drive(Read(RoomScenario(plank + "}"), {{"plan", "{planner: boustrophedon}"}}));
  const EpisodeRecord unseen =
      Drive(Read(RoomScenario(plank + ", known: false}"), {{"plan", "{planner: boustrophedon}"}}));
  EXPECT_EQ(known.outcome, Outcome::kSuccess);
  EXPECT_EQ(unseen.outcome, Outcome::kFailure);
  EXPECT_EQ(unseen.events.at(0).hazard, "it");
}

// Null test: on a flat, empty floor nothing fails, whatever the start, heading, friction.
TEST_F(Hazards, AFlatFloorHasNoEvents) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Stream draw(seed, 0, "null test");
    std::string plan = "x_m,y_m\n";
    for (int i = 0; i < 8; ++i)
      plan += std::to_string(draw.Uniform(1, 8)) + "," + std::to_string(draw.Uniform(1, 4)) + "\n";
    Save("plan.csv", plan);
    const std::string start = "start: {x_m: " + std::to_string(draw.Uniform(1, 8)) +
                              ", y_m: " + std::to_string(draw.Uniform(1, 4)) +
                              ", yaw_deg: " + std::to_string(draw.Uniform(-180, 180)) + "}\n";
    const EpisodeRecord dut =
        Drive(Read(RoomScenario("", start),
                   {{"site.floor.friction", std::to_string(draw.Uniform(0.4, 1.0))}}));
    EXPECT_EQ(dut.outcome, Outcome::kSuccess) << "seed " << seed;
    EXPECT_TRUE(dut.events.empty()) << "seed " << seed;
    for (const auto& margin : dut.margins) EXPECT_GT(margin.value, 0) << margin.detector;
  }
}

}  // namespace
}  // namespace floorproof

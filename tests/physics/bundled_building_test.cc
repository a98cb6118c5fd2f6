// SPDX-License-Identifier: Apache-2.0
// The bundled building, driven whole.
#include <gtest/gtest.h>

#include <filesystem>

#include "run/scenario/scenario_file.h"
#include "tests/places.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

// What the bundled scenario says of itself: across the lift's gap it gets on, along it a wheel, as
// wide as the gap or less, rolls in.
TEST_F(ScenarioTest, LanesAlongALiftsGapAreATrapAndLanesAcrossAreNot) {
  const auto file = SourceFile("models/scenarios/building.yaml");
  const EpisodeRecord across = Drive(ReadScenario(file, {}));
  EXPECT_EQ(across.outcome, Outcome::kSuccess) << across.message;
  EXPECT_GT(across.metrics.coverage, 0.9);
  const EpisodeRecord along = Drive(ReadScenario(file, {{"plan.direction_deg", "0"}}));
  ASSERT_FALSE(along.events.empty());
  EXPECT_EQ(along.events[0].mode, FailureMode::kStuck);
  EXPECT_EQ(along.events[0].hazard, "lift");
  EXPECT_NEAR(along.events[0].y_m, 1.4 + 0.135, 0.03) << "its right wheel over the gap";
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Real maps, through init alone, planned and driven. Slow: minutes of physics.
#include "tests/physics/real_map.h"

namespace floorproof {
namespace {

class RealMap : public RealMapTest {};

TEST_P(RealMap, IsCoveredWithoutAnEvent) {
  const EpisodeRecord dut = Drive(ReadInit());
  EXPECT_EQ(dut.outcome, Outcome::kSuccess) << dut.message;
  EXPECT_TRUE(dut.events.empty());
  EXPECT_GE(dut.metrics.coverage, 0.95);
  EXPECT_EQ(dut.metrics.contacts, 0);
  EXPECT_LT(dut.metrics.max_cross_track_m, 0.10);
}
INSTANTIATE_TEST_SUITE_P(Maps, RealMap,
                         ::testing::Values(RobotOnMap{"beluga", "lab_small"},
                                           RobotOnMap{"beluga", "small_house"},
                                           RobotOnMap{"beluga", "apartment"},
                                           RobotOnMap{"htetro", "office_scan"},
                                           RobotOnMap{"htetro", "apartment"}));

}  // namespace
}  // namespace floorproof

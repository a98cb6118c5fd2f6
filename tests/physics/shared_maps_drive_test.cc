// SPDX-License-Identifier: Apache-2.0
// Real maps, through init alone, planned and driven. Slow: minutes of physics.
#include "env/map/init_files.h"
#include "env/run/file_output.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

class RealMap : public ScenarioTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(RealMap, IsCoveredWithoutAnEvent) {
  const std::filesystem::path map =
      std::filesystem::path(FP_SHARED_MAPS_DIR) / GetParam() / "map.yaml";
  if (!std::filesystem::exists(map)) GTEST_SKIP() << map << " is not here";
  const RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  const InitFiles files = MakeInitFiles(map, robot.robot, folder_);
  Save("site.yaml", files.site_yaml);
  const EpisodeRecord dut = Drive(Read(files.scenario_yaml));
  EXPECT_EQ(dut.outcome, Outcome::kSuccess) << dut.message;
  EXPECT_TRUE(dut.events.empty());
  EXPECT_GE(dut.metrics.coverage, 0.95);
  EXPECT_LT(dut.metrics.max_cross_track_m, 0.10);
}
INSTANTIATE_TEST_SUITE_P(Maps, RealMap, ::testing::Values("lab_small", "small_house", "apartment"));

}  // namespace
}  // namespace floorproof

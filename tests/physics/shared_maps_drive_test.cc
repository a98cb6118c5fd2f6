// SPDX-License-Identifier: Apache-2.0
// Real maps, through init alone, planned and driven. Slow: minutes of physics.
#include "env/map/init_files.h"
#include "env/run/file_output.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

struct RobotOnMap {
  const char *robot, *map;
};
void PrintTo(const RobotOnMap& drive, std::ostream* os) {
  *os << drive.robot << " in " << drive.map;
}

class RealMap : public ScenarioTest, public ::testing::WithParamInterface<RobotOnMap> {};

TEST_P(RealMap, IsCoveredWithoutAnEvent) {
  const std::filesystem::path map =
      std::filesystem::path(FP_SHARED_MAPS_DIR) / GetParam().map / "map.yaml";
  if (!std::filesystem::exists(map)) GTEST_SKIP() << map << " is not here";
  const RobotModel robot = ReadRobot(FindRobotFile(GetParam().robot, {}));
  const InitFiles files = MakeInitFiles(map, robot.robot, folder_);
  Save("site.yaml", files.site_yaml);
  const EpisodeRecord dut = Drive(Read(files.scenario_yaml));
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

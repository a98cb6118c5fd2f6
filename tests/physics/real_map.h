// SPDX-License-Identifier: Apache-2.0
// Robots on real maps, in the scenario that `init` makes of each map. Skipped where the map is not
// available.
#pragma once

#include "env/map/init_files.h"
#include "run/scenario/override.h"
#include "run/scenario/scenario.h"
#include "tests/places.h"
#include "tests/robots.h"
#include "tests/run/scenario_text.h"

namespace floorproof {

struct RobotOnMap {
  std::string robot, map;
};
// Every registered robot on each of these maps.
inline std::vector<RobotOnMap> EachRobotOn(const std::vector<std::string>& maps) {
  std::vector<RobotOnMap> drives;
  for (const std::string& map : maps)
    for (const std::string& robot : RobotNames()) drives.push_back({robot, map});
  return drives;
}
inline void PrintTo(const RobotOnMap& drive, std::ostream* os) {
  *os << drive.robot << " in " << drive.map;
}

class RealMapTest : public ScenarioTest, public ::testing::WithParamInterface<RobotOnMap> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(map_)) GTEST_SKIP() << map_ << " is not here";
  }
  Scenario ReadInit(const std::vector<Override>& overrides = {}) const {
    const RobotModel robot = ReadRobot(FindRobotFile(GetParam().robot, {}));
    const InitFiles files = MakeInitFiles(map_, robot.spec, folder_);
    Save("site.yaml", files.site_yaml);
    return Read(files.scenario_yaml, overrides);
  }

 private:
  const std::filesystem::path map_ = SharedFile("maps") / GetParam().map / "map.yaml";
};

}  // namespace floorproof

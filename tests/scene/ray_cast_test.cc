// SPDX-License-Identifier: Apache-2.0
// Scans cast in the map are the scans that the physics would give if it held all walls.
#include "env/map/ray_cast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "env/core/streams.h"
#include "env/scene/scene.h"
#include "env/scene/walls.h"

namespace floorproof {
namespace {

HazardMap RoomsAndPillars() {
  HazardMap map;
  map.frame = {90, 70, 0.1, {1.3, -2.1, 0.4}};
  map.cells = Grid<CellState>(90, 70);
  map.inset_m = 0.015;
  Stream draw(4, 0, "cells");
  for (int k = 0; k < 60; ++k)
    map.cells(static_cast<int>(draw.Below(90)), static_cast<int>(draw.Below(70))) =
        CellState::kOccupied;
  for (int iy = 0; iy < 70; ++iy)
    if (iy % 30 > 11) map.cells(45, iy) = CellState::kOccupied;
  return map;
}

TEST(RayCast, GivesTheScanOfTheWholeScene) {
  const HazardMap map = RoomsAndPillars();
  const RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  const Pose2 start = map.frame.X_WG * Pose2{1.05, 1.05, 0};
  const Scene scene = BuildScene(map, robot, {}, start, WallSet::kAll);
  const WallGrid walls(WallBoxes(map, robot.robot, start.p()));
  const DataPtr data = MakeData(scene.model.get());
  ForwardEngine(scene.model.get(), data.get());

  constexpr double kMost_m = 8, kHeight_m = 0.2;
  constexpr int kPoses = 300, kBeams = 96;
  std::vector<double> angles(kBeams), ranges(kBeams);
  for (int i = 0; i < kBeams; ++i) angles[static_cast<std::size_t>(i)] = 2 * kPi * i / kBeams;
  std::vector<mjtNum> directions(3 * kBeams), expected(kBeams);
  std::vector<int> geoms(kBeams);
  Stream draw(4, 0, "poses");
  int met = 0;
  for (int k = 0; k < kPoses; ++k) {
    const Pose2 X_GS{draw.Uniform(0, 9), draw.Uniform(0, 7), draw.Uniform(-kPi, kPi)};
    CastScan(walls, X_GS, kHeight_m, angles, kMost_m, ranges);
    const Pose2 X_WS = map.frame.X_WG * X_GS;
    for (int i = 0; i < kBeams; ++i) {
      const double yaw = X_WS.yaw_rad + angles[static_cast<std::size_t>(i)];
      directions[3 * static_cast<std::size_t>(i)] = std::cos(yaw);
      directions[3 * static_cast<std::size_t>(i) + 1] = std::sin(yaw);
    }
    const mjtNum from[3] = {X_WS.x_m, X_WS.y_m, kHeight_m};
    mj_multiRay(scene.model.get(), data.get(), from, directions.data(), nullptr, 1, scene.base_body,
                geoms.data(), expected.data(), nullptr, kBeams, 100);
    for (std::size_t i = 0; i < kBeams; ++i) {
      // The robot's own wheels are bodies of their own: no ray of the map meets them.
      if (geoms[i] >= 0 &&
          scene.roles[static_cast<std::size_t>(geoms[i])].kind != GeomRole::Kind::kWall)
        continue;
      if (expected[i] >= 0 && expected[i] <= kMost_m) {
        ++met;
        EXPECT_NEAR(ranges[i], expected[i], 1e-6) << "pose " << k << " beam " << i;
      } else {
        EXPECT_EQ(ranges[i], std::numeric_limits<double>::infinity());
      }
    }
  }
  EXPECT_GT(met, kPoses * kBeams / 2);
}

}  // namespace
}  // namespace floorproof

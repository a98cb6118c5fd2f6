// SPDX-License-Identifier: Apache-2.0
// Rays meet what they would meet if the physics held all walls.
#include "env/sensors/rays.h"

#include <cmath>

#include "tests/sensors/sensor_rig.h"

namespace floorproof {
namespace {

HazardMap RoomsAndPillars() {
  HazardMap map;
  map.frame = {90, 70, 0.1, {1.3, -2.1, 0.4}};
  map.occupancy = Grid<CellState>(90, 70);
  map.inset_m = 0.015;
  Stream draw(4, 0, "cells");
  for (int k = 0; k < 300; ++k)
    map.occupancy(static_cast<int>(draw.Below(90)), static_cast<int>(draw.Below(70))) =
        CellState::kOccupied;
  for (int iy = 0; iy < 70; ++iy)
    if (iy % 30 > 11) map.occupancy(45, iy) = CellState::kOccupied;
  return map;
}

TEST(Rays, MeetWhatTheWholeSceneHolds) {
  const HazardMap map = RoomsAndPillars();
  const RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  const Pose2 start = map.frame.X_WG * Pose2{1.05, 1.05, 0};
  const Scene near = BuildScene(map, robot, {}, start);
  const Scene whole = BuildScene(map, robot, {}, start, WallSet::kAll);
  ASSERT_GT(near.pool.num, 0);
  const DataPtr near_data = MakeData(near.model.get()), whole_data = MakeData(whole.model.get());
  ForwardEngine(near.model.get(), near_data.get());
  ForwardEngine(whole.model.get(), whole_data.get());

  constexpr double kMax_m = 8;
  constexpr std::size_t kBeams = 96;
  Rays rays(near), all(whole);
  std::vector<double> directions(3 * kBeams);
  std::vector<RayHit> hits(kBeams), expected(kBeams);
  Stream draw(4, 0, "poses");
  int met = 0;
  for (int k = 0; k < 300; ++k) {
    const Pose2 X_WS =
        map.frame.X_WG * Pose2{draw.Uniform(0, 9), draw.Uniform(0, 7), draw.Uniform(-kPi, kPi)};
    const double up_rad = draw.Uniform(-0.05, 0.05);  // a robot that tilts
    for (std::size_t i = 0; i < kBeams; ++i) {
      const double yaw = X_WS.yaw_rad + 2 * kPi * static_cast<double>(i) / kBeams;
      const Vec3 way(std::cos(up_rad) * std::cos(yaw), std::cos(up_rad) * std::sin(yaw),
                     std::sin(up_rad));
      std::copy_n(way.data(), 3, &directions[3 * i]);
    }
    const Vec3 from(X_WS.x_m, X_WS.y_m, 0.2);
    rays.CastAll(near_data.get(), from, directions, kMax_m, hits);
    all.CastAll(whole_data.get(), from, directions, kMax_m, expected);
    for (std::size_t i = 0; i < kBeams; ++i) {
      met += expected[i].hits();
      if (expected[i].hits()) {
        EXPECT_NEAR(hits[i].range_m, expected[i].range_m, 1e-6) << "pose " << k << " beam " << i;
      } else {
        EXPECT_FALSE(hits[i].hits()) << "pose " << k << " beam " << i;
      }
      const RayHit one = rays.Cast(near_data.get(), from, Vec3(&directions[3 * i]), kMax_m);
      EXPECT_EQ(one.range_m, hits[i].range_m);
    }
  }
  EXPECT_GT(met, 300 * static_cast<int>(kBeams) / 2);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The lidar's ranges against geometry, its noise against what is stated, what it cannot see.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/robots.h"
#include "tests/sensors/sensor_rig.h"

namespace floorproof {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();
constexpr const char* kExact = "{noise_m: 0, noise_share: 0, dropout: 0, least_m: 0}";

// Distance from a point within a rectangle to its edge.
double ToEdge(const Vec2& p, double yaw_rad, const Vec2& low, const Vec2& high) {
  const Vec2 way(std::cos(yaw_rad), std::sin(yaw_rad));
  double least = kNothing;
  for (int k = 0; k < 2; ++k) {
    if (way[k] > 1e-12) least = std::min(least, (high[k] - p[k]) / way[k]);
    if (way[k] < -1e-12) least = std::min(least, (low[k] - p[k]) / way[k]);
  }
  return least;
}

// The beam that looks along this heading of the world.
std::size_t BeamAlong(const Observation& sensed, double body_yaw_rad, double yaw_rad) {
  std::size_t best = 0;
  const auto off = [&](std::size_t i) {
    return std::abs(WrapAngle(sensed.scan.angle_rad[i] + body_yaw_rad - yaw_rad));
  };
  for (std::size_t i = 1; i < sensed.scan.angle_rad.size(); ++i)
    if (off(i) < off(best)) best = i;
  return best;
}

TEST(Lidar, RangesAreThoseOfTheRoomToAMillimetre) {
  for (const std::string& robot : RobotNames()) {
    SensorRig rig(Room(6, 4), robot, {2, 2, 0});
    rig.Carry(MakeSensor("lidar", kExact));
    int told = 0;
    for (const Pose2& pose :
         {Pose2{2, 2, 0}, Pose2{3.3, 1.7, 0.4}, Pose2{6.1, 4.2, -2}, Pose2{4, 3, kPi / 2}}) {
      rig.Put(pose);
      rig.Carry(MakeSensor("lidar", kExact));
      const LidarScan& scan = rig.Sense().scan;
      ASSERT_EQ(scan.range_m.size(), 90u);
      const Pose2 X_WL = pose * scan.X_BL;
      for (std::size_t i = 0; i < scan.range_m.size(); ++i, ++told)
        EXPECT_NEAR(scan.range_m[i],
                    ToEdge(X_WL.p(), X_WL.yaw_rad + scan.angle_rad[i], Vec2(1, 1), Vec2(7, 5)),
                    0.001)
            << robot << " beam " << i;
    }
    EXPECT_EQ(told, 360);
  }
}

TEST(Lidar, TurnsAtItsRate) {
  SensorRig rig(Room(4, 4), "beluga", {3, 3, 0});
  rig.Carry(MakeSensor("lidar", "{rate_hz: 5}"));
  int turns = rig.Sense().scan.fresh;
  for (int i = 0; i < 100; ++i) turns += rig.Drive({}).scan.fresh;
  EXPECT_EQ(turns, 11) << "in two seconds, the first at once";
}

TEST(Lidar, NoiseIsAsStated) {
  SensorRig rig(Room(4, 4), "beluga", {3, 3, 0});
  rig.Carry(MakeSensor("lidar",
                       "{beams: 1, rate_hz: 50, noise_m: 0.01, noise_share: 0.02, "
                       "dropout: 0.1}"));
  const double truth_m = 2, sd_m = 0.01 + 0.02 * truth_m;
  double sum = 0, square = 0;
  int n = 0, lost = 0;
  constexpr int kTurns = 4000;
  for (int i = 0; i < kTurns; ++i) {
    const double range_m = rig.Drive({}).scan.range_m[0];
    if (!std::isfinite(range_m)) {
      ++lost;
      continue;
    }
    ++n;
    sum += range_m - truth_m;
    square += (range_m - truth_m) * (range_m - truth_m);
  }
  // Five standard errors.
  EXPECT_NEAR(sum / n, 0, 5 * sd_m / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(square / n), sd_m, 5 * sd_m / std::sqrt(2.0 * n));
  EXPECT_NEAR(lost, 0.1 * kTurns, 5 * std::sqrt(kTurns * 0.1 * 0.9));
}

TEST(Lidar, TheSameSeedTellsTheSame) {
  const auto ranges = [](std::uint64_t seed) {
    SensorRig rig(Room(4, 4), "beluga", {3, 3, 0});
    rig.Carry(MakeSensor("lidar"), seed);
    return rig.Sense().scan.range_m;
  };
  EXPECT_EQ(ranges(1), ranges(1));
  EXPECT_NE(ranges(1), ranges(2));
}

TEST(Lidar, GlassIsSeenOnlyHeadOn) {
  HazardMap map = Room(6, 4);
  map.hazards = {Block(HazardClass::kGlass, {4, 1}, {4.01, 5}, 2)};
  SensorRig rig(map, "beluga", {2, 3, 0});
  rig.Carry(MakeSensor("lidar",
                       "{beams: 360, noise_m: 0, noise_share: 0, dropout: 0, "
                       "glass_angle_deg: 4.5}"));
  const Observation& sensed = rig.Sense();
  const auto along = [&](double deg) {
    return sensed.scan.range_m[BeamAlong(sensed, 0, deg * kPi / 180)];
  };
  EXPECT_NEAR(along(0), 2, 1e-3);
  EXPECT_NEAR(along(4), 2 / std::cos(4 * kPi / 180), 1e-3);
  EXPECT_NEAR(along(5), 5 / std::cos(5 * kPi / 180), 1e-3) << "the wall behind";
  EXPECT_NEAR(along(-20), 5 / std::cos(20 * kPi / 180), 1e-3);
}

TEST(Lidar, WhatIsLowIsNotSeen) {
  for (const auto& [height_m, seen] : {std::pair(0.3, false), {0.4, true}}) {
    HazardMap map = Room(6, 4);
    map.hazards = {Block(HazardClass::kBlindObject, {4, 2}, {4.5, 4}, height_m)};
    SensorRig rig(map, "beluga", {2, 3, 0});  // its plane is at 0.335 m
    rig.Carry(MakeSensor("lidar", kExact));
    EXPECT_NEAR(rig.Sense().scan.range_m[0], seen ? 2 : 5, 1e-3) << height_m;
  }
}

TEST(Lidar, DarkThingsAreSeenLessFar) {
  HazardMap map = Room(20, 4);
  map.hazards = {Block(HazardClass::kBlindObject, {12, 2}, {12.5, 4}, 1)};
  map.hazards[0].material.reflectance = 0.16;
  SensorRig rig(map, "beluga", {2, 3, 0});
  const std::string ten = "{noise_m: 0, noise_share: 0, dropout: 0, range_m: 20}";
  rig.Carry(MakeSensor("lidar", ten));
  EXPECT_EQ(rig.Sense().scan.range_m[0], kNothing) << "10 m, of which it sees 20 sqrt(0.16) = 8";
  rig.Put({4.5, 3, 0});
  rig.Carry(MakeSensor("lidar", ten));
  EXPECT_NEAR(rig.Sense().scan.range_m[0], 7.5, 1e-3);
}

// A large map's walls stand in the map, not in the model.
TEST(Lidar, LargeMapsAreSeenAsSmallOnes) {
  HazardMap map = Room(30, 30, 0.1);
  for (int k = 0; k < 200; ++k)
    map.occupancy(40 + (k * 53) % 230, 30 + (k * 37) % 250) = CellState::kOccupied;
  SensorRig rig(map, "beluga", {16, 16, 0.3});
  ASSERT_GT(rig.scene().pool.num, 0);
  rig.Carry(
      MakeSensor("lidar", "{noise_m: 0, noise_share: 0, dropout: 0, least_m: 0, beams: 720}"));
  const LidarScan& scan = rig.Sense().scan;
  const Pose2 X_WL = Pose2{16, 16, 0.3} * scan.X_BL;
  int walls = 0;
  for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
    const double edge_m = ToEdge(X_WL.p(), X_WL.yaw_rad + scan.angle_rad[i], {1, 1}, {31, 31});
    EXPECT_LE(scan.range_m[i], edge_m + 0.001);
    walls += scan.range_m[i] > edge_m - 0.001;
  }
  EXPECT_GT(walls, 300);
  EXPECT_LT(walls, 720) << "pillars are seen, too";
}

TEST(Lidar, BeamsThatMeetTheRobotItselfAreRefused) {
  SensorRig rig(Room(4, 4), "beluga", {3, 3, 0});
  try {
    rig.Carry(MakeSensor("lidar", "{z_m: 0.1}"));
    FAIL() << "the lidar is within the belly";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("sensors.lidar.z_m = 0.1: the robot itself is in"));
  }
  EXPECT_NO_THROW(rig.Carry(MakeSensor("lidar", "{z_m: 0.5}")));
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The particle filter on scans of a drawn room, without physics.
#include "controllers/particle_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "controllers/odometry.h"
#include "tests/controllers/allocation_guard.h"

namespace floorproof {
namespace {

// 8 m x 6 m with a corner cut off and a pillar: no turn or mirror brings it onto itself.
HazardMap LRoom() {
  HazardMap map;
  map.frame = {90, 70, 0.1, {}};
  map.occupancy = Grid<CellState>(90, 70, CellState::kOccupied);
  for (int iy = 5; iy < 65; ++iy)
    for (int ix = 5; ix < 85; ++ix) map.occupancy(ix, iy) = CellState::kFree;
  for (int iy = 40; iy < 65; ++iy)
    for (int ix = 60; ix < 85; ++ix) map.occupancy(ix, iy) = CellState::kOccupied;
  for (int iy = 20; iy < 24; ++iy)
    for (int ix = 24; ix < 28; ++ix) map.occupancy(ix, iy) = CellState::kOccupied;
  return map;
}

LidarScan ScanFrom(const HazardMap& map, const Pose2& X_WB, double noise_m, Stream& draws) {
  LidarScan scan;
  scan.fresh = true;
  scan.most_m = 12;
  for (int i = 0; i < 90; ++i) {
    const double a = WrapAngle(2 * kPi * i / 90);
    const Vec2 way(std::cos(X_WB.yaw_rad + a), std::sin(X_WB.yaw_rad + a));
    double range_m = 0;
    while (range_m < scan.most_m && !map.IsWall(map.frame.ToCell(X_WB.p() + range_m * way)))
      range_m += 0.005;
    scan.angle_rad.push_back(a);
    scan.range_m.push_back(range_m + noise_m * draws.Normal());
  }
  return scan;
}

double Off(const Pose2& a, const Pose2& b) { return (a.p() - b.p()).norm(); }

// A round of the room; returns the estimate's errors after each step.
std::vector<double> Track(ParticleFilter& filter, const HazardMap& map,
                          const LikelihoodField& field, Pose2 truth, int steps,
                          double way_error = 0) {
  Stream noise(7, 0, "scans"), draws(8, 0, "motion");
  std::vector<double> errors;
  for (int i = 0; i < steps; ++i) {
    const BodyTwist twist{0.1, 0, i % 40 < 20 ? 0.08 : -0.08};
    truth = Moved(truth, twist, 1);
    Pose2 told = Moved({}, twist, 1);
    told.x_m *= 1 + way_error;
    filter.Move(told);
    filter.Weigh(field, ScanFrom(map, truth, 0.01, noise));
    errors.push_back(Off(filter.Best(), truth));
  }
  return errors;
}

TEST(ParticleFilter, FindsThePoseWithinAGuess) {
  const HazardMap map = LRoom();
  const LikelihoodField field(map, 0.3);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    ParticleFilter filter({}, map, Stream(seed, 0, "mcl"));
    const Pose2 truth{2, 4, 0};
    filter.StartAround({2.35, 3.7, 0.3}, 0.5, 0.35);
    EXPECT_GT(filter.position_std_m(), 0.4);
    const auto errors = Track(filter, map, field, truth, 30, 0.05);
    for (std::size_t i = 15; i < errors.size(); ++i)
      EXPECT_LT(errors[i], 0.1) << "seed " << seed << " step " << i;
    EXPECT_LT(filter.position_std_m(), 0.1);
  }
}

TEST(ParticleFilter, FewerParticlesDoOnceItIsSure) {
  const HazardMap map = LRoom();
  const LikelihoodField field(map, 0.3);
  FilterParams params;
  params.most = 3000;
  ParticleFilter filter(params, map, Stream(1, 0, "mcl"));
  filter.StartAnywhere();
  EXPECT_EQ(filter.size(), 3000u);
  Track(filter, map, field, {2, 4, 0}, 30);
  EXPECT_LT(filter.size(), 600u);
  EXPECT_GE(filter.size(), 100u);
}

TEST(ParticleFilter, FindsThePoseFromAnywhere) {
  const HazardMap map = LRoom();
  const LikelihoodField field(map, 0.3);
  FilterParams params;
  params.most = 5000;
  int found = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    ParticleFilter filter(params, map, Stream(seed, 0, "mcl"));
    filter.StartAnywhere();
    found += Track(filter, map, field, {2, 4, 0}, 40).back() < 0.15;
  }
  EXPECT_GE(found, 9);
}

// Carried to another place, as by a person's hand.
TEST(ParticleFilter, RecoversWhenItWasCarriedAway) {
  const HazardMap map = LRoom();
  const LikelihoodField field(map, 0.3);
  int recovered = 0, without = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    for (const bool recovery : {true, false}) {
      FilterParams params;
      params.most = 3000;
      if (!recovery) params.recover_slow = params.recover_fast = 0;
      ParticleFilter filter(params, map, Stream(seed, 0, "mcl"));
      filter.StartAround({2, 4, 0}, 0.2, 0.1);
      Track(filter, map, field, {2, 4, 0}, 15);
      const bool back = Track(filter, map, field, {4.5, 1.5, 0}, 33).back() < 0.15;
      (recovery ? recovered : without) += back;
    }
  EXPECT_GE(recovered, 5);
  EXPECT_LT(without, recovered / 2);
}

TEST(ParticleFilter, AllocatesNothingWhileItTracks) {
  const HazardMap map = LRoom();
  const LikelihoodField field(map, 0.3);
  ParticleFilter filter({}, map, Stream(1, 0, "mcl"));
  filter.StartAround({2, 4, 0}, 0.3, 0.2);
  Stream noise(7, 0, "scans");
  const LidarScan scan = ScanFrom(map, {2, 4, 0}, 0.01, noise);
  filter.Weigh(field, scan);
  const std::int64_t before = AllocationCount();
  for (int i = 0; i < 20; ++i) {
    filter.Move({0.05, 0, 0});
    filter.Weigh(field, scan);
  }
  EXPECT_EQ(AllocationCount(), before);
}

TEST(Moved, FollowsTheArc) {
  const Pose2 quarter = Moved({1, 2, 0}, {kPi / 2, 0, kPi / 2}, 1);  // a circle of 1 m
  EXPECT_NEAR(quarter.x_m, 2, 1e-12);
  EXPECT_NEAR(quarter.y_m, 3, 1e-12);
  EXPECT_NEAR(quarter.yaw_rad, kPi / 2, 1e-12);
  const Pose2 straight = Moved({1, 2, kPi / 2}, {0.5, 0.1, 0}, 2);
  EXPECT_NEAR(straight.x_m, 0.8, 1e-12);
  EXPECT_NEAR(straight.y_m, 3, 1e-12);
}

}  // namespace
}  // namespace floorproof

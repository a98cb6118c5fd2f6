// SPDX-License-Identifier: Apache-2.0
// What the places near walls say of the floor near walls, behind a cleaner that leaves a strip
// there: dirt depends on the distance from the wall, and so on where the places lie.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "env/audit/brush.h"
#include "env/audit/space_score.h"
#include "env/audit/tape.h"
#include "planners/audit/find_samples.h"
#include "stats/student.h"
#include "tests/audit/audit_floors.h"

namespace floorproof {
namespace {

constexpr double kSide_m = 4.6, kCell_m = 0.05, kNear_m = 0.3;
constexpr int kBand = 5;  // cells from a wall whose middles lie within kNear_m of the wall's cells
constexpr int kAudits = 100;

Shape2 Brush() {
  Shape2 disc;
  disc.radius_m = 0.085;
  return disc;
}

class JitteredSamples : public ::testing::TestWithParam<double> {
 protected:
  JitteredSamples() {
    const int n = static_cast<int>(std::lround(kSide_m / kCell_m));
    HazardMap map = testing::BareRoom(kSide_m + 2 * kCell_m, kSide_m + 2 * kCell_m);
    testing::AddWall(map, 0, 0, n + 1, 0);
    testing::AddWall(map, 0, n + 1, n + 1, n + 1);
    testing::AddWall(map, 0, 0, 0, n + 1);
    testing::AddWall(map, n + 1, 0, n + 1, n + 1);
    floor_ = LayDirt(map, {}, 1);
    Stream random(1, 0, "cleaning");
    std::vector<Pose2> poses = testing::ZigZag(kSide_m, kSide_m, 0.22, 0.17);
    for (Pose2& X_WB : poses) X_WB.x_m += kCell_m, X_WB.y_m += kCell_m;
    for (int round = 0; round < 5; ++round) CleanAlong(floor_, Brush(), poses, {}, random);

    room_.frame = map.frame;
    room_.pixels = Grid<std::uint8_t>(n + 2, n + 2, kOccupiedPixel);
    room_.inside = Grid<std::uint8_t>(n + 2, n + 2);
    reach_ = Grid<float>(n + 2, n + 2, 1);
    double particles = 0, cells = 0;
    for (int iy = 1; iy <= n; ++iy)
      for (int ix = 1; ix <= n; ++ix) {
        room_.pixels(ix, iy) = kFreePixel;
        room_.inside(ix, iy) = 1;
        if (std::min({ix - 1, iy - 1, n - ix, n - iy}) >= kBand) continue;
        ++cells;
        // The field's bins are the map's cells.
        particles += static_cast<double>(floor_.CountIn(ix, iy));
      }
    near_share_ = cells / (1.0 * n * n);
    truth_ = particles / (cells * kCell_m * kCell_m) * tape_.side_m * tape_.side_m;
  }

  SpaceScore NearWalls(bool jitter, std::uint64_t seed) const {
    SampleParams params;
    params.du_m = GetParam();
    params.boundary_m = kNear_m;
    params.corner_m = 0.001;  // none
    params.jitter = jitter;
    const FoundSamples found = FindSamples(room_, reach_, 0.36, params, seed);
    EXPECT_EQ(found.why, "");
    EXPECT_NEAR(found.parts.near_walls, near_share_, 1e-9);
    EXPECT_NEAR(found.parts.elsewhere, 1 - near_share_, 1e-9);
    EXPECT_EQ(found.parts.by_chance, jitter);
    DirtField field = floor_;
    Stream random(seed, 0, "lift");
    Stratum near{1, {}};
    for (const SamplePlace& place : found.places)
      if (place.kinds.near_walls())
        near.scores.push_back(static_cast<double>(
            LiftTape(field, {place.p_W.x(), place.p_W.y(), 0}, tape_, random).size()));
    return ScoreOfSpace({&near, 1});
  }
  static Interval IntervalOf(const SpaceScore& score) {
    return StudentInterval(*score.mean, *score.standard_error, score.degrees_of_freedom, 0.95);
  }

  TapeParams tape_;
  DirtField floor_{testing::BareRoom(1, 1)};
  Room room_;
  Grid<float> reach_;  // everywhere
  double near_share_ = 0;
  double truth_ = 0;  // particles below a tape that lies anywhere near walls
};

TEST_P(JitteredSamples, TheirMeanIsThatOfTheFloorNearWallsAndTheIntervalHoldsIt) {
  // Those of the lattice speak for their distance from the wall alone.
  EXPECT_FALSE(IntervalOf(NearWalls(false, 1)).Contains(truth_));
  std::vector<double> means;
  int holds = 0;
  double width = 0, mean = 0;
  for (int i = 0; i < kAudits; ++i) {
    const SpaceScore score = NearWalls(true, static_cast<std::uint64_t>(i));
    const Interval interval = IntervalOf(score);
    holds += interval.Contains(truth_);
    width += (interval.upper - interval.lower) / kAudits;
    means.push_back(*score.mean);
    mean += *score.mean / kAudits;
  }
  double squares = 0;
  for (const double m : means) squares += (m - mean) * (m - mean);
  const double error = std::sqrt(squares / (kAudits - 1) / kAudits);
  // A ratio of two chances, particles to places, is off by a little on the mean (Cochran
  // 1977, 6.8).
  EXPECT_NEAR(mean, truth_, 0.015 * truth_ + 3 * error);
  EXPECT_LT(error, 0.02 * truth_);
  EXPECT_GE(1.0 * holds / kAudits, 0.88);  // 0.95, less three standard deviations
  EXPECT_LT(width, 0.7 * truth_);          // an interval that says nothing would hold it always
}

INSTANTIATE_TEST_SUITE_P(Intervals, JitteredSamples, ::testing::Values(0.3, 0.35, 0.4));

}  // namespace
}  // namespace floorproof

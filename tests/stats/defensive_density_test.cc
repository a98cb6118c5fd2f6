// SPDX-License-Identifier: Apache-2.0
#include "stats/rare/defensive_density.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stats/rare/subset_pilot.h"

namespace floorproof {
namespace {

// Failures around (4, 1), as pilots may leave them that lost all other sides.
class DefensiveDensityTest : public testing::TestWithParam<bool> {
 protected:
  DefensiveDensityTest() {
    for (Eigen::Index i = 0; i < points_.u.cols(); ++i)
      points_.u.col(i) = Eigen::Vector2d(4, 1) + 0.3 * NormalVector(stream_, 2);
    points_.weights.setOnes();
  }
  Stream stream_{3, 0, "test"};
  WeightedPoints points_{Eigen::MatrixXd(2, 100), Eigen::VectorXd(100)};
};

// Draws weighted are draws as they come: of any event the weights' mean is its probability.
TEST_P(DefensiveDensityTest, WeightsGiveProbabilitiesBack) {
  const FailureMixture mixture(points_, false, stream_);
  const DefensiveDensity density(mixture, 2, GetParam());
  constexpr int kDraws = 200'000;
  double all = 0, left = 0, left_squares = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::VectorXd u = density.DrawFrom(stream_).u;
    const double weight = density.Weight(u);
    ASSERT_LE(weight, DefensiveDensity::kMostWeight * (1 + 1e-12));
    all += weight;
    if (u[0] > -3) continue;
    left += weight;
    left_squares += weight * weight;
  }
  EXPECT_NEAR(all / kDraws, 1, 0.02);
  const double truth = 0.5 * std::erfc(3 / std::sqrt(2.0));
  EXPECT_NEAR(left / kDraws, truth, 4 * std::sqrt(left_squares) / kDraws);
}

INSTANTIATE_TEST_SUITE_P(Mirrored, DefensiveDensityTest, testing::Bool());

// One coordinate's other sign, and all of them.
TEST_F(DefensiveDensityTest, MirroredItLooksOnTheOtherSides) {
  const FailureMixture mixture(points_, false, stream_);
  const Eigen::Vector2d sides[] = {{-4, 1}, {4, -1}, {-4, -1}};
  for (const bool mirrored : {false, true}) {
    const DefensiveDensity density(mixture, 2, mirrored);
    int near[3] = {};
    for (int i = 0; i < 3000; ++i) {
      const Eigen::VectorXd u = density.DrawFrom(stream_).u;
      for (int s = 0; s < 3; ++s) near[s] += (u - sides[s]).norm() < 0.5;
    }
    // 3,000 draws, 0.8 by failures, a quarter mirrored, three mirrors: 200 each, half of them near.
    for (const int draws : near) EXPECT_EQ(draws > 60, mirrored) << draws;
  }
}

}  // namespace
}  // namespace floorproof

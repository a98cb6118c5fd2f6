// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/dubins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace floorproof {
namespace {

constexpr double kR_m = 0.4;

double Shortest(const Pose2& from, const Pose2& to) {
  const DubinsCurves dut = CurvesBetween(from, to, kR_m);
  return dut.n > 0 ? dut.curves[0].Length() : std::nan("");
}

TEST(Dubins, LengthsInClosedForm) {
  EXPECT_NEAR(Shortest({}, {1.5, 0, 0}), 1.5, 1e-12) << "straight on";
  EXPECT_NEAR(Shortest({}, {0, 2 * kR_m, kPi}), kPi * kR_m, 1e-12) << "a half circle";
  EXPECT_NEAR(Shortest({}, {kR_m, kR_m, kPi / 2}), kPi / 2 * kR_m, 1e-12) << "a quarter";
  EXPECT_NEAR(Shortest({}, {0, 5 * kR_m, kPi}), kPi * kR_m + 3 * kR_m, 1e-12)
      << "two quarters and what lies between";
  // On the spot, the other way round: three circles that touch, 60, 300 and 60 deg.
  EXPECT_NEAR(Shortest({}, {0, 0, kPi}), 7 * kPi / 3 * kR_m, 1e-12);
  EXPECT_NEAR(Shortest({}, {2 * kR_m, 2 * kR_m, 0}), kPi * kR_m, 1e-9) << "two quarters, an S";
}

class RandomPoses : public ::testing::TestWithParam<unsigned> {
 protected:
  RandomPoses() : draws_(GetParam()) {}
  Pose2 Draw() {
    const double x = place_(draws_), y = place_(draws_);
    return {x, y, angle_(draws_)};
  }
  std::mt19937 draws_;
  std::uniform_real_distribution<double> place_{-2, 2}, angle_{-kPi, kPi};
};

// Every curve ends at its pose, and turns no more tightly than the radius.
TEST_P(RandomPoses, CurvesEndWhereTheyShallOnArcsOfTheRadius) {
  for (int k = 0; k < 300; ++k) {
    const Pose2 from = Draw(), to = Draw();
    const DubinsCurves dut = CurvesBetween(from, to, kR_m);
    ASSERT_GE(dut.n, 4);
    for (int c = 0; c < dut.n; ++c) {
      const DubinsCurve& curve = dut.curves[static_cast<std::size_t>(c)];
      const Pose2 end = curve.At(curve.Length() + 1e-9);
      EXPECT_NEAR((end.p() - to.p()).norm(), 0, 1e-9);
      EXPECT_NEAR(WrapAngle(end.yaw_rad - to.yaw_rad), 0, 1e-9);
      constexpr double kStep_m = 0.01;
      Pose2 before = curve.At(0);
      EXPECT_EQ(before, from);
      for (double s_m = kStep_m; s_m <= curve.Length(); s_m += kStep_m) {
        const Pose2 at = curve.At(s_m);
        EXPECT_LE(std::abs(WrapAngle(at.yaw_rad - before.yaw_rad)), kStep_m / kR_m + 1e-9);
        EXPECT_LE((at.p() - before.p()).norm(), kStep_m + 1e-9);
        EXPECT_GE((at.p() - before.p()).norm(), 0.999 * kStep_m) << "it moves along its heading";
        before = at;
      }
      const CurvePlaces places(curve);
      for (int i = 0; i <= 20; ++i) {
        const double s_m = 0.05 * i * curve.Length();
        EXPECT_LE((places.At(s_m) - curve.At(s_m).p()).norm(), 1e-12);
      }
      if (c > 0) {
        EXPECT_GE(curve.Length(), dut.curves[static_cast<std::size_t>(c - 1)].Length());
      }
    }
  }
}

// Mirrored poses have mirrored curves; a way driven backwards is as long.
TEST_P(RandomPoses, MirroredAndReversedWaysAreAsLong) {
  const auto mirrored = [](const Pose2& p) { return Pose2{p.x_m, -p.y_m, -p.yaw_rad}; };
  const auto about = [](const Pose2& p) { return Pose2{p.x_m, p.y_m, WrapAngle(p.yaw_rad + kPi)}; };
  for (int k = 0; k < 300; ++k) {
    const Pose2 from = Draw(), to = Draw();
    const double length_m = Shortest(from, to);
    EXPECT_NEAR(Shortest(mirrored(from), mirrored(to)), length_m, 1e-9);
    EXPECT_NEAR(Shortest(about(to), about(from)), length_m, 1e-9);
    EXPECT_GE(length_m, (to.p() - from.p()).norm() - 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomPoses, ::testing::Values(1u, 2u, 3u));

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "env/audit/space_score.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/error.h"

namespace floorproof {
namespace {

SpaceScore Of(const std::vector<Stratum>& strata) { return ScoreOfSpace(strata); }

TEST(SpaceScore, OfOneStratumIsTheMeanAndItsStandardError) {
  const SpaceScore dut = Of({{3, {0.9, 0.8, 1.0, 0.7}}});
  EXPECT_EQ(dut.samples, 4);
  EXPECT_EQ(dut.represented, 1);
  EXPECT_NEAR(*dut.mean, 0.85, 1e-12);
  EXPECT_NEAR(*dut.standard_error, std::sqrt(0.05 / 3 / 4), 1e-12);
  EXPECT_NEAR(dut.degrees_of_freedom, 3, 1e-9);
}

TEST(SpaceScore, StrataCountByTheirWeightAndNotByTheirSamples) {
  // Three dirty samples near walls, which are a quarter of the floor.
  const SpaceScore dut = Of({{1, {0.5, 0.6, 0.7}}, {3, {0.9, 1.0}}});
  EXPECT_NEAR(*dut.mean, 0.25 * 0.6 + 0.75 * 0.95, 1e-12);
  // Cochran's (5.6): the sum of (share^2 s^2 / n).
  const double near_walls = 0.0625 * 0.01 / 3, elsewhere = 0.5625 * 0.005 / 2;
  EXPECT_NEAR(*dut.standard_error, std::sqrt(near_walls + elsewhere), 1e-12);
  // (5.16): between the fewest that a stratum has and those of all.
  const double sum = near_walls + elsewhere;
  EXPECT_NEAR(dut.degrees_of_freedom,
              sum * sum / (near_walls * near_walls / 2 + elsewhere * elsewhere), 1e-9);
  EXPECT_GT(dut.degrees_of_freedom, 1);
  EXPECT_LT(dut.degrees_of_freedom, 3);
}

TEST(SpaceScore, OfPartsWithoutSamplesNothingIsSaid) {
  const SpaceScore dut = Of({{1, {0.5, 0.7}}, {3, {}}});
  EXPECT_NEAR(*dut.mean, 0.6, 1e-12);
  EXPECT_NEAR(dut.represented, 0.25, 1e-12);
  EXPECT_FALSE(Of({}).mean);
  EXPECT_FALSE(Of({{1, {}}}).mean);
  EXPECT_EQ(Of({{1, {}}}).represented, 0);
}

TEST(SpaceScore, OneSampleOfAStratumGivesNoError) {
  const SpaceScore dut = Of({{1, {0.5, 0.7}}, {3, {0.9}}});
  EXPECT_NEAR(*dut.mean, 0.25 * 0.6 + 0.75 * 0.9, 1e-12);
  EXPECT_FALSE(dut.standard_error);
  // One that counts for nothing is no reason.
  EXPECT_TRUE(Of({{1, {0.5, 0.7}}, {0, {0.9}}}).standard_error);
}

TEST(SpaceScore, SamplesThatAreAllAlikeHaveNoError) {
  const SpaceScore dut = Of({{1, {0.9, 0.9}}, {1, {0.9, 0.9, 0.9}}});
  EXPECT_EQ(*dut.standard_error, 0);
  EXPECT_EQ(dut.degrees_of_freedom, 3);
}

TEST(SpaceScore, AWeightIsANumber) {
  EXPECT_THROW(Of({{-1, {0.5}}}), InputError);
  EXPECT_THROW(Of({{std::nan(""), {0.5}}}), InputError);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "stats/equal_bins.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "base/error.h"

namespace floorproof {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::size_t> Bins(const std::vector<double>& values, int most) {
  return EqualBins(values, most);
}

TEST(EqualBins, HoldAsManyEach) {
  std::vector<double> values(80);
  std::iota(values.begin(), values.end(), 0.0);
  EXPECT_THAT(Bins(values, 8), ElementsAre(10, 20, 30, 40, 50, 60, 70, 80));
  values.resize(10);
  EXPECT_THAT(Bins(values, 3), ElementsAre(3, 6, 10));
  EXPECT_THAT(Bins(values, 1), ElementsAre(10));
}

TEST(EqualBins, AFewDistinctValuesHaveOneEach) {
  EXPECT_THAT(Bins({1, 1, 1, 1, 2, 3, 3}, 3), ElementsAre(4, 5, 7));
  EXPECT_THAT(Bins({5, 5}, 8), ElementsAre(2));
  EXPECT_THAT(Bins({}, 8), IsEmpty());
}

TEST(EqualBins, EqualValuesStayTogether) {
  EXPECT_THAT(Bins({1, 2, 2, 2, 2, 3, 4, 5}, 2), ElementsAre(5, 8)) << "the nearer side of the 2s";
  EXPECT_THAT(Bins({0, 0, 0, 0, 0, 0, 1, 2}, 2), ElementsAre(6, 8));
  EXPECT_THAT(Bins({-2, -1, 0, 0, 0, 0, 0, 0}, 2), ElementsAre(2, 8));
  EXPECT_THAT(Bins({0, 1, 1, 1, 1, 1, 1, 2}, 2), ElementsAre(1, 8)) << "no bin is empty";
}

TEST(EqualBins, RefusesNoBins) { EXPECT_THROW(Bins({1}, 0), InputError); }

}  // namespace
}  // namespace floorproof

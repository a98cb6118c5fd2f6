// SPDX-License-Identifier: Apache-2.0
#include "base/streams.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace floorproof {
namespace {

TEST(Streams, TheSameNameGivesTheSameDraws) {
  Stream a(7, 3, "site"), b(7, 3, "site");
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.Next(), b.Next());
}

// Neighbours share nothing: seeds, episodes and names are hashed, never added.
TEST(Streams, NeighboursDiffer) {
  std::set<std::uint64_t> first;
  for (std::uint64_t seed = 0; seed < 30; ++seed)
    for (std::uint64_t episode = 0; episode < 30; ++episode)
      for (const char* name : {"site", "lidar", "start"})
        first.insert(Stream(seed, episode, name).Next());
  EXPECT_EQ(first.size(), 30u * 30u * 3u);
}

TEST(Streams, MomentsOfUniformAndNormalDraws) {
  Stream dut(1, 0, "moments");
  constexpr int kDraws = 200000;
  double uniform = 0, normal = 0, square = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double u = dut.Uniform();
    ASSERT_TRUE(u >= 0 && u < 1);
    uniform += u / kDraws;
    const double z = dut.Normal();
    normal += z / kDraws;
    square += z * z / kDraws;
  }
  // Five standard errors each.
  EXPECT_NEAR(uniform, 0.5, 5 * std::sqrt(1.0 / 12 / kDraws));
  EXPECT_NEAR(normal, 0, 5 / std::sqrt(kDraws));
  EXPECT_NEAR(square, 1, 5 * std::sqrt(2.0 / kDraws));
}

TEST(Streams, BelowReachesEachValueAndNoOther) {
  Stream dut(1, 0, "below");
  int count[3] = {};
  for (int i = 0; i < 3000; ++i) ++count[dut.Below(3)];
  for (const int c : count) EXPECT_NEAR(c, 1000, 150);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "env/audit/tape.h"

#include <gtest/gtest.h>

#include "tests/audit/audit_floors.h"

namespace floorproof {
namespace {

using testing::BareRoom;

TEST(Tape, LiftsExactlyWhatIsBelowItTurnedByAnyYaw) {
  for (const Pose2& X_WG : {Pose2{}, Pose2{-0.2, 0.1, 1.1}}) {
    const HazardMap map = BareRoom(0.5, 0.5, 0.05, X_WG);
    DirtField dut = LayDirt(map, {.density_per_m2 = 400'000}, 1);
    for (int turn = 0; turn < 40; ++turn) {
      // Each on floor that the last ones have not touched, often across bins.
      const Vec2 p_W = X_WG * Vec2(0.05 + 0.05 * (turn % 8), 0.05 + 0.07 * (turn / 8));
      const Pose2 X_WT{p_W.x(), p_W.y(), 0.37 * turn};
      std::vector<Vec2> expected;
      for (const Particle& p : dut.All()) {
        const Vec2 p_T = X_WT.Inverse() * p.p_W;
        if (std::abs(p_T.x()) <= 0.01 && std::abs(p_T.y()) <= 0.01) expected.push_back(p_T);
      }
      const auto before = dut.size();
      Stream random(1, 0, "lift");
      const auto lifted = LiftTape(dut, X_WT, {}, random);
      ASSERT_EQ(lifted.size(), expected.size()) << turn;
      EXPECT_EQ(dut.size() + std::ssize(lifted), before);
      for (std::size_t i = 0; i < lifted.size(); ++i)
        EXPECT_LT((lifted[i].p_T - expected[i]).norm(), 1e-9);
      // Nothing is left for a second tape.
      EXPECT_TRUE(LiftTape(dut, X_WT, {}, random).empty());
    }
  }
}

TEST(Tape, HoldsAsManyAsItsAreaOfEvenDirt) {
  DirtField dut = LayDirt(BareRoom(2, 2), {.density_per_m2 = 25'000}, 2);
  Stream random(2, 0, "lift");
  double sum = 0, squares = 0;
  constexpr int kTapes = 40 * 40;
  for (int i = 0; i < kTapes; ++i) {
    const auto n = static_cast<double>(
        LiftTape(dut, {0.05 * (i % 40) + 0.025, 0.05 * (i / 40) + 0.025, 0.1 * i}, {}, random)
            .size());
    sum += n, squares += n * n;
  }
  // Poisson's law: mean and variance 10.
  EXPECT_NEAR(sum / kTapes, 10, 4 * std::sqrt(10.0 / kTapes));
  EXPECT_NEAR(squares / kTapes - sum / kTapes * sum / kTapes, 10, 1.5);
}

TEST(Tape, LiftsItsShare) {
  for (const double share : {0.0, 0.3, 1.0}) {
    DirtField dut = LayDirt(BareRoom(1, 1), {.density_per_m2 = 200'000}, 3);
    Stream random(3, 0, "lift");
    double lifted = 0;
    for (int i = 0; i < 100; ++i)
      lifted += static_cast<double>(LiftTape(dut, {0.1 * (i % 10) + 0.05, 0.1 * (i / 10) + 0.05, 1},
                                             {.side_m = 0.02, .lift = share}, random)
                                        .size());
    EXPECT_NEAR(lifted, 8'000 * share, share == 0 ? 0.0 : 400);
    EXPECT_EQ(dut.size() + std::llround(lifted), 200'000);
  }
}

TEST(Tape, BeyondTheFloorThereIsNothingToLift) {
  DirtField dut = LayDirt(BareRoom(1, 1), {}, 4);
  Stream random(4, 0, "lift");
  EXPECT_TRUE(LiftTape(dut, {-0.5, 0.5, 0}, {}, random).empty());
  EXPECT_TRUE(LiftTape(dut, {1e12, -1e12, 0}, {}, random).empty());
  EXPECT_TRUE(LiftTape(dut, {std::nan(""), 0, 0}, {}, random).empty());
  // Half on it.
  const auto half = LiftTape(dut, {0, 0.5, 0}, {}, random);
  EXPECT_GT(half.size(), 4u);
  for (const LiftedParticle& p : half) EXPECT_GE(p.p_T.x(), 0);
}

}  // namespace
}  // namespace floorproof

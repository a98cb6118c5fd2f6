// SPDX-License-Identifier: Apache-2.0
// What plans that were driven say of what rates come to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/streams.h"
#include "measure/drive_plans.h"
#include "measure/fit_carry_over.h"
#include "measure/plan_floors.h"

namespace floorproof {
namespace {

double Logistic(double eta) { return 1 / (1 + std::exp(-eta)); }

// Plans that fail as the line says, all of a plan's drives alike.
std::vector<Forecast> Plans(int plans, int drives, double intercept, double slope) {
  Stream random(1, 0, "carry_over_test");
  std::vector<Forecast> out;
  for (int i = 0; i < plans; ++i) {
    const double eta = random.Uniform(-5, 3);
    const bool fails = random.Uniform() < Logistic(intercept + slope * eta);
    out.push_back({Logistic(eta), fails ? drives : 0, drives});
  }
  return out;
}

TEST(CarryOver, WithoutPlansChangesNothing) {
  const CarryOver dut = FitCarryOver({});
  for (const double p : {0.0, 1e-9, 0.1, 0.5, 0.99, 1.0}) EXPECT_EQ(dut.Of(p), p);
}

TEST(CarryOver, FindsHowPlansFail) {
  const CarryOver dut = FitCarryOver(Plans(4000, 4, -0.5, 1.4));
  EXPECT_NEAR(dut.intercept, -0.5, 0.15);
  EXPECT_NEAR(dut.slope, 1.4, 0.15);
  EXPECT_EQ(dut.plans, 4000);
  EXPECT_EQ(dut.drives, 16000);
  EXPECT_NEAR(dut.Of(0.5), Logistic(-0.5), 0.05);
  double before = 0;
  for (double p = 0; p <= 1; p += 0.01) {
    EXPECT_GE(dut.Of(p), before);
    before = dut.Of(p);
  }
}

TEST(CarryOver, LeavesWhatIsRightAsItIs) {
  const CarryOver dut = FitCarryOver(Plans(4000, 4, 0, 1));
  for (const double p : {0.02, 0.1, 0.5, 0.9}) EXPECT_NEAR(dut.Of(p), p, 0.15 * p * (1 - p) + 0.01);
}

// What all drives of a plan have in common is seen once, however often it is driven.
TEST(CarryOver, APlanCountsOnce) {
  const CarryOver few = FitCarryOver(Plans(40, 2, -1, 1)),
                  many = FitCarryOver(Plans(40, 200, -1, 1));
  EXPECT_EQ(few.intercept, many.intercept);
  EXPECT_EQ(few.slope, many.slope);
}

// Two plans that failed surprisingly are no reason to doubt thousands of encounters.
TEST(CarryOver, FewPlansChangeLittle) {
  const CarryOver dut = FitCarryOver(std::vector<Forecast>{{0.1, 4, 4}, {0.2, 4, 4}});
  EXPECT_GT(dut.Of(0.1), 0.1);
  EXPECT_LT(dut.Of(0.1), 0.35);
  const CarryOver odd = FitCarryOver(std::vector<Forecast>{{0, 4, 4}, {1, 0, 4}, {0.5, 0, 0}});
  EXPECT_TRUE(std::isfinite(odd.intercept) && std::isfinite(odd.slope));
  EXPECT_GT(odd.slope, 0) << "else it would lead plans to where they fail";
}

TEST(PlanFloors, AreDrawnForTheRobotAndAreTheSameEachTime) {
  const RobotCampaign beluga = PlansOf("beluga", 3, {}), again = PlansOf("beluga", 3, {});
  EXPECT_EQ(beluga.text, again.text);
  EXPECT_NE(beluga.text, PlansOf("htetro", 3, {}).text);
  ASSERT_EQ(beluga.file.variants().size(), 12u);
  EXPECT_NO_THROW(beluga.file.CheckDraws());
  // Other floors: as many rows of characters, other ones.
  const auto map = [&](std::size_t variant) {
    return beluga.file.Read(0, beluga.file.variants()[variant]).world.site.map;
  };
  EXPECT_EQ(map(0).hazards.size(), map(1).hazards.size()) << "of one floor, by two planners";
  EXPECT_NE(map(0).occupancy.cells, map(4).occupancy.cells);
}

}  // namespace
}  // namespace floorproof

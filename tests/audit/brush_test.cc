// SPDX-License-Identifier: Apache-2.0
#include "env/audit/brush.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/audit/audit_floors.h"

namespace floorproof {
namespace {

using testing::AddWall;
using testing::BareRoom;
using testing::ZigZag;

const CleaningParams kTakesAll = {.pick_up = 1, .push_aside = 0};
const CleaningParams kTakesHalf = {.pick_up = 0.5, .push_aside = 0};
constexpr double kRim_m = 0.0012;  // to within what a turning tool's rim is known

double Real(std::int64_t count) { return static_cast<double>(count); }

Shape2 Disc(double radius_m) {
  Shape2 tool;
  tool.radius_m = radius_m;
  return tool;
}

Shape2 Footprint(const Polygon& corners) {
  Shape2 tool;
  tool.kind = Shape2::Kind::kFootprint;
  tool.footprint_B = corners;
  return tool;
}

// Not convex, not symmetric.
Shape2 Ell() {
  return Footprint(
      {{-0.1, -0.1}, {0.15, -0.1}, {0.15, -0.02}, {0, -0.02}, {0, 0.12}, {-0.1, 0.12}});
}

// Positive outside of the tool as it stands.
double DistanceTo(const Shape2& tool, const Pose2& X_WB, const Vec2& p_W) {
  const Vec2 p_B = X_WB.Inverse() * p_W;
  if (tool.kind == Shape2::Kind::kCircle) return p_B.norm() - tool.radius_m;
  return SignedDistance(tool.footprint_B, p_B);
}

// The least distance from the tool to the particle on its way, by stamps: an independent ruler.
double LeastDistance(const Shape2& tool, const std::vector<Pose2>& poses, const Vec2& p_W) {
  double least = 1e9;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose2 from = poses[i == 0 ? 0 : i - 1], to = poses[i];
    const double turn = WrapAngle(to.yaw_rad - from.yaw_rad);
    const double travel = (to.p() - from.p()).norm() + 0.2 * std::abs(turn);
    const int stamps = std::max(1, static_cast<int>(std::ceil(travel / 0.001)));
    for (int k = 0; k <= stamps; ++k) {
      const double t = static_cast<double>(k) / stamps;
      const Vec2 p = from.p() + t * (to.p() - from.p());
      if ((p - p_W).norm() > 0.3) continue;  // farther than any tool here reaches
      least = std::min(least, DistanceTo(tool, {p.x(), p.y(), from.yaw_rad + t * turn}, p_W));
    }
  }
  return least;
}

TEST(Brush, TakesWhatItPassesOverAndNothingElse) {
  const std::vector<Pose2> poses = {{0.3, 0.3, 0}, {1.2, 0.5, 0.4}, {1.2, 0.5, 2.4}, {0.5, 1.1, 2}};
  for (const Shape2& tool : {Disc(0.12), Footprint(Rectangle({-0.05, -0.15}, {0.02, 0.1})), Ell()})
    for (const Pose2& X_WG : {Pose2{}, Pose2{0.4, -0.6, 0.3}}) {
      DirtField dut = LayDirt(BareRoom(2, 2, 0.05, X_WG), {.density_per_m2 = 1'000}, 1);
      const std::vector<Particle> before = dut.All();
      Stream random(1, 0, "cleaning");
      const CleaningOutcome outcome = CleanAlong(dut, tool, poses, kTakesAll, random);
      const std::vector<Particle> after = dut.All();
      EXPECT_GT(outcome.taken_up, 150);
      EXPECT_EQ(outcome.taken_up + dut.size(), std::ssize(before));
      // What is left stands in the same order.
      std::size_t left = 0;
      for (const Particle& p : before) {
        const bool there = left < after.size() && after[left].p_W == p.p_W;
        left += there;
        const double distance = LeastDistance(tool, poses, p.p_W);
        EXPECT_TRUE(std::abs(distance) < kRim_m || there == (distance > 0)) << distance;
      }
      EXPECT_EQ(left, after.size());
    }
}

TEST(Brush, ALineInManyPosesTakesTheSameParticles) {
  for (const Shape2& tool : {Disc(0.12), Footprint(Rectangle({-0.05, -0.15}, {0.05, 0.15}))}) {
    const std::vector<Pose2> few = {{0.3, 1, 0.1}, {1.7, 1, 0.1}};
    std::vector<Pose2> many;
    for (int i = 0; i <= 700; ++i) many.push_back({0.3 + 0.002 * i, 1, 0.1});
    std::vector<std::vector<Particle>> left;
    for (const auto& poses : {few, many}) {
      DirtField dut = LayDirt(BareRoom(2, 2), {.density_per_m2 = 20'000}, 2);
      Stream random(2, 0, "cleaning");
      const CleaningOutcome outcome = CleanAlong(dut, tool, poses, kTakesHalf, random);
      // Overlapping stamps are one pass.
      EXPECT_NEAR(Real(outcome.taken_up) / Real(outcome.passed_over), 0.5, 0.02);
      left.push_back(dut.All());
    }
    ASSERT_EQ(left[0].size(), left[1].size());
    for (std::size_t i = 0; i < left[0].size(); ++i) ASSERT_EQ(left[0][i].p_W, left[1][i].p_W);
  }
}

// The share of the lane's particles that is left after the poses were driven so often.
double LeftInLane(const std::vector<Pose2>& poses, int calls, double pick_up) {
  DirtField dut = LayDirt(BareRoom(4, 1), {.density_per_m2 = 60'000}, 3);
  const auto in_lane = [&dut] {
    double count = 0;
    for (const Particle& p : dut.All())
      count += p.p_W.x() > 0.5 && p.p_W.x() < 1.5 && std::abs(p.p_W.y() - 0.5) < 0.14;
    return count;
  };
  const double before = in_lane();
  Stream random(3, 0, "cleaning");
  for (int i = 0; i < calls; ++i)
    CleanAlong(dut, Disc(0.15), poses, {.pick_up = pick_up, .push_aside = 0}, random);
  return in_lane() / before;
}

TEST(Brush, EachPassTakesItsShareAnew) {
  // 17,000 particles: a standard deviation of 0.004 at most.
  const std::vector<Pose2> once = {{0.2, 0.5, 0}, {3.8, 0.5, 0}};
  EXPECT_NEAR(LeftInLane(once, 1, 0.3), 0.7, 0.016);
  EXPECT_NEAR(LeftInLane(once, 2, 0.3), 0.7 * 0.7, 0.016);
  // There and back in one call is two passes, once the tool has been away by twice its width.
  const std::vector<Pose2> back = {{0.2, 0.5, 0}, {3.8, 0.5, 0}, {0.2, 0.5, 0}};
  EXPECT_NEAR(LeftInLane(back, 1, 0.3), 0.7 * 0.7, 0.016);
  // Back and forth by a few centimetres is not.
  std::vector<Pose2> rocking;
  for (int i = 0; i <= 360; ++i) {
    rocking.push_back({0.2 + 0.01 * i, 0.5, 0});
    rocking.push_back({0.15 + 0.01 * i, 0.5, 0});
  }
  EXPECT_NEAR(LeftInLane(rocking, 1, 0.3), 0.7, 0.016);
}

TEST(Brush, PicksUpNothingOrAll) {
  const std::vector<Pose2> once = {{0.2, 0.5, 0}, {3.8, 0.5, 0}};
  EXPECT_EQ(LeftInLane(once, 1, 0), 1);
  EXPECT_EQ(LeftInLane(once, 1, 1), 0);
}

TEST(Brush, StandingStillCleansWhereItStands) {
  DirtField dut = LayDirt(BareRoom(1, 1), {.density_per_m2 = 20'000}, 4);
  const auto laid = dut.size();
  Stream random(4, 0, "cleaning");
  const std::vector<Pose2> nowhere, here = {{0.5, 0.5, 0}};
  EXPECT_EQ(CleanAlong(dut, Disc(0.2), nowhere, kTakesAll, random).passed_over, 0);
  EXPECT_EQ(dut.size(), laid);
  const auto outcome = CleanAlong(dut, Disc(0.2), here, kTakesAll, random);
  EXPECT_NEAR(Real(outcome.taken_up), 20'000 * kPi * 0.04, 200);
  // Beyond the map there is nothing to clean.
  const std::vector<Pose2> beyond = {{-3, 0, 0}, {-3, 9, 0}};
  EXPECT_EQ(CleanAlong(dut, Disc(0.2), beyond, kTakesAll, random).passed_over, 0);
  const std::vector<Pose2> lost = {{std::nan(""), 0, 0}};
  EXPECT_THROW(CleanAlong(dut, Disc(0.2), lost, kTakesAll, random), InputError);
}

TEST(Brush, WhatItPushesLiesBesideItsLaneAndNoneIsLost) {
  DirtField dut = LayDirt(BareRoom(2, 1), {.density_per_m2 = 40'000}, 5);
  const auto laid = dut.size();
  const auto in_band = [&dut](double low, double high) {  // distance from the lane's middle
    int count = 0;
    for (const Particle& p : dut.All()) {
      const double d = std::abs(p.p_W.y() - 0.5);
      count += p.p_W.x() > 0.3 && p.p_W.x() < 1.7 && d >= low && d < high;
    }
    return count;
  };
  const int beside = in_band(0.1, 0.16), far = in_band(0.1601, 1);
  Stream random(5, 0, "cleaning");
  const std::vector<Pose2> lane = {{0.1, 0.5, 0}, {1.9, 0.5, 0}};
  const auto outcome = CleanAlong(dut, Footprint(Rectangle({-0.05, -0.1}, {0.05, 0.1})), lane,
                                  {.pick_up = 0, .push_aside = 1, .push_m = 0.06}, random);
  EXPECT_EQ(outcome.passed_over, outcome.pushed_aside);
  EXPECT_EQ(dut.size(), laid);
  EXPECT_EQ(in_band(0, 0.0999), 0);
  EXPECT_EQ(in_band(0.1601, 1), far);
  EXPECT_NEAR(in_band(0.1, 0.16), beside + 1.4 * 0.2 * 40'000, 100);
}

TEST(Brush, AWallStopsWhatIsPushed) {
  HazardMap map = BareRoom(2, 1);
  AddWall(map, 0, 13, 39, 13);  // y from 0.65 to 0.7, thin
  DirtField dut = LayDirt(map, {.density_per_m2 = 40'000}, 6);
  const auto laid = dut.size();
  const auto beyond = [&dut] {
    int count = 0;
    for (const Particle& p : dut.All()) count += p.p_W.y() > 0.65;
    return count;
  };
  const int before = beyond();
  Stream random(6, 0, "cleaning");
  const std::vector<Pose2> lane = {{0.1, 0.53, 0}, {1.9, 0.53, 0}};
  CleanAlong(dut, Disc(0.1), lane, {.pick_up = 0, .push_aside = 1, .push_m = 0.5}, random);
  EXPECT_EQ(dut.size(), laid);
  EXPECT_EQ(beyond(), before);
  int at_wall = 0;
  for (const Particle& p : dut.All()) at_wall += p.p_W.y() > 0.64 && p.p_W.y() < 0.65;
  // Two of every three that were pushed there would have gone farther than 2 cm.
  EXPECT_GT(at_wall, 5'000);
}

TEST(Brush, IsTheSameForTheSameStream) {
  const auto poses = ZigZag(2, 2, 0.15, 0.25);
  std::vector<std::vector<Particle>> left;
  for (int i = 0; i < 2; ++i) {
    DirtField dut = LayDirt(BareRoom(2, 2), {.density_per_m2 = 20'000}, 7);
    const auto laid = dut.size();
    Stream random(7, 0, "cleaning");
    const auto outcome = CleanAlong(dut, Ell(), poses, {}, random);
    EXPECT_GT(outcome.pushed_aside, 1'000);
    EXPECT_EQ(outcome.taken_up + dut.size(), laid);
    left.push_back(dut.All());
  }
  ASSERT_EQ(left[0].size(), left[1].size());
  for (std::size_t i = 0; i < left[0].size(); ++i) ASSERT_EQ(left[0][i].p_W, left[1][i].p_W);
}

}  // namespace
}  // namespace floorproof

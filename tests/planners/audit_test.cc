// SPDX-License-Identifier: Apache-2.0
// Audits: where they sample, which samples they reach, and the tour through these.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "planners/audit/find_samples.h"
#include "planners/orders/visit_order.h"
#include "tests/planners/floors.h"

namespace floorproof {
namespace {

using testing::DiscRobot;
using testing::Draw;
using testing::ExpectSound;
using testing::LeastClearance;
using testing::MakePlanner;

// 6 x 5 m, with a cupboard of 1 x 1 m in the middle.
constexpr const char* kRoomWithCupboard = R"(
  ##############
  #............#
  #............#
  #............#
  #............#
  #.....##.....#
  #.....##.....#
  #............#
  #............#
  #............#
  #............#
  ##############)";

class AuditTest : public ::testing::Test {
 protected:
  PlanResult Plan(const std::string& yaml = "{}") const {
    return MakePlanner("audit", yaml)
        ->Plan({map_, robot_, start_, std::nullopt, seed_, nullptr, places_});
  }
  static double Figure(const PlanResult& plan, const std::string& name) {
    for (const auto& [key, value] : plan.figures)
      if (key == name) return value;
    ADD_FAILURE() << name << " is not there";
    return 0;
  }
  // Metres from a place to the nearest wall.
  double ToWall(const Vec2& p_W) const {
    return static_cast<double>(ComputeClearance(map_, 0.01).At(p_W));
  }

  HazardMap map_ = Draw(kRoomWithCupboard, 0.5);
  RobotSpec robot_ = DiscRobot(0.18, 0.3);
  Pose2 start_ = {1.0, 1.0, 0};
  std::uint64_t seed_ = 7;
  std::vector<Vec2> places_;
};

TEST_F(AuditTest, SamplesLieNearWallsAndCornersAndAFewElsewhere) {
  const PlanResult plan = Plan();
  ExpectSound(map_, start_, plan);
  int elsewhere = 0;
  for (const SamplePlace& sample : plan.samples) {
    if (sample.kinds.random) {
      ++elsewhere;
      EXPECT_FALSE(sample.kinds.boundary || sample.kinds.corner);
      continue;
    }
    EXPECT_TRUE(sample.kinds.boundary || sample.kinds.corner);
    EXPECT_LT(ToWall(sample.p_W), 0.18 + 0.36);  // R_b, by default
  }
  EXPECT_EQ(elsewhere, Figure(plan, "random_samples"));
  EXPECT_GE(elsewhere, 1);
  EXPECT_LT(elsewhere, 0.1 * static_cast<double>(plan.samples.size()));
  // Each side of the room has a row of them, from corner to corner.
  for (double along = 1.0; along <= 5.0; along += 0.36)
    for (const Vec2& p : {Vec2(along, 0.9), Vec2(along, 5.1), Vec2(0.9, along), Vec2(6.1, along)})
      EXPECT_TRUE(std::ranges::any_of(plan.samples, [&](const SamplePlace& s) {
        return s.kinds.boundary && (s.p_W - p).norm() < 0.45;
      })) << p.transpose();
}

TEST_F(AuditTest, ALargerDistanceTakesMoreOfTheLatticeAndAllOfItInTheEnd) {
  std::size_t last = 0;
  for (const char* yaml : {"samples: {boundary_m: 0.3, random_share: 0}",
                           "samples: {boundary_m: 0.6, random_share: 0}",
                           "samples: {boundary_m: 1.2, random_share: 0}",
                           "samples: {boundary_m: 9, random_share: 0}"}) {
    const PlanResult plan = Plan(yaml);
    EXPECT_GT(plan.samples.size(), last) << yaml;
    last = plan.samples.size();
  }
  EXPECT_EQ(static_cast<double>(last), Figure(Plan("samples: {boundary_m: 9}"), "general_samples"));
}

// The same floor with a margin of unknown cells around it, as mapping programs store it.
TEST_F(AuditTest, WhereTheMapBeginsMakesNoDifference) {
  const PlanResult plan = Plan();
  HazardMap wide = map_;
  wide.frame = {
      map_.frame.width + 7, map_.frame.height + 5, map_.frame.cell_m, {-3 * 0.5, -2 * 0.5, 0}};
  wide.occupancy = Grid<CellState>(wide.frame.width, wide.frame.height, CellState::kUnknown);
  for (int iy = 0; iy < map_.frame.height; ++iy)
    for (int ix = 0; ix < map_.frame.width; ++ix)
      wide.occupancy(ix + 3, iy + 2) = map_.occupancy(ix, iy);
  map_ = wide;
  const PlanResult other = Plan();
  ASSERT_EQ(other.samples.size(), plan.samples.size());
  for (std::size_t i = 0; i < plan.samples.size(); ++i) {
    EXPECT_LT((other.samples[i].p_W - plan.samples[i].p_W).norm(), 1e-6);
    EXPECT_EQ(other.samples[i].kinds, plan.samples[i].kinds);
  }
}

// A gap of 0.3 m between two cupboards: floor, but not for this robot.
TEST_F(AuditTest, ASampleOutOfReachIsListedAndNotVisited) {
  places_ = {{2, 2}, {5, 2}, {2, 4}, {0.6, 4.0}, {3.5, 2.75}, {5, 5}};
  const PlanResult plan = Plan();
  ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
  ASSERT_EQ(plan.samples.size(), places_.size());
  std::set<int> visits;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const bool reachable = i != 3 && i != 4;  // beside the wall, and in the cupboard
    EXPECT_EQ(plan.samples[i].reachable, reachable) << i;
    EXPECT_EQ(plan.samples[i].visit > 0, reachable) << i;
    if (reachable) visits.insert(plan.samples[i].visit);
    EXPECT_TRUE(plan.samples[i].kinds.given);
  }
  EXPECT_EQ(visits, (std::set<int>{1, 2, 3, 4}));
  EXPECT_TRUE(plan.message.starts_with("left out: 2 of 6")) << plan.message;
}

TEST_F(AuditTest, TheRobotStandsAtEachSampleInTheOrderThatThePlanLists) {
  robot_.audit_speed_mps = 0.1;
  robot_.audit_dwell_s = 9;
  const PlanResult plan = Plan();
  int visit = 0;
  for (const Waypoint& w : plan.path) {
    EXPECT_EQ(w.task.has_value(), w.dwell_s > 0);
    if (!w.task) continue;
    ++visit;
    EXPECT_EQ(w.dwell_s, 9);
    const SamplePlace& sample = plan.samples[static_cast<std::size_t>(w.task->id)];
    EXPECT_EQ(sample.visit, visit);
    EXPECT_LT((sample.p_W - w.p_W).norm(), 1e-6);
  }
  EXPECT_EQ(visit, Figure(plan, "reachable_samples"));
  for (std::size_t i = 1; i < plan.path.size(); ++i) EXPECT_EQ(plan.path[i].speed_mps, 0.1);
  const PlanResult other = Plan("{speed_mps: 0.2, dwell_s: 3}");
  EXPECT_EQ(other.path.back().dwell_s, 3);
  EXPECT_EQ(other.path.back().speed_mps, 0.2);
}

// A sensor at the robot's nose gets closer to a wall than its middle does.
TEST_F(AuditTest, TheRobotTurnsItsSensorToThePlace) {
  places_ = {{0.6, 3.0}, {3.5, 2.42}, {5.0, 1.5}, {0.515, 3.6}};
  robot_.audit_dwell_s = 9;
  EXPECT_EQ(Plan().status, PlanStatus::kTooFewSamples)
      << "its middle cannot stand at three of them";
  robot_.audit_sensor_x_m = 0.135;
  const PlanResult plan = Plan();
  ExpectSound(map_, start_, plan);
  EXPECT_FALSE(plan.samples[3].reachable) << "15 mm from the wall";
  int visits = 0;
  for (const Waypoint& w : plan.path) {
    if (!w.task) continue;
    ++visits;
    ASSERT_TRUE(w.yaw_rad);
    const Vec2 sensor_W = w.p_W + 0.135 * Vec2(std::cos(*w.yaw_rad), std::sin(*w.yaw_rad));
    EXPECT_LT((sensor_W - places_[static_cast<std::size_t>(w.task->id)]).norm(), 1e-6);
  }
  EXPECT_EQ(visits, 3);
}

// Around the start each of them can be sampled from there: but not all at once.
TEST_F(AuditTest, EachPlaceHasAStopOfItsOwn) {
  robot_.audit_sensor_x_m = 0.135;
  robot_.audit_dwell_s = 9;
  start_ = {2.0, 2.0, 0};
  places_ = {{2.135, 2.0}, {1.865, 2.0}, {2.0, 2.135}, {2.0, 1.865}, {4.5, 1.5}};
  const PlanResult plan = Plan();
  ExpectSound(map_, start_, plan);
  const auto stops =
      std::ranges::count_if(plan.path, [](const Waypoint& w) { return w.dwell_s == 9; });
  EXPECT_EQ(stops, 5);
  std::set<int> sampled;
  for (const Waypoint& w : plan.path)
    if (w.task) sampled.insert(w.task->id);
  EXPECT_EQ(sampled.size(), 5u);
}

TEST_F(AuditTest, AnIntervalWiderThanTheRoomLeavesOnePlace) {
  const PlanResult plan = Plan("samples: {du_m: 1.0e+300, boundary_m: 9}");
  EXPECT_EQ(plan.status, PlanStatus::kTooFewSamples) << plan.message;
}

TEST_F(AuditTest, TheTourIsAsLongAsItsPath) {
  for (const auto& order : VisitOrders()) {
    const PlanResult plan = Plan("{order: " + std::string(order.name) +
                                 ", aco: {iterations: 20}, pso: {iterations: 20}}");
    ExpectSound(map_, start_, plan);
    EXPECT_NEAR(Length(plan.path), Figure(plan, "tour_m"), 1e-6) << order.name;
  }
}

TEST_F(AuditTest, AWayIsStraightWhereTheFloorIsFreeAndRoundTheCupboardWhereItIsNot) {
  places_ = {{5.02, 1.13}, {1.03, 5.07}};
  start_ = {1.03, 1.07, 0};
  const PlanResult plan = Plan("{order: zigzag}");
  ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
  ASSERT_GE(plan.path.size(), 4u);
  EXPECT_LT((plan.path[1].p_W - places_[0]).norm(), 1e-6);  // in sight: no bend on the way
  const double straight = (places_[1] - places_[0]).norm();
  const double ways = Length(plan.path) - (places_[0] - start_.p()).norm();
  EXPECT_GT(ways, straight + 0.05);
  // Round a corner of the cupboard with the robot's radius and its margin.
  const Vec2 corner(3.0, 2.5);
  const double around = (corner - places_[0]).norm() + (places_[1] - corner).norm();
  EXPECT_LT(ways, around + kPi * 0.21);
}

TEST_F(AuditTest, AClosedTourEndsWhereItBegan) {
  const PlanResult open = Plan(), closed = Plan("{closed: true}");
  EXPECT_GT((open.path.back().p_W - start_.p()).norm(), 0.1);
  EXPECT_LT((closed.path.back().p_W - start_.p()).norm(), 1e-6);
  EXPECT_GT(Figure(closed, "tour_m"), Figure(open, "tour_m"));
  EXPECT_FALSE(closed.path.back().task);
}

TEST_F(AuditTest, ItsBoundIsBelowEveryOrder) {
  const double bound = Figure(Plan(), "tour_bound_m");
  for (const char* order : {"tour", "zigzag", "random_order"}) {
    const double tour = Figure(Plan("{order: " + std::string(order) + "}"), "tour_m");
    EXPECT_GE(tour, bound - 1e-9) << order;
  }
  EXPECT_LT(Figure(Plan(), "tour_gap"), 0.03);
}

// A door as wide as the robot and 60 mm, of which poses in cells leave 5 mm on either side: it is
// passed in its middle, or the second room is lost.
TEST_F(AuditTest, ADoorIsPassedInItsMiddle) {
  map_ = Draw(R"(
    ######################
    #.........#..........#
    #.........#..........#
    #.........#..........#
    #.........#..........#
    #....................#
    #....................#
    #....................#
    #....................#
    #.........#..........#
    #.........#..........#
    #.........#..........#
    #.........#..........#
    ######################)",
              0.1);
  robot_ = DiscRobot(0.17, 0.3);
  start_ = {0.55, 0.75, 0};
  places_ = {{0.55, 0.95}, {1.65, 0.75}};
  const PlanResult plan = Plan();
  ExpectSound(map_, start_, plan);
  EXPECT_TRUE(plan.samples[1].reachable);
  EXPECT_GE(LeastClearance(map_, plan.path, 0.4) - 0.17, 0.028);
}

TEST_F(AuditTest, SaysWhyThereIsNoTour) {
  places_ = {{2, 2}, {3.5, 2.75}};
  const PlanResult one = Plan();
  EXPECT_EQ(one.status, PlanStatus::kTooFewSamples);
  EXPECT_EQ(one.message, "1 of 2 places to sample can be reached: a tour needs two");
  EXPECT_TRUE(one.path.empty());
  EXPECT_TRUE(one.samples[0].reachable && !one.samples[1].reachable);
  places_.clear();
  map_ = testing::EmptyFloor(40, 40, 0.1);
  const PlanResult bare = Plan();
  EXPECT_EQ(bare.status, PlanStatus::kFailed);
  EXPECT_NE(bare.message.find("free all over"), std::string::npos) << bare.message;
}

TEST_F(AuditTest, TooManyPlacesAreRefusedBeforeTheyTakeAllMemory) {
  const PlanResult plan = Plan("samples: {du_m: 0.05, boundary_m: 9}");
  EXPECT_EQ(plan.status, PlanStatus::kFailed);
  EXPECT_NE(plan.message.find("more than the 5000 that a tour takes"), std::string::npos)
      << plan.message;
}

TEST_F(AuditTest, RandomSamplesHangOnTheSeedAndTheOthersDoNot) {
  const auto chosen = [](const PlanResult& plan, bool random) {
    std::set<std::pair<double, double>> at;
    for (const SamplePlace& s : plan.samples)
      if (s.kinds.random == random) at.insert({s.p_W.x(), s.p_W.y()});
    return at;
  };
  const PlanResult a = Plan("samples: {random_share: 0.3}");
  seed_ = 8;
  const PlanResult b = Plan("samples: {random_share: 0.3}");
  EXPECT_EQ(chosen(a, false), chosen(b, false));
  EXPECT_NE(chosen(a, true), chosen(b, true));
  EXPECT_EQ(chosen(a, true).size(), chosen(b, true).size());
}

}  // namespace
}  // namespace floorproof

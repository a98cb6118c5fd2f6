// SPDX-License-Identifier: Apache-2.0
// survival_coverage goes where planted rates say that a robot fails least.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "planners/risk/path_rates.h"
#include "tests/planners/cell_site.h"
#include "tests/planners/planted_rates.h"

namespace floorproof {
namespace {

using testing::DrawHazards;
using ::testing::ElementsAre;
using testing::Figure;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::MakePlanner;
using testing::PaperTables;
using testing::PlantedBy;
using testing::PlantedByLead;
using testing::PlantedKind;
using testing::SquareRobot;

class SurvivalCoverageTest : public ::testing::Test {
 protected:
  SurvivalCoverageTest() {
    robot_.max_speed_mps = 0.4;
    robot_.cruise_mps = 0.2;
    robot_.max_accel_mps2 = 0.5;
  }

  // Hazards are named by place: from the bottom row on, from left to right.
  void Draw(const std::string& rows) {
    map_ = DrawHazards(rows, 0.5);
    for (Hazard& hazard : map_.hazards) {
      hazard.type = "cable_cover";
      hazard.keys = {{"height_m", 0.01}};
    }
  }
  PlanResult Plan(Cell start, std::optional<Cell> goal, const std::string& yaml = "{}") {
    risk_ = ComputeRisk(map_, robot_, PaperTables());
    const Vec2 from = map_.frame.Center(start);
    start_ = {from.x(), from.y(), 0};
    PlanRequest request{map_, robot_, start_, std::nullopt, 0, &risk_};
    if (goal) request.goal = map_.frame.Center(*goal);
    request.model = has_model_ ? &model_ : nullptr;
    request.conditions = conditions_;
    return MakePlanner("survival_coverage", yaml)->Plan(request);
  }
  std::vector<PlannedPassage> Crossings(const PlanResult& plan) const {
    auto found = FindPassages(map_, robot_, start_, plan.path, true);
    std::erase_if(found, [](const auto& p) { return p.passage != Passage::kOver; });
    return found;
  }
  std::set<int> Crossed(const PlanResult& plan) const {
    std::set<int> hazards;
    for (const PlannedPassage& crossing : Crossings(plan)) hazards.insert(crossing.hazard);
    return hazards;
  }

  RobotSpec robot_ = SquareRobot(0.5);
  HazardMap map_;
  RiskMap risk_;
  Pose2 start_;
  RiskModel model_;
  bool has_model_ = true;
  std::vector<DriveConditions> conditions_;
};

const char* kTwoDoors = R"(
    ....#....
    ....=....
    ....#....
    ....#....
    ....=....)";
const char* kStrip = R"(
    ......=....
    ......=....
    ......=....
    ......=....)";

TEST_F(SurvivalCoverageTest, IsRefusedWithoutMeasuredRates) {
  Draw(kStrip);
  has_model_ = false;
  const PlanResult plan = Plan({0, 0}, Cell{10, 3});
  EXPECT_EQ(plan.status, PlanStatus::kFailed);
  EXPECT_THAT(plan.message, HasSubstr("risk.model"));
  EXPECT_THAT(plan.path, IsEmpty());
}

TEST_F(SurvivalCoverageTest, TakesTheDoorThatIsMeasuredToBeSafe) {
  Draw(kTwoDoors);
  model_.kinds = {PlantedBy("height_m", true, 0.005, 0.03, 0.01, 3)};
  for (const int deadly : {0, 1}) {
    map_.hazards[0].keys[0].second = deadly == 0 ? 0.03 : 0.005;
    map_.hazards[1].keys[0].second = deadly == 1 ? 0.03 : 0.005;
    const PlanResult plan = Plan({0, 0}, Cell{8, 4});
    ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
    EXPECT_THAT(Crossed(plan), ElementsAre(1 - deadly));
    EXPECT_EQ(plan.left_out_cells, 0);
    EXPECT_NEAR(Figure(plan, "p_failure"), 1 - std::exp(-0.01), 1e-4);
    EXPECT_EQ(Figure(plan, "crossings"), 1);
  }
}

// One ramp falls along the way, the other rises.
TEST_F(SurvivalCoverageTest, TakesTheRampInTheDirectionThatIsMeasuredToBeSafe) {
  Draw(kTwoDoors);
  model_.kinds = {PlantedBy("rise_along", true, -0.2, 0.2, 0.01, 3, "ramp")};
  for (const int rises : {0, 1}) {
    for (int i = 0; i < 2; ++i) {
      Hazard& hazard = map_.hazards[static_cast<std::size_t>(i)];
      hazard.type = "ramp";
      Solid slope;
      slope.base = hazard.footprint[0];
      slope.z_high_m = 0.1;
      slope.gradient = Vec2(i == rises ? 0.2 : -0.2, 0);
      hazard.solids = {slope};
    }
    const PlanResult plan = Plan({0, 0}, Cell{8, 4});
    ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
    EXPECT_THAT(Crossed(plan), ElementsAre(1 - rises));
    EXPECT_NEAR(Figure(plan, "p_failure"), 1 - std::exp(-0.01), 1e-4);
  }
}

TEST_F(SurvivalCoverageTest, CrossesAtTheSpeedThatIsMeasuredToBeSafe) {
  Draw(kStrip);
  for (const bool slow : {true, false}) {
    model_.kinds = {PlantedBy("speed_mps", false, 0.05, 0.5, slow ? 0.001 : 2, slow ? 2 : 0.001)};
    const PlanResult plan = Plan({0, 0}, Cell{10, 3});
    ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
    ASSERT_FALSE(Crossings(plan).empty());
    // The least and the most that `measure` drives: 0.3 of the top speed, and all of it.
    for (const PlannedPassage& crossing : Crossings(plan))
      EXPECT_NEAR(crossing.at.speed_mps, slow ? 0.12 : 0.4, 1e-9);
    double at_pace_m = 0;
    for (std::size_t i = 1; i < plan.path.size(); ++i)
      if (plan.path[i].speed_mps == 0)
        at_pace_m += (plan.path[i].p_W - plan.path[i - 1].p_W).norm();
    EXPECT_GT(at_pace_m, 0.7 * Length(plan.path)) << "elsewhere as the robot drives anyway";
  }
}

TEST_F(SurvivalCoverageTest, CrossesWithTheSideThatIsMeasuredToBeSafe) {
  for (const char* rows : {kStrip, R"(
    .....
    .....
    .....
    =====
    .....
    .....
    .....)"}) {
    Draw(rows);
    const Cell goal{map_.frame.width - 1, map_.frame.height - 1};
    for (const bool sideways : {true, false}) {
      model_.kinds = {sideways ? PlantedByLead(2, 0.001) : PlantedByLead(0.001, 2)};
      const PlanResult plan = Plan({0, 0}, goal);
      ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
      ASSERT_FALSE(Crossings(plan).empty());
      for (const PlannedPassage& crossing : Crossings(plan))
        EXPECT_NEAR(std::abs(std::sin(crossing.at.lead_rad)), sideways ? 1 : 0, 0.01);
    }
  }
}

TEST_F(SurvivalCoverageTest, LeavesOutWhatLiesBehindDangerAsFarAsItMay) {
  Draw(R"(
    ...........=..
    ...........=..
    ...........=..)");
  model_.kinds = {PlantedKind("cable_cover", Passage::kOver, 0.5)};
  const PlanResult most = Plan({0, 0}, std::nullopt, "{min_coverage: 0.7}");
  ASSERT_EQ(most.status, PlanStatus::kSuccess) << most.message;
  EXPECT_THAT(Crossed(most), IsEmpty());
  EXPECT_EQ(most.left_out_cells, 6);
  EXPECT_THAT(most.message, HasSubstr("left out for their risk: 6 of 39 free cells"));
  EXPECT_NEAR(Figure(most, "cell_coverage"), 33.0 / 39, 1e-9);
  EXPECT_EQ(Figure(most, "p_failure"), 0);
  const PlanResult all = Plan({0, 0}, std::nullopt);
  EXPECT_EQ(all.left_out_cells, 0);
  EXPECT_FALSE(Crossed(all).empty());
  const PlanResult too_much = Plan({0, 0}, std::nullopt, "{min_coverage: 0.9}");
  EXPECT_EQ(too_much.left_out_cells, 0) << "6 of 39 are more than a tenth";
}

// Ten carpets in a row on one way, a cover on the other.
class TenOrOne : public SurvivalCoverageTest {
 protected:
  TenOrOne() {
    Draw(R"(
      ...==========...
      ...##########...
      .......=........)");
    for (std::size_t i = 1; i < map_.hazards.size(); ++i) map_.hazards[i].type = "carpet";
  }
  bool TakesTheTen() {
    const PlanResult plan = Plan({0, 0}, Cell{15, 2});
    EXPECT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
    const std::set<int> crossed = Crossed(plan);
    EXPECT_TRUE(crossed.size() == 1 || crossed.size() == 10) << crossed.size();
    return crossed.size() == 10;
  }
};

TEST_F(TenOrOne, IsDecidedByTheSumOfIndependentRates) {
  for (const double one : {0.05, 0.3}) {
    model_.kinds = {PlantedKind("cable_cover", Passage::kOver, one),
                    PlantedKind("carpet", Passage::kOver, 0.01)};
    EXPECT_EQ(TakesTheTen(), one > 10 * 0.01);
  }
}

// The sum of expected rates is 40 there and 0.2 here; yet the ten fail together, one time in ten.
TEST_F(TenOrOne, IsDecidedByWhatFailsTogether) {
  model_.kinds = {PlantedKind("cable_cover", Passage::kOver, 0.2),
                  PlantedBy("friction", false, 0.4, 0.8, 40, 1e-9, "carpet")};
  conditions_.assign(10, {0.8, 10, 0.03});
  conditions_[0].friction = 0.4;
  EXPECT_TRUE(TakesTheTen());
  conditions_[1].friction = conditions_[2].friction = 0.4;  // three in ten
  EXPECT_FALSE(TakesTheTen());
}

TEST_F(TenOrOne, WhereNothingWasMeasuredIsTheLastWayToTake) {
  model_.kinds = {PlantedKind("cable_cover", Passage::kOver, 0.3)};
  EXPECT_FALSE(TakesTheTen());
  EXPECT_EQ(Figure(Plan({0, 0}, Cell{15, 2}), "unmeasured_crossings"), 0);
}

}  // namespace
}  // namespace floorproof

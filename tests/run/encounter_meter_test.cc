// SPDX-License-Identifier: Apache-2.0
#include "run/episode/encounter_meter.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "run/episode/encounter_table.h"
#include "run/scenario/floors.h"
#include "run/scenario/scenario.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

std::vector<std::string> Outcomes(const std::vector<Encounter>& encounters) {
  std::vector<std::string> outcomes;
  for (const Encounter& e : encounters)
    outcomes.push_back((e.hazard.empty() ? e.type : e.hazard) + " " + std::string(OutcomeText(e)));
  return outcomes;
}

constexpr const char* kCover =
    "{type: cable_cover, id: cover, line_m: [[4, 0.5], [4, 4.5]], height_m: 0.005}";

class EncounterDrive : public ScenarioTest {};

// What the robot met is what its plan wanted: the same passages, met the same way.
TEST_F(EncounterDrive, WhatIsMetIsWhatWasPlanned) {
  Save("plan.csv", "x_m,y_m\n2,2.5\n6,2.5\n6,3\n2,1.5\n");
  for (const char* robot : {"beluga", "htetro"}) {
    Scenario scenario = Read(RoomScenario(kCover), {{"robot", robot}});
    const Execution dut = Execute(scenario);
    const auto planned =
        FindPassages(TrueFloor(scenario.world), scenario.world.robot.spec, scenario.world.start,
                     dut.plan.path, robot == std::string("htetro"));
    std::vector<Encounter> met = dut.record.encounters;
    const auto exposures = std::stable_partition(
        met.begin(), met.end(), [](const Encounter& e) { return !e.hazard.empty(); });
    ASSERT_THAT(planned, SizeIs(2)) << robot;
    ASSERT_EQ(std::distance(met.begin(), exposures), 2) << robot;
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(OutcomeText(met[i]), "cleared");
      EXPECT_EQ(met[i].passage, planned[i].passage);
      EXPECT_NEAR(WrapAngle(met[i].at.heading_rad - planned[i].at.heading_rad), 0, 0.05);
      EXPECT_NEAR(WrapAngle(met[i].at.lead_rad - planned[i].at.lead_rad), 0, 0.05);
      EXPECT_NEAR(met[i].at.over_m, planned[i].at.over_m, 0.05);
      EXPECT_NEAR(met[i].way_m, planned[i].at.over_m, 0.1);
      EXPECT_NEAR(met[i].x_m, planned[i].X_WB.x_m, 0.06);
      EXPECT_NEAR(met[i].y_m, planned[i].X_WB.y_m, 0.06);
      EXPECT_NEAR(met[i].at.speed_mps, planned[i].at.speed_mps, 0.03);
      EXPECT_GT(met[i].time_s, 0.9 * met[i].way_m / planned[i].at.speed_mps);
      EXPECT_EQ(met[i].at.mass_kg, scenario.world.robot.spec.mass_kg);
    }
    double way_m = 0;
    for (const Encounter& e : dut.record.encounters) way_m += e.way_m;
    EXPECT_NEAR(way_m, dut.record.metrics.path_length_m, 0.4) << robot << ": all of the way";
  }
}

// A step that it cannot climb, which nobody told it of: its failure is that encounter's outcome.
TEST_F(EncounterDrive, AFailureIsItsEncountersOutcome) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n7,2.5\n");
  const EpisodeRecord dut = Drive(Read(RoomScenario(
      std::string(kCover) +
      ", {type: step, id: kerb, polygon_m: [[6, 0.5], [8.5, 0.5], [8.5, 4.5], [6, 4.5]], "
      "height_m: 0.05, known: false}")));
  ASSERT_FALSE(dut.events.empty());
  ASSERT_EQ(dut.events[0].hazard, "kerb");
  const std::string mode(Name(dut.events[0].mode));
  EXPECT_THAT(Outcomes(dut.encounters),
              ElementsAre("cover cleared", "kerb " + mode, "free_floor cleared"));
  EXPECT_EQ(dut.encounters[1].size[0], std::pair(std::string("height_m"), 0.05));
  const std::string csv = EncountersCsv(dut.encounters);
  EXPECT_THAT(csv, HasSubstr("\nkerb,step,over,"));
  EXPECT_THAT(csv, HasSubstr("," + mode + ","));
}

// A ramp's rise is told along the robot's way, whichever way it faces in the world.
TEST_F(EncounterDrive, ARampIsMetUpOrDownAndNotTowardsSomewhere) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n5,2.5\n2,2.5\n");
  const EpisodeRecord dut = Drive(Read(RoomScenario(
      "{type: ramp, polygon_m: [[3, 0.5], [6, 0.5], [6, 4.5], [3, 4.5]], slope_deg: 2, "
      "toward_deg: 0}")));
  ASSERT_GE(dut.encounters.size(), 2u);
  const auto rise = [&](std::size_t i) {
    for (const auto& [name, value] : dut.encounters[i].size)
      if (name == "rise_along") return value;
    return 0.0;
  };
  EXPECT_NEAR(rise(0), std::tan(2 * kPi / 180), 1e-3);
  EXPECT_THAT(Outcomes(dut.encounters), ::testing::Contains("ramp-0 cleared"));
}

// A robot of 0.5 m that is moved by hand along y = 2.5 m.
class Moved : public ScenarioTest {
 protected:
  Moved() : scenario_(Read(RoomScenario(kCover, "drive: none\n"), {{"plan.file", Plan()}})) {}
  std::string Plan() const { return Save("plan.csv", "x_m,y_m\n1,2.5\n8,2.5\n").filename(); }

  // From `from_m` to `to_m` at 0.5 m/s.
  void Move(double from_m, double to_m, double y_m = 2.5) {
    const double step_m = std::copysign(0.01, to_m - from_m);
    for (int i = 0; i <= std::lround((to_m - from_m) / step_m); ++i) {
      t_s_ += 0.02;
      Sample sample;
      sample.t_s = t_s_;
      sample.p_WB = {from_m + i * step_m, y_m, 0};
      sample.v_WB_W = {std::copysign(0.5, step_m), 0, 0};
      dut_.OnControl(sample, {}, path_.empty() ? nullptr : &path_);
    }
  }
  void Fail(FailureMode mode, const std::string& hazard) {
    Event event;
    event.mode = mode;
    event.hazard = hazard;
    event.t_s = t_s_;
    dut_.OnEvent(event);
  }

  Scenario scenario_;
  HazardMap floor_ = TrueFloor(scenario_.world);
  EncounterMeter dut_{floor_, scenario_.world.robot.spec, false};
  double t_s_ = 0;
  Path path_;
};

TEST_F(Moved, AFailureSoonAfterwardsIsStillTheHazards) {
  Move(2, 6);
  t_s_ += 10;
  Fail(FailureMode::kStuck, "cover");
  EXPECT_THAT(Outcomes(dut_.Finish()), ElementsAre("cover stuck", "free_floor cleared"));
}

TEST_F(Moved, AFailureLongAfterwardsIsTheFloors) {
  Move(2, 6);
  t_s_ += 60;
  Fail(FailureMode::kStuck, "cover");
  EXPECT_THAT(Outcomes(dut_.Finish()), ElementsAre("cover cleared", "free_floor stuck"));
}

TEST_F(Moved, WhatNobodyDidIsOfWhatTheRobotIsIn) {
  Move(2, 4);
  Fail(FailureMode::kVeerOff, "");
  Fail(FailureMode::kRollOver, "");
  EXPECT_THAT(Outcomes(dut_.Finish()), ElementsAre("cover veer_off", "free_floor cleared"))
      << "the first counts";
}

TEST_F(Moved, WhatTheWallDidIsTheWalls) {
  Move(1, 3, 0.75);
  Fail(FailureMode::kBounceBack, "wall");
  Move(3, 3.2, 2.5);
  const std::vector<Encounter> dut = dut_.Finish();
  EXPECT_THAT(Outcomes(dut), ElementsAre("wall_beside bounce_back", "free_floor cleared"));
  EXPECT_NEAR(dut[0].way_m, 2, 0.03);
  EXPECT_NEAR(dut[0].at.speed_mps, 0.5, 0.01);
}

// Who is thrown back from it and gets over it in the end was in it once; a plan that leads over it,
// beside it and back was twice.
TEST_F(Moved, WhoFallsBackAndTriesAgainIsInTheSameEncounter) {
  path_.resize(2);
  path_[0].p_W = {1, 2.5}, path_[1].p_W = {8, 2.5};
  const double enters_m =
      BoxAround(floor_.hazards[0].footprint[0]).low.x() - scenario_.world.robot.spec.clear.radius_m;
  Move(2, enters_m + 0.03);
  Move(enters_m + 0.03, enters_m - 0.05);
  Move(enters_m - 0.05, 6);
  const std::vector<Encounter> dut = dut_.Finish();
  EXPECT_THAT(Outcomes(dut), ElementsAre("cover cleared", "free_floor cleared"));
  EXPECT_NEAR(dut[0].way_m, dut[0].at.over_m, 0.12);
}

TEST_F(Moved, ComingOverItAgainIsAnotherEncounterThoughItStaysWithinReach) {
  const double leaves_m = BoxAround(floor_.hazards[0].footprint[0]).high.x() +
                          scenario_.world.robot.spec.clear.radius_m;
  Move(2, leaves_m + 0.05);
  Move(leaves_m + 0.05, 2);
  EXPECT_THAT(Outcomes(dut_.Finish()),
              ElementsAre("cover cleared", "cover cleared", "free_floor cleared"));
}

TEST_F(Moved, WhatIsOpenWhenItIsCarriedOrEndsIsCensored) {
  Move(2, 4);
  dut_.Lift();
  Move(2, 4);
  EXPECT_THAT(Outcomes(dut_.Finish()),
              ElementsAre("cover censored", "cover censored", "free_floor cleared"));
}

TEST_F(Moved, RowsComeBackAsTheyWere) {
  Move(2, 6);
  for (const Encounter& encounter : dut_.Finish()) {
    const Encounter again = EncounterOf(EncounterValues(encounter));
    EXPECT_EQ(EncounterValues(again), EncounterValues(encounter));
    EXPECT_EQ(again.size, encounter.size);
  }
}

}  // namespace
}  // namespace floorproof

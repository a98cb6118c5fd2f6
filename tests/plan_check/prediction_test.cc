// SPDX-License-Identifier: Apache-2.0
#include "run/plan_check/prediction.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "env/scene/measured_block.h"
#include "measure/risk_model_json.h"
#include "run/episode/make_plan.h"
#include "run/episode/plain_draws.h"
#include "run/episode/plan_inputs.h"
#include "run/episode/records.h"
#include "run/scenario/scenario_file.h"
#include "tests/planners/planted_modes.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Rates of getting stuck alone, which fall in a straight line of eta with friction.
KindRates Planted(const char* type, Passage passage, double rate_at_04, double rate_at_08) {
  KindRates kind;
  kind.type = type;
  kind.passage = passage;
  kind.encounters = kind.cleared = 1000;
  RateAxis friction;
  friction.name = "friction";
  friction.lower = 0.4, friction.upper = 0.8;
  friction.knots = {0.4, 0.6, 0.8};
  friction.functions = {{-1, 0, 1}};
  kind.axes = {friction};
  testing::PlantShares({0, 1, 0, 0}, kind);
  const double low = EtaOf(rate_at_04), high = EtaOf(rate_at_08);
  kind.any = testing::Point({(low + high) / 2, (high - low) / 2});
  kind.any.blocks = {{{{0, 0, 1}}}};
  return kind;
}

constexpr const char* kCovers =
    "{type: cable_cover, id: first, line_m: [[3, 0.5], [3, 4.5]], height_m: 0.01}, "
    "{type: cable_cover, id: second, line_m: [[5, 0.5], [5, 4.5]], height_m: 0.01}";

class PredictionTest : public ScenarioTest {
 protected:
  PredictionTest() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n7,2.5\n"); }

  // The plan crosses two covers; each is `rate` at either friction, and nothing else fails.
  void SaveModel(double rate_at_04, double rate_at_08, const char* robot = "beluga") {
    const RobotModel model = ReadRobot(FindRobotFile(robot, {}));
    RiskModel risk;
    risk.robot = {model.spec.name, model.spec.drive, model.spec.mass_kg, model.spec.clearance_m,
                  ModelHash(model.files, {})};
    KindRates floor = Planted("free_floor", Passage::kBeside, 1e-12, 1e-12);
    floor.per_metre = true;
    risk.kinds = {Planted("cable_cover", Passage::kOver, rate_at_04, rate_at_08), floor};
    Save("model.json", RiskModelJson(risk));
  }
  ScenarioFile File(const std::string& hazards, const std::string& more = "") const {
    return ScenarioFile(
        Save("scenario.yaml", RoomScenario(hazards, "risk: {model: model.json}\n" + more)));
  }
  std::string WhyRefused(const std::string& more = "") const {
    try {
      Predict(File(kCovers, more), {}, 8);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
};

TEST_F(PredictionTest, EachMeetingHasItsShare) {
  SaveModel(0.2, 0.2);
  const Prediction dut = Predict(File(kCovers), {}, 100);
  EXPECT_EQ(dut.conditions, 1) << "nothing is drawn";
  EXPECT_NEAR(dut.survival.no_failure.value, std::exp(-0.4), 1e-5);
  ASSERT_THAT(dut.meetings, SizeIs(3)) << "and the floor between";
  EXPECT_EQ(dut.meetings[0].expected.hazard, "first");
  EXPECT_NEAR(dut.meetings[0].probability, 1 - std::exp(-0.2), 1e-5);
  EXPECT_NEAR(dut.meetings[1].probability, std::exp(-0.2) * (1 - std::exp(-0.2)), 1e-5);
  EXPECT_NEAR(dut.meetings[1].expected.x_m, 5 - 0.065 - 0.18, 0.06);
  EXPECT_TRUE(dut.complete());
  EXPECT_THAT(dut.beyond, IsEmpty());
}

// Ten crossings that one friction decides fail together: as often as one.
TEST_F(PredictionTest, WhatIsDrawnOnceIsSharedByAllMeetings) {
  SaveModel(40, 1e-9);
  std::string way = "x_m,y_m\n1.5,2.5\n";
  for (int i = 0; i < 5; ++i) way += "7,2.5\n1.5,2.5\n";
  Save("plan.csv", way);
  const std::string one = "{type: cable_cover, id: first, line_m: [[3, 0.5], [3, 4.5]]}";
  const Prediction dut =
      Predict(File(one, "randomise: {site.floor.friction: {uniform: [0.4, 0.8]}}\n"), {}, 400);
  EXPECT_EQ(dut.conditions, 400);
  ASSERT_THAT(dut.meetings, SizeIs(11));
  const double together = 1 - dut.survival.no_failure.value;
  const double once = dut.meetings[0].probability;
  EXPECT_GT(once, 0.3);
  EXPECT_LT(together, once + 0.1) << "independent ones would make " << 1 - std::pow(1 - once, 10);
}

// A draw that moves a hazard off the way takes its meeting away.
TEST_F(PredictionTest, WhatDrawsMoveIsFoundAnew) {
  SaveModel(0.2, 0.2);
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n4,2.5\n");
  const Prediction dut = Predict(
      File(kCovers, "randomise: {site.hazards.first.shift_x_m: {choice: [0, 3]}}\n"), {}, 60);
  double met = 0;
  for (const PredictedMeeting& meeting : dut.meetings)
    if (meeting.expected.hazard == "first") met += meeting.probability;
  const double moved = 1 - met / (1 - std::exp(-0.2));
  EXPECT_GT(moved, 0.2);
  EXPECT_LT(moved, 0.8);
  EXPECT_NEAR(dut.survival.no_failure.value, moved + (1 - moved) * std::exp(-0.2), 1e-5);
}

// Every episode's plan is made for all that may be drawn.
TEST_F(PredictionTest, APlannerKnowsWhatMayBeDrawnAndNotWhatIs) {
  SaveModel(0.5, 1e-9);
  const std::string scenario = RoomScenario(
      "{type: cable_cover, id: first, line_m: [[3, 0.5], [3, 4.5]]}",
      "risk: {model: model.json}\nrandomise: {site.floor.friction: {uniform: [0.4, 0.8]}}\n");
  const ScenarioFile file(Save("scenario.yaml", scenario),
                          {{"plan", "{planner: survival_coverage}"}});
  Scenario a = file.Read(0), b = file.Read(1);
  ASSERT_NE(a.world.site.map.floor_friction, b.world.site.map.floor_friction);
  const std::vector<DriveConditions> of_a = ConditionsOf(a), of_b = ConditionsOf(b);
  ASSERT_THAT(of_a, SizeIs(64));
  double sum = 0;
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    EXPECT_EQ(of_a[i].friction, of_b[i].friction);
    EXPECT_GE(of_a[i].friction, 0.4);
    EXPECT_LE(of_a[i].friction, 0.8);
    EXPECT_EQ(of_a[i].mass_kg, a.world.robot.spec.mass_kg);
    sum += of_a[i].friction / 64;
  }
  EXPECT_NEAR(sum, 0.6, 0.005) << "spread evenly";
  EXPECT_EQ(PlanInputs(a), PlanInputs(b));
  const Scenario other = ScenarioFile(file.file(), {{"plan", "{planner: survival_coverage}"},
                                                    {"site.floor.friction", "0.5"}})
                             .Read(0);
  EXPECT_THAT(ConditionsOf(other), SizeIs(1)) << "what is set is not drawn";
  EXPECT_NE(PlanInputs(other), PlanInputs(a));
}

TEST_F(PredictionTest, WhatWasNotMeasuredIsSaid) {
  SaveModel(0.2, 0.2);
  const Prediction dut =
      Predict(File(std::string(kCovers) + ", {type: groove, line_m: [[6, 0.5], [6, 4.5]]}"), {}, 1);
  EXPECT_FALSE(dut.complete());
  ASSERT_THAT(dut.unmeasured, SizeIs(1));
  EXPECT_EQ(dut.unmeasured[0].type, "groove");
  EXPECT_EQ(dut.unmeasured[0].meetings, 1);
  const std::vector<std::string> lines = PredictionLines(dut);
  EXPECT_THAT(lines, Contains(HasSubstr("at least 33 %")));
  EXPECT_THAT(lines, Contains(HasSubstr("warning: nothing is known of groove over, met 1 time")));
}

TEST_F(PredictionTest, WhatLiesBeyondWhatWasMeasuredIsSaid) {
  SaveModel(0.2, 0.2);
  const Prediction within = Predict(File(kCovers), {}, 1);
  const std::string slippery = RoomScenario(kCovers, "risk: {model: model.json}\n");
  const Prediction dut = Predict(
      ScenarioFile(Save("scenario.yaml", slippery), {{"site.floor.friction", "0.2"}}), {}, 1);
  ASSERT_THAT(dut.beyond, SizeIs(2)) << "of covers and of floor";
  EXPECT_EQ(dut.beyond[0].axis, "friction");
  EXPECT_NEAR(dut.beyond[0].share, 0.5, 1e-9);
  const auto width = [](const Prediction& p) {
    return p.survival.no_failure.upper - p.survival.no_failure.lower;
  };
  EXPECT_GT(width(dut), width(within) + 0.1);
  EXPECT_THAT(PredictionLines(dut), Contains(HasSubstr("by 50 % of that range")));
}

// Far beyond it nothing is known: by a share of the range, or by a factor.
TEST_F(PredictionTest, FarBeyondWhatWasMeasuredItMayAlwaysFail) {
  SaveModel(0.01, 0.01);
  const std::string text = RoomScenario(kCovers, "risk: {model: model.json}\n");
  const auto at = [&](const char* friction) {
    return Predict(ScenarioFile(Save("scenario.yaml", text), {{"site.floor.friction", friction}}),
                   {}, 1);
  };
  for (const char* near : {"0.4", "0.37", "0.85"}) {
    EXPECT_TRUE(at(near).complete()) << near;
    EXPECT_GT(at(near).survival.no_failure.lower, 0.5) << near;
  }
  for (const char* far : {"0.25", "0.001", "1.3"}) {
    EXPECT_FALSE(at(far).complete()) << far;
    EXPECT_EQ(at(far).survival.no_failure.lower, 0) << far;
    EXPECT_THAT(PredictionLines(at(far)), Contains(HasSubstr("to 100 %"))) << far;
  }
  EXPECT_THAT(PredictionLines(at("0.001")),
              Contains(HasSubstr("friction = 0.001 is far beyond what was measured of cable_cover, "
                                 "0.4 to 0.8, at first (cable_cover, over)")));
}

// A robot that knows its place and passes close by a wall does what was measured, though no drive
// came to be wrong by exactly 0, or had exactly 0 between it and the wall.
TEST(FarBeyond, IsAFactorOfWhatCannotBeZeroAlone) {
  const auto is_far = [](const char* name, bool of_hazard, double lower, double upper, double x) {
    RateAxis axis;
    axis.name = name;
    axis.of_hazard = of_hazard;
    axis.lower = lower, axis.upper = upper;
    return IsFarBeyond(axis, x);
  };
  EXPECT_FALSE(is_far("wall_m", false, 0.0101528, 1, 0));
  EXPECT_FALSE(is_far("estimate_error_m", false, 1.86702e-06, 0.136975, 0));
  EXPECT_FALSE(is_far("gap_m", false, 5.85e-05, 0.0998, 0));
  EXPECT_FALSE(is_far("speed_mps", false, 0.045, 0.4, 0)) << "it starts there";
  EXPECT_TRUE(is_far("speed_mps", false, 0.045, 0.4, 0.5));
  EXPECT_TRUE(is_far("estimate_error_m", false, 1.86702e-06, 0.136975, 0.2));
  EXPECT_TRUE(is_far("friction", true, 0.0205, 0.6, 0.001)) << "of a wet floor";
  EXPECT_TRUE(is_far("friction", false, 0.3, 1, 0.19));
  EXPECT_TRUE(is_far("height_m", true, 0.001, 0.02, 0.031));
}

// Rates of ramps were measured on ramps that lead to a floor.
TEST_F(PredictionTest, ARampThatLeadsToNothingMayAlwaysFail) {
  SaveModel(0.01, 0.01);
  const Prediction dut =
      Predict(File("{type: ramp, id: quay, polygon_m: [[3, 0.5], [5, 0.5], [5, 4.5], [3, 4.5]], "
                   "slope_deg: 4, toward_deg: 0, known: false}"),
              {}, 1);
  EXPECT_FALSE(dut.complete());
  EXPECT_THAT(dut.left_out, Contains(HasSubstr("the end of ramp quay, 140 mm above the floor")));
  EXPECT_EQ(dut.survival.no_failure.lower, 0);
}

// From a carpet on which it starts the floor beside is a level change without keys.
TEST_F(PredictionTest, TheEdgeOfTheFloorOnWhichItStartsMayAlwaysFail) {
  SaveModel(0.01, 0.01);
  const Prediction dut =
      Predict(File("{type: step, id: rug, height_m: 0.006, polygon_m: [[0.5, 0.5], [3, 0.5], "
                   "[3, 4.5], [0.5, 4.5]]}"),
              {}, 1);
  EXPECT_FALSE(dut.complete());
  EXPECT_THAT(dut.left_out, Contains(HasSubstr("the edge of 'base_floor'")));
  EXPECT_EQ(dut.survival.no_failure.lower, 0);
}

// A robot that is wrong about its place, what breaks and who watches it: rates know nothing of it.
TEST_F(PredictionTest, WhatIsNotInItIsSaid) {
  SaveModel(0.2, 0.2);
  const Prediction dut = Predict(File(kCovers, "estimator: odometry\n"), {}, 1);
  EXPECT_FALSE(dut.complete());
  EXPECT_THAT(PredictionLines(dut), Contains(HasSubstr("warning: not in it: how wrong odometry")));
  EXPECT_THAT(Predict(File(kCovers), {}, 1).left_out, IsEmpty());
}

// Longer than any that was measured, it counts as so many of the longest.
TEST_F(PredictionTest, ALongerMeetingCountsMoreOften) {
  KindRates kind = Planted("cable_cover", Passage::kOver, 0.2, 0.2);
  kind.axes.resize(kind.axes.size() + 1);
  kind.axes.back().name = "over_m";
  kind.axes.back().upper = 2;
  Approach at;
  at.over_m = 1;
  EXPECT_EQ(RateEvaluator(kind).TimesMeasured(at), 1);
  at.over_m = 5;
  EXPECT_EQ(RateEvaluator(kind).TimesMeasured(at), 2.5);
  kind.per_metre = true;
  EXPECT_EQ(RateEvaluator(kind).TimesMeasured(at), 1) << "its metres count already";
}

TEST_F(PredictionTest, TheFileSaysAllOfIt) {
  SaveModel(0.2, 0.2);
  const ScenarioFile file = File(kCovers);
  const Prediction prediction = Predict(file, {}, 1);
  const Scenario s = file.Read();
  const auto plan = PlanJson(s, prediction.plan);
  const auto dut = PredictionJson(s, prediction, plan);
  EXPECT_EQ(dut["coverage"], plan["coverage"]);
  EXPECT_NEAR(dut["no_failure"]["probability"], std::exp(-0.4), 1e-5);
  EXPECT_NEAR(dut["modes"]["stuck"]["probability"], 1 - std::exp(-0.4), 1e-5);
  EXPECT_NEAR(dut["hazards"]["second"], prediction.meetings[1].probability, 1e-12);
  EXPECT_EQ(dut["meetings"][0]["type"], "cable_cover");
  EXPECT_EQ(dut["meetings"][0]["size"]["height_m"], 0.01);
  EXPECT_NEAR(dut["meetings"][0]["met"]["speed_mps"], 0.25, 0.01);
}

TEST_F(PredictionTest, WhatCannotBePredictedIsRefusedInALine) {
  SaveModel(0.2, 0.2, "rover");
  EXPECT_THAT(WhyRefused(), HasSubstr("risk.model = model.json: was measured of rover, and this is "
                                      "beluga"));
  SaveModel(0.2, 0.2);
  const std::string room = RoomScenario(kCovers, "risk: {model: model.json}\n");
  for (const auto& [key, value] :
       {std::pair("robot.wheel_radius_m", "0.03"), {"battery.voltage_v", "9"}}) {
    try {
      Predict(ScenarioFile(Save("scenario.yaml", room), {{key, value}}), {}, 1);
      ADD_FAILURE() << key;
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr(std::string("the scenario sets ") + key));
    }
  }
  EXPECT_NO_THROW(
      Predict(ScenarioFile(Save("scenario.yaml", room), {{"robot.clearance_m", "0.024"}}), {}, 1));
  // A battery in use, as `init` draws it.
  const Prediction used =
      Predict(ScenarioFile(Save("scenario.yaml", room), {{"battery.voltage_v", "11"}}), {}, 1);
  EXPECT_THAT(used.left_out, ElementsAre("a battery of 11 V: the rates were measured at 12 V"));
  EXPECT_THAT(PredictionLines(used), Contains(HasSubstr("95 % interval of what is in it")));
  EXPECT_THAT(WhyRefused("plan: {planner: frontier_coverage}\n"), HasSubstr("plan"));
  std::filesystem::remove(folder_ / "model.json");
  EXPECT_THAT(WhyRefused(), HasSubstr("model.json"));
  EXPECT_THAT(WhyRefused(), Not(HasSubstr("\n")));
}

}  // namespace
}  // namespace floorproof

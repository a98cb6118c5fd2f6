// SPDX-License-Identifier: Apache-2.0
#include "measure/expert_predictors.h"

#include <gmock/gmock.h>

#include <cmath>

#include "base/streams.h"

namespace floorproof {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;

TEST(FitConstant, IsTheShareThatFailed) {
  EXPECT_DOUBLE_EQ(FitConstant(std::vector<TrainingPlan>{{{}, 3, 10}, {{}, 1, 30}}), 0.1);
  EXPECT_TRUE(std::isnan(FitConstant({})));
}

TEST(FitRatesOfExposures, OfOnePlanGivesItsShareBack) {
  const std::vector<TrainingPlan> plans = {{{4}, 3, 10}};
  const auto dut = FitRatesOfExposures(plans);
  EXPECT_THAT(dut, ElementsAre(DoubleNear(-std::log(0.7) / 4, 1e-8)));
  EXPECT_NEAR(FailureOfExposures(dut, plans[0].exposures), 0.3, 1e-8);
}

TEST(FitRatesOfExposures, FindsPlantedRatesAndGivesOthersNone) {
  const std::vector<double> truth = {0.02, 0.3, 0};
  Stream random(0, 0, "planted");
  std::vector<TrainingPlan> plans;
  for (int i = 0; i < 300; ++i) {
    TrainingPlan plan{{10 * random.Uniform(), std::floor(4 * random.Uniform()), 0}, 0, 50};
    if (i % 2 == 0) plan.exposures[2] = 3;
    const double p = FailureOfExposures(truth, plan.exposures);
    for (int drive = 0; drive < plan.n; ++drive) plan.k += random.Uniform() < p;
    plans.push_back(plan);
  }
  EXPECT_THAT(FitRatesOfExposures(plans),
              ElementsAre(DoubleNear(0.02, 0.002), DoubleNear(0.3, 0.02), DoubleNear(0, 0.005)));
}

TEST(FitRatesOfExposures, OfWhatNobodyMetIsNone) {
  EXPECT_THAT(FitRatesOfExposures(std::vector<TrainingPlan>{{{1, 0}, 5, 10}}),
              ElementsAre(DoubleNear(std::log(2), 1e-8), 0));
  EXPECT_THAT(FitRatesOfExposures(std::vector<TrainingPlan>{{{1}, 0, 10}}),
              ElementsAre(DoubleNear(0, 1e-9)));
}

Encounter Met(const char* type, Encounter::Outcome outcome) {
  Encounter e;
  e.type = type;
  e.outcome = outcome;
  return e;
}

TEST(ExpertFailures, AreOfTheClassesThatWereMet) {
  using Outcome = Encounter::Outcome;
  const std::map<std::string, HazardClass> classes = {{"step", HazardClass::kLevelChange},
                                                      {"ramp", HazardClass::kLevelChange},
                                                      {"rough", HazardClass::kTerrain}};
  std::vector<Encounter> met = {
      Met("step", Outcome::kFailed),    Met("step", Outcome::kCleared),
      Met("ramp", Outcome::kCleared),   Met("ramp", Outcome::kCleared),
      Met("rough", Outcome::kCensored), Met("free_floor", Outcome::kFailed)};
  const ClassNumbers occurrence = OccurrenceOfClasses(met, classes);
  EXPECT_THAT(occurrence, ElementsAre(0, 0, 0.25, 0));
  FmeaTables tables;
  tables.mode_of_class[2] = {0.1, 0.2, 0.3, 0.4};
  const ModeNumbers dut = ExpertFailures(tables, occurrence, {5, 0, 2, 0});
  const double any = 1 - 0.75 * 0.75;
  EXPECT_THAT(dut, ElementsAre(DoubleNear(0.1 * any, 1e-12), DoubleNear(0.2 * any, 1e-12),
                               DoubleNear(0.3 * any, 1e-12), DoubleNear(0.4 * any, 1e-12)));
}

}  // namespace
}  // namespace floorproof

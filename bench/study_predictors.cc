// SPDX-License-Identifier: Apache-2.0
#include "bench/study_predictors.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bench/study_figures.h"
#include "planners/risk/risk_meter.h"
#include "run/plan_check/prediction.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

void AddOthers(const FittedPredictors& fitted, const FmeaTables& tables, Json& plan) {
  const std::vector<double> crf = {plan["crf"]};
  const ClassNumbers meetings = plan["meetings"];
  Json& predicted = plan["predicted"];
  predicted["a constant"] = fitted.constant;
  predicted["1 - exp(-a CRF)"] = FailureOfExposures(fitted.of_crf, crf);
  predicted["hazards counted"] = FailureOfExposures(fitted.of_classes, meetings);
  predicted["Table 3, occurrence fitted"] =
      Total(ExpertFailures(tables, fitted.occurrence, meetings));
}

}  // namespace

std::string KindOf(const Encounter& e) {
  return e.hazard.empty() ? e.type : fmt::format("{} {}", e.type, Name(e.passage));
}

void DescribePlan(const ScenarioFile& file, const std::map<std::string, HazardClass>& class_of_type,
                  const FittedPredictors* fitted, Json& plan) {
  constexpr int kDraws = 256;
  const Scenario scenario = file.Read();
  const Prediction prediction = Predict(file, {}, kDraws);
  std::vector<Encounter> expected;
  std::map<std::string, double> kinds;
  for (const PredictedMeeting& meeting : prediction.meetings) {
    expected.push_back(meeting.expected);
    kinds[KindOf(meeting.expected)] += meeting.probability;
  }
  const RiskMap risk = ComputeRisk(scenario.world.site.map, scenario.world.robot.spec,
                                   scenario.spec.fmea, scenario.spec.risk);
  plan["crf"] = MeasureRisk(risk, prediction.plan.path).cumulative_risk;
  plan["meetings"] = MeetingsOfClasses(expected, class_of_type);
  plan["complete"] = prediction.complete();
  const Probability& none = prediction.survival.no_failure;
  plan["lower"] = 1 - none.upper;
  plan["upper"] = 1 - none.lower;
  for (int m = 0; m < kNumFailureModes; ++m)
    plan["modes"][std::string(Name(static_cast<FailureMode>(m)))] =
        prediction.survival.first[static_cast<std::size_t>(m)].value;
  plan["kinds"] = kinds;
  plan["predicted"][kModelPredictor] = 1 - none.value;
  if (fitted != nullptr) AddOthers(*fitted, scenario.spec.fmea, plan);
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "report/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "report/rates.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

VariantSummary Summary(const std::string& name, int k, int n, double upper = 0.5) {
  const double rate = n > 0 ? static_cast<double>(k) / n : NAN;
  VariantSummary v{.name = name, .n = n, .success = n - k, .failure = k};
  v.failures = {{"any_failure", k, n, rate, rate / 2, upper}, {"stuck", 1, n, 0.05, 0.01, 0.2}};
  return v;
}

Report Of(std::vector<VariantSummary> variants, const std::string& subject = "") {
  Report report;
  report.subject = subject;
  report.summary.variants = std::move(variants);
  return report;
}

GateSummary GateOf(const std::string& metric, GateVerdict verdict) {
  return {.metric = metric, .max_rate = 0.01, .confidence = 0.95, .verdict = verdict};
}

TEST(Verdict, NamesRobotPlanSiteRateAndGate) {
  VariantSummary variant = Summary("all", 3, 1000);
  variant.failures[0].lower = 0.0006;
  variant.failures[0].upper = 0.0087;
  Report report = Of({variant}, "htetro, risk_coverage plan, staircase hall");
  EXPECT_EQ(VerdictText(report),
            "htetro, risk_coverage plan, staircase hall: 3 failures in 1,000 drives (0.3 %), 0.06 "
            "to 0.87 % at 95 %.");
  report.summary.gate = GateOf("any_failure", GateVerdict::kPassed);
  EXPECT_THAT(VerdictText(report), HasSubstr("0.87 % at 95 %; gate < 1 %: passed."));
  EXPECT_THAT(VerdictBox(report), StartsWith("<div class=\"verdict passed\">"));
}

TEST(Verdict, OfOneVariantSaysWhatCanBeSaid) {
  EXPECT_EQ(VerdictText(Of({Summary("a", 0, 20, 0.168)})),
            "no failure in 20 drives, 0 to 16.8 % at 95 %.");
  EXPECT_THAT(VerdictText(Of({Summary("a", 1, 1)})), StartsWith("1 failure in 1 drive (100 %), "));
  EXPECT_EQ(VerdictText(Of({Summary("a", 0, 0)}, "htetro")), "htetro: no drive that counts.");
  VariantSummary repeated = Summary("a", 0, 1);
  repeated.repeated = true;
  repeated.n = 100;
  EXPECT_EQ(VerdictText(Of({repeated})), "no failure in its one drive, repeated 100 times.");
}

TEST(Verdict, IsOfWhatTheGateJudges) {
  Report report = Of({Summary("a", 5, 20)});
  report.summary.gate = GateOf("stuck", GateVerdict::kUndecided);
  EXPECT_EQ(VerdictText(report),
            "stuck in 1 of 20 drives (5 %), 1 to 20 % at 95 %; gate on stuck < 1 %: undecided.");
  EXPECT_THAT(VerdictBox(report), StartsWith("<div class=\"verdict undecided\">"));
}

TEST(Verdict, OfSeveralVariantsNamesTheBestAndTheWorst) {
  EXPECT_THAT(VerdictText(Of({Summary("a", 5, 20), Summary("b", 2, 20)}, "htetro, hall")),
              StartsWith("htetro, hall: b: 2 failures in 20 drives (10 %), "));
  EXPECT_THAT(VerdictText(Of({Summary("a", 2, 20), Summary("b", 2, 20)})),
              StartsWith("both variants failed equally often, a: 2 failures"));
  EXPECT_THAT(VerdictText(Of({Summary("a", 2, 20), Summary("b", 2, 20), Summary("c", 2, 20)})),
              StartsWith("all 3 variants failed equally often, a: "));
  EXPECT_THAT(VerdictText(Of({Summary("a", 2, 20), Summary("b", 1, 20), Summary("c", 3, 20)})),
              testing::AllOf(StartsWith("least often b: 1 failure in 20 drives"),
                             HasSubstr("; most often c: 3 failures in 20 drives")));
  VariantSummary late = Summary("a", 0, 20), timely = Summary("b", 0, 20);
  late.timeout = 20;
  late.failures.push_back({"not_success", 20, 20, 1, 0.8, 1});
  timely.failures.push_back({"not_success", 0, 20, 0, 0, 0.17});
  EXPECT_THAT(VerdictText(Of({late, timely})),
              testing::AllOf(StartsWith("b: not success in 0 of 20 drives"),
                             HasSubstr("; a: not success in 20 of 20 drives (100 %)")));
  EXPECT_THAT(VariantsTable(Of({late, timely})), HasSubstr("By variant: not success"));
  EXPECT_EQ(VerdictText(Of({Summary("a", 0, 0), Summary("b", 0, 0)})),
            "no robot drove: the episodes are plans only, or none counts.");
  Report gated = Of({Summary("a", 2, 20), Summary("b", 1, 20)});
  gated.summary.gate = GateOf("any_failure", GateVerdict::kFailed);
  EXPECT_THAT(VerdictText(gated), StartsWith("gate < 1 % in each variant: failed; b: 1 failure"));
}

TEST(Verdict, WithoutAGateIsColouredByWhetherAnythingFailed) {
  EXPECT_THAT(VerdictBox(Of({Summary("a", 0, 20)})), StartsWith("<div class=\"verdict passed\">"));
  EXPECT_THAT(VerdictBox(Of({Summary("a", 1, 20)})), StartsWith("<div class=\"verdict failed\">"));
  EXPECT_THAT(VerdictBox(Of({Summary("a", 0, 0)})), StartsWith("<div class=\"verdict \">"));
  VariantSummary some = Summary("a", 0, 20);
  some.not_planned = 5;
  EXPECT_THAT(VerdictBox(Of({some})), StartsWith("<div class=\"verdict undecided\">"));
}

// No failure is no success: a robot that runs out of time has not done its work.
TEST(Verdict, WhatIsNoSuccessIsSaidAndIsNotGreen) {
  VariantSummary variant = Summary("a", 0, 12);
  variant.success = 0;
  variant.timeout = 11;
  variant.aborted = 1;
  variant.not_planned = 3;
  const Report report = Of({variant});
  EXPECT_THAT(
      VerdictText(report),
      testing::EndsWith(" at 95 %, 11 ran out of time, 1 stopped by themselves, 3 had no plan."));
  EXPECT_THAT(VerdictBox(report), StartsWith("<div class=\"verdict undecided\">"));
}

// A gate looks at one side: beside an interval of two its bound is said, too.
TEST(Verdict, APassedGateSaysItsBound) {
  Report report = Of({Summary("a", 0, 59, 0.0607)});
  report.summary.gate = GateOf("any_failure", GateVerdict::kPassed);
  report.summary.gate->max_rate = 0.05;
  GateReport found;
  found.rate = {0, 0.04951};
  report.summary.gate->variants = {{"a", found}};
  EXPECT_EQ(VerdictText(report),
            "no failure in 59 drives, 0 to 6.07 % at 95 %; gate < 5 %: passed, at most 4.96 % with "
            "95 % confidence.");
}

// What the variants differ in is no subject of all of them.
TEST(Verdict, SubjectIsWhatTheVariantsShare) {
  Scenario scenario;
  scenario.world.robot.spec.name = "htetro";
  scenario.spec.planner_name = "spiral";
  scenario.world.site.map.name = "hall";
  EXPECT_EQ(SubjectOf(scenario, {}), "htetro, spiral plan, hall");
  const auto with = [&](const std::string& key) {
    Variant variant;
    variant.overrides = {{key, ConfigNode()}};
    return SubjectOf(scenario, {variant});
  };
  EXPECT_EQ(with("robot"), "spiral plan, hall");
  EXPECT_EQ(with("plan.planner"), "htetro, hall");
  EXPECT_EQ(with("plan.speed_mps"), "htetro, spiral plan, hall");
  EXPECT_EQ(with("site"), "htetro, spiral plan");
  EXPECT_EQ(with("site.floor.friction"), "htetro, spiral plan, hall");
  scenario.spec.planner_name.clear();
  scenario.spec.plan_file = "plans/mine.csv";
  EXPECT_EQ(SubjectOf(scenario, {}), "htetro, plan mine.csv, hall");
}

}  // namespace
}  // namespace floorproof

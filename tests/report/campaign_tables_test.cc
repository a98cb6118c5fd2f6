// SPDX-License-Identifier: Apache-2.0
// The tables that a campaign ends with.
#include "report/campaign_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace floorproof {
namespace {

using ::testing::ElementsAre;

FailureRate Rate(const char* name, int k, int n, double lower, double upper) {
  return {.name = name,
          .k = k,
          .n = n,
          .rate = static_cast<double>(k) / n,
          .lower = lower,
          .upper = upper};
}

VariantSummary Variant(const char* name, int failures) {
  VariantSummary v;
  v.name = name;
  v.n = 1200;
  v.success = 1200 - failures;
  v.failure = failures;
  const double lower = failures == 0 ? 0 : 0.01037, upper = failures == 0 ? 0.003071 : 0.02525;
  v.failures = {Rate("any_failure", failures, 1200, lower, upper),
                Rate("veer_off", 0, 1200, 0, 0.003071), Rate("stuck", failures, 1200, lower, upper),
                Rate("roll_over", 0, 1200, 0, 0.003071),
                Rate("not_success", failures, 1200, lower, upper)};
  return v;
}

TEST(CampaignTables, SayOutcomesAndRatesOfOneVariant) {
  CampaignSummary dut;
  dut.variants = {Variant("default", 20)};
  EXPECT_THAT(OutcomesTable(dut).Lines(80, false),
              ElementsAre("  Variant  Episodes  Success  Failure    Fail  95 % interval",
                          "  default     1,200    1,180       20  1.67 %  1.03 to 2.53 %"));
  EXPECT_THAT(ModesTable(dut).Lines(80, false),
              ElementsAre("  Failure              Drives    Rate  95 % interval",
                          "  stuck                    20  1.67 %  1.03 to 2.53 %",
                          "  veer off, roll over       0    none  at most 0.308 %"));
}

TEST(CampaignTables, WhatHappenedToNoneTakesNoRoom) {
  CampaignSummary dut;
  dut.variants = {Variant("default", 0)};
  EXPECT_THAT(OutcomesTable(dut).Lines(80, false),
              ElementsAre("  Variant  Episodes  Success  Failure  Fail  95 % interval",
                          "  default     1,200    1,200        0  none  at most 0.308 %"));
  EXPECT_TRUE(ModesTable(dut).empty());
  dut.variants.front().timeout = 3;
  dut.variants.front().errors = 1;
  EXPECT_EQ(OutcomesTable(dut).Lines(100, false).front(),
            "  Variant  Episodes  Success  Failure  Timeout  Error  Fail  95 % interval");
}

TEST(CampaignTables, CompareVariantsByMode) {
  CampaignSummary dut;
  dut.variants = {Variant("floor=dry", 0), Variant("floor=wet", 20)};
  EXPECT_THAT(ModesTable(dut).Lines(80, false),
              ElementsAre("  Drives that failed   stuck",  //
                          "  floor=dry             none",  //
                          "  floor=wet           1.67 %"));
  EXPECT_THAT(
      OutcomesTable(dut).Lines(40, false),
      ElementsAre("  floor=dry", "    Episodes: 1,200", "    Success: 1,200", "    Failure: 0",
                  "    Fail: none", "    95 % interval: at most 0.308 %", "  floor=wet",
                  "    Episodes: 1,200", "    Success: 1,180", "    Failure: 20",
                  "    Fail: 1.67 %", "    95 % interval: 1.03 to 2.53 %"));
}

TEST(CampaignTables, CompareVariantsThatRanOutOfTime) {
  CampaignSummary dut;
  dut.variants = {Variant("slow", 0), Variant("fast", 0)};
  dut.variants[0].success = 1180;
  dut.variants[0].timeout = 20;
  dut.variants[0].failures.back() = Rate("not_success", 20, 1200, 0.01037, 0.02525);
  EXPECT_THAT(ModesTable(dut).Lines(80, false),
              ElementsAre("  Drives that failed  not success", "  slow                     1.67 %",
                          "  fast                       none"));
}

// All ended without being driven.
TEST(CampaignTables, SayNoRateOfNoDrive) {
  CampaignSummary dut;
  VariantSummary& v = dut.variants.emplace_back();
  v.name = "default";
  v.not_planned = 5;
  v.failures = {{.name = "any_failure"}};
  EXPECT_THAT(OutcomesTable(dut).Lines(80, false),
              ElementsAre("  Variant  Episodes  Success  Failure  No plan  Fail  95 % interval",
                          "  default         0        0        0        5"));
}

}  // namespace
}  // namespace floorproof

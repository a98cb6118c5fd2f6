// SPDX-License-Identifier: Apache-2.0
// Minutes: how well rates are found again, over many repeats.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "measure/judge_rates.h"
#include "tests/measure/known_truth.h"
#include "tests/measure/planted_rates.h"

namespace floorproof {
namespace {

TEST(KnownTruth, IntervalsCoverInNineteenOfTwentyRepeats) {
  for (const int encounters : {500, 2000}) {
    const double coverage = Coverage(500, encounters, 256);
    std::cout << encounters << " encounters: " << coverage << "\n";
    EXPECT_GE(coverage, 0.93);
    EXPECT_LE(coverage, 0.97);
  }
}

struct Truth {
  const char* name;
  PlantedRates rates;
};

class Calibration : public ::testing::TestWithParam<Truth> {};

// Of whether encounters fail, in whatever mode.
double LossOfFailure(std::vector<JudgedEncounter> judged) {
  for (JudgedEncounter& each : judged) {
    each.first = {Total(each.first)};
    each.mode = std::min(each.mode, 0);
  }
  return Judge(judged).log_loss;
}

// Fitted to 2500 encounters of a kind, judged on 20,000 fresh ones; means over repeats.
TEST_P(Calibration, OfFreshEncountersIsRight) {
  constexpr int kRepeats = 8;
  double slope = 0, error = 0, excess = 0, of_modes = 0, of_truth = 0;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    Stream random(3, repeat, GetParam().name);
    RateFitOptions options;
    options.mirrored = true;
    const RiskModel model =
        FitRates(DrawEncounters(2500, GetParam().rates, DrawCover, random), {}, options);
    const std::vector<Encounter> fresh = DrawEncounters(20000, GetParam().rates, DrawCover, random);
    const std::vector<JudgedEncounter> judged = Predicted(ModelRates(model), fresh);
    const RateJudgement dut = Judge(judged);
    std::vector<JudgedEncounter> truly;
    for (const Encounter& e : fresh)
      truly.push_back({FirstFailures(GetParam().rates(e)),
                       e.outcome == Encounter::Outcome::kFailed ? static_cast<int>(e.mode) : -1});
    slope += dut.slope.value() / kRepeats;
    error += dut.calibration_error / kRepeats;
    const RateJudgement best = Judge(truly);
    const double whole = dut.log_loss - best.log_loss,
                 bare = LossOfFailure(judged) - LossOfFailure(truly);
    of_truth += best.log_loss / kRepeats;
    excess += bare / kRepeats;
    of_modes += (whole - bare) / kRepeats;
    EXPECT_LT(dut.log_loss, dut.log_loss_of_constant);
  }
  std::cout << GetParam().name << ": slope " << slope << ", calibration error " << error
            << ", log loss " << of_truth << " + " << excess << " + " << of_modes << "\n";
  EXPECT_GE(slope, 0.9);
  EXPECT_LE(slope, 1.1);
  EXPECT_LE(error, 0.02);
  EXPECT_LE(excess, 0.02);
  EXPECT_LE(of_modes, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Of, Calibration,
                         ::testing::Values(Truth{"sharp", SharpCover},
                                           Truth{"gradual", GradualCover},
                                           Truth{"safe", SafeCover}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Drives are drawn from true probabilities, so it is known how good the predictions are.
#include "measure/judge_predictions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/streams.h"

namespace floorproof {
namespace {

constexpr int kSites = 60, kPlansPerSite = 4, kDrives = 50;

double Odds(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

// Predictions whose log odds are so many times those of the truth, and so much above.
std::vector<JudgedPlan> Driven(double times, double above, std::uint64_t seed = 0) {
  Stream random(seed, 0, "judged_plans");
  std::vector<JudgedPlan> plans;
  for (int i = 0; i < kSites * kPlansPerSite; ++i) {
    const double log_odds = random.Uniform(-4, 2);
    JudgedPlan plan{i / kPlansPerSite, {Odds(times * log_odds + above), 0, kDrives}};
    for (int drive = 0; drive < kDrives; ++drive)
      plan.failure.k += random.Uniform() < Odds(log_odds);
    plans.push_back(plan);
  }
  return plans;
}

bool Holds(const RangedFigures& of, std::optional<double> PredictionFigures::*figure,
           double value) {
  return *(of.lower.*figure) <= value && value <= *(of.upper.*figure);
}

TEST(PredictionFigures, OfFewPlansAreThoseOfTheirFormulas) {
  const std::vector<JudgedPlan> plans = {{0, {0.25, 1, 4}}, {1, {0.75, 2, 4}}};
  const PredictionFigures dut = FiguresOf(plans);
  EXPECT_NEAR(*dut.log_score, (3 * std::log(0.25) + 5 * std::log(0.75)) / 8, 1e-12);
  EXPECT_NEAR(*dut.brier, (3 * 0.75 * 0.75 + 5 * 0.25 * 0.25) / 8, 1e-12);
  EXPECT_NEAR(*dut.reliability, 0.5 * 0.25 * 0.25, 1e-12);
  EXPECT_NEAR(*dut.resolution, 0.125 * 0.125, 1e-12);
  EXPECT_NEAR(*dut.uncertainty, 0.375 * 0.625, 1e-12);
  EXPECT_NEAR(*dut.brier, *dut.reliability - *dut.resolution + *dut.uncertainty, 1e-12);
  EXPECT_NEAR(*dut.calibration_error, 0.125, 1e-12);
  EXPECT_NEAR(*dut.mean_error, 0.125, 1e-12);
  EXPECT_FALSE(dut.slope);  // of three failures nothing can be said
}

TEST(PredictionFigures, OfNothingDrivenAreNone) {
  for (const PredictionFigure& figure : kPredictionFigures)
    EXPECT_FALSE(FiguresOf(std::vector<JudgedPlan>{{0, {0.5, 0, 0}}}).*figure.member)
        << figure.name;
}

TEST(PredictionFigures, OneSurpriseIsWorthNoMoreThanTheBound) {
  EXPECT_NEAR(*FiguresOf(std::vector<JudgedPlan>{{0, {0, 1, 1}}}).log_score, std::log(1e-4), 1e-9);
}

TEST(JudgePredictions, RightOnesShowWhatRightOnesWould) {
  const PredictionJudgement dut = JudgePredictions(Driven(1, 0), 200);
  EXPECT_EQ(dut.sites, kSites);
  EXPECT_EQ(dut.plans, kSites * kPlansPerSite);
  EXPECT_EQ(dut.drives, kSites * kPlansPerSite * kDrives);
  EXPECT_TRUE(Holds(dut.seen, &PredictionFigures::slope, 1));
  EXPECT_TRUE(Holds(dut.seen, &PredictionFigures::intercept, 0));
  for (const PredictionFigure& figure : kPredictionFigures)
    EXPECT_TRUE(Holds(dut.right, figure.member, *(dut.seen.value.*figure.member))) << figure.name;
  EXPECT_NEAR(*dut.right.value.slope, 1, 0.01);
}

TEST(JudgePredictions, TooBoldOnesHaveASlopeBelowOne) {
  const PredictionJudgement dut = JudgePredictions(Driven(2, 0), 200);
  EXPECT_NEAR(*dut.seen.value.slope, 0.5, 0.05);
  EXPECT_LT(*dut.seen.upper.slope, 1);
  EXPECT_GT(*dut.seen.value.calibration_error, *dut.right.upper.calibration_error);
  EXPECT_GT(*dut.seen.value.reliability, *dut.right.upper.reliability);
  EXPECT_GT(*dut.seen.value.mean_error, *dut.right.upper.mean_error);
}

TEST(JudgePredictions, TooTimidOnesHaveASlopeAboveOne) {
  EXPECT_GT(*JudgePredictions(Driven(0.5, 0), 100).seen.lower.slope, 1);
}

// The slope says nothing of it: all log odds are off by as much.
TEST(JudgePredictions, TooHighOnesHaveAnInterceptBelowNought) {
  const PredictionJudgement dut = JudgePredictions(Driven(1, 1), 100);
  EXPECT_TRUE(Holds(dut.seen, &PredictionFigures::slope, 1));
  EXPECT_NEAR(*dut.seen.value.intercept, -1, 0.15);
  EXPECT_LT(*dut.seen.upper.intercept, 0);
}

TEST(JudgePredictions, AConstantTellsNothingApart) {
  std::vector<JudgedPlan> plans = Driven(1, 0);
  for (JudgedPlan& plan : plans) plan.failure.p = 0.3;
  const PredictionFigures dut = FiguresOf(plans);
  EXPECT_NEAR(*dut.resolution, 0, 1e-12);
  EXPECT_FALSE(dut.slope);
}

// Plans of a site that are off together are fewer witnesses than as many sites.
TEST(JudgePredictions, PlansOfOneSiteStandTogether) {
  std::vector<JudgedPlan> together, apart;
  for (int i = 0; i < 80; ++i) {
    const Forecast forecast{0.3, i / 4 % 2 == 0 ? 40 : 10, 50};
    together.push_back({i / 4, forecast});
    apart.push_back({i, forecast});
  }
  const auto width = [](const std::vector<JudgedPlan>& plans) {
    const RangedFigures seen = JudgePredictions(plans, 400).seen;
    return *seen.upper.log_score - *seen.lower.log_score;
  };
  EXPECT_GT(width(together), 1.5 * width(apart));
}

TEST(JudgePredictions, TheSamePlansGiveTheSameFigures) {
  const auto plans = Driven(1, 0);
  const PredictionJudgement a = JudgePredictions(plans, 20), b = JudgePredictions(plans, 20);
  for (const PredictionFigure& figure : kPredictionFigures) {
    EXPECT_EQ(a.seen.lower.*figure.member, b.seen.lower.*figure.member);
    EXPECT_EQ(a.right.value.*figure.member, b.right.value.*figure.member);
  }
}

TEST(ReliabilityPoints, StandWhereDrivesWere) {
  const std::vector<JudgedPlan> plans = {{0, {0.12, 2, 10}}, {0, {0.18, 2, 30}}, {1, {1, 9, 10}}};
  const auto dut = ReliabilityPoints(plans);
  ASSERT_EQ(dut.size(), 2u);
  EXPECT_NEAR(dut[0].predicted, 0.165, 1e-12);
  EXPECT_EQ(dut[0].k, 4);
  EXPECT_EQ(dut[0].n, 40);
  EXPECT_TRUE(dut[0].share.Contains(0.1));
  EXPECT_EQ(dut[1].predicted, 1);
}

TEST(CompareBySite, CountsSitesWithTheBetterLogScore) {
  std::vector<JudgedPlan> right = Driven(1, 0), off = Driven(1, 1);
  const SitesWon dut = CompareBySite(right, off);
  EXPECT_EQ(dut.sites, kSites);
  EXPECT_EQ(dut.a + dut.b, kSites);
  EXPECT_GT(dut.share_of_a.lower, 0.6);
  const SitesWon with_itself = CompareBySite(right, right);
  EXPECT_EQ(with_itself.a, 0);
  EXPECT_EQ(with_itself.b, 0);
}

}  // namespace
}  // namespace floorproof

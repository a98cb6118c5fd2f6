// SPDX-License-Identifier: Apache-2.0
#include "stats/rare/rare_estimate.h"

#include <gmock/gmock.h>

#include <cmath>

#include "base/error.h"
#include "base/streams.h"
#include "stats/binomial.h"
#include "tests/stats/reliability_problems.h"

namespace floorproof {
namespace {

using reliability::Problem;
using testing::ElementsAre;
using testing::HasSubstr;

RareProblem TrialsOf(Eigen::Index dimensions, std::function<TrialResult(const Trial&)> one) {
  RareProblem problem{dimensions, false, {}};
  problem.evaluate = [one = std::move(one)](std::span<const Trial> trials) {
    std::vector<TrialResult> results;
    for (const Trial& trial : trials) results.push_back(one(trial));
    return results;
  };
  return problem;
}

// Published probabilities of three of them are off; these are known in closed form.
TEST(ReliabilityProblems, QuadratureAgreesWithClosedForms) {
  for (const Problem& problem : reliability::Problems()) {
    if (problem.truth == 0 || problem.dimensions != 2) continue;
    EXPECT_NEAR(reliability::Quadrature(problem.g) / problem.truth, 1, 2e-3) << problem.name;
  }
}

TEST(RareEstimate, EstimatesAreRightWhereTheTruthIsKnown) {
  for (const Problem& problem : reliability::Problems()) {
    const RareEstimate got = EstimateRare(reliability::AsTrials(problem), {.seed = 3});
    ASSERT_EQ(got.answer, RareAnswer::kEstimate) << problem.name << ": " << got.why;
    const double truth = reliability::Truth(problem);
    EXPECT_NEAR(got.probability / truth, 1, 4.5 * got.cov) << problem.name;
    EXPECT_TRUE(got.reached_target) << problem.name;
    EXPECT_LE(got.lower_bound, truth) << problem.name;
    EXPECT_GE(got.lower_bound, truth / 3) << problem.name;
    EXPECT_LE(got.trials, 15'000u) << problem.name;
  }
}

// Four ways to fail, a quarter each by symmetry in pairs, nearest where theory says: at a distance
// of 3 straight ahead, and of 3.5 beside.
TEST(RareEstimate, RegionsHaveTheirShareAndTheirLikeliestFailure) {
  const Problem four = reliability::Problems()[1];
  const RareEstimate got = EstimateRare(reliability::AsTrials(four), {.seed = 5});
  ASSERT_EQ(got.regions.size(), 4u);
  std::vector<double> distances;
  for (const FailureRegion& region : got.regions) {
    EXPECT_GE(region.pilots, 1);
    EXPECT_LE(four.g(region.likeliest.u), 0) << "it does not fail";
    distances.push_back(region.distance);
  }
  std::ranges::sort(distances);
  EXPECT_THAT(distances,
              ElementsAre(testing::DoubleNear(3, 0.02), testing::DoubleNear(3, 0.02),
                          testing::DoubleNear(3.5, 0.02), testing::DoubleNear(3.5, 0.02)));
  double shares = 0;
  for (const FailureRegion& region : got.regions) shares += region.share;
  EXPECT_NEAR(shares, 1, 1e-12);
}

// A scenario that always fails: no more than certain.
TEST(RareEstimate, WhatAlwaysFailsIsCertain) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const RareEstimate got = EstimateRare(TrialsOf(2,
                                                   [](const Trial&) {
                                                     return TrialResult{true, 0};
                                                   }),
                                          {.seed = seed});
    ASSERT_EQ(got.answer, RareAnswer::kEstimate) << got.why;
    EXPECT_NEAR(got.probability, 1, 0.05);
    EXPECT_LE(got.probability, 1);
    EXPECT_LE(got.interval.lower, got.interval.upper);
    EXPECT_GE(CleanDrawsNeeded(got.probability, 0.95), 1);
  }
}

// Pilots that are still on their way have not found that nothing fails.
TEST(RareEstimate, PilotsThatRunOutOfTrialsFoundNothingOut) {
  const RareEstimate got = EstimateRare(TrialsOf(1,
                                                 [](const Trial& t) {
                                                   return TrialResult{t.u[0] > 6, 6 - t.u[0]};
                                                 }),
                                        {.max_trials = 5'500});
  EXPECT_EQ(got.answer, RareAnswer::kNoEstimate);
  EXPECT_THAT(got.why, HasSubstr("used up their trials"));
}

TEST(RareEstimate, NoMoreTrialsThanAllowed) {
  for (const Problem& problem : reliability::Problems()) {
    const std::uint64_t fewest = FewestTrials(0.1);
    const RareEstimate got =
        EstimateRare(reliability::AsTrials(problem), {.max_trials = fewest, .seed = 1});
    EXPECT_LE(got.trials, fewest) << problem.name;
  }
}

TEST(RareEstimate, FollowsFromTheSeed) {
  const RareProblem trials = reliability::AsTrials(reliability::Problems()[0]);
  const RareEstimate a = EstimateRare(trials, {.seed = 1}), b = EstimateRare(trials, {.seed = 1}),
                     c = EstimateRare(trials, {.seed = 2});
  EXPECT_EQ(a.probability, b.probability);
  EXPECT_NE(a.probability, c.probability);
}

// Nothing fails: every trial is spent, and says how often it can be at most.
TEST(RareEstimate, NothingFoundIsSaidWithItsUpperBound) {
  const RareEstimate got = EstimateRare(TrialsOf(3,
                                                 [](const Trial& t) {
                                                   return TrialResult{false, 9 - t.u[0]};
                                                 }),
                                        {});
  EXPECT_EQ(got.answer, RareAnswer::kNothingFound);
  EXPECT_EQ(got.trials, 15'000u);
  EXPECT_GT(got.nominal_draws, 7000);
  EXPECT_DOUBLE_EQ(got.upper_bound, ClopperPearsonUpper(0, got.nominal_draws, 0.95));
  EXPECT_EQ(got.lower_bound, 0);
  EXPECT_TRUE(got.regions.empty());
}

// A margin that stays at its start value until just before the failure: by itself it leads nowhere.
TEST(RareEstimate, TiesAreSplitByTheSecondScore) {
  const auto atom = [](bool split) {
    return TrialsOf(2, [split](const Trial& t) {
      return TrialResult{t.u[0] > 3.8, std::min(1.0, 4.4 - t.u[0]), split ? -t.u[0] : 0};
    });
  };
  const RareEstimate blind = EstimateRare(atom(false), {}), got = EstimateRare(atom(true), {});
  EXPECT_NE(blind.answer, RareAnswer::kEstimate);
  int stalled = 0;
  for (const PilotReport& pilot : blind.pilots) stalled += pilot.end == SubsetPilot::End::kStalled;
  EXPECT_GE(stalled, 3);
  ASSERT_EQ(got.answer, RareAnswer::kEstimate) << got.why;
  EXPECT_NEAR(got.probability / reliability::Normal(-3.8), 1, 4.5 * got.cov);
}

// A choice (an atom of draws) that fails by itself, however far the margin of all others is.
TEST(RareEstimate, AnAtomThatFailsIsFound) {
  const RareEstimate got =
      EstimateRare(TrialsOf(2,
                            [](const Trial& t) {
                              const bool fails = t.u[1] < -2.5;
                              return TrialResult{fails, fails ? 0.0 : 1.0, std::abs(t.u[0] - 1)};
                            }),
                   {.seed = 4});
  const double truth = reliability::Normal(-2.5);
  ASSERT_EQ(got.answer, RareAnswer::kEstimate) << got.why;
  EXPECT_NEAR(got.probability / truth, 1, 4.5 * got.cov);
}

// A second way to fail that only shows to who is near it already: half of all pilots miss it. Where
// one of five came upon it, or none, there is no estimate: of 150 seeds 59 % give one.
TEST(RareEstimate, AModeThatOnePilotMissesIsFoundByFive) {
  const RareProblem two = TrialsOf(2, [](const Trial& t) {
    const double seen = 3.5 - t.u[0], hidden = t.u[1] < -3.2 ? 3.5 + t.u[1] : 9;
    return TrialResult{std::min(seen, hidden) <= 0, std::min(seen, hidden)};
  });
  const double one = reliability::Normal(-3.5), truth = 2 * one - one * one;
  int missed = 0, right = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SubsetPilot pilot(two, seed, 0);
    while (pilot.goes_on()) {
      std::vector<Trial> batch;
      pilot.Propose(0, batch);
      pilot.Take(two.evaluate(batch));
    }
    missed += std::ranges::none_of(pilot.failures(),
                                   [](const PilotFailure& f) { return f.trial.u[1] < -3.2; });
    const RareEstimate got = EstimateRare(two, {.seed = seed});
    if (got.answer != RareAnswer::kEstimate) {
      EXPECT_THAT(got.why, HasSubstr("pilots disagree")) << seed;
      continue;
    }
    EXPECT_NEAR(got.probability / truth, 1, 5 * got.cov) << seed;
    ++right;
  }
  EXPECT_GE(missed, 2);
  EXPECT_GE(right, 6);
}

// Four arms that bend outwards: with these seeds no pilot of the five keeps one of them. It is
// found again on the other side of another.
TEST(RareEstimate, ASideThatPilotsLostIsFoundOnTheOtherSideOfAnother) {
  const Problem arms = reliability::Problems().back();
  ASSERT_EQ(arms.name, "RP111");
  for (const std::uint64_t seed : {50'049, 50'113, 50'210}) {
    const RareEstimate got = EstimateRare(reliability::AsTrials(arms), {.seed = seed});
    ASSERT_EQ(got.answer, RareAnswer::kEstimate) << got.why;
    EXPECT_NEAR(got.probability / reliability::Truth(arms), 1, 0.15) << seed;
  }
}

// Forty corners that show only to who is near: each pilot finds a few of them, and no two the same.
// What draws say of those is no estimate of all.
TEST(RareEstimate, WherePilotsOrDrawsDisagreeThereIsNoEstimate) {
  const RareProblem corners = TrialsOf(20, [](const Trial& t) {
    double least = 9;
    for (const double value : t.u)
      if (std::abs(value) > 2.9) least = std::min(least, 4.6 - std::abs(value));
    return TrialResult{least <= 0, least, 0};
  });
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const RareEstimate got = EstimateRare(corners, {.seed = seed});
    EXPECT_EQ(got.answer, RareAnswer::kNoEstimate) << got.probability;
    EXPECT_NE(got.why, "");
    // What holds whatever the sampler did is still said.
    const double truth = 40 * reliability::Normal(-4.6);
    EXPECT_LE(got.lower_bound, truth);
    EXPECT_GE(got.upper_bound, truth);
  }
}

// Half of what decides is noise, which no coordinate moves.
TEST(RareEstimate, NoiseIsDrawnAnew) {
  RareProblem noisy = TrialsOf(1, [](const Trial& t) {
    const double sum = t.u[0] + Stream(99, t.noise, "noise").Normal();
    return TrialResult{sum > 5, 5 - sum};
  });
  noisy.noisy = true;
  const double truth = reliability::Normal(-5 / std::numbers::sqrt2);
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const RareEstimate got = EstimateRare(noisy, {.seed = seed});
    ASSERT_EQ(got.answer, RareAnswer::kEstimate) << got.why;
    EXPECT_NEAR(got.probability / truth, 1, 5 * got.cov);
  }
}

TEST(RareEstimate, WhatMakesNoSenseIsRefusedBeforeAnyTrial) {
  RareProblem problem = TrialsOf(1, [](const Trial&) -> TrialResult { throw "driven"; });
  const auto refusal = [&](const RareSettings& settings) {
    try {
      EstimateRare(problem, settings);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("nothing");
  };
  EXPECT_THAT(refusal({.target_cov = 0.001}), HasSubstr("target_cov"));
  EXPECT_THAT(refusal({.target_cov = 0.1, .max_trials = 1000}), HasSubstr("max_trials"));
  EXPECT_THAT(refusal({.target_cov = 0.01, .max_trials = 5'600}), HasSubstr("max_trials"));
  problem.dimensions = 41;
  EXPECT_THAT(refusal({}), HasSubstr("must be in [1, 40]"));
}

TEST(RareEstimate, CleanDrawsNeededAreAboutThreeOverTheProbability) {
  EXPECT_EQ(CleanDrawsNeeded(0.05, 0.95), 59);
  EXPECT_NEAR(CleanDrawsNeeded(1e-5, 0.95) * 1e-5, 3, 0.01);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// How far estimates of rare failures spread, and how often their intervals hold the truth: 500
// searches of each problem.
#include <gtest/gtest.h>

#include <cmath>

#include "stats/rare/rare_estimate.h"
#include "tests/stats/reliability_problems.h"

namespace floorproof {
namespace {

class SlowRareEstimate : public testing::TestWithParam<std::size_t> {};

TEST_P(SlowRareEstimate, IsUnbiasedNarrowAndCovered) {
  const reliability::Problem problem = reliability::Problems()[GetParam()];
  const RareProblem trials = reliability::AsTrials(problem);
  const double truth = reliability::Truth(problem);
  constexpr int kRepeats = 500;
  int estimates = 0, covered = 0, lower = 0;
  double sum = 0, squares = 0, most = 0;
  for (int i = 0; i < kRepeats; ++i) {
    const RareEstimate got = EstimateRare(trials, {.seed = static_cast<std::uint64_t>(50'000 + i)});
    lower += got.lower_bound <= truth;
    most = std::max(most, static_cast<double>(got.trials));
    if (got.answer != RareAnswer::kEstimate) continue;
    ++estimates;
    const double ratio = got.probability / truth;
    sum += ratio;
    squares += ratio * ratio;
    covered += got.interval.Contains(truth);
  }
  const double mean = sum / estimates, cov = std::sqrt(squares / estimates - mean * mean);
  std::printf(
      "%-14s %.3e: %d estimates, mean %.3f of it, coefficient of variation %.3f, interval "
      "holds it in %.1f %%, lower bound below it in %.1f %%, %.0f trials at most\n",
      problem.name.c_str(), truth, estimates, mean, cov, 100.0 * covered / estimates,
      100.0 * lower / kRepeats, most);
  EXPECT_GE(estimates, 0.9 * kRepeats);
  EXPECT_NEAR(mean, 1, 4 * cov / std::sqrt(estimates) + 0.01);
  EXPECT_LE(cov, 0.1);
  EXPECT_GE(covered, 0.93 * estimates - 1);
  EXPECT_GE(lower, 0.95 * kRepeats);
  EXPECT_LE(most, 15'000);
}

INSTANTIATE_TEST_SUITE_P(Problems, SlowRareEstimate,
                         testing::Range(std::size_t{0}, reliability::Problems().size()));

}  // namespace
}  // namespace floorproof

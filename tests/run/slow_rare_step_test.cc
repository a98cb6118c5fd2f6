// SPDX-License-Identifier: Apache-2.0
// A search with three draws through physics, against a truth that bisection finds.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "run/rare/rare_search.h"
#include "run/scenario/scenario_file.h"
#include "tests/places.h"
#include "tests/run/rare_scenario.h"

namespace floorproof {
namespace {

class SlowRareStep : public RareScenarioTest {};

// BELUGA over a step, stuck or not: at each friction and speed a height decides, which bisection
// finds; how likely a step is higher than that is known.
TEST_F(SlowRareStep, AgreesWithABisectedBoundaryOfThreeDraws) {
  const ScenarioFile file(SourceFile("models/scenarios/rare_step.yaml"));
  EpisodeMaker maker(file);
  const auto boundary = [&](double friction, double speed) {
    double low = 0.004, high = 0.025;
    while (high - low > 1e-5) {
      const double middle = (low + high) / 2;
      const Drawn drawn = {
          {"site.generate.sizes.step.height_m", ConfigNode::Scalar(std::to_string(middle))},
          {"site.floor.friction", ConfigNode::Scalar(std::to_string(friction))},
          {"plan.speed_mps", ConfigNode::Scalar(std::to_string(speed))}};
      const bool fails = maker.RunDrawn(RareTrials::TrialVariant(), 0, drawn).events_of[1] > 0;
      (fails ? high : low) = middle;
    }
    return high;
  };
  constexpr double kStep = 0.02;
  constexpr int kSpeeds = 5;
  double truth = 0;
  for (double friction = 0.2 + kStep / 2; friction < 0.9; friction += kStep) {
    const double z = (friction - 0.7) / 0.08;
    const double density = std::exp(-z * z / 2) / (0.08 * std::sqrt(2 * kPi));
    for (int i = 0; i < kSpeeds; ++i) {
      const double height = boundary(friction, 0.2 + 0.1 * (i + 0.5) / kSpeeds);
      truth +=
          density * kStep / kSpeeds * 0.5 * std::erfc((height - 0.010) / 0.0015 / std::sqrt(2));
    }
  }
  const RareOutcome dut = SearchRare(file, {.mode = "stuck", .jobs = 2}, folder_ / "step");
  ASSERT_EQ(dut.estimate.answer, RareAnswer::kEstimate) << dut.estimate.why;
  std::printf("a step: bisected %.3g, %.3g, coefficient of variation %.3f, %llu drives\n", truth,
              dut.estimate.probability, dut.estimate.cov,
              static_cast<unsigned long long>(dut.estimate.trials));
  EXPECT_NEAR(dut.estimate.probability / truth, 1, 0.2);  // the grid is coarse
  EXPECT_EQ(dut.failures.at(0).row.outcome, "failure");
}

}  // namespace
}  // namespace floorproof

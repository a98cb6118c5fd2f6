// SPDX-License-Identifier: Apache-2.0
// What meetings came to, beside rates that were planted: right rates lie on what is counted, wrong
// ones do not.
#include "measure/kind_findings.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "measure/fit_rates.h"
#include "tests/measure/planted_rates.h"

namespace floorproof {
namespace {

// Higher and more slippery steps hold the robot more often; one in a hundred throws it back.
ModeNumbers RatesOfSteps(const Encounter& e) {
  ModeNumbers rates = {};
  rates[kHeld] = 2 * Step((e.size[0].second - 0.02 * e.at.friction) / 0.002);
  rates[kThrown] = 0.01;
  return rates;
}

Encounter DrawUpOrDown(Stream& random) {
  Encounter e = DrawStep(random);
  if (random.Uniform() < 0.5) e.size[0].second *= -1;
  return e;
}

std::vector<Encounter> Draw(int count, const PlantedRates& rates, Encounter (*draw)(Stream&),
                            int seed = 1) {
  Stream random(seed, 0, "kind_findings_test");
  return DrawEncounters(count, rates, draw, random);
}

const AxisFinding& Axis(const KindFinding& found, const std::string& name) {
  const auto axis = std::ranges::find(found.axes, name, &AxisFinding::name);
  if (axis == found.axes.end()) throw std::runtime_error("no axis " + name);
  return *axis;
}

// In how many groups the rates lie outside what was counted.
int Outside(const AxisFinding& axis) {
  return static_cast<int>(std::ranges::count_if(axis.groups, [](const AxisGroup& group) {
    return group.expected < group.counted.lower || group.expected > group.counted.upper;
  }));
}

// From four times as many meetings as are counted, so that the rates are nearly the truth: of 16
// intervals they leave one on average, more than three once in thirty.
TEST(KindFindings, RightRatesLieOnWhatIsCounted) {
  const RiskModel model = FitRates(Draw(16000, RatesOfSteps, DrawStep), {}, {});
  const std::vector<Encounter> fresh = Draw(4000, RatesOfSteps, DrawStep, 2);
  const KindFinding dut = FindKinds(model, fresh).at(0);
  EXPECT_EQ(dut.n, 4000);
  EXPECT_NEAR(dut.expected, dut.failures(), 0.05 * dut.failures());
  EXPECT_LE(Outside(Axis(dut, "height_m")) + Outside(Axis(dut, "friction")), 3);
}

TEST(KindFindings, RatesOfAnotherRobotDoNot) {
  const auto weaker = [](const Encounter& e) {
    Encounter higher = e;
    higher.size[0].second += 0.004;
    return RatesOfSteps(higher);
  };
  const RiskModel model = FitRates(Draw(4000, RatesOfSteps, DrawStep), {}, {});
  const std::vector<Encounter> fresh = Draw(4000, weaker, DrawStep, 2);
  const KindFinding dut = FindKinds(model, fresh).at(0);
  EXPECT_GE(Outside(Axis(dut, "friction")), 5);
}

TEST(KindFindings, WhatDecidesStandsFirstAndWhatDoesNotIsLeftOut) {
  const std::vector<Encounter> met = Draw(4000, RatesOfSteps, DrawStep);
  const RiskModel model = FitRates(met, {}, {});
  const KindFinding dut = FindKinds(model, met).at(0);
  ASSERT_EQ(dut.axes.size(), 2u);  // not the speed
  EXPECT_EQ(dut.axes[0].name, "height_m");
  EXPECT_TRUE(dut.axes[0].of_hazard);
  EXPECT_EQ(dut.axes[1].name, "friction");
  EXPECT_EQ(dut.axes[0].groups.size(), 8u);
  for (std::size_t i = 1; i < 8; ++i)
    EXPECT_GT(dut.axes[0].groups[i].low, dut.axes[0].groups[i - 1].high);
}

// As floating point leaves it, what is always all of the width has thousands of values.
TEST(KindFindings, WhatDiffersByRoundingAloneIsTheSame) {
  std::vector<Encounter> met = Draw(2000, RatesOfSteps, DrawStep);
  const RiskModel model = FitRates(met, {}, {});
  for (std::size_t i = 0; i < met.size(); ++i) met[i].at.friction = i % 2 ? 0.6 : 0.6 - 1e-16;
  const KindFinding dut = FindKinds(model, met).at(0);
  for (const AxisFinding& axis : dut.axes) EXPECT_NE(axis.name, "friction");
}

// It is the one at which to look: a mild step that held the robot nevertheless.
TEST(KindFindings, TheUnlikeliestFailureIsTheOneThatTheRatesLeastExpect) {
  std::vector<Encounter> met = Draw(4000, RatesOfSteps, DrawStep);
  const RiskModel model = FitRates(met, {}, {});
  met[17].size[0].second = 0.004;
  met[17].at.friction = 0.9;
  met[17].outcome = Encounter::Outcome::kFailed;
  met[17].mode = FailureMode(kHeld);
  const KindFinding dut = FindKinds(model, met).at(0);
  EXPECT_EQ(dut.unlikeliest[kHeld].met, &met[17]);
  EXPECT_LT(dut.unlikeliest[kHeld].p, 0.05);
  // Of being thrown back, not of any failure: that is nearly sure on many steps.
  EXPECT_LT(dut.unlikeliest[kThrown].p, 0.02);
  EXPECT_NE(dut.unlikeliest[kThrown].met, nullptr);
  EXPECT_EQ(dut.unlikeliest[kOverturned].met, nullptr);  // none
}

// As the rates were fitted; whichever meetings were cut short, these agree with what was counted.
TEST(KindFindings, MeetingsWithoutAnOutcomeAreExpectedToFailByHalf) {
  std::vector<Encounter> met = Draw(4000, RatesOfSteps, DrawStep);
  for (int i = 0; i < 1500; ++i) met[i].outcome = Encounter::Outcome::kCensored;
  const RiskModel model = FitRates(met, {}, {});
  const KindFinding dut = FindKinds(model, met).at(0);
  EXPECT_EQ(dut.n, 2500);
  EXPECT_EQ(dut.censored, 1500);
  EXPECT_NEAR(dut.expected, dut.failures(), 0.01 * dut.failures());
  for (const AxisFinding& axis : dut.axes) {
    double n = 0, expected = 0;
    for (const AxisGroup& group : axis.groups) {
      n += group.counted.n;
      expected += group.counted.n * group.expected;
    }
    EXPECT_EQ(n, 2500);
    EXPECT_NEAR(expected, dut.expected, 1e-6 * dut.expected);
  }
}

TEST(KindFindings, AHazardThatDoesNotStateASizeIsRefused) {
  std::vector<Encounter> met = Draw(1000, RatesOfSteps, DrawStep);
  const RiskModel model = FitRates(met, {}, {});
  met[5].size.clear();
  EXPECT_THROW(FindKinds(model, met), InputError);
}

// Held by steps of more than these heights.
PlantedRates Held(double up_m, double down_m) {
  return [=](const Encounter& e) {
    const double height_m = e.size[0].second;
    return ModeNumbers{0, 3 * Step((std::abs(height_m) - (height_m > 0 ? up_m : down_m)) / 0.0002),
                       0, 0};
  };
}

TEST(SafeSizes, UpAndDownAreAskedApart) {
  const SafeSizes dut = FindSafeSizes(Draw(4000, Held(0.008, 0.014), DrawUpOrDown), {});
  EXPECT_EQ(dut.looked_at, 2);
  ASSERT_EQ(dut.shown.size(), 2u);
  for (const SizeFinding& size : dut.shown) {
    EXPECT_EQ(size.type, "step");
    EXPECT_EQ(size.key, "height_m");
    ASSERT_EQ(size.of.safe->answer, SafeAnswer::kPart);
    EXPECT_FALSE(size.of.safe->from);
    EXPECT_NEAR(size.of.safe->up_to->edge, size.way == SizeFinding::Way::kUp ? 0.008 : 0.0142,
                0.0006);
    // The mean up to there is small; that end of it is not.
    EXPECT_GE(size.at_edge.n, 50);
    EXPECT_GT(size.at_edge.rate, 0.1);
  }
  EXPECT_NE(dut.shown[0].way, dut.shown[1].way);
}

// That one direction is safe up to somewhere must not hide that the other never is.
TEST(SafeSizes, ADirectionThatIsNeverSafeStandsBesideTheOther) {
  for (const double down_m : {0.0, 1.0}) {  // no step down is survived; every one is
    const SafeSizes dut = FindSafeSizes(Draw(2000, Held(0.008, down_m), DrawUpOrDown), {});
    ASSERT_EQ(dut.shown.size(), 2u) << down_m;
    const auto& down = dut.shown[dut.shown[0].way == SizeFinding::Way::kDown ? 0 : 1];
    EXPECT_EQ(down.way, SizeFinding::Way::kDown);
    EXPECT_EQ(down.of.safe->answer, down_m == 0 ? SafeAnswer::kNotShown : SafeAnswer::kWhole);
  }
}

TEST(SafeSizes, WhatGoesDownAloneIsCalledSo) {
  std::vector<Encounter> met = Draw(1000, Held(1, 0.008), DrawUpOrDown);
  std::erase_if(met, [](const Encounter& e) { return e.size[0].second > 0; });
  const SafeSizes dut = FindSafeSizes(met, {});
  ASSERT_EQ(dut.shown.size(), 1u);
  EXPECT_EQ(dut.shown[0].way, SizeFinding::Way::kDown);
}

// Their failures say nothing of the size.
TEST(SafeSizes, RobotsThatAreWrongAboutTheirPlaceDoNotCount) {
  std::vector<Encounter> met = Draw(1000, Held(0.008, 0.008), DrawStep);
  for (std::size_t i = 0; i < met.size(); i += 2) {
    met[i].at.estimate_error_m = 0.05;
    met[i].outcome = Encounter::Outcome::kFailed;
  }
  const SafeSizes dut = FindSafeSizes(met, {});
  ASSERT_EQ(dut.shown.size(), 1u);
  EXPECT_EQ(dut.shown[0].of.n, 500);
  EXPECT_EQ(dut.shown[0].of.safe->answer, SafeAnswer::kPart);
}

std::vector<SizeFinding> Shown(const std::vector<Encounter>& met) {
  return FindSafeSizes(met, {}).shown;
}

TEST(SafeSizes, WhatNeverFailsIsSafeOverAllThatWasDriven) {
  const auto none = [](const Encounter&) { return ModeNumbers{}; };
  const std::vector<SizeFinding> dut = Shown(Draw(500, none, DrawStep));
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_EQ(dut[0].way, SizeFinding::Way::kOnly);
  EXPECT_EQ(dut[0].of.safe->answer, SafeAnswer::kWhole);
}

TEST(SafeSizes, WhatFailsAtAnySizeIsShownToBeSafeAtNone) {
  const auto always = [](const Encounter&) { return ModeNumbers{0, 0.5, 0, 0}; };
  const std::vector<SizeFinding> dut = Shown(Draw(1000, always, DrawStep));
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_EQ(dut[0].of.safe->answer, SafeAnswer::kNotShown);
}

// How a way goes up a ramp is no size of it; what is passed is not led over.
TEST(SafeSizes, AreOfWhatPlansLeadOver) {
  std::vector<Encounter> met = Draw(400, RatesOfSteps, DrawStep);
  for (std::size_t i = 0; i < met.size(); ++i) {
    met[i].size.emplace_back("rise_along", met[i].size[0].second);
    if (i % 2 == 0) met[i].passage = Passage::kBeside;
  }
  const std::vector<SizeFinding> dut = Shown(met);
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_EQ(dut[0].key, "height_m");
  EXPECT_EQ(dut[0].of.n, 200);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "measure/fit_rates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/round.h"
#include "measure/judge_rates.h"
#include "measure/penalised_rates.h"
#include "measure/rate_axes.h"
#include "planners/risk/model_rates.h"
#include "tests/measure/known_truth.h"
#include "tests/measure/planted_rates.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

std::vector<Encounter> Steps(int count, std::uint64_t seed = 1) {
  Stream random(seed, 0, "fit_rates_test");
  return DrawEncounters(count, StepRates, DrawStep, random);
}

ModeNumbers At(const RiskModel& model, const Encounter& e) {
  const ModelRates rates(model);
  const RateEvaluator* of = rates.Find(e.type, e.passage, e.at);
  Covariates covariates(of->kind().axes, model.mirrored, e.size);
  return of->At(covariates.Of(e.at));
}

TEST(FitRates, FindsPlantedRatesAgain) {
  const RiskModel dut = FitRates(Steps(4000), {}, {});
  ASSERT_THAT(dut.kinds, SizeIs(1));
  Stream random(2, 0, "fit_rates_test");
  double error = 0;
  for (int i = 0; i < 200; ++i) {
    const Encounter e = DrawStep(random);
    error += std::abs(std::exp(-Total(At(dut, e))) - std::exp(-Total(StepRates(e)))) / 200;
  }
  EXPECT_LT(error, 0.02);
}

TEST(FitRates, GivesTheSameNumbersAgainRoundedAsTheyAreWritten) {
  const RiskModel dut = FitRates(Steps(600), {}, {}), again = FitRates(Steps(600), {}, {});
  const auto compare = [](const LinearPredictor& of, const LinearPredictor& other) {
    EXPECT_EQ(of.coefficients, other.coefficients);
    EXPECT_EQ(of.members, other.members);
    EXPECT_THAT(of.members, SizeIs(kRateMembers));
    for (const std::vector<double>& member : of.members)
      for (const double value : member) EXPECT_EQ(value, RoundedTo6(value));
  };
  compare(dut.kinds[0].any, again.kinds[0].any);
  for (std::size_t k = 0; k < dut.kinds[0].splits.size(); ++k)
    compare(dut.kinds[0].splits[k].of, again.kinds[0].splits[k].of);
}

// Held at middling speeds alone: rates are not taken to rise or fall.
TEST(FitRates, FindsALimitThatSpeedPassesTwice) {
  const auto rates = [](const Encounter& e) {
    ModeNumbers of = {};
    of[kHeld] = 0.02 + 2 * std::exp(-std::pow((e.at.speed_mps - 0.2) / 0.03, 2));
    return of;
  };
  Stream random(4, 0, "fit_rates_test");
  const RiskModel dut = FitRates(DrawEncounters(2000, rates, DrawStep, random), {}, {});
  Encounter e = DrawStep(random);
  const auto held = [&](double speed) {
    e.at.speed_mps = speed;
    return At(dut, e)[kHeld];
  };
  EXPECT_GT(held(0.2), 10 * held(0.11));
  EXPECT_GT(held(0.2), 10 * held(0.29));
}

// Friction matters on high steps alone: no sum of one function each says that.
TEST(FitRates, FindsWhereTwoThingsMatterTogether) {
  const auto rates = [](const Encounter& e) {
    ModeNumbers of = {};
    const double high = (e.size[0].second - 0.011) / 0.007,
                 slippery = (0.65 - e.at.friction) / 0.25;
    of[kHeld] = RateOf(-1 + 3 * high * slippery);
    return of;
  };
  Stream random(5, 0, "fit_rates_test");
  const RiskModel dut = FitRates(DrawEncounters(1500, rates, DrawStep, random), {}, {});
  Encounter e = DrawStep(random);
  const auto held = [&](double height, double friction) {
    e.size[0].second = height;
    e.at.friction = friction;
    return At(dut, e)[kHeld];
  };
  EXPECT_GT(held(0.017, 0.42), 5 * held(0.017, 0.88));
  EXPECT_GT(held(0.005, 0.88), 5 * held(0.005, 0.42));
}

// One failure in 125 is of a rare kind. Far below the limit neither is to be expected.
TEST(FitRates, RareModesAreAsRareAsFailuresOnMildMeetings) {
  const auto rates = [](const Encounter& e) {
    ModeNumbers of = {};
    of[kHeld] = 3 * Step((e.size[0].second - 0.013 - 0.01 * (e.at.friction - 0.6)) / 0.0007);
    of[kThrown] = 0.008 * of[kHeld];
    return of;
  };
  Stream random(11, 0, "fit_rates_test");
  const std::vector<Encounter> met = DrawEncounters(1000, rates, DrawStep, random);
  const RiskModel dut = FitRates(met, {}, {});
  EXPECT_LT(dut.kinds[0].any.events - dut.kinds[0].splits[0].of.events, kLeastEvents);
  double mild = 0;
  for (Encounter e : met) {
    e.size[0].second = 0.005;
    mild += Total(At(dut, e)) / static_cast<double>(met.size());
    e.size[0].second = 0.017;
    EXPECT_GT(At(dut, e)[kThrown], 0.002);
  }
  EXPECT_LT(mild, 0.002);
}

// Of two modes that matter in different places: the one at high speeds, the other at low ones.
TEST(FitRates, SharesOfModesDependOnHowHazardsAreMet) {
  const auto rates = [](const Encounter& e) {
    const double fast = Step((e.at.speed_mps - 0.2) / 0.02);
    return ModeNumbers{0.1 * (1 - fast), 0, 0, 0.3 * fast};
  };
  Stream random(12, 0, "fit_rates_test");
  const RiskModel dut = FitRates(DrawEncounters(2000, rates, DrawStep, random), {}, {});
  Encounter e = DrawStep(random);
  e.at.speed_mps = 0.12;
  EXPECT_NEAR(At(dut, e)[kVeer], 0.1, 0.03);
  EXPECT_LT(At(dut, e)[kThrown], 0.02);
  e.at.speed_mps = 0.28;
  EXPECT_NEAR(At(dut, e)[kThrown], 0.3, 0.06);
  EXPECT_LT(At(dut, e)[kVeer], 0.02);
}

TEST(FitRates, WhatNeverHappenedHasABoundOfThreeOverTheEncounters) {
  const auto none = [](const Encounter&) { return ModeNumbers{}; };
  Stream random(10, 0, "fit_rates_test");
  const RiskModel dut = FitRates(DrawEncounters(1000, none, DrawStep, random), {}, {});
  const LinearPredictor& any = dut.kinds[0].any;
  EXPECT_EQ(any.events, 0);
  EXPECT_THAT(any.blocks, SizeIs(0));
  const double rate = RateOf(any.coefficients[0]);
  EXPECT_GT(rate, 0);
  EXPECT_LT(rate, 1.0 / 1000);
  std::vector<double> members;
  for (const std::vector<double>& member : any.members) members.push_back(RateOf(member[0]));
  std::sort(members.begin(), members.end());
  EXPECT_NEAR(members.back() * 1000, -std::log(0.5 / kRateMembers), 0.1);  // beyond 3 only 1 in 16
  EXPECT_LT(members[kRateMembers - 2], 3.0 / 1000);
  const ModeNumbers modes = At(dut, DrawStep(random));
  for (const double of_mode : modes) EXPECT_NEAR(of_mode, rate / kNumFailureModes, 1e-5 * rate);
}

// Of the failures about one half is to come in modes that were never seen, all together.
TEST(FitRates, ModesThatNeverHappenedShareWhatIsLeft) {
  const auto held = [](const Encounter& e) { return ModeNumbers{0, StepRates(e)[kHeld], 0, 0}; };
  Stream random(13, 0, "fit_rates_test");
  const std::vector<Encounter> met = DrawEncounters(1000, held, DrawStep, random);
  const RiskModel dut = FitRates(met, {}, {});
  const KindRates& kind = dut.kinds[0];
  double expected = 0;
  for (const Encounter& e : met) {
    const ModeNumbers first = FirstFailures(At(dut, e));
    EXPECT_NEAR(first[kThrown], first[kVeer], 1e-5 * first[kVeer]);
    EXPECT_NEAR(first[kThrown], first[kOverturned], 1e-5 * first[kVeer]);
    expected += 3 * first[kThrown];
  }
  EXPECT_NEAR(expected, 0.5, 0.05);
  double most = 0;  // of a member, that a failure is of these modes
  Covariates covariates(kind.axes, false, met[0].size);
  for (const ModeNumbers& member : RateEvaluator(kind).MembersAt(covariates.Of(met[0].at)))
    most = std::max(most, 1 - member[kHeld] / Total(member));
  EXPECT_NEAR(most * kind.any.events, -std::log(0.5 / kRateMembers), 0.1);
}

// A third meet the edge square on, to what a drive computes: knots at quantiles would all but
// coincide there.
TEST(FitRates, ValuesThatAreAlmostTheSameShareAKnot) {
  std::vector<Encounter> met = Steps(900);
  Stream random(12, 0, "fit_rates_test");
  for (std::size_t i = 0; i < met.size(); ++i)
    met[i].at.heading_rad = i % 3 == 0 ? 1e-17 * random.Normal() : random.Uniform(-1.5, 1.5);
  const RiskModel dut = FitRates(met, {}, {});
  for (const RateAxis& axis : dut.kinds.at(0).axes)
    for (std::size_t j = 1; j < axis.knots.size(); ++j)
      EXPECT_GE(axis.knots[j] - axis.knots[j - 1], 0.0099 * (axis.upper - axis.lower)) << axis.name;
  for (const double value : dut.kinds[0].any.coefficients) EXPECT_TRUE(std::isfinite(value));
}

TEST(FitRates, TooFewEncountersAreSaid) {
  std::vector<Encounter> met = Steps(60);
  for (int i = 0; i < 20; ++i) met.push_back(met[i]);
  for (std::size_t i = 60; i < met.size(); ++i) met[i].type = "groove";
  const RiskModel dut = FitRates(met, {}, {});
  EXPECT_THAT(dut.kinds, SizeIs(1));
  ASSERT_THAT(dut.unmeasured, SizeIs(1));
  EXPECT_EQ(dut.unmeasured[0].type, "groove");
  EXPECT_EQ(dut.unmeasured[0].why, "20 encounters with an outcome; at least 50 are needed");
  EXPECT_EQ(ModelRates(dut).Find("groove", Passage::kOver, {}), nullptr);
}

// A hazard that is passed: who is farther wrong about its place than there is room touches it.
// Where it is high, or deep, that stops `share` of them.
Encounter DrawPassed(const std::string& type, double share, Stream& random) {
  Encounter e;
  e.type = type;
  e.passage = Passage::kBeside;
  const double rise_m = random.Uniform(0.002, 0.02);
  e.size = {{type == "groove" ? "depth_m" : "height_m", rise_m}};
  e.at.gap_m = random.Uniform(0, 0.1);
  e.at.estimate_error_m = random.Uniform() < 0.5 ? 0 : random.Uniform(0, 0.08);
  e.at.speed_mps = random.Uniform(0.1, 0.3);
  ModeNumbers rates = {};
  if (e.at.estimate_error_m > e.at.gap_m && rise_m > 0.011) rates[kHeld] = -std::log1p(-share);
  DrawOutcome(rates, random, e);
  return e;
}

// Too seldom by themselves to say at what they fail, passed hazards say it together; how often,
// each says for itself.
TEST(FitRates, PassedHazardsFailAtTheSame) {
  Stream random(21, 0, "fit_rates_test");
  std::vector<Encounter> met;
  for (int i = 0; i < 1500; ++i) {
    met.push_back(DrawPassed("step", 0.8, random));
    met.push_back(DrawPassed("groove", 0.08, random));
    met.push_back(DrawPassed("glass", 0.08, random));  // alone of what stands there
  }
  const auto failed = [&](const std::string& type) {
    return std::ranges::count_if(met, [&](const Encounter& e) {
      return e.type == type && e.outcome == Encounter::Outcome::kFailed;
    });
  };
  ASSERT_GT(failed("step"), 100) << "it stands by itself, and counts for the groove";
  ASSERT_LT(failed("groove"), 25);
  const RiskModel dut = FitRates(met, {}, {});
  const auto total = [&](const std::string& type, double gap_m, double error_m, double rise_m) {
    Encounter e;
    e.type = type;
    e.passage = Passage::kBeside;
    e.size = {{type == "groove" ? "depth_m" : "height_m", rise_m}};
    e.at.gap_m = gap_m;
    e.at.estimate_error_m = error_m;
    e.at.speed_mps = 0.2;
    return Total(At(dut, e));
  };
  EXPECT_LT(total("groove", 0.08, 0, 0.018), 1e-3);
  EXPECT_GT(total("groove", 0.01, 0.07, 0.018), 0.04);
  EXPECT_LT(total("groove", 0.01, 0.07, 0.018), 0.25);
  EXPECT_LT(total("groove", 0.01, 0.07, 0.004), 0.02) << "shallow";
  EXPECT_GT(total("step", 0.01, 0.07, 0.018), 0.8);
  double expected = 0;
  for (const Encounter& e : met)
    if (e.type == "groove") expected += -std::expm1(-Total(At(dut, e)));
  EXPECT_NEAR(expected, static_cast<double>(failed("groove")), 2);
  EXPECT_GT(total("glass", 0.08, 0, 0.018), total("groove", 0.08, 0, 0.018))
      << "it has no other to learn from";
}

// What turns on a step fails at half the height. One smooth function of both would bend between
// them; a kind for each manner does not.
TEST(FitRates, TurnsHaveRatesOfTheirOwnWhereThereAreEnough) {
  Stream random(13, 0, "fit_rates_test");
  const auto rates = [](const Encounter& e) {
    const double limit_m = e.at.turn_rad > 0 ? 0.008 : 0.014;
    return ModeNumbers{0, 8 * Step((e.size[0].second - limit_m) / 0.001), 0, 0};
  };
  const auto draw = [](Stream& from) {
    Encounter e = DrawStep(from);
    e.at.turn_rad = from.Uniform() < 0.5 ? 0 : from.Uniform(0.2, 3);
    return e;
  };
  const std::vector<Encounter> met = DrawEncounters(2000, rates, draw, random);
  const RiskModel dut = FitRates(met, {}, {});
  ASSERT_THAT(dut.kinds, SizeIs(2));
  EXPECT_EQ(dut.kinds[0].manner, Manner::kStraight);
  EXPECT_EQ(dut.kinds[1].manner, Manner::kTurning);
  EXPECT_EQ(dut.kinds[0].encounters + dut.kinds[1].encounters, 2000);
  for (const RateAxis& axis : dut.kinds[0].axes) EXPECT_NE(axis.name, "turn_rad");
  Encounter between = met[0];
  between.size[0].second = 0.011;
  between.at.turn_rad = 0;
  EXPECT_LT(Total(At(dut, between)), 0.8) << "0.38 is true";
  between.at.turn_rad = 1;
  EXPECT_GT(Total(At(dut, between)), 3) << "7.6 is true";
  EXPECT_THAT(FitRates({met.begin(), met.begin() + 300}, {}, {}).kinds, SizeIs(1))
      << "of few, both are pooled";
}

// Every other meeting is cut short somewhere, as by a failure at the hazard beside. Left out, those
// that were being cleared would be missing: 0.69 would be found.
TEST(FitRates, MeetingsThatWereCutShortCountByHalf) {
  constexpr double kRate = 0.5;
  Stream random(9, 0, "fit_rates_test");
  std::vector<Encounter> met;
  for (int i = 0; i < 4000; ++i) {
    Encounter e = DrawStep(random);
    const double until = -std::log(1 - random.Uniform()) / kRate;
    const double end = i % 2 == 0 ? 1 : random.Uniform();
    e.outcome = until < end  ? Encounter::Outcome::kFailed
                : i % 2 == 0 ? Encounter::Outcome::kCleared
                             : Encounter::Outcome::kCensored;
    met.push_back(e);
  }
  const RiskModel dut = FitRates(met, {}, {});
  double mean = 0;
  for (int i = 0; i < 200; ++i) mean += Total(At(dut, DrawStep(random))) / 200;
  EXPECT_NEAR(mean, kRate, 0.04);
  EXPECT_EQ(dut.kinds[0].censored,
            std::ranges::count(met, Encounter::Outcome::kCensored, &Encounter::outcome));
}

TEST(FitRates, AMeetingCountsForItsMirrorImage) {
  const auto rates = [](const Encounter& e) {
    ModeNumbers of = {};
    of[kVeer] = RateOf(-1 + 2 * std::sin(e.at.heading_rad) * std::sin(e.at.lead_rad));
    return of;
  };
  Stream random(6, 0, "fit_rates_test");
  const std::vector<Encounter> met = DrawEncounters(1500, rates, DrawCover, random);
  RateFitOptions options;
  options.mirrored = true;
  const RiskModel dut = FitRates(met, {}, options);
  Encounter e = met[0];
  e.at.heading_rad = -0.9;
  e.at.lead_rad = -1.4;
  Encounter image = e;
  image.at.heading_rad = 0.9;
  image.at.lead_rad = 1.4;
  EXPECT_EQ(At(dut, e), At(dut, image));
  Encounter other = e;
  other.at.heading_rad = 0.9;
  EXPECT_GT(At(dut, e)[kVeer], 3 * At(dut, other)[kVeer]);
}

// A pivot drives on backward, at a lead of pi. That is not beyond what was measured of a robot that
// has no side to lead with.
TEST(FitRates, OfARobotThatCannotGoSidewaysTheLeadDoesNotCount) {
  std::vector<Encounter> met = Steps(300);
  Stream random(14, 0, "fit_rates_test");
  for (Encounter& e : met) e.at.lead_rad = random.Uniform(-0.1, 0.1);
  RateFitOptions options;
  Approach pivot = met[0].at;
  pivot.lead_rad = 3.13;
  const auto beyond = [&] {
    const RiskModel dut = FitRates(met, {}, options);
    Covariates covariates(dut.kinds[0].axes, false, met[0].size);
    return RateEvaluator(dut.kinds[0]).Beyond(covariates.Of(pivot));
  };
  EXPECT_GT(beyond(), 1);
  options.holonomic = false;
  EXPECT_EQ(beyond(), 0);
}

TEST(FitRates, OfExposuresAreAMetre) {
  Stream random(7, 0, "fit_rates_test");
  std::vector<Encounter> met;
  for (int i = 0; i < 3000; ++i) {
    Encounter e;
    e.type = std::string(kWallBeside);
    e.passage = Passage::kBeside;
    e.at.wall_m = random.Uniform(0, 0.5);
    const double rate = 0.05 * std::exp(-6 * e.at.wall_m);  // a metre
    const double until = -std::log(1 - random.Uniform()) / rate, end = random.Uniform(1, 10);
    e.way_m = std::min(until, end);
    e.outcome = until < end ? Encounter::Outcome::kFailed : Encounter::Outcome::kCensored;
    e.mode = FailureMode::kBounceBack;
    met.push_back(e);
  }
  const RiskModel dut = FitRates(met, {}, {});
  ASSERT_TRUE(dut.kinds[0].per_metre);
  Encounter e = met[0];
  for (const double wall : {0.05, 0.2}) {  // farther away it happened some ten times
    e.at.wall_m = wall;
    EXPECT_NEAR(At(dut, e)[kThrown] / (0.05 * std::exp(-6 * wall)), 1, 0.3) << wall;
  }
}

// A robot that knows its place does not drive into walls because lost ones do.
TEST(FitRates, LostRobotsSayNothingOfWalls) {
  std::vector<Encounter> met;
  for (int i = 0; i < 400; ++i) {
    Encounter e;
    e.type = std::string(kWallBeside);
    e.passage = Passage::kBeside;
    e.drive = i;
    e.way_m = 5;
    e.at.estimate_error_m = i % 4 == 0 ? 0.09 : 0.002;
    const bool fails = i % 40 == 0;
    e.outcome = fails ? Encounter::Outcome::kFailed : Encounter::Outcome::kCleared;
    met.push_back(e);
  }
  const RiskModel dut = FitRates(met, {}, {});
  ASSERT_THAT(dut.kinds, SizeIs(1));
  EXPECT_EQ(dut.kinds[0].any.events, 0);
  EXPECT_EQ(dut.kinds[0].way_m, 300 * 5);
  EXPECT_LT(Total(At(dut, met[1])), 1e-3) << "a metre; of all drives ten failed on 2,000 m";
}

// Square on with any of its sides, whichever way it travels, or turned: by what a robot that drives
// every way fails at here, the way of travel says nothing.
TEST(FitRates, HowABodyStandsToTheEdgeCounts) {
  Stream random(9, 0, "fit_rates_test");
  std::vector<Encounter> met;
  for (int i = 0; i < 4000; ++i) {
    Encounter e;
    e.type = "step";
    e.size = {{"height_m", 0.01}};
    e.drive = i;
    e.at.lead_rad = random.Uniform(-kPi, kPi);
    e.at.heading_rad = random.Uniform(-1.4, 1.4);
    if (random.Uniform() < 0.5)
      e.at.heading_rad = std::remainder(e.at.lead_rad, kPi / 2) + random.Uniform(-1e-3, 1e-3);
    const bool fails = random.Uniform() < (AskewOf(e.at) < 0.1 ? 0.05 : 0.5);
    e.outcome = fails ? Encounter::Outcome::kFailed : Encounter::Outcome::kCleared;
    e.mode = FailureMode::kStuck;
    met.push_back(e);
  }
  const RiskModel dut = FitRates(met, {}, {});
  Encounter e = met[0];
  const auto fails = [&](double heading_rad, double lead_rad) {
    e.at.heading_rad = heading_rad;
    e.at.lead_rad = lead_rad;
    return 1 - std::exp(-Total(At(dut, e)));
  };
  EXPECT_NEAR(fails(0, 0), 0.05, 0.03);
  EXPECT_NEAR(fails(0.5, 0.5 - kPi / 2), 0.05, 0.03) << "aslant, square on with its side";
  EXPECT_NEAR(fails(0, 0.5), 0.5, 0.1) << "straight across, turned";
  EXPECT_NEAR(fails(-0.4, 0.3), 0.5, 0.1);
  RateFitOptions options;
  options.holonomic = false;
  const RiskModel turned = FitRates(met, {}, options);
  for (const RateAxis& axis : turned.kinds[0].axes)
    EXPECT_NE(axis.name, kAskew) << "its heading says it";
}

// The slow tests have the full statement, with 500 repeats.
TEST(KnownTruth, IsCoveredByIntervals) { EXPECT_GE(Coverage(30, 300, 64), 0.8); }

TEST(Judge, TellsRightPredictionsFromBoldOnes) {
  Stream random(8, 0, "fit_rates_test");
  std::vector<JudgedEncounter> right, bold;
  for (int i = 0; i < 20000; ++i) {
    const double eta = random.Uniform(-4, 2), rate = RateOf(eta);
    JudgedEncounter each;
    each.first[kHeld] = -std::expm1(-rate);
    each.mode = random.Uniform() < each.first[kHeld] ? static_cast<int>(kHeld) : -1;
    right.push_back(each);
    each.first[kHeld] = -std::expm1(-RateOf(2 * eta));  // twice the log odds
    bold.push_back(each);
  }
  const RateJudgement dut = Judge(right), of_bold = Judge(bold);
  EXPECT_NEAR(dut.slope.value(), 1, 0.05);
  EXPECT_NEAR(dut.intercept.value(), 0, 0.1);
  EXPECT_LT(dut.calibration_error, 2.5 * dut.calibration_error_by_chance);
  EXPECT_NEAR(of_bold.slope.value(), 0.5, 0.03);
  EXPECT_GT(of_bold.calibration_error, 5 * of_bold.calibration_error_by_chance);
  EXPECT_LT(dut.log_loss, of_bold.log_loss);
  EXPECT_LT(dut.log_loss, dut.log_loss_of_constant);
  // Nine failures say nothing of a slope.
  std::vector<JudgedEncounter> few;
  for (int i = 0; i < 100; ++i)
    few.push_back({right[i].first, i < 9 ? static_cast<int>(kHeld) : -1});
  EXPECT_FALSE(Judge(few).slope.has_value());
}

TEST(HoldOut, JudgesEncountersByOthers) {
  std::vector<Encounter> met = Steps(1200);
  for (int i = 0; i < 100; ++i) {  // exposures are not judged
    met.push_back(met[i]);
    met.back().type = std::string(kFreeFloor);
    met.back().way_m = 1;
  }
  const HoldOut dut = JudgeByHoldOut(met, {}, 3);
  EXPECT_EQ(dut.of_all.encounters, 1200);
  ASSERT_THAT(dut.kinds, SizeIs(1));
  EXPECT_EQ(dut.kinds[0].of.log_loss, dut.of_all.log_loss);
  EXPECT_NEAR(dut.of_all.slope.value(), 1, 0.2);
  EXPECT_LT(dut.of_all.log_loss, 0.9 * dut.of_all.log_loss_of_constant);
}

TEST(RateAxis, HasFunctionsOfMeanZeroTheFirstOneStraight) {
  std::vector<double> values;
  for (int i = 0; i < 500; ++i) values.push_back(std::pow(i / 499.0, 2));
  const RateAxis dut = MakeRateAxis("speed_mps", false, values, 0);
  ASSERT_THAT(dut.knots, SizeIs(8));
  EXPECT_EQ(dut.lower, 0);
  EXPECT_EQ(dut.upper, 1);
  ASSERT_THAT(dut.functions, SizeIs(7));
  const auto& straight = dut.functions[0];
  for (std::size_t j = 1; j + 1 < dut.knots.size(); ++j)
    EXPECT_NEAR((straight[j] - straight[0]) / (straight[7] - straight[0]), dut.knots[j], 1e-4);
  std::vector<RateAxis> axes = {dut};
  const RateFeatures features(axes, {{{{0, 0, 7}}}});
  std::vector<double> at(8), mean(8);
  for (const double x : values) {
    features.At(std::vector<double>{x}, at);
    for (std::size_t k = 0; k < 8; ++k) mean[k] += at[k] / 500;
  }
  for (std::size_t k = 1; k < 8; ++k) EXPECT_NEAR(mean[k], 0, 1e-4);
}

TEST(RateAxis, OfAnAngleIsPeriodicUnlessAGapIsLeft) {
  std::vector<double> round, half;
  for (int i = 0; i < 360; ++i) round.push_back(i * kPi / 180 - kPi);
  for (int i = 0; i < 180; ++i) half.push_back(i * kPi / 180 - kPi / 2);
  const RateAxis dut = MakeRateAxis("lead_rad", false, round, 2 * kPi);
  EXPECT_EQ(dut.upper - dut.lower, dut.period);
  for (const auto& f : dut.functions) EXPECT_EQ(f.front(), f.back());
  const RateAxis front = MakeRateAxis("lead_rad", false, half, 2 * kPi);
  EXPECT_NEAR(front.lower, 1.5 * kPi, 1e-4);
  EXPECT_NEAR(front.upper - front.lower, kPi, 0.03);
  EXPECT_EQ(Beyond(front, 0.3), 0);
  EXPECT_GT(Beyond(front, kPi), 0.4);
}

TEST(RateAxis, OfWhatNeverVariedHasNoFunctions) {
  const RateAxis dut = MakeRateAxis("mass_kg", false, {3.5, 3.5, 3.5}, 0);
  EXPECT_THAT(dut.functions, SizeIs(0));
  EXPECT_EQ(dut.lower, 3.5);
  EXPECT_NEAR(Beyond(dut, 7), 1, 1e-12);
  // Nor has what differs by rounding, as headings that were all to be square on do.
  const RateAxis square = MakeRateAxis("heading_rad", false, {2e-12, -1e-10, 3e-11}, 0);
  EXPECT_THAT(square.functions, SizeIs(0));
  EXPECT_EQ(square.lower, 0);
  EXPECT_EQ(Beyond(square, -2e-10), 0);
  EXPECT_NEAR(Beyond(square, 0.3), 0.3, 1e-12);
  const RateAxis ahead = MakeRateAxis("lead_rad", false, {1e-10, -1e-10}, 2 * kPi);
  EXPECT_THAT(ahead.functions, SizeIs(0));
  EXPECT_EQ(Beyond(ahead, 1e-9), 0);
  EXPECT_EQ(Beyond(ahead, -1e-9), 0);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/survival.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/streams.h"
#include "env/geometry/geometry.h"
#include "tests/planners/planted_modes.h"

namespace floorproof {
namespace {

using ::testing::Each;

constexpr std::size_t kStuck = static_cast<std::size_t>(FailureMode::kStuck);
constexpr std::size_t kVeerOff = static_cast<std::size_t>(FailureMode::kVeerOff);

// A kind whose rates are the same everywhere, and whose posterior is a point.
KindRates Constant(const ModeNumbers& rates) {
  KindRates kind;
  kind.type = "step";
  testing::PlantRates(rates, kind);
  return kind;
}

// Of `stuck`, eta falls from `high` to `low` in a straight line over frictions from 0.4 to 0.8.
KindRates StuckByFriction(double high, double low) {
  KindRates kind = Constant({0, 1, 0, 0});
  RateAxis axis;
  axis.name = "friction";
  axis.lower = 0.4;
  axis.upper = 0.8;
  axis.knots = {0.4, 0.6, 0.8};
  axis.functions = {{-1, 0, 1}};
  kind.axes = {axis};
  kind.any = testing::Point({(high + low) / 2, (low - high) / 2});
  kind.any.blocks = {{{{0, 0, 1}}}};
  return kind;
}

// The same meetings in each condition, met as that says.
Survival Predict(const std::vector<PlannedMeeting>& meetings,
                 const std::vector<std::vector<Approach>>& conditions) {
  std::vector<std::vector<PlannedMeeting>> drawn(conditions.size(), meetings);
  for (std::size_t c = 0; c < drawn.size(); ++c)
    for (std::size_t i = 0; i < meetings.size(); ++i)
      drawn[c][i].at = conditions[c][i], drawn[c][i].number = i;
  return PredictSurvival(drawn, meetings.size(), RiskModel());
}

std::vector<std::vector<Approach>> Same(std::size_t conditions, std::size_t meetings,
                                        const Approach& at = {}) {
  return std::vector(conditions, std::vector(meetings, at));
}

TEST(Rates, CompeteForWhoComesFirst) {
  const ModeNumbers first = FirstFailures({0.3, 0.1, 0, 0});
  EXPECT_NEAR(first[0] + first[1], 1 - std::exp(-0.4), 1e-12);
  EXPECT_NEAR(first[0], 3 * first[1], 1e-12);
  EXPECT_EQ(first[2], 0);
  EXPECT_THAT(FirstFailures({}), Each(0.0));
  for (const double rate : {1e-6, 0.1, 3.0, 50.0}) EXPECT_NEAR(RateOf(EtaOf(rate)) / rate, 1, 1e-9);
}

TEST(Survival, OfIndependentMeetingsIsTheProductOfTheirs) {
  const KindRates kind = Constant({0.02, 0.05, 0, 0});
  const RateEvaluator rates(kind);
  const std::vector<PlannedMeeting> meetings(10, {&rates, {}, {}, 1});
  const Survival dut = Predict(meetings, Same(4, 10));
  EXPECT_NEAR(dut.no_failure.value, std::exp(-0.7), 1e-12);
  EXPECT_NEAR(dut.no_failure.lower, dut.no_failure.upper, 1e-7);  // nothing is unknown
  double sum = dut.no_failure.value;
  for (const Probability& p : dut.first) sum += p.value;
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_NEAR(dut.first[kStuck].value, 2.5 * dut.first[kVeerOff].value, 1e-12);
  sum = 0;
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(dut.by_meeting[i], std::exp(-0.07 * static_cast<double>(i)) * -std::expm1(-0.07),
                1e-12);
    sum += dut.by_meeting[i];
  }
  EXPECT_NEAR(sum, 1 - dut.no_failure.value, 1e-12);
}

TEST(Survival, OfExposuresGoesByTheirWay) {
  const KindRates kind = Constant({0.001, 0, 0, 0});
  const RateEvaluator rates(kind);
  const std::vector<PlannedMeeting> meetings = {{&rates, {}, {}, 400}, {&rates, {}, {}, 100}};
  EXPECT_NEAR(Predict(meetings, Same(1, 2)).no_failure.value, std::exp(-0.5), 1e-12);
}

// What no covariate says of a hazard holds for all meetings with it. They end the more alike the
// larger theta is; a meeting with another hazard does not.
TEST(Survival, MeetingsWithOneHazardEndAlike) {
  KindRates kind = Constant({0.02, 0.05, 0, 0});
  const RateEvaluator rates(kind);
  std::vector<PlannedMeeting> meetings(8, {&rates, {}, {}, 1});
  kind.theta = 3;
  EXPECT_NEAR(Predict(meetings, Same(2, 8)).no_failure.value, std::exp(-0.07 * std::cbrt(8)),
              1e-12);
  kind.theta = 50;
  const Survival dut = Predict(meetings, Same(2, 8));
  EXPECT_NEAR(dut.no_failure.value, std::exp(-0.07), 0.004) << "all or none of them";
  EXPECT_NEAR(dut.no_failure.lower, dut.no_failure.upper, 1e-6)
      << "the members' rates are the same";
  EXPECT_NEAR(dut.by_meeting[0], 1 - dut.no_failure.value, 0.004) << "who gets over it once";
  EXPECT_NEAR(dut.first[kStuck].value, 2.5 * dut.first[kVeerOff].value, 1e-12);
  for (std::size_t i = 4; i < 8; ++i) meetings[i].first = 4;
  EXPECT_NEAR(Predict(meetings, Same(2, 8)).no_failure.value, std::exp(-0.14), 0.004);
}

// Plans fail less often than their rates say: which mode and which meeting ends a drive stays.
TEST(Survival, OfAPlanIsAsPlansWere) {
  const KindRates kind = Constant({0.02, 0.05, 0, 0});
  const RateEvaluator rates(kind);
  const std::vector<PlannedMeeting> meetings = {{&rates, {}, {}, 1, 0, 0},
                                                {&rates, {}, {}, 1, 1, 1}};
  const std::vector<std::vector<PlannedMeeting>> conditions(1, meetings);
  RiskModel model;
  const Survival before = PredictSurvival(conditions, 2, model);
  model.carry_over = {-1, 1.2, 80, 320, 40, 52.5};
  const Survival dut = PredictSurvival(conditions, 2, model);
  EXPECT_NEAR(1 - dut.no_failure.value, model.carry_over.Of(1 - before.no_failure.value), 1e-12);
  EXPECT_LE(dut.no_failure.lower, dut.no_failure.value);
  EXPECT_GE(dut.no_failure.upper, dut.no_failure.value);
  double modes = 0;
  for (int m = 0; m < kNumFailureModes; ++m) {
    modes += dut.first[m].value;
    EXPECT_NEAR(dut.first[m].value * before.first[0].value,
                before.first[m].value * dut.first[0].value, 1e-12);
  }
  EXPECT_NEAR(modes, 1 - dut.no_failure.value, 1e-9);
  EXPECT_NEAR(dut.by_meeting[0] + dut.by_meeting[1], modes, 1e-9);
  EXPECT_NEAR(dut.by_meeting[0] / dut.by_meeting[1], before.by_meeting[0] / before.by_meeting[1],
              1e-9);
}

// Whatever the line does to odds, no mode is likelier than any failure.
TEST(Survival, AModesIntervalLiesWithinThatOfAnyFailure) {
  const KindRates kind = StuckByFriction(1, -5);
  const RateEvaluator rates(kind);
  Approach at;
  at.friction = 1.2;  // beyond: the members part
  const std::vector<std::vector<PlannedMeeting>> conditions(1, {{&rates, {}, at, 1, 0, 0}});
  for (const CarryOver& line : {CarryOver{0.5, 0.3}, CarryOver{-1, 1.5}, CarryOver{}}) {
    RiskModel model;
    model.carry_over = line;
    const Survival dut = PredictSurvival(conditions, 1, model);
    for (const Probability& mode : dut.first) {
      EXPECT_LE(mode.upper, std::max(mode.value, 1 - dut.no_failure.lower) + 1e-12);
      EXPECT_LE(mode.lower, mode.value);
      EXPECT_GE(mode.upper, mode.value);
    }
  }
}

// One condition in twenty lies beyond what was measured: it is seen wherever it stands among them,
// and the interval is wider for it.
TEST(Survival, WhatLiesBeyondNowAndThenIsSeen) {
  const KindRates kind = StuckByFriction(1, -5);
  const RateEvaluator rates(kind);
  const std::vector<PlannedMeeting> meetings(1, {&rates, {}, {}, 1});
  const auto width = [&](std::size_t odd) {
    std::vector<std::vector<Approach>> conditions(60, std::vector<Approach>(1));
    for (std::size_t c = 0; c < conditions.size(); ++c)
      conditions[c][0].friction = c % 20 == odd ? 1.6 : 0.6;
    const Survival dut = Predict(meetings, conditions);
    EXPECT_EQ(dut.beyond[0].condition % 20, odd);
    EXPECT_GT(dut.beyond[0].share, 1);
    return dut.no_failure.upper - dut.no_failure.lower;
  };
  std::vector<std::vector<Approach>> within(60, std::vector<Approach>(1));
  for (auto& condition : within) condition[0].friction = 0.6;
  const Survival known = Predict(meetings, within);
  for (const std::size_t odd : {0u, 7u, 19u})
    EXPECT_GT(width(odd), 1.2 * (known.no_failure.upper - known.no_failure.lower)) << odd;
}

// One friction in ten holds the robot at every crossing, the others at none. Ten crossings with the
// same friction fail together; with a friction of its own each, hardly any drive gets through.
TEST(Survival, CrossingsThatOneFrictionDecidesFailTogether) {
  const KindRates kind = StuckByFriction(300, -2700);
  const RateEvaluator rates(kind);
  const std::vector<PlannedMeeting> meetings(10, {&rates, {}, {}, 1});
  std::vector<std::vector<Approach>> together, apart;
  Stream random(1, 0, "survival_test");
  for (int c = 0; c < 1000; ++c) {
    together.emplace_back();
    apart.emplace_back();
    for (int i = 0; i < 10; ++i) {
      Approach at;
      at.friction = 0.4 + 0.4 * (c + 0.5) / 1000;
      together.back().push_back(at);
      at.friction = random.Uniform(0.4, 0.8);
      apart.back().push_back(at);
    }
  }
  EXPECT_NEAR(1 - Predict(meetings, together).no_failure.value, 0.10, 0.005);
  EXPECT_NEAR(1 - Predict(meetings, apart).no_failure.value, 1 - std::pow(0.9, 10), 0.05);
}

TEST(Survival, BeyondWhatWasMeasuredIsSaidAndLessCertain) {
  const KindRates kind = StuckByFriction(1, -5);
  const RateEvaluator rates(kind);
  const std::vector<PlannedMeeting> meetings(1, {&rates, {}, {}, 1});
  const auto at = [&](double friction) {
    Approach approach;
    approach.friction = friction;
    return Predict(meetings, Same(2, 1, approach));
  };
  const Survival edge = at(0.8), beyond = at(0.9), far = at(1.2);
  EXPECT_EQ(edge.beyond[0].share, 0);
  EXPECT_NEAR(beyond.beyond[0].share, 0.25, 1e-12);
  EXPECT_NEAR(far.beyond[0].share, 1, 1e-12);
  EXPECT_NEAR(beyond.no_failure.value, edge.no_failure.value, 1e-12);  // the nearest measured one
  EXPECT_LT(beyond.no_failure.lower, edge.no_failure.lower - 0.005);
  EXPECT_LT(far.no_failure.lower, beyond.no_failure.lower - 0.1);
}

// Of one crossing at this place beyond what was measured.
Probability FailureAt(const KindRates& kind, const Approach& at) {
  const RateEvaluator rates(kind);
  const std::vector<PlannedMeeting> meetings(1, {&rates, {}, {}, 1});
  const Probability p = Predict(meetings, Same(1, 1, at)).no_failure;
  return {1 - p.value, 1 - p.upper, 1 - p.lower};
}

TEST(Survival, BeyondWhatNeverMatteredIsALittleLessCertain) {
  KindRates kind = Constant({0.01, 0, 0, 0});
  kind.axes.resize(1);
  kind.axes[0].name = "mass_kg";
  kind.axes[0].lower = kind.axes[0].upper = 10;
  Approach at;
  at.mass_kg = 10;
  EXPECT_NEAR(FailureAt(kind, at).upper, 0.01, 1e-4);
  at.mass_kg = 20;
  EXPECT_GT(FailureAt(kind, at).upper, 0.013);
  EXPECT_LT(FailureAt(kind, at).upper, 0.03);
  at.mass_kg = 300;  // counts as 40
  EXPECT_LT(FailureAt(kind, at).upper, 0.1);
}

// Friction matters at high speeds one way, at low ones the other: no function of it alone.
TEST(Survival, BeyondWhatMattersTogetherWithOthersIsLessCertain) {
  KindRates kind = Constant({0.01, 0, 0, 0});
  kind.axes.resize(2);
  kind.axes[0].name = "friction";
  kind.axes[0].lower = 0.4, kind.axes[0].upper = 0.8;
  kind.axes[1].name = "speed_mps";
  kind.axes[1].lower = 0.1, kind.axes[1].upper = 0.3;
  for (RateAxis& axis : kind.axes) {
    axis.knots = {axis.lower, axis.upper};
    axis.functions = {{-1, 1}};
  }
  Approach at;
  at.friction = 1.2;
  at.speed_mps = 0.2;
  const Probability without = FailureAt(kind, at);
  kind.any = testing::Point({kind.any.coefficients[0], 1});
  kind.any.blocks = {{{{0, 0, 1}, {1, 0, 1}}}};
  const Probability with = FailureAt(kind, at);
  EXPECT_NEAR(with.value, without.value, 1e-12);
  EXPECT_GT(with.upper, 3 * without.upper);
}

TEST(Survival, IntervalsGrowWithWhatTheModelDoesNotKnow) {
  KindRates kind = Constant({0.1, 0, 0, 0});
  const auto width = [&](double spread) {
    for (std::size_t r = 0; r < kRateMembers; ++r)
      kind.any.members[r][0] = kind.any.coefficients[0] + (r % 2 == 0 ? spread : -spread);
    const RateEvaluator rates(kind);
    const std::vector<PlannedMeeting> meetings(3, {&rates, {}, {}, 1});
    const Probability p = Predict(meetings, Same(1, 3)).no_failure;
    EXPECT_LT(p.lower, p.value);
    EXPECT_LT(p.value, p.upper);
    return p.upper - p.lower;
  };
  EXPECT_GT(width(0.4), 1.8 * width(0.2));
}

// A slope that rises to the robot's left rises to its right in the mirror; how much it turns, both
// ways added up, stays.
TEST(Covariates, OfAMirrorImageAreTheSame) {
  std::vector<RateAxis> axes(5);
  axes[0].name = "heading_rad";
  axes[1].name = "lead_rad";
  axes[2].name = "turn_rad";
  axes[3].name = "height_m";
  axes[4].name = "rise_across";
  axes[3].of_hazard = axes[4].of_hazard = true;
  Approach at;
  at.heading_rad = -0.3;
  at.lead_rad = 0.7;
  at.turn_rad = 1.5;
  Approach mirrored = at;
  mirrored.heading_rad = 0.3;
  mirrored.lead_rad = -0.7;
  Covariates dut(axes, true, {{"height_m", 0.01}, {"rise_across", -0.2}});
  Covariates image(axes, true, {{"height_m", 0.01}, {"rise_across", 0.2}});
  const std::span<const double> x = dut.Of(at);
  const std::vector<double> first(x.begin(), x.end());
  EXPECT_THAT(image.Of(mirrored), ::testing::ElementsAreArray(first));
  EXPECT_THAT(first, ::testing::ElementsAre(0.3, -0.7, 1.5, 0.01, 0.2));
  EXPECT_THAT(dut.Of(mirrored), ::testing::ElementsAre(0.3, -0.7, 1.5, 0.01, -0.2));
  EXPECT_THROW(Covariates(axes, true, {{"width_m", 0.01}}), InputError);
}

TEST(Beyond, OfAnAngleGoesRoundTheCircle) {
  RateAxis axis;
  axis.period = 2 * kPi;
  axis.lower = -0.5;
  axis.upper = 0.5;
  EXPECT_EQ(Beyond(axis, 2 * kPi + 0.2), 0);
  EXPECT_NEAR(Beyond(axis, 0.7), 0.2, 1e-9);
  EXPECT_NEAR(Beyond(axis, -0.7), 0.2, 1e-9);
  axis.period = 0;
  EXPECT_NEAR(Beyond(axis, -1.5), 1, 1e-12);
}

TEST(CubicFunctions, AreSmoothAndGoThroughTheirKnots) {
  const std::vector<double> knots = {0, 1, 1.5, 3};
  Eigen::MatrixXd values(4, 2);
  values << 0, 1, 1, -1, 0, 2, 2, 1;  // the second is periodic
  for (const bool periodic : {false, true}) {
    Eigen::MatrixXd of = periodic ? Eigen::MatrixXd(values.col(1)) : Eigen::MatrixXd(values);
    const CubicFunctions dut(knots, of, periodic);
    std::vector<double> at(of.cols()), left(of.cols()), right(of.cols());
    for (std::size_t j = 0; j < knots.size(); ++j) {
      dut.At(knots[j], at);
      for (Eigen::Index k = 0; k < of.cols(); ++k)
        EXPECT_NEAR(at[k], of(static_cast<Eigen::Index>(j), k), 1e-12);
    }
    const auto slope = [&](double x, double side) {  // of the last function
      constexpr double kStep = 1e-5;
      dut.At(x, at);
      dut.At(x + side * kStep, right);
      return side * (right.back() - at.back()) / kStep;
    };
    EXPECT_NEAR(slope(1, -1), slope(1, 1), 1e-3);
    EXPECT_NEAR(slope(1.5, -1), slope(1.5, 1), 1e-3);
    if (periodic) {
      EXPECT_NEAR(slope(3, -1), slope(0, 1), 1e-3);
    }
  }
}

}  // namespace
}  // namespace floorproof

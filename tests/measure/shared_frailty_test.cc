// SPDX-License-Identifier: Apache-2.0
// Meetings with one hazard in one drive end alike where something that no covariate says decides.
#include "measure/shared_frailty.h"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/fit_rates.h"
#include "tests/measure/planted_rates.h"

namespace floorproof {
namespace {

ModeNumbers RatesOfSteps(const Encounter& e) {
  ModeNumbers rates = {};
  rates[kHeld] = 2 * Step((e.size[0].second - 0.03 * (e.at.friction - 0.1)) / 0.002);
  return rates;
}

// Positive stable, of Laplace transform exp(-s^alpha) (Kanter, Ann. Probab. 3 (1975) 697).
double StableFrailty(double alpha, Stream& random) {
  const double u = kPi * random.Uniform(), e = -std::log(1 - random.Uniform());
  return std::sin(alpha * u) / std::pow(std::sin(u), 1 / alpha) *
         std::pow(std::sin((1 - alpha) * u) / e, (1 - alpha) / alpha);
}

// Each drive meets a step three times, unless it fails before.
std::vector<Encounter> Drives(int count, double theta) {
  Stream random(11, 0, "shared_frailty_test");
  std::vector<Encounter> met;
  for (int drive = 0; drive < count; ++drive) {
    const double frailty = theta == 1 ? 1 : StableFrailty(1 / theta, random);
    Encounter e = DrawStep(random);
    e.hazard = "edge";
    e.drive = drive;
    for (int i = 0; i < 3; ++i) {
      e.at.speed_mps = random.Uniform(0.1, 0.3);
      const double rate = frailty * std::pow(RatesOfSteps(e)[kHeld], theta);
      e.outcome = random.Uniform() < -std::expm1(-rate) ? Encounter::Outcome::kFailed
                                                        : Encounter::Outcome::kCleared;
      e.mode = FailureMode(kHeld);
      met.push_back(e);
      if (e.outcome == Encounter::Outcome::kFailed) break;
    }
  }
  return met;
}

TEST(SharedFrailty, IsFoundAgain) {
  for (const double theta : {1.0, 2.0, 6.0}) {
    const RiskModel dut = FitRates(Drives(3000, theta), {}, {});
    EXPECT_NEAR(dut.kinds.at(0).theta / theta, 1, 0.2) << theta;
  }
}

// Of first meetings, whatever came of later ones: only who got over the step met it again.
TEST(SharedFrailty, LeavesTheRatesOfOneMeetingAsTheyAre) {
  const std::vector<Encounter> met = Drives(3000, 6);
  const RiskModel dut = FitRates(met, {}, {});
  double expected = 0;
  int failed = 0;
  for (const auto& of_drive : MeetingsOfDrives(met)) {
    expected += -std::expm1(-Total(RatesOfSteps(*of_drive.front())));
    failed += of_drive.front()->outcome == Encounter::Outcome::kFailed;
  }
  EXPECT_EQ(dut.kinds.at(0).encounters, 3000);
  EXPECT_NEAR(failed / expected, 1, 0.1);
  EXPECT_EQ(dut.encounters, static_cast<int>(met.size()));
}

// Hardly anything fails, again or for the first time: any theta would do, and the largest would
// make one crossing of many.
TEST(SharedFrailty, IsOneWhereNothingSpeaksForMore) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Stream random(seed, 0, "shared_frailty_test");
    std::vector<Encounter> met;
    for (int drive = 0; drive < 100; ++drive)
      for (int i = 0; i < 2; ++i) {
        Encounter e = DrawStep(random);
        e.hazard = "edge";
        e.drive = drive;
        DrawOutcome({0, 0.02, 0, 0}, random, e);
        met.push_back(e);
        if (e.outcome == Encounter::Outcome::kFailed) break;
      }
    EXPECT_LT(FitRates(met, {}, {}).kinds.at(0).theta, 4) << seed;
  }
}

TEST(SharedFrailty, IsNotGuessedFromAFew) {
  EXPECT_EQ(FitRates(Drives(15, 6), {}, {.least_encounters = 10}).kinds.at(0).theta, 1);
  std::vector<Encounter> of_no_drive = Drives(500, 6);
  for (Encounter& e : of_no_drive) e.drive = -1;
  EXPECT_EQ(FitRates(of_no_drive, {}, {}).kinds.at(0).theta, 1);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "measure/measured_fmea.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/config.h"
#include "env/geometry/geometry.h"
#include "measure/measured_fmea_yaml.h"
#include "run/scenario/fmea_file.h"
#include "tests/places.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

FmeaTables Experts() { return ReadFmeaTables(SourceFile("models/fmea/htetro.yaml")); }

Encounter Met(const std::string& type, double lead_rad, double speed_mps,
              std::optional<FailureMode> mode = {}) {
  Encounter e;
  e.type = type;
  e.at.lead_rad = lead_rad;
  e.at.speed_mps = speed_mps;
  e.outcome = mode ? Encounter::Outcome::kFailed : Encounter::Outcome::kCleared;
  if (mode) e.mode = *mode;
  return e;
}

// 40 covers met, of which 10 held the robot, 2 turned it aside and 1 was censored.
std::vector<Encounter> Covers() {
  std::vector<Encounter> met;
  for (int i = 0; i < 27; ++i) met.push_back(Met("cable_cover", 0, 0.3));
  for (int i = 0; i < 10; ++i) met.push_back(Met("cable_cover", kPi / 2, 0.1, FailureMode::kStuck));
  for (int i = 0; i < 2; ++i)
    met.push_back(Met("cable_cover", -kPi / 4, 0.3, FailureMode::kVeerOff));
  met.push_back(Met("cable_cover", 0, 0.3));
  met.back().outcome = Encounter::Outcome::kCensored;
  return met;
}
const std::map<std::string, HazardClass> kClasses = {{"cable_cover", HazardClass::kTerrain},
                                                     {"groove", HazardClass::kTerrain},
                                                     {"step", HazardClass::kLevelChange}};

TEST(MeasuredFmea, CountsNoFailureAsAColumnOfItsOwn) {
  const MeasuredFmea dut = MeasureFmea(Covers(), kClasses, 0.2, Experts());
  const MeasuredClass& terrain = dut.classes[3];
  EXPECT_THAT(terrain.types, ElementsAre("cable_cover"));
  EXPECT_EQ(terrain.all.encounters, 39);
  EXPECT_EQ(terrain.all.censored, 1);
  EXPECT_EQ(terrain.all.none.events, 27);
  EXPECT_EQ(terrain.all.modes[1].events, 10);
  double sum = terrain.all.none.value();
  for (const CountedShare& mode : terrain.all.modes) sum += mode.value();
  EXPECT_NEAR(sum, 1, 1e-12);
  // Clopper and Pearson of 0 in 39: 1 - 0.025^(1 / 39).
  EXPECT_NEAR(terrain.all.modes[2].interval.upper, 1 - std::pow(0.025, 1.0 / 39), 1e-9);
}

TEST(MeasuredFmea, TellsDirectionsAndSpeedsApart) {
  const MeasuredFmea dut = MeasureFmea(Covers(), kClasses, 0.2, Experts());
  const auto& by_way = dut.classes[3].by_way;
  EXPECT_EQ(by_way[0][1].encounters, 27);  // forward, fast
  EXPECT_EQ(by_way[1][0].modes[1].events, 10);
  EXPECT_EQ(by_way[2][1].modes[0].events, 2);
  EXPECT_EQ(by_way[1][1].encounters, 0);
  EXPECT_EQ(LeadingSideOf(kPi), LeadingSide::kForward);  // back
  EXPECT_EQ(LeadingSideOf(-kPi / 2 + 0.4), LeadingSide::kSideways);
  EXPECT_EQ(LeadingSideOf(3 * kPi / 4), LeadingSide::kDiagonal);
}

// The experts: of failures on terrain 30 % veer off and 70 % are stuck. Of 12, 10 stuck may well be
// that; of 120, 100 may not.
TEST(MeasuredFmea, ExcludesExpertsFiguresOnlyByEnoughData) {
  std::vector<Encounter> met = Covers();
  const auto excluded = [&](std::size_t mode) {
    return MeasureFmea(met, kClasses, 0.2, Experts()).classes[3].given_failure[mode].excluded();
  };
  EXPECT_FALSE(excluded(1));
  const std::vector<Encounter> once = met;
  for (int i = 1; i < 10; ++i) met.insert(met.end(), once.begin(), once.end());
  EXPECT_TRUE(excluded(0));
  EXPECT_TRUE(excluded(1));
  EXPECT_FALSE(excluded(2));  // never: as the experts say
  met.push_back(Met("groove", 0, 0.3, FailureMode::kRollOver));
  EXPECT_TRUE(excluded(2));  // once: not never
}

TEST(MeasuredFmea, OfNothingMeasuredNothingIsSaid) {
  const MeasuredFmea dut = MeasureFmea({}, kClasses, 0.2, Experts());
  for (const MeasuredClass& of : dut.classes)
    for (const ComparedShare& share : of.given_failure) EXPECT_FALSE(share.excluded());
  EXPECT_THAT(MeasuredFmeaYaml(dut, "cart", {"cliff"}), HasSubstr("excluded: []"));
}

// By damage, and by whether the robot got on alone; of any mass.
TEST(MeasuredFmea, EffectsFollowFromEnergyAndFromWhatTheRobotDidThen) {
  const auto effect = [](Encounter::After after, double drop_m, double mass_kg = 10) {
    Encounter e = Met("step", 0, 0.1, FailureMode::kRollOver);
    e.after = after;
    e.at.mass_kg = mass_kg;
    e.energy_j = mass_kg * 9.81 * drop_m / 2;
    return EffectOf(e, {0.025, 0.1});
  };
  constexpr auto kAlone = Encounter::After::kRecovered, kHelped = Encounter::After::kNeedsHelp;
  for (const double mass_kg : {1.0, 10.0, 140.0}) {
    EXPECT_EQ(effect(kAlone, 0.003, mass_kg), 0) << "E1";
    EXPECT_EQ(effect(kAlone, 0.05, mass_kg), 1) << "E2";
    EXPECT_EQ(effect(kHelped, 0.003, mass_kg), 2) << "E3";
    EXPECT_EQ(effect(kHelped, 0.05, mass_kg), 2) << "E3";
    EXPECT_EQ(effect(kAlone, 0.15, mass_kg), 3) << "E4";
    EXPECT_EQ(effect(kHelped, 0.15, mass_kg), 4) << "E5";
  }
  EXPECT_EQ(effect(Encounter::After::kUnseen, 0.15), std::nullopt);
  Encounter cleared = Met("step", 0, 0.1);
  cleared.after = kAlone;
  EXPECT_EQ(EffectOf(cleared, {}), std::nullopt);
}

// In physics: held by a kerb it stands there, whole, until somebody comes; what falls 0.15 m is
// broken as well.
class DrivenToFail : public ScenarioTest {};
TEST_F(DrivenToFail, AKerbCallsAPersonAndADeepPitIsTheEnd) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n6.5,2.5\n");
  const auto effect = [this](const std::string& height_m) -> std::optional<std::size_t> {
    const EpisodeRecord record = Drive(
        Read(RoomScenario("{type: step, polygon_m: [[2.5,0.5],[3.5,0.5],[3.5,4.5],[2.5,4.5]], "
                          "known: false, height_m: " +
                              height_m + "}",
                          "on_failure: watch\n")));
    for (const Encounter& e : record.encounters)
      if (e.outcome == Encounter::Outcome::kFailed) return EffectOf(e, {});
    return std::nullopt;
  };
  EXPECT_EQ(effect("0.05"), 2) << "E3";
  EXPECT_EQ(effect("-0.15"), 4) << "E5";
}

TEST(MeasuredFmea, CountsEffectsAndWhatWasSensedInTime) {
  std::vector<Encounter> met(30, Met("step", 0, 0.1, FailureMode::kRollOver));
  for (Encounter& e : met) {
    e.after = Encounter::After::kNeedsHelp;
    e.at.mass_kg = 10;
    e.energy_j = 10 * 9.81 * 0.15 / 2;
    e.sensed = Encounter::Sensed::kNotInTime;
  }
  for (int i = 0; i < 10; ++i) met[static_cast<std::size_t>(i)].sensed = Encounter::Sensed::kInTime;
  met[0].sensed = Encounter::Sensed::kUnseen;
  met[29].passage = Passage::kBeside;  // no cliff sensor is to see it
  const MeasuredFmea dut = MeasureFmea(met, kClasses, 0.2, Experts());
  EXPECT_EQ(dut.effect_of_mode[2][4].measured.events, 30);
  EXPECT_TRUE(dut.effect_of_mode[2][4].excluded());  // the experts: 0.7
  EXPECT_FALSE(dut.effect_of_mode[1][2].excluded());
  EXPECT_EQ(dut.classes[2].not_sensed.of, 28);
  EXPECT_EQ(dut.classes[2].not_sensed.events, 19);
  EXPECT_EQ(
      MeasureFmea(met, kClasses, 0.2, Experts(), {0.1, 0.2}).effect_of_mode[2][2].measured.events,
      30)
      << "whoever knows that a drop of 0.15 m does no lasting damage says so";
  EXPECT_THAT(MeasuredFmeaYaml(dut, "cart", {"cliff"}), HasSubstr("missing: []"));
  EXPECT_THAT(MeasuredFmeaYaml(dut, "cart", {"cliff"}),
              HasSubstr("P(F3 -> E5): experts 0.7, measured 1 ["));
}

TEST(MeasuredFmea, IsAFileThatReadsBack) {
  std::vector<Encounter> met = Covers();
  for (int i = 0; i < 50; ++i) met.push_back(Met("step", 0, 0.1, FailureMode::kStuck));
  met.push_back(Met("unheard_of", 0, 0.1));
  const ConfigNode dut = ParseYaml(
      MeasuredFmeaYaml(MeasureFmea(met, kClasses, 0.2, Experts()), "hTetro", {"lidar", "cliff"}),
      "f.yaml");
  EXPECT_EQ(dut.Find("fmea_measured")->scalar, "1");
  EXPECT_EQ(dut.Find("robot")->scalar, "hTetro");
  EXPECT_THAT(dut.Find("sensors")->items, ::testing::SizeIs(2));
  const ConfigNode& terrain = *dut.Find("classes")->Find("C4");
  EXPECT_EQ(terrain.Find("all")->Find("none")->Find("k")->scalar, "27");
  EXPECT_EQ(terrain.Find("sideways_slow")->Find("F2")->Find("p")->scalar, "1");
  EXPECT_EQ(terrain.Find("detectability")->Find("not_sensed")->Find("p")->scalar, "none");
  EXPECT_EQ(terrain.Find("given_failure")->Find("F2")->Find("experts")->scalar, "0.7");
  EXPECT_EQ(dut.Find("modes")->Find("F2")->Find("effects")->Find("E3")->Find("p")->scalar, "none");
  EXPECT_THAT(dut.Find("missing")->items, ::testing::SizeIs(2));  // effects, detectability
  // All 50 failures at steps were F2; the experts say 0.1, F3 0.8 and F4 0.1.
  EXPECT_THAT(dut.Find("excluded")->items, ::testing::SizeIs(3));
  EXPECT_THAT(dut.Find("excluded")->items[0].scalar,
              HasSubstr("P(C3 -> F2) given a failure: experts 0.1, measured 1 [0.92"));
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "env/core/failure_text.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace floorproof {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

HazardMap Floor() {
  HazardMap map;
  Hazard hazard;
  hazard.id = "threshold";
  hazard.type = "step";
  hazard.height_m = 0.015;
  map.hazards.push_back(hazard);
  hazard.id = "slot";
  hazard.type = "groove";
  hazard.height_m = -0.03;
  map.hazards.push_back(hazard);
  hazard.id = "cover";
  hazard.type = "cable_cover";
  hazard.height_m = 0.02;
  map.hazards.push_back(hazard);
  return map;
}

Event Make(FailureMode mode, const char* kind, const char* hazard, double value, double threshold,
           std::vector<std::pair<std::string, double>> evidence = {}) {
  Event event;
  event.mode = mode;
  event.kind = kind;
  event.hazard = hazard;
  event.t_s = 30;
  event.x_m = 5.58;
  event.y_m = 3.03;
  event.value = value;
  event.threshold = threshold;
  event.evidence = std::move(evidence);
  return event;
}

TEST(FailureText, HazardsAreSaidWithTypeAndSize) {
  const HazardMap map = Floor();
  EXPECT_EQ(ObstaclePhrase(map, "threshold"), "'threshold' (step, 15 mm)");
  EXPECT_EQ(ObstaclePhrase(map, "slot"), "'slot' (groove, 30 mm deep)");
  EXPECT_EQ(ObstaclePhrase(map, "cover"), "'cover' (cable cover, 20 mm)");
  EXPECT_EQ(ObstaclePhrase(map, "wall"), "a wall");
  EXPECT_EQ(ObstaclePhrase(map, "gone"), "'gone'");
}

TEST(FailureText, StuckStandsStill) {
  Event event = Make(FailureMode::kStuck, "", "threshold", 0.499, 0.5,
                     {{"gained_m", 0.499}, {"still_s", 8}, {"since_s", 20}});
  EXPECT_EQ(FailureSentence(event, Floor()),
            "stood still for 8 s before 'threshold' (step, 15 mm), at x 5.58, y 3.03 m");
  event.hazard = "slot";
  EXPECT_EQ(FailureText(event, Floor()), "stood still for 8 s in 'slot' (groove, 30 mm deep)");
  event.hazard = "wall";
  EXPECT_EQ(FailureText(event, Floor()), "stood still for 8 s at a wall");
  event.hazard = "";
  EXPECT_EQ(FailureText(event, Floor()), "stood still for 8 s");
}

TEST(FailureText, StuckOnWhatItStandsOn) {
  HazardMap map = Floor();
  const auto square = [](double x_m, double y_m) {
    return Polygon{{x_m, y_m}, {x_m + 1, y_m}, {x_m + 1, y_m + 1}, {x_m, y_m + 1}};
  };
  map.hazards[0].footprint = {square(8, 8), square(5, 2.5)};
  Event event = Make(FailureMode::kStuck, "", "threshold", 0.499, 0.5,
                     {{"gained_m", 0.499}, {"still_s", 8}, {"since_s", 20}});
  EXPECT_EQ(FailureText(event, map), "stood still for 8 s on 'threshold' (step, 15 mm)");
  event.x_m = 4.9;
  EXPECT_EQ(FailureText(event, map), "stood still for 8 s before 'threshold' (step, 15 mm)");
}

TEST(FailureText, StuckGetsOnTooSlowly) {
  Event event = Make(FailureMode::kStuck, "", "threshold", 0.4996, 0.5,
                     {{"gained_m", 0.4996},
                      {"commanded_m", 2.13},
                      {"turning", 0},
                      {"still_s", 3.2},
                      {"since_s", 20}});
  EXPECT_EQ(FailureText(event, Floor()),
            "advanced 0.50 m of the 2.13 m commanded in 10 s before 'threshold' (step, 15 mm), and "
            "stood still "
            "for 3.2 s");
  event.hazard.clear();
  event.evidence[3].second = 0.4;
  EXPECT_EQ(FailureText(event, Floor()), "advanced 0.50 m of the 2.13 m commanded in 10 s");
}

TEST(FailureText, StuckSaysWhatItsWheelsDid) {
  Event event = Make(FailureMode::kStuck, "", "", 0.01, 0.5,
                     {{"gained_m", 0.01},
                      {"still_s", 9.5},
                      {"driven_share", 0.02},
                      {"rim_m", 3.1},
                      {"since_s", 20}});
  EXPECT_EQ(FailureText(event, Floor()),
            "stood still for 9.5 s; its driven wheels carried 2 % of its weight");
  event.evidence[2].second = 0.6;
  EXPECT_EQ(FailureText(event, Floor()),
            "stood still for 9.5 s; its wheels slipped: they ran 3.10 m");
  event.evidence[3].second = 0.1;
  EXPECT_EQ(FailureText(event, Floor()), "stood still for 9.5 s");
}

TEST(FailureText, StuckDoesNotTurn) {
  Event event = Make(FailureMode::kStuck, "", "wall", 0.1, 0.5,
                     {{"gained_m", 0},
                      {"turn_rad", 0.0873},
                      {"turn_threshold_rad", 0.5},
                      {"turning", 1},
                      {"still_s", 1},
                      {"since_s", 20}});
  EXPECT_EQ(FailureText(event, Floor()), "turned by 5 deg, 29 deg was due, in 10 s at a wall");
  event.evidence[1].second = 4;
  EXPECT_EQ(FailureText(event, Floor()), "turned to and fro without getting on in 10 s at a wall");
}

TEST(FailureText, HighCentredSaysWhatCarriesIt) {
  const Event event =
      Make(FailureMode::kStuck, "high_centred", "cover", 0, 0.5,
           {{"gained_m", 0}, {"still_s", 9.5}, {"belly_load_n", 34.2}, {"since_s", 20}});
  EXPECT_EQ(FailureText(event, Floor()),
            "stood still for 9.5 s with its belly on 'cover' (cable cover, 20 mm), which carries "
            "34.2 N of its weight");
}

TEST(FailureText, VeerOff) {
  const Event event =
      Make(FailureMode::kVeerOff, "", "threshold", 0.5004, 0.5, {{"since_s", 29.8}});
  EXPECT_EQ(
      FailureText(event, Floor()),
      "was off its path by 0.5004 m, 0.5000 m is allowed, for 0.2 s, after it met 'threshold' "
      "(step, 15 mm)");
}

TEST(FailureText, RollOverInThreeWays) {
  EXPECT_EQ(FailureText(Make(FailureMode::kRollOver, "", "threshold", 0.62, 0.61), Floor()),
            "leaned by 36 deg, 35 deg is allowed, at 'threshold' (step, 15 mm)");
  EXPECT_EQ(FailureText(Make(FailureMode::kRollOver, "tipped", "slot", -0.012, -0.004), Floor()),
            "tipped: its centre of mass was outside of what its wheels stand on by 12 mm, 4 mm is "
            "allowed, in 'slot' (groove, 30 mm deep)");
  EXPECT_EQ(FailureText(Make(FailureMode::kRollOver, "fell", "slot", 0.148, 0.03), Floor()),
            "fell: a wheel dropped by 148 mm, 30 mm is allowed, into 'slot' (groove, 30 mm deep)");
  EXPECT_EQ(FailureText(Make(FailureMode::kRollOver, "fell", "threshold", 0.05, 0.03), Floor()),
            "fell: a wheel dropped by 50 mm, 30 mm is allowed, off 'threshold' (step, 15 mm)");
  EXPECT_EQ(FailureText(Make(FailureMode::kRollOver, "fell", "slot", -0.148, -0.03), Floor()),
            "fell, into 'slot' (groove, 30 mm deep)")
      << "of a record by an earlier version, which compared heights";
  EXPECT_EQ(FailureText(Make(FailureMode::kRollOver, "landed", "", 1.25, 1), Floor()),
            "landed on a wheel with 1.25 J/kg, 1.00 J/kg is allowed");
}

TEST(FailureText, BounceBackInTwoWays) {
  EXPECT_EQ(FailureText(Make(FailureMode::kBounceBack, "reversed", "wall", 0.08, 0.025,
                             {{"closing_mps", 0.2}}),
                        Floor()),
            "hit a wall at 0.20 m/s and was thrown back at 0.080 m/s, 0.025 m/s is allowed");
  EXPECT_EQ(FailureText(Make(FailureMode::kBounceBack, "parted", "threshold", 0.0032, 0.001,
                             {{"closing_mps", 0.2}}),
                        Floor()),
            "hit 'threshold' (step, 15 mm) at 0.20 m/s and came off it by 3.2 mm, 1.0 mm is "
            "allowed");
}

// Whatever the numbers: what was judged never reads like its limit, and nothing is in powers of
// ten.
TEST(FailureText, ValueAndLimitAreToldApart) {
  const HazardMap map = Floor();
  for (const FailureMode mode :
       {FailureMode::kVeerOff, FailureMode::kRollOver, FailureMode::kBounceBack})
    for (const double limit : {0.001, 0.25, 0.5, 1.2})
      for (const double apart : {0.00002, 0.003, 0.4}) {
        const double value = limit * (1 + apart);
        const std::string text =
            FailureText(Make(mode, "", "", value, limit, {{"since_s", 20}}), map);
        const std::size_t comma = text.find(", ");
        ASSERT_NE(comma, std::string::npos) << text;
        const std::size_t from = text.find_last_of("0123456789", comma);
        const std::size_t begin = text.find_last_not_of("0123456789.", from) + 1;
        const std::string first = text.substr(begin, from + 1 - begin);
        const std::string second = text.substr(comma + 2, first.size());
        EXPECT_TRUE(first != second || limit * apart < 1e-6) << text;
        EXPECT_THAT(text, Not(HasSubstr("e-"))) << text;
      }
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A fall is what the wheels did, on whatever floor: the same drop is the same verdict wherever it
// lies, whatever leads to it and whatever the plan knew.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

std::string Strip(const std::string& keys, double from_m, double to_m) {
  return fmt::format("{{{}, polygon_m: [[{}, 0.5], [{}, 0.5], [{}, 4.5], [{}, 4.5]]}}", keys,
                     from_m, to_m, to_m, from_m);
}

class Falls : public ScenarioTest, public ::testing::WithParamInterface<const char*> {
 protected:
  EpisodeRecord Over(const std::string& hazards, double to_x_m = 7.5,
                     double speed_mps = 0.25) const {
    Save("plan.csv",
         fmt::format("x_m,y_m,speed_mps\n1.5,2.5,{0}\n{1},2.5,{0}\n", speed_mps, to_x_m));
    return Drive(Read(RoomScenario(hazards), {{"robot", GetParam()}}));
  }
  static void ExpectFall(const EpisodeRecord& dut, const std::string& from) {
    EXPECT_EQ(dut.outcome, Outcome::kFailure) << dut.message;
    ASSERT_FALSE(dut.events.empty());
    EXPECT_EQ(dut.events[0].mode, FailureMode::kRollOver) << dut.events[0].kind;
    EXPECT_EQ(dut.events[0].kind, "fell");
    EXPECT_EQ(dut.events[0].hazard, from);
  }
  static void ExpectNothing(const EpisodeRecord& dut) {
    EXPECT_EQ(dut.outcome, Outcome::kSuccess) << dut.message;
    for (const Event& e : dut.events)
      ADD_FAILURE() << Name(e.mode) << " " << e.kind << " " << e.value << " at x " << e.x_m;
  }
};

const char* const kRobots[] = {"beluga", "htetro", "rover", "scrubber"};
INSTANTIATE_TEST_SUITE_P(Robots, Falls, ::testing::ValuesIn(kRobots),
                         [](const auto& robot) { return std::string(robot.param); });

// Up a ramp of 5 degrees onto a dock, and off its far edge.
TEST_P(Falls, OffADock) {
  const double rise_m = 2 * std::tan(5 * kPi / 180);  // 175 mm
  ExpectFall(Over(Strip(fmt::format("type: step, id: dock, height_m: {}", rise_m), 4.5, 6) + ", " +
                  Strip("type: ramp, id: up, slope_deg: 5, toward_deg: 0", 2.5, 4.5)),
             "dock");
}

TEST_P(Falls, OffTheEndOfARamp) {
  for (const bool known : {false, true})
    ExpectFall(
        Over(Strip(fmt::format("type: ramp, id: up, slope_deg: 5, toward_deg: 0, known: {}", known),
                   2.5, 5)),
        "up");
}

// A ramp at its far side, which the robot never comes to, does not make a bay's edge a way in.
TEST_P(Falls, OverTheEdgeOfABayWhateverLeadsOutOfIt) {
  const std::string bay = Strip("type: step, id: bay, height_m: -0.175", 3, 5);
  const EpisodeRecord without = Over(bay),
                      with =
                          Over(bay + ", " +
                               Strip("type: ramp, id: out, slope_deg: -5, toward_deg: 180", 5, 7));
  ExpectFall(without, "bay");
  ASSERT_FALSE(with.events.empty());
  EXPECT_EQ(with.events[0].kind, "fell");
  EXPECT_DOUBLE_EQ(with.events[0].t_s, without.events[0].t_s);
}

// Wheels that roll down have not dropped, whatever the plan knew, slow or fast over the crest.
TEST_P(Falls, DownARampIsNone) {
  for (const char* known : {"true", "false"})
    for (const double speed_mps : {0.1, 0.4}) {
      const double slope_deg = 3, drop_m = std::tan(slope_deg * kPi / 180);
      ExpectNothing(Over(
          Strip(fmt::format("type: step, id: low, height_m: {}, known: {}", -drop_m, known), 4,
                8.5) +
              ", " +
              Strip(fmt::format("type: ramp, id: down, slope_deg: {}, toward_deg: 0, known: {}",
                                -slope_deg, known),
                    3, 4),
          5.5, speed_mps));
    }
}

// Over a ridge a body rocks with its wheels in the air, and comes down on a slope that it drives
// on.
TEST_P(Falls, OverTheRidgeOfTwoRampsIsNone) {
  for (const double slope_deg : {5.0, 7.0})
    for (const double speed_mps : {0.1, 0.3})
      ExpectNothing(Over(Strip(fmt::format("type: ramp, id: up, slope_deg: {}, toward_deg: 0, "
                                           "known: false",
                                           slope_deg),
                               3, 4) +
                             ", " +
                             Strip(fmt::format("type: ramp, id: down, slope_deg: {}, toward_deg: "
                                               "180, known: false",
                                               slope_deg),
                                   4, 5),
                         6, speed_mps));
}

// A step down that the robot climbs, too, and a drop just beyond what is allowed.
TEST_P(Falls, AStepOfItsOwnIsNone) {
  ExpectNothing(Over(Strip("type: step, id: low, height_m: -0.004, known: false", 4, 8.5), 7));
}

}  // namespace
}  // namespace floorproof

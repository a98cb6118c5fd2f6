// SPDX-License-Identifier: Apache-2.0
// Drives over what buildings hold: ramps, carpets, thresholds, lifts' sills, wet patches.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "run/scenario/override.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

constexpr const char* kRobots[] = {"beluga", "htetro"};

// From a foot at x_m, to the right (toward 0 deg) or to the left (180), 1.5 m long, so wide.
std::string Ramp(const std::string& id, double from_m, double to_m, double slope_deg,
                 double toward_deg, double low_m = 1, double high_m = 4) {
  return fmt::format(
      "{{type: ramp, id: {}, slope_deg: {}, toward_deg: {}, polygon_m: [[{}, {}], [{}, {}], [{}, "
      "{}], [{}, {}]]}}",
      id, slope_deg, toward_deg, from_m, low_m, to_m, low_m, to_m, high_m, from_m, high_m);
}

std::string Level(const std::string& id, double from_m, double to_m, double height_m,
                  double low_m = 1, double high_m = 4) {
  return fmt::format(
      "{{type: step, id: {}, height_m: {:.9f}, polygon_m: [[{}, {}], [{}, {}], [{}, {}], [{}, "
      "{}]]}}",
      id, height_m, from_m, low_m, to_m, low_m, to_m, high_m, from_m, high_m);
}

double Rise(double slope_deg, double length_m) {
  return length_m * std::tan(slope_deg * kPi / 180);
}

// How high and how low the robot's origin came, and how far it leaned.
class Heights final : public EpisodeObserver {
 public:
  bool OnControl(const EpisodeView& now) override {
    const Sample& sample = now.sample;
    highest_m = std::max(highest_m, sample.p_WB.z());
    lowest_m = std::min(lowest_m, sample.p_WB.z());
    tilt_rad = std::max(tilt_rad, sample.tilt_rad);
    return true;
  }
  double highest_m = -1, lowest_m = 1, tilt_rad = 0;
};

class Building : public ScenarioTest, public ::testing::WithParamInterface<const char*> {
 protected:
  Building() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n7,2.5\n"); }
  EpisodeRecord Over(const std::string& hazards, std::vector<Override> overrides = {},
                     EpisodeObserver* observer = nullptr) const {
    overrides.push_back({"robot", GetParam()});
    return Drive(Read(RoomScenario(hazards), overrides), observer);
  }
  static void ExpectNothing(const EpisodeRecord& dut, double aside_m = 0.05) {
    EXPECT_EQ(dut.outcome, Outcome::kSuccess) << dut.message;
    for (const Event& e : dut.events)
      ADD_FAILURE() << Name(e.mode) << " " << e.kind << " at x " << e.x_m;
    EXPECT_LT(dut.metrics.max_cross_track_m, aside_m);
  }
};
INSTANTIATE_TEST_SUITE_P(Robots, Building, ::testing::ValuesIn(kRobots),
                         [](const auto& robot) { return std::string(robot.param); });

TEST_P(Building, UpARampOverAPlatformAndDownAgain) {
  for (const double slope_deg : {4.76, 8.0}) {
    Heights heights;
    const double height_m = Rise(slope_deg, 1.5);
    ExpectNothing(Over(Ramp("up", 2.5, 4, slope_deg, 0) + ", " + Level("platform", 4, 5, height_m) +
                           ", " + Ramp("down", 5, 6.5, slope_deg, 180),
                       {}, &heights));
    EXPECT_NEAR(heights.highest_m, height_m, 0.01);
    // BELUGA rocks on its springs, 8 mm at 0.14 m from the axle, where the slope changes.
    EXPECT_GT(heights.tilt_rad, slope_deg * kPi / 180 - 0.01);
    EXPECT_LT(heights.tilt_rad, slope_deg * kPi / 180 + 0.06);
  }
}

// A floor that lies lower is a fall to who did not know of it, and a way to who did.
TEST_P(Building, DownARampIsNoFall) {
  const double depth_m = Rise(6, 1.5);
  std::string hazards = Ramp("down", 2.5, 4, -6, 0) + ", " + Level("pit", 4, 5, -depth_m) + ", " +
                        Ramp("up", 5, 6.5, -6, 180);
  Heights heights;
  ExpectNothing(Over(hazards, {}, &heights));
  EXPECT_NEAR(heights.lowest_m, -depth_m, 0.01);
  for (std::size_t at = 0; (at = hazards.find("id:", at)) != std::string::npos; at += 20)
    hazards.insert(at, "known: false, ");
  ExpectNothing(Over(hazards));  // nor is it down one that no map knows
}

// A hill of two ramps, turned about its ridge's middle: met askew, its slopes turn the robot aside.
std::string Hill(double turn_deg, double slope_deg) {
  const Pose2 X_WH{4.2, 2.5, turn_deg * kPi / 180};
  const auto half = [&](const char* id, double from_m, double to_m, double toward_deg) {
    std::string polygon;
    for (const Vec2& corner : Rectangle({from_m, -1.2}, {to_m, 1.2})) {
      const Vec2 p = X_WH * corner;
      polygon += fmt::format("{}[{:.9f}, {:.9f}]", polygon.empty() ? "" : ", ", p.x(), p.y());
    }
    return fmt::format("{{type: ramp, id: {}, slope_deg: {}, toward_deg: {}, polygon_m: [{}]}}", id,
                       slope_deg, toward_deg, polygon);
  };
  return half("up", -1, 0, turn_deg) + ", " + half("down", 0, 1, turn_deg + 180);
}

// hTetro's sixteen wheels on a rigid body then stand on a few: 3 degrees off square it is pushed
// aside by 0.09 m, 10 degrees off by 0.19 m, and 35 degrees off it does not get up.
TEST_P(Building, OverAHillThatLiesAskew) {
  const bool rigid = std::string(GetParam()) == "htetro";
  for (const double turn_deg : rigid ? std::vector{-3.0, 3.0} : std::vector{-35.0, 10.0, 35.0}) {
    Heights heights;
    ExpectNothing(Over(Hill(turn_deg, 6), {}, &heights), rigid ? 0.1 : 0.05);
    EXPECT_NEAR(heights.highest_m, std::tan(6 * kPi / 180), 0.02);
  }
}

TEST_P(Building, WhatHoldsRollingWheelsCostsEnergy) {
  const auto carpet = [](double drag) {
    return fmt::format(
        "{{type: carpet, height_m: 0.004, rolling_drag: {}, polygon_m: [[3, 1], [6, 1], [6, 4], "
        "[3, 4]]}}",
        drag);
  };
  const EpisodeRecord hard = Over(carpet(0)), soft = Over(carpet(0.05));
  ExpectNothing(hard);
  ExpectNothing(soft);
  EXPECT_GT(soft.metrics.energy_j, hard.metrics.energy_j + 5);
}

TEST_P(Building, AThresholdAndALiftThatItIsTrustedToCross) {
  ExpectNothing(Over("{type: threshold, height_m: 0.008, line_m: [[4, 1], [4, 4]]}"));
  ExpectNothing(
      Over("{type: lift_sill, level_m: 0.004, polygon_m: [[4, 4], [4, 1], [7.5, 1], [7.5, 4]]}"));
  ExpectNothing(
      Over("{type: lift_sill, level_m: -0.004, polygon_m: [[4, 4], [4, 1], [7.5, 1], [7.5, 4]]}"));
}

// The same ramp, wet: what its friction does not hold is not climbed.
TEST_P(Building, AWetRampIsNotClimbed) {
  const std::string ramp = Ramp("up", 2.5, 4, 8, 0) + ", " + Level("top", 4, 8, Rise(8, 1.5));
  const auto wet = [](double friction) {
    return fmt::format(
        ", {{type: wet, id: wet, friction: {}, polygon_m: [[3, 0.5], [8, 0.5], [8, 4.5], [3, "
        "4.5]]}}",
        friction);
  };
  ExpectNothing(Over(ramp + wet(0.4)));
  const EpisodeRecord dut = Over(ramp + wet(0.08));
  ASSERT_FALSE(dut.events.empty());
  EXPECT_EQ(dut.events[0].mode, FailureMode::kStuck);
  EXPECT_GT(dut.events[0].x_m, 2.6);
  EXPECT_LT(dut.events[0].x_m, 3.5);
}

// A planner covers what the ramp leads to, and keeps off its sides and the platform's edge.
TEST_P(Building, APlanCoversAPlatformWithARamp) {
  const double height_m = Rise(5, 1.5);
  const std::string hazards =
      Ramp("ramp", 2.5, 4, 5, 0, 1, 2.5) + ", " + Level("platform", 4, 5.5, height_m, 0.75, 3);
  const std::string room_of_6_m_by_3_m =
      "\"##############\\n#............#\\n#............#\\n#............#\\n#............#\\n"
      "#............#\\n#............#\\n##############\\n\"";
  const EpisodeRecord dut = Over(hazards, {{"plan", "boustrophedon"},
                                           {"site.grid.rows", room_of_6_m_by_3_m},
                                           {"time_limit_s", "1500"}});
  EXPECT_EQ(dut.outcome, Outcome::kSuccess) << dut.message;
  for (const Event& e : dut.events)
    ADD_FAILURE() << Name(e.mode) << " " << e.kind << " at " << e.x_m << " " << e.y_m;
  EXPECT_GT(dut.metrics.coverage, 0.9);
}

// Set down on a ramp, facing up, down or across, it stands there as it is put, leaning as the ramp
// does.
TEST_P(Building, SetDownOnARampItStandsThere) {
  for (const double slope_deg : {6.0, -6.0})
    for (const double yaw_deg : {0.0, 90.0, 200.0}) {
      SCOPED_TRACE(fmt::format("{} {}", slope_deg, yaw_deg));
      Save("plan.csv",
           fmt::format("x_m,y_m\n{:.6f},{:.6f}\n", 3.2 + 0.4 * std::cos(yaw_deg * kPi / 180),
                       2.5 + 0.4 * std::sin(yaw_deg * kPi / 180)));
      Heights heights;
      const EpisodeRecord dut =
          Over(Ramp("ramp", 2.2, 4.6, slope_deg, 0),
               {{"start", fmt::format("{{x_m: 3.2, y_m: 2.5, yaw_deg: {}}}", yaw_deg)}}, &heights);
      EXPECT_EQ(dut.outcome, Outcome::kSuccess) << dut.message;
      for (const Event& e : dut.events) ADD_FAILURE() << Name(e.mode) << " " << e.kind;
      EXPECT_NEAR(heights.tilt_rad, 6 * kPi / 180, 0.06);
      EXPECT_NEAR(heights.highest_m, Rise(slope_deg, slope_deg > 0 ? 1.4 : 0.6), 0.06);
    }
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Which hazards a robot's own sensors tell of in time to stop.
#include "run/episode/hazard_sight.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "run/scenario/override.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

constexpr const char* kAll = "sensors: {lidar: {}, cliff: {}}\n";

class SightDrive : public ScenarioTest {
 protected:
  SightDrive() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n6.5,2.5\n"); }

  // Of the hazard, which the robot meets driving straight on along y = 2.5 m.
  Encounter::Sensed Meet(const std::string& hazard, const std::string& keys = kAll,
                         const std::vector<Override>& overrides = {}) const {
    const EpisodeRecord record =
        Drive(Read(RoomScenario("{" + hazard + ", id: it, known: false}", keys), overrides));
    const auto at = std::ranges::find(record.encounters, "it", &Encounter::hazard);
    EXPECT_NE(at, record.encounters.end()) << hazard;
    return at == record.encounters.end() ? Encounter::Sensed::kUnseen : at->sensed;
  }
  static std::string Across(const std::string& type, const std::string& keys) {
    return "type: " + type + ", polygon_m: [[2.4,0.6],[3,0.6],[3,4.4],[2.4,4.4]], " + keys;
  }
};

// A lidar at 0.335 m sees over what is lower, and to what is higher from afar.
TEST_F(SightDrive, ALidarSeesWhatReachesUpToIt) {
  const auto crate = [](const char* height_m) {
    return std::string("type: blind_object, polygon_m: [[3,2.2],[3.4,2.2],[3.4,2.8],[3,2.8]], ") +
           "height_m: " + height_m;
  };
  EXPECT_EQ(Meet(crate("0.5")), Encounter::Sensed::kInTime);
  EXPECT_EQ(Meet(crate("0.3")), Encounter::Sensed::kNotInTime);
  EXPECT_EQ(Meet(crate("0.5"), "sensors: {cliff: {}}\n"), Encounter::Sensed::kNotInTime);
}

// Head-on it comes back, askew it lets all beams through; and the wall behind is no glass.
TEST_F(SightDrive, GlassIsSeenHeadOnAlone) {
  EXPECT_EQ(Meet("type: glass, line_m: [[3, 1.5], [3, 3.5]], height_m: 0.6"),
            Encounter::Sensed::kInTime);
  EXPECT_EQ(Meet("type: glass, line_m: [[3, 2.4], [3.8, 3.2]], height_m: 0.6"),
            Encounter::Sensed::kNotInTime);
}

// They look down at the robot's edge, hTetro's wheels are 5 cm within. Slow, it stops before one is
// over the drop; fast, it does not. What is less deep than they can tell they do not see.
TEST_F(SightDrive, CliffSensorsSeeADropInTimeOfASlowRobot) {
  const auto at = [&](const char* depth_m, const char* speed_mps) {
    Save("plan.csv", std::string("x_m,y_m,speed_mps\n1.5,2.5,\n3.5,2.5,") + speed_mps + "\n");
    return Meet(Across("step", std::string("height_m: -") + depth_m), kAll, {{"robot", "htetro"}});
  };
  EXPECT_EQ(at("0.1", "0.1"), Encounter::Sensed::kInTime);
  EXPECT_EQ(at("0.1", "0.4"), Encounter::Sensed::kNotInTime);
  EXPECT_EQ(at("0.02", "0.2"), Encounter::Sensed::kNotInTime);
}

// It cannot miss what it has no eyes for: nothing is said.
TEST_F(SightDrive, OfARobotWithoutSensorsNothingIsSaid) {
  EXPECT_EQ(Meet(Across("step", "height_m: -0.1"), ""), Encounter::Sensed::kUnseen);
}

// Once it was over it, its sensors were as well: coming back says nothing of them.
TEST_F(SightDrive, TheFirstMeetingCounts) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n3,2.5\n2,2.5\n");
  const EpisodeRecord record = Drive(Read(RoomScenario(
      "{type: cable_cover, id: it, line_m: [[2.5, 0.5], [2.5, 4.5]], height_m: 0.005}", kAll)));
  ASSERT_GE(record.encounters.size(), 2u);
  ASSERT_EQ(record.encounters[1].hazard, "it");
  EXPECT_EQ(record.encounters[0].sensed, Encounter::Sensed::kNotInTime);
  EXPECT_EQ(record.encounters[1].sensed, Encounter::Sensed::kUnseen);
}

}  // namespace
}  // namespace floorproof

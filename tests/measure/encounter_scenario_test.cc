// SPDX-License-Identifier: Apache-2.0
// The encounters that a robot's risk is measured by: for every robot and hazard they can be laid
// out and driven, and their ranges follow from the robot.
#include "measure/encounter_scenario.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "controllers/drive.h"
#include "env/hazards/hazard_type.h"
#include "env/map/crossing_site.h"
#include "env/map/site.h"
#include "measure/drive_encounters.h"
#include "measure/drive_plans.h"
#include "measure/plan_floors.h"
#include "run/episode/make_plan.h"
#include "run/scenario/scenario_file.h"
#include "tests/robots.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> kSensors = {"lidar", "cliff"};

class EveryRobotsEncounters : public ::testing::TestWithParam<std::string> {
 protected:
  RobotSpec robot_ = ReadRobot(FindRobotFile(GetParam(), {})).spec;
};
INSTANTIATE_TEST_SUITE_P(Robots, EveryRobotsEncounters, ::testing::ValuesIn(RobotNames()),
                         [](const auto& robot) { return robot.param; });

// Each in its own variant, over it and beside it; what stands in the way is not driven over.
TEST_P(EveryRobotsEncounters, AreWithEveryTypeThatThereIs) {
  const ScenarioFile file = EncountersOf(GetParam(), {}).file;
  std::set<std::string> dut;
  for (const Variant& variant : file.variants()) dut.insert(variant.name);
  for (const std::string& type : PluginNames(HazardTypes())) {
    EXPECT_TRUE(dut.contains("meeting=" + type + " beside")) << type;
    const Site site = ReadSite(
        ParseYaml("site: 1\ngenerate: {kind: crossing, hazard: " + type + "}", "s.yaml"), ".");
    const HazardClass is = site.map.hazards[0].hazard_class;
    EXPECT_EQ(dut.contains("meeting=" + type + " over"),
              is == HazardClass::kLevelChange || is == HazardClass::kTerrain)
        << type;
  }
}

TEST_P(EveryRobotsEncounters, CanBePlanned) {
  const ScenarioFile file = EncountersOf(GetParam(), {}).file;
  std::uint64_t episode = 0;
  for (const Variant& variant : file.variants()) {
    const Scenario s = file.Read(episode++, variant);
    const PlanResult plan = MakePlan(s);
    ASSERT_EQ(plan.status, PlanStatus::kSuccess) << variant.name << ": " << plan.message;
    EXPECT_LE(plan.path.back().speed_mps, robot_.max_speed_mps);
    EXPECT_GT(plan.path.back().speed_mps, 0);
  }
}

// All ends of all ranges, on the shortest strip and the longest, at the steepest angle.
TEST_P(EveryRobotsEncounters, EveryCornerOfTheRangesIsAHazard) {
  const ConfigNode scenario = ParseYaml(EncounterScenario(GetParam(), robot_, kSensors), "s.yaml");
  const ConfigNode* lengths =
      scenario.Find("randomise")->Find("site.generate.length_m")->Find("uniform");
  for (const auto& entry : HazardTypes()) {
    std::vector<ConfigNode> corners = {ConfigNode::Map()};
    const auto add = [&](const std::string& key, const std::vector<std::string>& values) {
      std::vector<ConfigNode> more;
      for (const ConfigNode& corner : corners)
        for (const std::string& value : values)
          more.emplace_back(corner).SetPath(key, ConfigNode::Scalar(value));
      corners = std::move(more);
    };
    add("generate.length_m", {lengths->items[0].scalar, lengths->items[1].scalar});
    for (const KeyRange& range : entry.make()->Ranges(robot_)) {
      std::vector<std::string> ends;
      for (const auto& [low, high] : range.spans)
        for (const double value : {low, high}) ends.push_back(FormatDouble(value));
      add("generate.sizes." + std::string(entry.name) + "." + range.key, ends);
    }
    for (ConfigNode& corner : corners) {
      corner.SetPath("site", ConfigNode::Scalar("1"));
      ConfigNode& generate = *corner.Find("generate");
      for (const auto& [key, value] : scenario.Find("site")->Find("generate")->entries)
        generate.Add(key, value);
      generate.Add("hazard", ConfigNode::Scalar(std::string(entry.name)));
      generate.Add("angle_deg", ConfigNode::Scalar("70"));
      EXPECT_NO_THROW(ReadSite(corner, ".")) << WriteYaml(corner);
    }
  }
}

// A robot that cannot drive sideways is not asked to.
TEST_P(EveryRobotsEncounters, LeadByWhateverSideTheRobotCan) {
  const std::string dut = EncounterScenario(GetParam(), robot_, kSensors);
  EXPECT_EQ(dut.find("lead_deg") != std::string::npos, IsHolonomic(robot_));
}

// Of a key that is drawn as one of several values.
std::vector<double> Drawn(const RobotSpec& robot, const std::string& key) {
  const ConfigNode scenario = ParseYaml(EncounterScenario("beluga", robot, kSensors), "s.yaml");
  std::vector<double> values;
  for (const ConfigNode& value : scenario.Find("randomise")->Find(key)->Find("choice")->items)
    values.push_back(AsDouble(value, key));
  std::ranges::sort(values);
  return values;
}

// As plans lead, with each of its four sides alike; and all round.
TEST(Encounters, LeadMostlyAlongTheRobotsAxes) {
  const RobotSpec robot = ReadRobot(FindRobotFile("htetro", {})).spec;
  const std::vector<double> leads = Drawn(robot, "site.generate.lead_deg");
  for (const double side : {-90., 0., 90., 180.})
    EXPECT_EQ(std::ranges::count(leads, side) * 6, std::ssize(leads)) << side;
  double last = leads.front();
  for (const double lead : leads) {
    EXPECT_LE(lead - last, 15) << lead;
    last = lead;
  }
  EXPECT_EQ(leads.front() + 360 - leads.back(), 15);
}

// By its figures, not by its name.
TEST(Encounters, GrowWithTheRobot) {
  RobotSpec robot = ReadRobot(FindRobotFile("beluga", {})).spec;
  const auto heights = [&] { return Drawn(robot, "site.generate.sizes.step.height_m"); };
  EXPECT_EQ(heights().front(), -0.02) << "four fifths of a belly at 25 mm";
  EXPECT_EQ(heights().back(), 0.02);
  robot.clearance_m = 0.05;
  EXPECT_EQ(heights().back(), 0.04);
  robot.measured.frictions = {0.5, 1};
  robot.measured.limits = {{"step", {0.01, 0.02}}};
  EXPECT_EQ(heights().back(), 0.05) << "2.5 times the step that it was measured to cross";
}

// Plans are led over what is mild. How seldom that stops a robot cannot be learned from what does.
TEST(Encounters, AreMildMoreOftenThanNot) {
  const RobotSpec robot = ReadRobot(FindRobotFile("beluga", {})).spec;
  const std::vector<double> up = Drawn(robot, "site.generate.sizes.cable_cover.height_m");
  const double low = up.front(), high = up.back();
  EXPECT_GE(std::ranges::count_if(up, [&](double x) { return x < low + 0.4 * (high - low); }),
            std::ssize(up) / 2);
  const std::vector<double> both = Drawn(robot, "site.generate.sizes.step.height_m");
  EXPECT_EQ(std::ranges::count_if(both, [](double x) { return x < 0; }), std::ssize(both) / 2);
  EXPECT_GE(std::ranges::count_if(both, [](double x) { return std::abs(x) < 0.008; }),
            std::ssize(both) / 2);
  EXPECT_LE(std::abs(both[both.size() / 2]), 0.001) << "down to next to nothing";
}

// A robot's file may lie anywhere, and its model may be called anything.
TEST(Encounters, TakeARobotOfAnyName) {
  const std::string file = "/my \"big\" robots/#1: a\\b.xml";
  RobotSpec robot = ReadRobot(FindRobotFile("beluga", {})).spec;
  robot.name = "mine: \"new\" #2";
  for (const std::string& text : {EncounterScenario(file, robot, kSensors),
                                  PlanFloorsScenario(file, robot, 1, FloorConditions::kKnown)}) {
    const ConfigNode dut = ParseYaml(text, "s.yaml");
    EXPECT_EQ(dut.Find("robot")->Find("name")->scalar, file);
    EXPECT_THAT(dut.Find("name")->scalar, HasSubstr(robot.name));
  }
}

// Each of the plans' floors has a friction and a mass of its own; a mass that the user sets stays,
// and whoever predicts the plans knows neither.
TEST(PlansOverFloors, EachFloorHasItsConditions) {
  constexpr int kFloors = 3, kPlanners = 4;
  std::set<double> frictions, masses;
  const ScenarioFile dut = PlansOf("beluga", kFloors, {}).file;
  ASSERT_EQ(std::ssize(dut.variants()), kFloors * kPlanners);
  for (const Variant& variant : dut.variants()) {
    const Scenario s = dut.Read(0, variant);
    frictions.insert(s.world.site.map.floor_friction);
    masses.insert(s.world.robot.spec.mass_kg);
  }
  EXPECT_EQ(std::ssize(frictions), kFloors);
  EXPECT_EQ(std::ssize(masses), kFloors);
  const ScenarioFile heavy = PlansOf("beluga", 1, {{"robot.mass_kg", "13"}}).file;
  EXPECT_NEAR(heavy.Read(0, heavy.variants()[0]).world.robot.spec.mass_kg, 13, 1e-9);
  const RobotSpec robot = ReadRobot(FindRobotFile("beluga", {})).spec;
  const ConfigNode predicted =
      ParseYaml(PlanFloorsScenario("beluga", robot, kFloors, FloorConditions::kDrawn), "s.yaml");
  EXPECT_EQ(predicted.Find("randomise")->entries.size(), 2u);
}

TEST(Encounters, AreToldInATable) {
  CampaignSummary summary;
  VariantSummary& over = summary.variants.emplace_back();
  over.name = "meeting=step over";
  over.n = 200;
  over.success = 150;
  over.failures = {{.name = "stuck", .k = 40, .n = 200}, {.name = "veer_off", .k = 10, .n = 200}};
  over.errors = 2;
  EXPECT_THAT(
      EncounterTable(summary).Lines(100, false),
      ::testing::ElementsAre(
          "  Meeting    Episodes  Cleared  veer off  stuck  roll over  bounce back  No outcome",
          "  step over       200     75 %       5 %   20 %        0 %          0 %  2 errors"));
}

}  // namespace
}  // namespace floorproof

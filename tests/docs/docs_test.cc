// SPDX-License-Identifier: Apache-2.0
// The plug-ins of docs/adding-a-*.md, compiled from the pages; pages that must list what there is.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "controllers/supervision/safety_plan.h"
#include "env/core/coverage.h"
#include "env/core/encounter.h"
#include "env/failures/detector.h"
#include "env/faults/fault.h"
#include "env/hazards/hazard_type.h"
#include "env/scene/scene.h"
#include "env/sensors/sensor.h"
#include "env/sim/simulation.h"
#include "planners/online/online_planner.h"
#include "planners/planner.h"
#include "run/episode/metrics.h"
#include "run/episode/trace.h"
#include "tests/places.h"
#include "validate/law.h"

namespace floorproof {

std::unique_ptr<Planner> MakePlainRows();
std::unique_ptr<HazardType> MakeRails();
std::unique_ptr<Detector> MakeDrift();
std::unique_ptr<Sensor> MakeSonar();
std::unique_ptr<Fault> MakeHotMotors();
std::unique_ptr<Monitor> MakeHotBattery();

namespace {

HazardMap Room(double width_m, double depth_m) {
  HazardMap map;
  map.frame = {static_cast<int>(width_m / 0.05), static_cast<int>(depth_m / 0.05), 0.05, {}};
  map.occupancy = Grid<CellState>(map.frame.width, map.frame.height, CellState::kFree);
  return map;
}

// A page's block, as it is extracted beside the tests that were built.
std::filesystem::path DocsCode(const char* name) {
  return ProgramFile().parent_path().parent_path() / "tests/docs/code" / name;
}

RobotModel Burger() { return ReadRobot(DocsCode("burger.xml")); }

TEST(AddingARobot, TheModelSaysWhatThePageSays) {
  const RobotSpec dut = Burger().spec;
  ASSERT_EQ(dut.wheels.size(), 2u);
  EXPECT_NEAR(dut.wheels[0].radius_m, 0.033, 1e-9);
  EXPECT_NEAR((dut.wheels[0].p_BW - dut.wheels[1].p_BW).norm(), 0.160, 1e-9);
  EXPECT_NEAR(dut.wheels[0].max_speed_radps, 6.5, 0.1);
  EXPECT_NEAR(dut.mass_kg, 0.94, 1e-9);
  EXPECT_LT(dut.cruise_mps, dut.wheels[0].max_speed_radps * dut.wheels[0].radius_m);
}

TEST(AddingARobot, ItStandsWhereItIsPut) {
  const HazardMap map = Room(2, 2);
  const Scene scene = BuildScene(map, Burger(), {}, {1, 1, 0});
  const DataPtr data = MakeData(scene.model.get());
  while (data->time < 1) StepEngine(scene.model.get(), data.get());
  const double* p_WB = data->xpos + 3 * scene.base_body;
  EXPECT_NEAR(p_WB[0], 1, 0.005);
  EXPECT_NEAR(p_WB[1], 1, 0.005);
  EXPECT_NEAR(p_WB[2], 0, 0.003);
}

TEST(AddingAPlanner, ItCoversARoomAlongEitherAxis) {
  const HazardMap map = Room(3, 2);
  const RobotSpec robot = Burger().spec;
  double length_m[2] = {};
  for (const bool along_y : {false, true}) {
    const auto dut = MakePlainRows();
    ConfigNode keys = ConfigNode::Map();
    keys.Add("along_y", ConfigNode::Scalar(along_y ? "true" : "false"));
    ReadParams(keys, "plan.", *dut);
    const PlanResult plan = dut->Plan({map, robot, {0.3, 0.3, 0}, {}, 1});
    ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
    const SweepArea area = ComputeSweepArea(map, robot.clear, robot.tool, robot.step_m, {0.3, 0.3});
    EXPECT_GT(MeasureCoverage(area, robot.tool, plan.path).coverage, 0.95);
    // Most of the way lies along the rows.
    double along_m = 0;
    for (std::size_t i = 1; i < plan.path.size(); ++i) {
      const Vec2 step = plan.path[i].p_W - plan.path[i - 1].p_W;
      if (std::abs(along_y ? step.x() : step.y()) < 1e-6) along_m += step.norm();
    }
    length_m[along_y] = Length(plan.path);
    EXPECT_GT(along_m, 0.6 * length_m[along_y]);
  }
  EXPECT_NE(length_m[0], length_m[1]);
}

TEST(AddingAHazard, RailsLieOnBothSidesOfTheLine) {
  const auto dut = MakeRails();
  ConfigNode keys = ConfigNode::Map();
  keys.Add("height_m", ConfigNode::Scalar("0.006"));
  ReadParams(keys, "", *dut);
  const Hazard straight = dut->Make({{1, 2}, {1.9, 2}});
  ASSERT_EQ(straight.solids.size(), 2u);
  for (const Solid& rail : straight.solids) {
    EXPECT_NEAR(SignedArea(rail.base), 0.9 * 0.03, 1e-9);
    EXPECT_EQ(rail.z_high_m, 0.006);
  }
  EXPECT_TRUE(Contains(straight.footprint[0], {1.5, 2 - 0.315})) << "the right one";
  EXPECT_TRUE(Contains(straight.footprint[1], {1.5, 2 + 0.315}));
  EXPECT_EQ(dut->Make({{0, 0}, {2, 0}, {2, 2}}).solids.size(), 4u);
  EXPECT_FALSE(IsObstacle(straight, 0.006));
  EXPECT_TRUE(IsObstacle(straight, 0.005));
}

TEST(AddingAMonitor, ABatteryThatGivesTooMuchForLongIsAnAlarm) {
  const auto dut = MakeHotBattery();
  const RobotSpec robot = Burger().spec;
  const HazardMap map = Room(2, 2);
  const auto drive = MakePlugin(Drives(), robot.drive, "drive");
  drive->Configure(robot);
  const auto raised = [&](double current_a, double for_s) {
    dut->Start({robot, *drive, map});
    const std::vector<double> none(robot.wheels.size());
    const PowerReading power{true, std::vector<double>(robot.wheels.size(), current_a), 12};
    for (double t_s = 0; t_s < for_s; t_s += 0.02)
      dut->Update({t_s, 0.02, {}, none, none, {}, false, {}, {}, {}, {}, power, {}});
    return dut->alarms()[0].raised();
  };
  EXPECT_FALSE(raised(2, 60)) << "48 W";
  EXPECT_FALSE(raised(4, 4)) << "96 W, not for long";
  EXPECT_TRUE(raised(4, 10));
}

TEST(SafetyPage, ItsMissionIsOne) {
  const ConfigNode root = ReadYamlFile(DocsCode("mission.yaml"));
  const Mission mission = ReadMission(root, RobotPrimitiveTypes());
  EXPECT_EQ(mission.name, "inspect the bridge");
  EXPECT_EQ(mission.nodes.size(), 1u + 1 + 1 + 4);
}

TEST(AddingADetector, ASmallErrorThatLastsFailsAndALargeOneThatPassesDoesNot) {
  const HazardMap map = Room(3, 2);
  const RobotSpec robot = Burger().spec;
  const auto count = [&](double error_m, double lasts_s) {
    const auto dut = MakeDrift();
    dut->Start({map, robot});
    int events = 0;
    for (Sample sample; sample.t_s < 60; sample.t_s += 0.004) {
      sample.cross_track_m = sample.t_s < lasts_s ? error_m : 0;
      events += dut->Update(sample);
    }
    EXPECT_EQ(events > 0, dut->margin() < 0);
    return events;
  };
  EXPECT_EQ(count(0.14, 60), 0);
  EXPECT_EQ(count(0.20, 60), 1);
  EXPECT_EQ(count(0.40, 1), 0);
}

TEST(AddingASensor, ItTellsTheNearestInEachConeGlassToo) {
  HazardMap map = Room(4, 2);
  Hazard pane;
  pane.id = "pane";
  pane.hazard_class = HazardClass::kGlass;
  pane.footprint = {Rectangle({3, 0.8}, {3.01, 1.2})};
  pane.solids = {{Solid::Kind::kPrism, pane.footprint[0], {}, 0, 2}};
  map.hazards = {pane};
  const RobotModel robot = Burger();
  const Pose2 start{1, 1, 0};
  const Scene scene = BuildScene(map, robot, {}, start);
  Simulation sim(scene, map, robot.spec);
  sim.Reset(start);
  const auto dut = MakeSonar();
  ReadParams(ParseYaml("{cones: 4, noise_m: 0}", "keys"), "", *dut);
  Observation sensed;
  dut->Start({scene, map, robot.spec, 0.02}, sim.data(), sim.truth(), Stream(1, 0, "sonar"),
             sensed);
  dut->Sense(sim.data(), sim.truth(), sensed);
  EXPECT_NEAR(sensed.scan.range_m[0], 2, 1e-3) << "ahead, the pane";
  EXPECT_NEAR(sensed.scan.range_m[1], 1, 1e-3) << "to the left, the border";
  EXPECT_NEAR(sensed.scan.range_m[2], 1, 1e-3);
  EXPECT_NEAR(sensed.scan.range_m[3], 1, 1e-3);
}

TEST(AddingAFault, HotWindingsResistMore) {
  const auto dut = MakeHotMotors();
  ReadParams(ParseYaml("{winding_c: 120}", "keys"), "", *dut);
  dut->Start({Burger().spec, {}});
  Alterations alterations;
  dut->Break(alterations);
  EXPECT_NEAR(alterations.motor_resistance, 1.393, 1e-9);
}

std::string Page(const std::string& name) {
  std::ifstream file(SourceFile("docs") / name);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Readme, ItsTablesHoldEveryPlannerHazardAndRobot) {
  const std::string readme = Page("../README.md");
  const std::size_t begin = readme.find("\n## Planners, hazards, robots\n");
  ASSERT_NE(begin, std::string::npos);
  const std::string tables = readme.substr(begin, readme.find("\n## ", begin + 1) - begin);
  std::vector<std::string> names = PluginNames(Planners());
  for (const auto& more : {PluginNames(OnlinePlanners()), PluginNames(HazardTypes())})
    names.insert(names.end(), more.begin(), more.end());
  for (const RobotEntry& robot : Robots()) names.emplace_back(robot.name);
  ASSERT_GT(names.size(), 20u);
  for (const std::string& name : names)
    EXPECT_NE(tables.find("`" + name + "`"), std::string::npos) << name << " is in no table";
}

TEST(Validation, ThePageListsEveryLaw) {
  const std::string page = Page("validation.md");
  ASSERT_FALSE(Laws().empty());
  for (const auto& name : PluginNames(Laws()))
    EXPECT_NE(page.find("\n| `" + name + "` |"), std::string::npos) << name << " has no row";
}

// The table of that heading, as the page must hold it.
std::string TableOf(const std::string& page, const std::string& heading) {
  const std::size_t begin = page.find("\n|", page.find("\n## " + heading + "\n")) + 1;
  return page.substr(begin, page.find("\n\n", begin) + 1 - begin);
}

std::vector<std::string> Lines(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// Says the line that is missing or other, not both tables.
void ExpectSameLines(const std::string& page, const std::string& wanted) {
  const std::vector<std::string> there = Lines(page), want = Lines(wanted);
  const auto holds = [](const auto& lines, const std::string& line) {
    return std::ranges::find(lines, line) != lines.end();
  };
  bool same_lines = true;
  for (const std::string& line : want)
    if (!holds(there, line)) {
      ADD_FAILURE() << "docs/results.md lacks the line\n" << line;
      same_lines = false;
    }
  for (const std::string& line : there)
    if (!holds(want, line)) {
      ADD_FAILURE() << "docs/results.md has a line that the code does not\n" << line;
      same_lines = false;
    }
  if (!same_lines) return;
  const auto [at, by] = std::ranges::mismatch(there, want);
  if (by != want.end())
    ADD_FAILURE() << "docs/results.md does not have this line in its place\n" << *by;
  else if (at != there.end())
    ADD_FAILURE() << "docs/results.md has this line twice\n" << *at;
}

std::string Line(std::string_view name, std::string_view unit, std::string_view type,
                 std::string_view help) {
  std::string line = "| `";
  line.append(name).append("` | ").append(unit).append(unit.empty() ? "| " : " | ");
  return line.append(type).append(" | ").append(help).append(" |\n");
}

constexpr const char* kHead = "| name | unit | type | meaning |\n|---|---|---|---|\n";

TEST(Results, ThePageListsEveryMetric) {
  constexpr const char* kTypes[] = {"real", "count", "real, or none"};  // as MetricColumn::Member
  std::string table = kHead;
  for (const MetricColumn& metric : kMetrics)
    table += Line(metric.name, metric.unit, kTypes[metric.member.index()], metric.help);
  ExpectSameLines(TableOf(Page("results.md"), "Metrics"), table);
}

TEST(Results, ThePageListsEveryTraceColumn) {
  constexpr const char* kTypes[] = {"time", "place", "real", "word"};  // as TraceColumn::Member
  std::string table = kHead;
  for (const TraceColumn& column : kTraceColumns)
    table += Line(column.name, column.unit, kTypes[column.member.index()], column.help);
  ExpectSameLines(TableOf(Page("results.md"), "trace.csv"), table);
}

TEST(Results, ThePageListsWhatHazardsAreMetWith) {
  std::string table = "| name | unit | meaning |\n|---|---|---|\n";
  for (const ApproachColumn& column : kApproach) {
    const std::string unit = column.unit.empty() ? "" : std::string(column.unit) + " ";
    table +=
        "| `" + std::string(column.name) + "` | " + unit + "| " + std::string(column.help) + " |\n";
  }
  ExpectSameLines(TableOf(Page("results.md"), "encounters.csv"), table);
}

}  // namespace
}  // namespace floorproof

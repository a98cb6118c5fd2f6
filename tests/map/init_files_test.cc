// SPDX-License-Identifier: Apache-2.0
// `init`: a site and a scenario that run as they are.
#include "env/map/init_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "env/core/coverage.h"
#include "env/map/site.h"
#include "tests/map/temp_folder.h"
#include "tests/places.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

RobotSpec Disc(double radius_m) {
  RobotSpec robot;
  robot.name = "disc";
  robot.clear = robot.tool = {Shape2::Kind::kCircle, radius_m, {}};
  robot.inscribed_radius_m = robot.circumscribed_radius_m = radius_m;
  robot.step_m = 0.01;
  return robot;
}

class InitFilesTest : public TempFolder {
 protected:
  // A map of 0.1 m cells drawn in '#', '.' and '?'.
  fs::path SaveMap(const std::vector<std::string>& rows, const std::string& origin) const {
    std::string pgm =
        "P5 " + std::to_string(rows[0].size()) + " " + std::to_string(rows.size()) + " 255\n";
    for (const auto& row : rows)
      for (const char c : row) pgm += c == '#' ? '\0' : static_cast<char>(c == '.' ? 254 : 205);
    Save("map.pgm", pgm);
    return Save("map.yaml", "image: map.pgm\nresolution: 0.1\norigin: " + origin +
                                "\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  }
};

// Two rooms; the right one is larger.
const std::vector<std::string> kTwoRooms = {
    "#####################", "#......#............#", "#......#............#",
    "#......#............#", "#......#............#", "#......#............#",
    "#......#............#", "#......#............#", "#####################"};

TEST_F(InitFilesTest, StartsInTheLargestRoomWithRoomToTurn) {
  const fs::path map = SaveMap(kTwoRooms, "[-3, 4, 0]");
  const RobotSpec robot = Disc(0.15);
  const InitFiles dut = MakeInitFiles(map, robot, folder_ / "try");
  const ConfigNode scenario = ParseYaml(dut.scenario_yaml, "scenario.yaml");
  const ConfigNode& start = *scenario.Find("start");
  const Vec2 p(std::stod(start.Find("x_m")->scalar), std::stod(start.Find("y_m")->scalar));
  EXPECT_GT(p.x(), -3 + 0.8);
  // Lower left of the room, 0.10 m to spare (and the cell's own half).
  EXPECT_LT(p.x(), -3 + 0.8 + 0.4);
  EXPECT_LT(p.y(), 4 + 0.1 + 0.4);

  fs::create_directory(folder_ / "try");
  const Site site = ReadSiteFile(Save("try/site.yaml", dut.site_yaml));
  const SweepArea area = ComputeSweepArea(site.map, robot.clear, robot.tool, robot.step_m, p);
  EXPECT_GT(area.area_m2(), 0.9 * 1.2 * 0.7);
  EXPECT_GE(ComputeClearance(site.map, robot.step_m).At(p), 0.15 + 0.1);
}

TEST_F(InitFilesTest, TheTextsSayWhatTheDesignAsks) {
  const InitFiles dut = MakeInitFiles(SaveMap(kTwoRooms, "[0, 0, 0]"), Disc(0.15), folder_);
  const ConfigNode scenario = ParseYaml(dut.scenario_yaml, "scenario.yaml");
  EXPECT_EQ(scenario.Find("scenario")->scalar, "1");
  EXPECT_EQ(scenario.Find("site")->scalar, "site.yaml");
  EXPECT_EQ(scenario.Find("robot")->scalar, "disc");
  EXPECT_EQ(scenario.Find("plan")->Find("planner")->scalar, "boustrophedon");
  EXPECT_EQ(scenario.Find("success")->Find("min_coverage")->scalar, "0.9");
  const ConfigNode site = ParseYaml(dut.site_yaml, "site.yaml");
  EXPECT_EQ(site.Find("map")->scalar, "map.yaml");
}

// A value that is written and drawn is not the one that is driven: beside each it says so.
TEST_F(InitFilesTest, WhereAValueIsDrawnItSaysThatTheDrawWins) {
  RobotSpec robot = Disc(0.15);
  robot.mass_kg = 8;
  robot.battery.voltage_v = 12;
  const InitFiles dut = MakeInitFiles(SaveMap(kTwoRooms, "[0, 0, 0]"), robot, folder_);
  // The comment that ends with the line of the key.
  const auto comment = [](const std::string& text, const std::string& key) {
    const std::size_t at = text.find("\n" + key + ":");
    EXPECT_NE(at, std::string::npos) << key;
    std::size_t begin = at;
    for (std::size_t line = text.rfind('\n', begin - 1);
         text[text.find_first_not_of(' ', line + 1)] == '#'; line = text.rfind('\n', line - 1))
      begin = line;
    return text.substr(begin, at - begin);
  };
  EXPECT_THAT(comment(dut.site_yaml, "  friction"), HasSubstr("what is drawn"));
  EXPECT_THAT(comment(dut.scenario_yaml, "start"), HasSubstr("what is drawn wins"));
  EXPECT_THAT(comment(dut.scenario_yaml, "randomise"), HasSubstr("What is drawn wins"));
  EXPECT_THAT(dut.scenario_yaml,
              HasSubstr("`randomise` below draws its mass and battery's voltage"));
  robot.mass_kg = 0;
  EXPECT_THAT(MakeInitFiles(folder_ / "map.yaml", robot, folder_).scenario_yaml,
              HasSubstr("`randomise` below draws its battery's voltage"));
  EXPECT_THAT(comment(dut.scenario_yaml, "  min_coverage"), HasSubstr("lower this value"));
}

// Two rooms without a door: only one is driven. The larger it is, the less is missed.
TEST_F(InitFilesTest, FloorOutOfReachIsSaid) {
  using ::testing::IsEmpty;
  const auto warnings = [&](std::size_t wall) {
    std::vector<std::string> rows(42, "#" + std::string(60, '.') + "#");
    for (std::string& row : rows)
      if (wall > 0) row[wall] = '#';
    rows.front() = rows.back() = std::string(62, '#');
    return MakeInitFiles(SaveMap(rows, "[0, 0, 0]"), Disc(0.15), folder_).warnings;
  };
  EXPECT_THAT(warnings(0), IsEmpty()) << "seams and corners alone";
  EXPECT_THAT(warnings(5), IsEmpty()) << "a closet";
  for (const std::size_t wall : {20u, 30u, 45u}) {
    const double free_m2 = 40 * 59 * 0.01;
    const double room_m2 = 0.4 * static_cast<double>(std::max(wall - 1, 60 - wall));
    const auto said = warnings(wall);
    ASSERT_EQ(said.size(), 1u) << wall;
    double swept_m2 = 0, of_m2 = 0;
    ASSERT_EQ(std::sscanf(said.front().c_str(), "from the start the robot can sweep %lf of %lf m2",
                          &swept_m2, &of_m2),
              2)
        << said.front();
    EXPECT_NEAR(of_m2, free_m2, 0.1);
    EXPECT_LE(swept_m2, room_m2 + 0.1);
    EXPECT_GT(swept_m2, 0.95 * room_m2);
    EXPECT_THAT(said.front(), HasSubstr("change `start` in scenario.yaml"));
  }
}

// How often is answered from the first campaign on: something is drawn, and there is a gate.
TEST_F(InitFilesTest, AFirstCampaignDrawsAndIsJudged) {
  RobotSpec robot = Disc(0.15);
  const auto drawn = [&] {
    const InitFiles dut = MakeInitFiles(SaveMap(kTwoRooms, "[0, 0, 0]"), robot, folder_);
    std::vector<std::string> keys;
    const ConfigNode scenario = ParseYaml(dut.scenario_yaml, "scenario.yaml");
    EXPECT_NE(scenario.Find("gate"), nullptr);
    for (const auto& [key, value] : scenario.Find("randomise")->entries) keys.push_back(key);
    return keys;
  };
  using ::testing::Contains;
  using ::testing::IsSupersetOf;
  using ::testing::Not;
  EXPECT_THAT(drawn(), IsSupersetOf({"site.floor.friction", "start.x_m", "start.y_m",
                                     "start.yaw_deg", "estimator.start_error_x_m"}));
  EXPECT_THAT(drawn(), Not(Contains("robot.mass_kg"))) << "its model states none";
  robot.mass_kg = 8;
  robot.battery.voltage_v = 12;
  EXPECT_THAT(drawn(), IsSupersetOf({"robot.mass_kg", "battery.voltage_v"}));
}

TEST_F(InitFilesTest, TheScenarioIsNamedAfterTheMapAndNamesTheRobotAsItIsTold) {
  const InitFiles dut =
      MakeInitFiles(SaveMap(kTwoRooms, "[0, 0, 0]"), Disc(0.15), folder_, "../my bot.xml");
  const ConfigNode scenario = ParseYaml(dut.scenario_yaml, "scenario.yaml");
  EXPECT_EQ(scenario.Find("name")->scalar, folder_.filename().string());
  EXPECT_EQ(scenario.Find("robot")->scalar, "../my bot.xml");
}

// The commented examples are no decoration: without their '#' they read.
TEST_F(InitFilesTest, TheCommentedHazardsRead) {
  const InitFiles dut = MakeInitFiles(SaveMap(kTwoRooms, "[0, 0, 0]"), Disc(0.15), folder_);
  std::string text = dut.site_yaml;
  int examples = 0;
  for (std::size_t at = 0; (at = text.find("\n#  - {", at)) != std::string::npos; ++examples)
    text.erase(at + 1, 1);
  EXPECT_EQ(examples, 8);
  EXPECT_EQ(ReadSiteFile(Save("site.yaml", text)).map.hazards.size(), 8u);
}

TEST_F(InitFilesTest, NamesWithQuotesAndBlanksSurvive) {
  SaveMap(kTwoRooms, "[0, 0, 0]");
  fs::create_directory(folder_ / "a \"b\" #c");
  for (const char* file : {"map.yaml", "map.pgm"})
    fs::rename(folder_ / file, folder_ / "a \"b\" #c" / file);
  const InitFiles dut = MakeInitFiles(folder_ / "a \"b\" #c" / "map.yaml", Disc(0.15), folder_);
  EXPECT_EQ(ReadSiteFile(Save("site.yaml", dut.site_yaml)).map.name, "a \"b\" #c");
}

TEST_F(InitFilesTest, ARobotThatFitsNowhereIsRefusedWithTheWidestSpot) {
  const fs::path map = SaveMap(kTwoRooms, "[0, 0, 0]");
  EXPECT_THAT(Refusal([&] { MakeInitFiles(map, Disc(0.5), folder_); }),
              HasSubstr("map.yaml: the map has no place for a robot of radius 0.5 m"));
}

TEST_F(InitFilesTest, SpecksAndTurnedMapsAreNoMatter) {
  std::vector<std::string> rows(60, std::string(60, '?'));
  for (std::size_t i = 0; i < 60; i += 3) rows[i][(i * 7) % 60] = '.';
  for (std::size_t y = 20; y < 40; ++y)
    for (std::size_t x = 10; x < 50; ++x) rows[y][x] = '.';
  const fs::path map = SaveMap(rows, "[1, 2, 0.5]");
  const InitFiles dut = MakeInitFiles(map, Disc(0.2), folder_);
  const Site site = ReadSiteFile(Save("site.yaml", dut.site_yaml));
  const Pose2 start = ChooseStart(site.map, Disc(0.2));
  EXPECT_DOUBLE_EQ(start.yaw_rad, 0.5);
  const Cell c = site.map.frame.ToCell(start.p());
  EXPECT_TRUE(c.ix >= 10 && c.ix < 50 && c.iy >= 20 && c.iy < 40);
}

TEST_F(InitFilesTest, EverySharedMapHoldsAStart) {
  const fs::path maps = SharedFile("maps");
  if (!fs::exists(maps)) GTEST_SKIP() << "no " << maps << ": real maps are not shipped";
  for (const auto& entry : fs::directory_iterator(maps)) {
    const RobotSpec robot = Disc(0.25);
    const InitFiles dut = MakeInitFiles(entry.path() / "map.yaml", robot, folder_);
    const Site site = ReadSiteFile(Save("site.yaml", dut.site_yaml));
    const Pose2 start = ChooseStart(site.map, robot);
    const SweepArea area =
        ComputeSweepArea(site.map, robot.clear, robot.tool, robot.step_m, start.p());
    EXPECT_GT(area.area_m2(), 10) << entry.path();
    EXPECT_GE(ComputeClearance(site.map, robot.step_m).At(start.p()), 0.25) << entry.path();
  }
}

}  // namespace
}  // namespace floorproof

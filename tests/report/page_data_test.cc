// SPDX-License-Identifier: Apache-2.0
#include "report/page_data.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/own_folder.h"

namespace floorproof {
namespace {

HazardMap Floor(int width, int height) {
  HazardMap map;
  map.name = "floor";
  map.frame = {width, height, 0.1, {1, 2, 0.5}};
  map.occupancy = Grid<CellState>(width, height, CellState::kFree);
  return map;
}

TEST(MapData, CellsAreRunsFromTheTopRowOn) {
  HazardMap map = Floor(3, 2);
  map.occupancy(0, 1) = CellState::kOccupied;  // the top row's first
  map.occupancy(2, 0) = CellState::kUnknown;   // the last of all
  const PageJson data = MapData(map);
  EXPECT_EQ(data.at("cells").at("runs").dump(), "[1,1,0,4,2,1]");
  EXPECT_EQ(data.at("frame").at("yaw"), 0.5);
  EXPECT_DOUBLE_EQ(data.at("frame").at("width_m"), 0.3);
}

TEST(MapData, AWallOfALargeMapIsNotLost) {
  HazardMap map = Floor(4000, 4000);
  map.occupancy(2001, 1999) = CellState::kOccupied;
  const PageJson cells = MapData(map).at("cells");
  EXPECT_LE(cells.at("width"), 900);
  int walls = 0, all = 0;
  const auto& runs = cells.at("runs");
  for (std::size_t i = 0; i < runs.size(); i += 2) {
    if (runs[i] == 1) walls += runs[i + 1].get<int>();
    all += runs[i + 1].get<int>();
  }
  EXPECT_EQ(walls, 1);
  EXPECT_EQ(all, cells.at("width").get<int>() * cells.at("height").get<int>());
}

TEST(MapData, HazardsSayWhetherTheyAreKnown) {
  HazardMap map = Floor(10, 10);
  Hazard& plank = map.hazards.emplace_back();
  plank.id = "plank";
  plank.type = "step";
  plank.hazard_class = HazardClass::kLevelChange;
  plank.known = false;
  plank.footprint = {{{0, 0}, {1, 0}, {1, 1}}};
  plank.height_m = 0.04;
  const PageJson hazard = MapData(map).at("hazards").at(0);
  EXPECT_EQ(hazard.at("label"), "C3 step (not on the map)");
  EXPECT_EQ(hazard.at("colour"), "#c81446") << "as on the pictures";
  EXPECT_EQ(hazard.at("text"), "'plank' (step, 40 mm), on no map");
  EXPECT_EQ(hazard.at("polygons").dump(), "[[[0.0,0.0],[1.0,0.0],[1.0,1.0]]]");
}

TEST(VisitsData, HasTheFloorsFormAndMarksWhatIsOutOfReach) {
  Visits visits;
  visits.frame = {3, 2, 0.1, {1, 2, 0.5}};
  visits.passes = Grid<std::uint8_t>(3, 2, 1);
  visits.passes(0, 1) = Visits::kOutOfReach;
  visits.passes(2, 0) = 0;
  const PageJson data = VisitsData(visits);
  EXPECT_EQ(data.at("cells").at("runs").dump(), "[-1,1,1,4,0,1]");
  EXPECT_EQ(data.at("frame"), MapData(Floor(3, 2)).at("frame"));
}

TEST(RatesData, SaysOfHowManyAndHowSure) {
  VariantSummary variant;
  EXPECT_TRUE(RatesData(variant).is_null());
  variant.place_m = 0.25;
  variant.places = {{{1, 2}, {"", 3, 40, 0.075, 0.0157, 0.2039}}};
  EXPECT_EQ(RatesData(variant).dump(),
            R"({"cell_m":0.25,"places":[[1.0,2.0,3,40,0.0157,0.2039]]})");
}

TEST(SafetyData, IsOfTheMissionAsAWhole) {
  const std::string csv =
      "t_s,node,safety_state,level,machine_state,reason\n"
      "2.5,cover.drive,48,serious,normal,by its worst\n"
      "2.5,\"clean, twice\",48,serious,normal,by its worst\n"
      "9,\"clean, twice\",0,high,normal,\"over, and done\"\n";
  EXPECT_EQ(SafetyData(csv, "clean, twice").dump(),
            R"({"t_s":[0,2.5,9.0],"state":[0,48.0,0.0],"level":["high","serious","high"]})");
  EXPECT_EQ(SafetyData(csv, "").at("t_s").size(), 1u) << "a mission without a name is `mission`";
  EXPECT_TRUE(SafetyData("", "clean").is_null());
  EXPECT_TRUE(SafetyData(csv + "x,2\n", "clean, twice").is_null()) << "damaged";
  EXPECT_TRUE(SafetyData(csv.substr(0, csv.find("0,high")), "clean, twice").is_null()) << "cut";
}

std::string Trace(int rows) {
  std::string csv = "t_s,x_m,y_m,roll_rad,pitch_rad,vx_mps,vy_mps,cross_track_m,power_w,coverage\n";
  for (int i = 0; i < rows; ++i)
    csv += fmt::format("{:.2f},{:.3f},1,0,{},0.3,0.4,0.002,50,0.5\n", 0.02 * i, 0.01 * i,
                       i == rows / 2 ? 0.1 : 0);
  return csv;
}

TEST(TraceData, ColumnsHaveTheUnitsThatTheyName) {
  const PageJson columns = ReadTraceData(Trace(3)).columns;
  EXPECT_EQ(columns.at("speed_mps").dump(), "[0.5,0.5,0.5]");
  EXPECT_EQ(columns.at("cross_track_mm").dump(), "[2.0,2.0,2.0]");
  EXPECT_EQ(columns.at("coverage_percent").dump(), "[50.0,50.0,50.0]");
  EXPECT_NEAR(columns.at("tilt_deg").at(1), 0.1 * 180 / kPi, 1e-3);
}

TEST(TraceData, ALongTraceIsThinnedAndEndsWhereItEnded) {
  const TraceData data = ReadTraceData(Trace(60000));
  EXPECT_LE(data.columns.at("t_s").size(), 1600u);
  EXPECT_NEAR(data.columns.at("t_s").back(), 0.02 * 59999, 1e-6);
  EXPECT_LT(data.way.size(), 10u) << "a straight way needs few points";
}

TEST(TraceData, WhereTheRobotWasCarriedTheWayHasAGap) {
  const TraceData data = ReadTraceData("t_s,x_m,y_m\n0,0,0\n0.1,0.1,0\n0.2,5,5\n0.3,5.1,5\n");
  ASSERT_EQ(data.way.size(), 5u);
  EXPECT_TRUE(data.way.at(2).at(0).is_null());
}

TEST(TraceData, WhatIsNoTraceIsNone) {
  for (const char* text : {"", "a,b\n1,2\n", "t_s,x_m,y_m\n1,2\n", "t_s,x_m,y_m\n1,2,nan\n",
                           "t_s,x_m,y_m\n", "t_s,x_m,y_m\nx,1,1\n"})
    EXPECT_TRUE(ReadTraceData(text).columns.is_null()) << text;
}

class FilmTimes : public OwnFolderTest {};

// PageText would write what the file holds into the page, level by level.
TEST_F(FilmTimes, OfANestedFileAreRefused) {
  PageJson drive = PageJson::object();
  std::ofstream(folder_ / "video.json") << R"({"fps": 15, "t_s": [0, 0.1]})";
  AddFilmTimes(folder_, drive);
  EXPECT_EQ(PageText(drive), R"({"film_fps":15.0,"film_t_s":[0.0,0.1]})");
  std::ofstream(folder_ / "video.json") << R"({"fps": 15, "t_s": )" << std::string(1'000'000, '[')
                                        << std::string(1'000'000, ']') << "}";
  EXPECT_THROW(AddFilmTimes(folder_, drive), InputError);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "report/drive_marks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "media/media.h"
#include "report/pictures.h"
#include "run/episode/execute.h"
#include "run/scenario/scenario_file.h"
#include "tests/places.h"

namespace floorproof {
namespace {

std::vector<TraceRow> Trace(const std::vector<Vec2>& places, double period_s = 0.02) {
  std::vector<TraceRow> trace;
  for (const Vec2& p : places) {
    TraceRow& row = trace.emplace_back();
    row = {};
    row.t_s = period_s * static_cast<double>(trace.size());
    row.x_m = p.x();
    row.y_m = p.y();
  }
  return trace;
}

double Off(const std::vector<std::vector<Vec2>>& way, const Vec2& p) {
  double least = 1e9;
  for (const auto& stretch : way)
    for (std::size_t i = 1; i < stretch.size(); ++i)
      least = std::min(least, DistanceToSegment(stretch[i - 1], stretch[i], p));
  return least;
}

TEST(DriveMarks, TheWayIsWithinMillimetresInFewPoints) {
  std::vector<Vec2> places;
  for (int i = 0; i <= 400; ++i) places.emplace_back(0.01 * i, 2);
  for (int i = 0; i <= 600; ++i)
    places.emplace_back(4 + std::sin(0.01 * i), 3 - std::cos(0.01 * i));
  const auto dut = WayDriven(Trace(places));
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_LT(dut[0].size(), places.size() / 8);
  EXPECT_EQ(dut[0].front(), places.front());
  EXPECT_EQ(dut[0].back(), places.back());
  for (const Vec2& p : places) EXPECT_LT(Off(dut, p), 0.006);
}

TEST(DriveMarks, BeingCarriedIsNoWay) {
  std::vector<Vec2> places;
  for (int i = 0; i <= 100; ++i) places.emplace_back(0.01 * i, 0);
  for (int i = 0; i <= 100; ++i) places.emplace_back(3 + 0.01 * i, 1);
  const auto dut = WayDriven(Trace(places));
  ASSERT_EQ(dut.size(), 2u);
  EXPECT_EQ(dut[0].back(), Vec2(1, 0));
  EXPECT_EQ(dut[1].front(), Vec2(3, 1));
  EXPECT_GT(Off(dut, {2, 0.5}), 0.9);
  EXPECT_TRUE(WayDriven({}).empty());
  EXPECT_EQ(WayDriven(Trace({{1, 1}})).size(), 1u);
}

// From cell to cell, or in a trace of few rows.
TEST(DriveMarks, FarApartInALongTimeIsDriven) {
  std::vector<Vec2> places;
  for (int i = 0; i <= 10; ++i) places.emplace_back(0.5 * i, 0);
  EXPECT_EQ(WayDriven(Trace(places, 2)).size(), 1u);
  EXPECT_EQ(WayDriven(Trace(places)).size(), places.size());
}

TEST(DriveMarks, NumbersAreThePlacesInTheList) {
  std::vector<Event> events(3);
  events[1].mode = FailureMode::kRollOver;
  events[1].kind = "high_centred";
  events[1].t_s = 12.34;
  events[1].x_m = 4;
  const auto dut = ListedFailures(events);
  ASSERT_EQ(dut.size(), 3u);
  EXPECT_EQ(dut[0].number, "1");
  EXPECT_EQ(dut[1].number, "2");
  EXPECT_EQ(dut[1].label, "roll over (high centred), 12.3 s");
  EXPECT_EQ(dut[1].p_W, Vec2(4, 0));
}

TEST(DriveMarks, EveryMapOfADriveHasItsFailures) {
  Scenario scenario = ReadScenario(SourceFile("models/scenarios/fig1_chair_legs.yaml"),
                                   {{"risk", "{}"}, {"mapper", "{}"}});
  Execution out = Execute(scenario, nullptr);
  ASSERT_EQ(out.record.events.size(), 1u);
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "drive_marks_maps";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const auto marked = [&] {  // by map
    WriteHeatMaps(scenario, out.plan, out.record, folder, {.quiet = true});
    std::vector<std::pair<std::string, int>> rims;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with("heatmap_")) continue;
      const Image image = ReadImage(entry.path());
      int n = 0;
      for (std::size_t i = 0; i + 2 < image.data.size(); i += 3)
        n += image.data[i] == 250 && image.data[i + 1] == 215 && image.data[i + 2] == 40;
      rims.emplace_back(name, n);
    }
    return rims;
  };
  const auto with = marked();
  EXPECT_GE(with.size(), 7u);
  for (const auto& [name, n] : with) EXPECT_GT(n, 60) << name;  // two: the map's and the legend's
  out.record.events.clear();
  for (const auto& [name, n] : marked()) EXPECT_LT(n, 20) << name;
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace floorproof

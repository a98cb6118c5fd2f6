// SPDX-License-Identifier: Apache-2.0
// What a drive over an unknown floor leaves in plots, pictures and films says what its record says.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/result_folder.h"
#include "report/cell_picture.h"
#include "report/coverage_plot.h"
#include "report/drive_and_film.h"
#include "report/replay.h"
#include "report/swept_again.h"
#include "run/episode/execute.h"
#include "run/episode/tool_meter.h"
#include "run/scenario/scenario_file.h"
#include "tests/own_folder.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

class OnlinePictures : public OwnFolderTest {
 protected:
  OnlinePictures() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }

  // A random walk over cells, until nine in ten are covered.
  static std::string Text(const std::string& plan = "random_walk") {
    return "scenario: 1\nname: hall\nsite: {site: 1, grid: {cell_m: 0.5, rows: \""
           "############\\n#..........#\\n#..###.....#\\n#..#.#.....#\\n#..###.....#\\n"
           "#..........#\\n############\\n\"}, start: {x_m: 0.75, y_m: 0.75, yaw_deg: 0}}\n"
           "robot: beluga\nplan: {planner: " +
           plan + ", radius_m: 1}\ndrive: cells\nsuccess: {stop_at_coverage: 0.9}\n";
  }
  Scenario Read(const std::string& text, const std::vector<Override>& overrides = {}) const {
    std::ofstream(folder_ / "s.yaml") << text;
    return ReadScenario(folder_ / "s.yaml", overrides);
  }
  static std::string Bytes(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(OnlinePictures, TheCurvesEndAtTheMetrics) {
  Scenario s = Read(Text());
  const EpisodeRecord record = Execute(s).record;
  const Metrics& m = record.metrics;
  ASSERT_GT(m.revisited, 0.1);
  const Chart dut = CoverageChart("hall", record);
  ASSERT_EQ(dut.panels.size(), 2u);
  const double ends[] = {m.duration_s, m.path_length_m};
  for (std::size_t i = 0; i < 2; ++i) {
    const ChartPanel& panel = dut.panels[i];
    ASSERT_EQ(panel.series.size(), 2u);
    for (const ChartSeries& series : panel.series) {
      EXPECT_EQ(series.points.back().x, ends[i]);
      for (std::size_t k = 1; k < series.points.size(); ++k) {
        EXPECT_GE(series.points[k].x, series.points[k - 1].x);
        EXPECT_GE(series.points[k].y, series.points[k - 1].y - 1e-4) << "in percent, from a float";
      }
    }
    EXPECT_EQ(panel.series[0].points.back().y, 100 * m.coverage);
    EXPECT_EQ(panel.series[1].points.back().y, 100 * m.revisited);
    EXPECT_GE(panel.x_ticks.back(), 0.9 * ends[i]);
  }
}

// From cell to cell the way is that of the metric, to the bit of its sum.
TEST_F(OnlinePictures, OnCellsTheWayIsExact) {
  Scenario s = Read(Text(), {{"success.stop_at_coverage", "0.3"}});
  const EpisodeRecord record = Execute(s).record;
  const ChartSeries dut = CoverageChart("hall", record).panels[1].series[0];
  ASSERT_EQ(dut.points.size(), record.trace.size() + 1) << "a point each, and the end";
  double way_m = 0;
  for (std::size_t i = 1; i < record.trace.size(); ++i) {
    way_m += std::hypot(record.trace[i].x_m - record.trace[i - 1].x_m,
                        record.trace[i].y_m - record.trace[i - 1].y_m);
    EXPECT_NEAR(dut.points[i].x, way_m, 1e-9);
  }
  EXPECT_NEAR(way_m, record.metrics.path_length_m, 1e-9);
}

TEST_F(OnlinePictures, ThePictureHasTheRecordsCells) {
  Scenario s = Read(Text());
  const EpisodeRecord record = Execute(s).record;
  const auto counts = CountProperties(record);
  const HeatValues dut = CellProperties(s.world.site.map, record);
  std::array<std::int64_t, kNumCellProperties> drawn{};
  for (const float v : dut.values.cells)
    if (std::isfinite(v)) ++drawn[static_cast<std::size_t>(v)];
  const auto of = [](const auto& all, CellProperty p) { return all[static_cast<std::size_t>(p)]; };
  const auto lost = static_cast<std::size_t>(CellProperty::kOutOfReach);
  EXPECT_EQ(drawn[lost], 1) << "the one that is walled in";
  drawn[lost] = 0;
  EXPECT_EQ(drawn, counts);
  std::int64_t all = 0;
  for (const auto n : counts) all += n;
  const auto share = [&](std::int64_t n) {
    return static_cast<double>(n) / static_cast<double>(all);
  };
  EXPECT_NEAR(share(all - of(counts, CellProperty::kNotCovered)), record.metrics.coverage, 1e-12);
  EXPECT_NEAR(share(of(counts, CellProperty::kTwice) + of(counts, CellProperty::kMore)),
              record.metrics.revisited, 1e-12);
  EXPECT_GT(of(counts, CellProperty::kMore), 0);
}

TEST_F(OnlinePictures, ADriveOverCellsIsFilmedWithoutPhysicsAndAgainTheSame) {
  Scenario s = Read(Text(), {{"video.width", "320"},
                             {"video.height", "180"},
                             {"video.fps", "10"},
                             {"video.max_frames", "60"}});
  const fs::path out = folder_ / "out";
  fs::create_directories(out);
  const DriveResult driven = DriveAndFilm(s, out, {.video = true}, {.quiet = true});
  EXPECT_FALSE(driven.not_written);
  for (const char* name :
       {"video.mp4", "frame_start.png", "frame_end.png", "heatmap_cells.png", "plot_coverage.png"})
    EXPECT_GT(Bytes(out / name).size(), 500u) << name;
  EXPECT_FALSE(fs::exists(out / "plot_errors.png")) << "an ideal robot has none";
  const std::string film = Bytes(out / "video.mp4");
  fs::remove(out / "video.mp4");
  ReplayRun(out, {}, Trust::kNone, true, {.quiet = true});
  EXPECT_EQ(Bytes(out / "video.mp4"), film);
}

// A tool of a robot that drives a lane twice and half of a third time.
TEST_F(OnlinePictures, WhatIsSweptAgainIsPaintedWhereAndWhenItIs) {
  const Scenario s = Read(Text());
  const RobotSpec& robot = s.world.robot.spec;
  SweepArea area;
  area.frame = {80, 40, 0.05, {1, 2, 0.3}};
  area.sweepable = Grid<std::uint8_t>(80, 40, 1);
  area.sweepable_cells = 80 * 40;
  EpisodeRecord record;
  record.passes_frame = area.frame;
  record.sweepable = area.sweepable;
  ToolMeter meter(area, robot);
  for (int i = 0; i <= 300; ++i) {
    const int k = i % 200;
    const double along_m = 0.5 + 0.03 * (k <= 100 ? k : 200 - k);
    const Vec2 p_W = area.frame.X_WG * Vec2(along_m, 1);
    TraceRow& row = record.trace.emplace_back();
    row = {};
    row.t_s = i;
    row.x_m = p_W.x();
    row.y_m = p_W.y();
    row.shape = robot.shape;
    meter.Add({p_W.x(), p_W.y(), 0});
  }
  record.passes = meter.swept().passes();
  const auto dut = SweptAgainPatches(record, robot);
  ASSERT_FALSE(dut.empty());
  double painted_m2 = 0, last_s = 0;
  for (const FloorPatch& patch : dut) {
    painted_m2 += (patch.b_W - patch.a_W).norm() * patch.width_m;
    EXPECT_GE(patch.t_s, last_s);
    EXPECT_GT(patch.t_s, 100) << "on the way back";
    last_s = patch.t_s;
    const Vec2 middle = area.frame.X_WG.Inverse() * Vec2(0.5 * (patch.a_W + patch.b_W));
    EXPECT_NEAR(middle.y(), 1, 0.5 * s.world.robot.spec.circumscribed_radius_m + 0.2);
  }
  const double again_m2 = meter.swept().revisited() * area.area_m2();
  EXPECT_GT(again_m2, 0.3);
  EXPECT_NEAR(painted_m2, again_m2, 1e-9) << "all of it, once";
  EXPECT_LT(dut.size(), 100u) << "in few rectangles";
}

// Of planners that know the floor there are none of these.
TEST_F(OnlinePictures, OnlyUnknownFloorsAreShownSo) {
  std::string text = Text("boustrophedon");
  text.replace(text.find(", radius_m: 1"), 13, "");
  text.replace(text.find("drive: cells"), 12, "drive: physics");
  text += "time_limit_s: 2\n";
  Scenario s = Read(text);
  DriveAndFilm(s, folder_ / "out", {}, {.quiet = true});
  EXPECT_TRUE(fs::exists(folder_ / "out" / "heatmap_visits.png"));
  EXPECT_FALSE(fs::exists(folder_ / "out" / "heatmap_cells.png"));
  EXPECT_FALSE(fs::exists(folder_ / "out" / "plot_coverage.png"));
}

}  // namespace
}  // namespace floorproof

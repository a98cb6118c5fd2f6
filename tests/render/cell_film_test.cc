// SPDX-License-Identifier: Apache-2.0
// Films of drives from cell to cell: what stands in their pictures is what was driven.
#include "render/cell_film.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "render/cell_stage.h"
#include "tests/render/hall.h"

namespace floorproof {
namespace {

constexpr double kCell_m = 0.5;

std::string Bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A hall of 12 x 8 cells whose lowest free row is driven to and fro and to again: its cells are
// visited once, twice or three times. One cell beside the way is out of reach.
struct Drive {
  Drive() : map(Hall(12, 8, kCell_m)), in_reach(12, 8), visits(12, 8) {
    for (std::size_t i = 0; i < in_reach.cells.size(); ++i)
      in_reach.cells[i] = map.occupancy.cells[i] == CellState::kFree;
    in_reach(kLost) = 0;
    Go(1, 9);
    Go(8, 4);
    Go(5, 7);
    script.map = &map;
    script.in_reach = &in_reach;
    script.visits = &visits;
    script.window_m = 1;
    script.title = "a hall";
  }
  void Go(int from, int to) {
    for (int ix = from; ix != to + (from < to ? 1 : -1); ix += from < to ? 1 : -1) {
      ++visits(ix, 1);
      script.steps.push_back(
          {2.0 * static_cast<double>(script.steps.size()), map.frame.Center(ix, 1), 0.01, 0.005});
    }
  }

  static constexpr Cell kLost = {10, 6};
  HazardMap map;
  Grid<std::uint8_t> in_reach, visits;
  CellFilmScript script;
};

// At a corner of a cell, where neither the robot nor, in these places, its window lies.
Rgb ColourOfCell(const Image& image, const CellStage& stage, const HazardMap& map, Cell c) {
  const cv::Point2d p =
      stage.floor().frame().Pixel(map.frame.Center(c) - Vec2(0.4 * kCell_m, 0.4 * kCell_m));
  return ColourAt(image, {stage.floor_px().ix + p.x, stage.floor_px().iy + p.y});
}

TEST(CellFilm, TheLastPictureShowsEachCellAsItWasLeft) {
  const Drive drive;
  CellStage dut(drive.script, 960, 540);
  const double end_s = drive.script.steps.back().t_s;
  const Image& image = dut.Draw({end_s, 1}, true);
  std::array<std::int64_t, kNumCellProperties> counts{};
  for (int iy = 0; iy < 8; ++iy)
    for (int ix = 0; ix < 12; ++ix) {
      const Cell c = {ix, iy};
      if (drive.in_reach(c)) ++counts[static_cast<std::size_t>(PropertyOf(drive.visits(c)))];
      const bool driven = iy == 1 && ix >= 1 && ix <= 9;
      const bool under_ring = std::abs(ix - 7) <= 2 && iy <= 3;
      if (driven && !under_ring) {
        EXPECT_EQ(ColourOfCell(image, dut, drive.map, c), ColourOf(PropertyOf(drive.visits(c))))
            << ix;
      }
    }
  EXPECT_EQ(dut.floor().counts(), counts);
  EXPECT_GT(counts[static_cast<std::size_t>(CellProperty::kTwice)], 0);
  EXPECT_GT(counts[static_cast<std::size_t>(CellProperty::kMore)], 0);
}

// A step at a time shows what all of them at once do.
TEST(CellFilm, PaintingWhatChangesIsPaintingAll) {
  const Drive drive;
  CellStage slowly(drive.script, 640, 360), at_once(drive.script, 640, 360);
  const double end_s = drive.script.steps.back().t_s;
  for (double t_s = 0; t_s < end_s; t_s += 0.7) slowly.Draw({t_s, 1}, false);
  EXPECT_EQ(slowly.Draw({end_s, 1}, true).data, at_once.Draw({end_s, 1}, true).data);
}

TEST(CellFilm, ACellChangesWhenTheRobotComesToItAndIsSeenBefore) {
  const Drive drive;
  CellStage dut(drive.script, 960, 540);
  const auto colour_at = [&](double t_s, Cell c) {
    return ColourOfCell(dut.Draw({t_s, 1}, false), dut, drive.map, c);
  };
  const Cell far = {9, 1};  // reached at 16 s; within 1 m from 12 s on
  const Rgb unseen = colour_at(0, far);
  EXPECT_NE(unseen, ColourOf(CellProperty::kNotCovered)) << "under the veil";
  EXPECT_EQ(colour_at(11.9, far), unseen);
  EXPECT_EQ(colour_at(15.9, far), ColourOf(CellProperty::kNotCovered));
  EXPECT_EQ(dut.floor().visits(far), 0);
  dut.Draw({16, 1}, false);
  EXPECT_EQ(dut.floor().visits(far), 1);
  EXPECT_EQ(colour_at(26, far), ColourOf(CellProperty::kOnce)) << "the robot has gone on";
}

// What lay within its window without being looked at stays under the veil.
TEST(CellFilm, WhatTheRobotDoesNotKnowItHasNotSeen) {
  Drive drive;
  KnownMap known(drive.map.frame);
  drive.script.known = &known;
  CellStage dut(drive.script, 960, 540);
  const Rgb without = ColourOfCell(dut.Draw({8, 1}, false), dut, drive.map, {3, 1});
  known.Add(3, 1, -4, 4);
  CellStage with(drive.script, 960, 540);
  EXPECT_EQ(ColourOfCell(with.Draw({8, 1}, false), with, drive.map, {3, 1}),
            ColourOf(CellProperty::kOnce));
  EXPECT_NE(without, ColourOf(CellProperty::kOnce));
}

// Its pixels lie as far from the robot as it reaches.
TEST(CellFilm, TheWindowIsAroundTheRobot) {
  Drive drive;
  CellStage dut(drive.script, 960, 540);
  const Image image = dut.Draw({16, 1}, false);
  const PanelFrame& frame = dut.floor().frame();
  const cv::Point2d middle = frame.Pixel(drive.map.frame.Center(9, 1));
  const double radius_px = drive.script.window_m * frame.px_per_m();
  int on_ring = 0;
  for (int y = 0; y < dut.floor().image().height; ++y)
    for (int x = 0; x < dut.floor().image().width; ++x) {
      if (!Is(image, dut.floor_px().ix + x, dut.floor_px().iy + y, kWindowBlue)) continue;
      const double d = std::hypot(x + 0.5 - middle.x, y + 0.5 - middle.y);
      if (d < 0.4 * kCell_m * frame.px_per_m()) continue;  // the robot
      EXPECT_NEAR(d, radius_px, 2.5);
      ++on_ring;
    }
  EXPECT_GT(on_ring, 100);
}

// Wherever the picture is too small for all of it.
TEST(CellFilm, AnySizeHasAPicture) {
  Drive drive;
  drive.script.closing = Banner{Banner::Tone::kSuccess, "SUCCESS", "covered"};
  for (const auto& [width, height] : {std::pair(64, 64), {320, 180}, {1920, 1080}, {240, 960}}) {
    CellStage dut(drive.script, width, height);
    const Image image = dut.Draw({30, 1}, true);
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    if (height >= 180) {
      EXPECT_GT(Count(image, ColourOf(CellProperty::kOnce)), 0) << width;
    }
  }
}

TEST(CellFilm, HasTheFramesOfItsScheduleAndTheSameBytesTwice) {
  const Drive drive;
  const TestFolder folder;
  ReelOptions options;
  options.width = 320;
  options.height = 240;
  options.pace.fps = 20;
  options.pace.speed_up = 10;
  options.pace.max_frames = 100;
  options.stills = folder.path();
  const double end_s = drive.script.steps.back().t_s;
  const FilmResult film = WriteCellFilm(drive.script, options, folder / "a.mp4");
  EXPECT_EQ(film.frames, static_cast<int>(ScheduleFilm(0, end_s, {}, options.pace).size()));
  EXPECT_NEAR(film.frames, end_s / 10 * 20 + 25 + 1, 2) << "the last one is held";
  const Image last = ReadImage(folder / "frame_end.png");
  EXPECT_EQ(last.data, CellStage(drive.script, 320, 240).Draw({end_s, 10}, true).data);
  EXPECT_NE(ReadImage(folder / "frame_start.png").data, last.data);
  EXPECT_FALSE(std::filesystem::exists(folder / "frame_failure.png"));
  WriteCellFilm(drive.script, options, folder / "b.mp4");
  EXPECT_EQ(Bytes(folder / "a.mp4"), Bytes(folder / "b.mp4"));
  EXPECT_GT(Bytes(folder / "a.mp4").size(), 2000u);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What lies over a heat map's cells: numbers, the plan, hazards.
#include <algorithm>
#include <string>

#include "tests/render/hall.h"

namespace floorproof {
namespace {

// The panel of a hall of w x h cells begins 24 px from the left and 64 px from the top.
struct PanelPlace {
  PanelPlace(const Image& image, int w) : cell_px((image.width - 250 - 48) / w) {}
  int Left(int ix) const { return 24 + cell_px * ix; }
  int cell_px;
};

int Changed(const Image& a, const Image& b, int x0, int y0, int x1, int y1) {
  int n = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) n += Difference(a, b, x, y) > 0;
  return n;
}

TEST(HeatMapMarks, NumbersStandInTheirCells) {
  const HazardMap map = Hall(12, 12, 0.5);
  HeatValues values = Values(map, 2);
  values.values(5, 5) = HeatValues::kNone;
  HeatMapOptions options;
  const Image plain = DrawHeatMap(map, &values, options);
  options.numbers = true;
  const Image dut = DrawHeatMap(map, &values, options);
  const PanelPlace place(dut, 12);
  for (int row = 1; row < 11; ++row)
    for (int column = 1; column < 11; ++column) {
      const int x = place.Left(column), y = 64 + place.cell_px * row;
      const bool empty = column == 5 && row == 12 - 1 - 5;
      EXPECT_EQ(Changed(dut, plain, x, y, x + place.cell_px, y + place.cell_px) > 5, !empty)
          << column << ", " << row;
    }
}

TEST(HeatMapMarks, NumbersAreLeftOutWhereCellsAreTooSmall) {
  for (const auto& [cells, value] : {std::pair(80, 2.0f), {30, 123456.0f}}) {
    const HazardMap map = Hall(cells, cells, 0.1);
    const HeatValues values = Values(map, value);
    HeatMapOptions options;
    const Image plain = DrawHeatMap(map, &values, options);
    options.numbers = true;
    EXPECT_EQ(DrawHeatMap(map, &values, options).data, plain.data) << cells;
  }
}

// What lies far off changes nothing that shows, and takes no time.
TEST(HeatMapMarks, WhatLiesFarOffIsCut) {
  const auto drawn = [](bool known, double far_m) {
    HazardMap map = Hall(12, 12, 0.5);
    Hazard hazard;
    hazard.type = "step";
    hazard.known = known;
    hazard.footprint = {{{far_m, 2}, {3, 2}, {3, 2.5}, {far_m, 2.5}}};
    map.hazards.push_back(hazard);
    HeatMapOptions options;
    options.points = {{{far_m, 1e9}, "stuck"}, {{4, 4}, "stuck"}};
    return DrawHeatMap(map, nullptr, options);
  };
  EXPECT_EQ(drawn(true, -808564).data, drawn(true, -100).data);
  for (const double far_m : {-808564.0, 808564.0, 1e15}) {
    const Image dashed = drawn(false, far_m), outlined = drawn(true, far_m);
    EXPECT_GT(Changed(dashed, outlined, 24, 64, dashed.width - 300, dashed.height), 0) << far_m;
  }
}

TEST(HeatMapMarks, ANumberKeepsOffTheWay) {
  const HazardMap map = Hall(12, 12, 0.5);
  const HeatValues values = Values(map, 2);
  const double low = 2.5, cell = 0.5;  // cell (5, 5)
  for (const bool above : {true, false}) {
    const double y = low + cell * (above ? 0.85 : 0.15);
    const Path path = Straight({{0.5, y}, {5.5, y}});
    HeatMapOptions options;
    options.plan = &path;
    const Image plain = DrawHeatMap(map, &values, options);
    options.numbers = true;
    const Image dut = DrawHeatMap(map, &values, options);
    const PanelPlace place(dut, 12);
    const int x = place.Left(5), top = 64 + place.cell_px * 6, half = place.cell_px / 2;
    const int up = Changed(dut, plain, x, top, x + 2 * half, top + half),
              down = Changed(dut, plain, x, top + half, x + 2 * half, top + 2 * half);
    EXPECT_GT(above ? down : up, 5);
    EXPECT_EQ(above ? up : down, 0);
  }
}

constexpr Rgb kStart = {20, 150, 90}, kEnd = {190, 20, 120};

TEST(HeatMapMarks, AClosedPlansStartAndEndBothShow) {
  HazardMap map = Hall(12, 12, 0.5);
  map.start = Pose2{1, 1, 0};
  const Path open = Straight({{1, 1}, {5, 1}, {5, 5}}), closed = Straight({{1, 1}, {5, 1}, {1, 1}});
  for (const Path* path : {&open, &closed}) {
    HeatMapOptions options;
    options.plan = path;
    const Image dut = DrawHeatMap(map, nullptr, options);
    // Mark and legend alike.
    EXPECT_GT(Count(dut, kStart), 100);
    EXPECT_GT(Count(dut, kEnd), 150);
  }
}

TEST(HeatMapMarks, LinesOfADensePlanAreThin) {
  const HazardMap map = Hall(100, 100, 0.1);
  Path lanes = Straight({{1, 1}, {9, 1}});
  const auto across = [&](const Path& path) {  // px, of its first line
    HeatMapOptions options;
    options.plan = &path;
    const Image dut = DrawHeatMap(map, nullptr, options);
    const int bottom = 64 + 11 * 100, y = bottom - 11 * 10, x = 24 + 11 * 50;
    int n = 0;
    for (int dy = -4; dy <= 4; ++dy) n += Luma(dut, x, y + dy) < 150;
    return n;
  };
  const int sparse = across(lanes);
  for (double y = 1.1; y < 9; y += 0.1)
    for (const double x : {1.0, 9.0}) lanes.emplace_back().p_W = {x, y};
  EXPECT_GE(sparse, 2);
  EXPECT_LT(across(lanes), sparse);
}

Hazard Patch(const std::string& type, HazardClass hazard_class, double x) {
  Hazard hazard;
  hazard.id = hazard.type = type;
  hazard.hazard_class = hazard_class;
  hazard.footprint = {Rectangle({x, 2}, {x + 1, 3})};
  return hazard;
}

TEST(HeatMapMarks, AHazardsColourIsItsClasssWhateverElseThereIs) {
  HazardMap map = Hall(80, 50, 0.1);
  const Hazard step = Patch("step", HazardClass::kLevelChange, 1),
               rough = Patch("rough", HazardClass::kTerrain, 3),
               groove = Patch("groove", HazardClass::kTerrain, 5);
  const auto colours = [&](const std::vector<Hazard>& hazards) {
    map.hazards = hazards;
    const Image dut = DrawHeatMap(map, nullptr, {});
    std::vector<Rgb> seen;  // at the middle of the left border of each place
    for (const double x : {1.0, 3.0, 5.0}) {
      const std::uint8_t* p = Pixel(dut, 24 + static_cast<int>(x * 140), 64 + 140 * 5 / 2);
      seen.push_back({p[0], p[1], p[2]});
    }
    return seen;
  };
  const auto all = colours({rough, step, groove});
  EXPECT_EQ(colours({step})[0], all[0]);
  EXPECT_EQ(colours({rough})[1], all[1]);
  EXPECT_EQ(colours({groove})[2], all[1]) << "alone it is the first of its class";
  EXPECT_NE(all[0], all[1]);
  EXPECT_NE(all[1], all[2]) << "types of a class are told apart";
}

TEST(HeatMapMarks, ClassesOfCellsAreToldApart) {
  std::vector<Rgb> colours;
  for (const auto c : {HazardClass::kBlindObject, HazardClass::kGlass, HazardClass::kLevelChange,
                       HazardClass::kTerrain}) {
    const HeatCategory dut = CellsOf(c);
    EXPECT_EQ(dut.label.substr(0, 2), "C" + std::to_string(static_cast<int>(c) + 1));
    EXPECT_EQ(std::ranges::count(colours, dut.colour), 0) << dut.label;
    colours.push_back(dut.colour);
  }
}

}  // namespace
}  // namespace floorproof

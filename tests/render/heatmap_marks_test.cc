// SPDX-License-Identifier: Apache-2.0
// What lies over a heat map's cells: numbers, the plan, hazards.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "render/cell_property.h"
#include "tests/render/hall.h"

namespace floorproof {
namespace {

// A square cell's place in the picture.
struct CellPlace {
  CellPlace(const HazardMap& map, const HeatMapOptions& options, int ix, int iy) {
    const double cell_m = map.frame.cell_m;
    const Vec2 upper = PixelOf(map, options, cell_m * Vec2(ix, iy + 1)),
               lower = PixelOf(map, options, cell_m * Vec2(ix + 1, iy));
    x = static_cast<int>(upper.x());
    y = static_cast<int>(upper.y());
    size = static_cast<int>(lower.x()) - x;
  }
  int x, y, size;
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
  for (int iy = 1; iy < 11; ++iy)
    for (int ix = 1; ix < 11; ++ix) {
      const CellPlace at(map, options, ix, iy);
      const bool empty = ix == 5 && iy == 5;
      EXPECT_EQ(Changed(dut, plain, at.x, at.y, at.x + at.size, at.y + at.size) > 5, !empty)
          << ix << ", " << iy;
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
    EXPECT_GT(Changed(dashed, outlined, 80, 76, dashed.width - 300, dashed.height), 0) << far_m;
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
    const CellPlace at(map, options, 5, 5);
    const int x = at.x, top = at.y, half = at.size / 2;
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
    const Vec2 at = PixelOf(map, options, {5, 1});
    const int x = static_cast<int>(at.x()), y = static_cast<int>(at.y());
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
      seen.push_back(ColourAt(dut, PixelOf(map, {}, {x, 2.5})));
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

constexpr Rgb kWall = {52, 60, 72}, kFree = {238, 240, 243}, kPlan = {0, 114, 178},
              kDriven = {240, 136, 0};

TEST(HeatMapMarks, WhatWasDrivenLiesOverThePlanWhichShowsBesideIt) {
  const HazardMap map = Hall(40, 30, 0.1);
  const Path plan = Straight({{0.5, 1}, {3.5, 1}});
  HeatMapOptions options;
  options.plan = &plan;
  options.driven = {{{0.5, 1}, {2, 1}, {2, 2}}, {{3, 2}, {3, 2.5}}};
  const Image dut = DrawHeatMap(map, nullptr, options);
  const auto at = [&](double x_m, double y_m) { return PixelOf(map, options, {x_m, y_m}); };
  const auto near = [&](const Vec2& p, const Rgb& colour) {
    int n = 0;
    for (int dy = -4; dy <= 4; ++dy) n += ColourAt(dut, p + Vec2(0, dy)) == colour;
    return n;
  };
  EXPECT_GT(near(at(1.2, 1), kDriven), 0);
  EXPECT_GT(near(at(1.2, 1), kPlan), 0) << "beside it";
  EXPECT_EQ(near(at(2.8, 1), kDriven), 0) << "not driven";
  EXPECT_GT(near(at(2.8, 1), kPlan), 0);
  EXPECT_EQ(ColourAt(dut, at(2, 1.5)), kDriven) << "off the plan";
  EXPECT_EQ(ColourAt(dut, at(2.5, 2)), kFree) << "carried, not driven";
  EXPECT_EQ(ColourAt(dut, at(0.05, 1)), kWall);
}

TEST(HeatMapMarks, ARingHasItsRadiusAndALineInTheLegend) {
  const HazardMap map = Hall(80, 60, 0.1);
  HeatMapOptions options;
  options.rings = {{{3.5, 2.5}, 1.2, "its window", kWindowBlue}};
  const Image dut = DrawHeatMap(map, nullptr, options);
  const Vec2 middle = PixelOf(map, options, {3.5, 2.5});
  const double px_per_m = (PixelOf(map, options, {4.5, 2.5}) - middle).x();
  int on_ring = 0, in_dot = 0, in_legend = 0;
  for (int y = 0; y < dut.height; ++y)
    for (int x = 0; x < dut.width; ++x) {
      if (!Is(dut, x, y, kWindowBlue)) continue;
      const double d_m = (Vec2(x + 0.5, y + 0.5) - middle).norm() / px_per_m;
      if (d_m < 0.1)
        ++in_dot;
      else if (x > PixelOf(map, options, {8, 0}).x())
        ++in_legend;
      else {
        ++on_ring;
        EXPECT_NEAR(d_m, 1.2, 0.02);
      }
    }
  EXPECT_GT(on_ring, 2 * kPi * 1.2 * px_per_m);
  EXPECT_GT(in_dot, 30);
  EXPECT_GT(in_legend, 10);
}

TEST(HeatMapMarks, OfARingBeyondTheMapTheRestIsShown) {
  const HazardMap map = Hall(40, 30, 0.1);
  HeatMapOptions options;
  options.rings = {{{0.5, 0.5}, 1, "its window", kWindowBlue}};
  const Image dut = DrawHeatMap(map, nullptr, options);
  const int left = static_cast<int>(PixelOf(map, options, {0, 0}).x());
  int beyond = 0;
  for (int y = 0; y < dut.height; ++y)
    for (int x = 0; x < left; ++x) beyond += Is(dut, x, y, kWindowBlue);
  EXPECT_EQ(beyond, 0);
  EXPECT_GT(Count(dut, kWindowBlue), 100);
}

// A colour as an eye sees it that lacks a kind of cone (Machado, Oliveira and Fernandes, 2009, of
// full severity), in linear light.
using Cones = std::array<std::array<double, 3>, 3>;
constexpr Cones kAll = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr Cones kNoLong = {{{0.152286, 1.052583, -0.204868},
                            {0.114503, 0.786281, 0.099216},
                            {-0.003882, -0.048116, 1.051998}}};
constexpr Cones kNoMiddle = {{{0.367322, 0.860646, -0.227968},
                              {0.280085, 0.672501, 0.047413},
                              {-0.011820, 0.042940, 0.968881}}};
constexpr Cones kNoShort = {{{1.255528, -0.076749, -0.178779},
                             {-0.078411, 0.930809, 0.147602},
                             {0.004733, 0.691367, 0.303900}}};
Vec3 SeenAs(const Rgb& colour, const Cones& cones) {
  Vec3 seen = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) seen[i] += cones[i][k] * std::pow(colour[k] / 255.0, 2.2);
    seen[i] = 255 * std::pow(std::clamp(seen[i], 0.0, 1.0), 1 / 2.2);
  }
  return seen;
}

TEST(HeatMapMarks, EveryEyeTellsPathsWallsAndFloorApartAndPropertiesOfCells) {
  constexpr double kApart = 60;  // of 255, over three channels
  const Rgb colours[] = {kWall, kFree, kPlan, kDriven};
  for (const Cones& cones : {kAll, kNoLong, kNoMiddle, kNoShort})
    for (const Rgb& a : colours)
      for (const Rgb& b : colours)
        if (a != b) {
          EXPECT_GT((SeenAs(a, cones) - SeenAs(b, cones)).norm(), kApart);
        }
  std::vector<Rgb> cells = {kWall, kWindowBlue};
  for (int i = 0; i < kNumCellProperties; ++i)
    cells.push_back(ColourOf(static_cast<CellProperty>(i)));
  for (const Cones& cones : {kAll, kNoLong, kNoMiddle, kNoShort})
    for (const Rgb& a : cells)
      for (const Rgb& b : cells)
        if (a != b) {
          EXPECT_GT((SeenAs(a, cones) - SeenAs(b, cones)).norm(), kApart);
        }
  // The measure itself tells: red and green of one lightness are the same without long cones.
  EXPECT_LT((SeenAs({190, 90, 60}, kNoMiddle) - SeenAs({128, 120, 50}, kNoMiddle)).norm(), kApart);
}

}  // namespace
}  // namespace floorproof

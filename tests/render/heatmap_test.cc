// SPDX-License-Identifier: Apache-2.0
#include "render/heatmap.h"

#include <algorithm>
#include <string>

#include "tests/render/hall.h"

namespace floorproof {
namespace {

Vec2 Middle(const Image& image, const Rgb& colour) {
  Vec2 sum = Vec2::Zero();
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (Is(image, x, y, colour)) sum += Vec2(x, y);
  return sum / std::max(1, Count(image, colour));
}

constexpr Rgb kWall = {52, 60, 72}, kFree = {238, 240, 243}, kViridisTop = {253, 231, 37},
              kViridisBottom = {68, 1, 84};

struct Size {
  int width, height;
};
class HeatMapSizes : public ::testing::TestWithParam<Size> {};

TEST_P(HeatMapSizes, LongSideIs800To1600Pixels) {
  const HazardMap map = Hall(GetParam().width, GetParam().height, 0.05);
  const Image image = DrawHeatMap(map, nullptr, {});
  EXPECT_GE(std::max(image.width, image.height), 800);
  EXPECT_LE(std::max(image.width, image.height), 1600);
  EXPECT_GT(Count(image, kWall), 500);
  EXPECT_GT(Count(image, kFree), 500);
}

INSTANTIATE_TEST_SUITE_P(Sizes, HeatMapSizes,
                         ::testing::Values(Size{11, 11}, Size{30, 600}, Size{700, 20},
                                           Size{590, 590}, Size{20, 1159}, Size{1161, 900},
                                           Size{4000, 4000}, Size{3, 3}),
                         [](const auto& i) {
                           return std::to_string(i.param.width) + "x" +
                                  std::to_string(i.param.height);
                         });

TEST(HeatMapTest, UpIsYAndRightIsX) {
  const HazardMap map = Hall(12, 10, 0.5);
  HeatValues values = Values(map, HeatValues::kNone);
  values.values(9, 8) = 5;  // upper right
  values.values(2, 1) = 0;  // lower left
  const Image image = DrawHeatMap(map, &values, {});
  // The bar in the right column holds both colours too, by some rows only.
  ASSERT_GT(Count(image, kViridisTop), 2000);
  ASSERT_GT(Count(image, kViridisBottom), 2000);
  const Vec2 high = Middle(image, kViridisTop), low = Middle(image, kViridisBottom);
  EXPECT_GT(high.x(), low.x() + 300);
  EXPECT_LT(high.y(), low.y() - 300);
}

// Colours between the bar's ends are the bar's.
TEST(HeatMapTest, EveryValueHasAColourOfTheBar) {
  const HazardMap map = Hall(20, 20, 0.1);
  HeatValues values = Values(map, 0);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) values.values(x, y) = static_cast<float>(x);
  HeatMapOptions options;
  options.low = 0;
  options.high = 19;
  const Image image = DrawHeatMap(map, &values, options);
  const int bar_x = image.width - 250 + 10;
  std::vector<std::array<std::uint8_t, 3>> bar;
  for (int y = 60; y < image.height; ++y) {
    const std::uint8_t* p = Pixel(image, bar_x, y);
    bar.push_back({p[0], p[1], p[2]});
  }
  for (int x = 1; x < 19; ++x) {
    const Rgb p = ColourAt(image, PixelOf(map, options, {0.1 * x + 0.05, 1.05}));
    int nearest = 1000;
    for (const auto& b : bar) {
      int d = 0;
      for (int k = 0; k < 3; ++k) d = std::max(d, std::abs(b[k] - p[k]));
      nearest = std::min(nearest, d);
    }
    EXPECT_LE(nearest, 6) << "cell " << x;
  }
}

TEST(HeatMapTest, WallsAndFloorStayVisibleOverACoarseAndAFineGrid) {
  const HazardMap map = Hall(12, 10, 0.5);
  for (const int k : {1, 10}) {
    HeatValues values;
    values.frame = map.frame.Subdivided(k);
    values.values = Grid<float>(values.frame.width, values.frame.height, 3.0f);
    const Image image = DrawHeatMap(map, &values, {});
    EXPECT_GT(Count(image, kWall), 10000) << k;
    EXPECT_EQ(Count(image, kFree), 0) << k;
  }
}

TEST(HeatMapTest, CategoriesUseTheirColoursAndNoOthers) {
  const HazardMap map = Hall(12, 10, 0.5);
  HeatValues values = Values(map, 0);
  for (int x = 6; x < 12; ++x)
    for (int y = 0; y < 10; ++y) values.values(x, y) = 1;
  HeatMapOptions options;
  options.categories = {{"swept", {10, 200, 100}}, {"missed", {250, 150, 0}}};
  const Image image = DrawHeatMap(map, &values, options);
  EXPECT_NEAR(Count(image, {10, 200, 100}), Count(image, {250, 150, 0}), 1000);
  EXPECT_EQ(Count(image, kViridisBottom), 0);
}

TEST(HeatMapTest, UnknownSurroundingsAreCutOff) {
  HazardMap wide;
  wide.frame = {1000, 1000, 0.05, {}};
  wide.occupancy = Grid<CellState>(1000, 1000, CellState::kUnknown);
  for (int x = 500; x < 540; ++x)
    for (int y = 300; y < 340; ++y) wide.occupancy(x, y) = CellState::kFree;
  const Image image = DrawHeatMap(wide, nullptr, {});
  EXPECT_GT(Count(image, kFree), image.width * image.height / 3);
}

TEST(HeatMapTest, PointsAndHazardsAreDrawnWhereTheyLie) {
  HazardMap map = Hall(40, 40, 0.1);
  Hazard step;
  step.id = step.type = "step";
  step.footprint = {Rectangle({2.5, 2.5}, {3.5, 3.0})};
  const Image plain = DrawHeatMap(map, nullptr, {});
  map.hazards = {step};
  HeatMapOptions options;
  options.points = {{{1.0, 1.0}, "stuck"}};
  const Image image = DrawHeatMap(map, nullptr, options);
  ASSERT_EQ(image.width, plain.width);
  const auto changed = [&](double x_m, double y_m) {
    const Vec2 at = PixelOf(map, options, {x_m, y_m});
    const int x = static_cast<int>(at.x()), y = static_cast<int>(at.y());
    int n = 0;
    for (int dy = -4; dy <= 4; ++dy)
      for (int dx = -4; dx <= 4; ++dx) n += Difference(image, plain, x + dx, y + dy) > 30;
    return n;
  };
  EXPECT_GT(changed(1.0, 1.0), 10);
  EXPECT_GT(changed(2.5, 2.7), 10);
  EXPECT_GT(changed(3.0, 3.0), 10);
  EXPECT_EQ(changed(3.0, 2.75), 0);  // an outline only
  EXPECT_EQ(changed(1.0, 3.0), 0);
}

// A turned map is drawn in its own frame: the same walls and floor under the lines of its axes.
TEST(HeatMapTest, TurningTheMapTurnsOnlyArrowAndAxes) {
  HazardMap map = Hall(40, 30, 0.1);
  map.occupancy(10, 20) = CellState::kOccupied;
  const Image straight = DrawHeatMap(map, nullptr, {});
  const Vec2 from = PixelOf(map, {}, {0, 3});
  for (const double yaw_rad : {0.7, kPi / 2, -2.4}) {
    map.frame.X_WG = {3, -2, yaw_rad};
    const Image turned = DrawHeatMap(map, nullptr, {});
    const Vec2 to = PixelOf(map, {}, map.frame.X_WG * Vec2(0, 3));
    const int w = 40 * 29, h = 30 * 29;
    int differ = 0;
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x)
        differ += ColourAt(straight, from + Vec2(x, y)) != ColourAt(turned, to + Vec2(x, y));
    if (yaw_rad == kPi / 2)
      EXPECT_EQ(differ, 0);
    else
      EXPECT_LT(differ, w * h / 20);
    int arrow = 0;
    for (int y = 0; y < 70; ++y)
      for (int x = 1; x <= 70; ++x)
        arrow +=
            ColourAt(straight, {straight.width - x, y}) != ColourAt(turned, {turned.width - x, y});
    EXPECT_GT(arrow, 50) << yaw_rad;
  }
}

TEST(HeatMapTest, ValuesWithoutRangeOrWithoutAnyAreDrawn) {
  const HazardMap map = Hall(11, 11, 0.5);
  const HeatValues none = Values(map, HeatValues::kNone), flat = Values(map, 2);
  EXPECT_GT(Count(DrawHeatMap(map, &none, {}), kFree), 1000);
  EXPECT_EQ(Count(DrawHeatMap(map, &flat, {}), kFree), 0);
}

TEST(HeatMapTest, ATitleStandsWholeOverANarrowFloor) {
  HeatMapOptions options;
  options.title = std::string(60, 'w');
  const Image wide = DrawHeatMap(Hall(60, 60, 0.1), nullptr, options),
              dut = DrawHeatMap(Hall(10, 600, 0.1), nullptr, options);
  EXPECT_EQ(Ink(dut, 0, 0, dut.width, 48), Ink(wide, 0, 0, wide.width, 48));
}

TEST(HeatMapTest, ALegendOfManyLinesStandsWhole) {
  const HazardMap map = Hall(60, 20, 0.1);
  HeatMapOptions options;
  for (int i = 0; i < 40; ++i)
    options.points.push_back({{3, 1},
                              "series " + std::string(1, static_cast<char>('a' + i % 26)) +
                                  std::string(i / 26 ? 30 : 1, 'x')});
  const Image dut = DrawHeatMap(map, nullptr, options);
  int lines = 0;
  bool blank = true;
  const int column = static_cast<int>(PixelOf(map, options, {6, 0}).x()) + 24 + 32;
  for (int y = 76; y < dut.height; ++y) {
    const bool ink = Ink(dut, column, y, dut.width, y + 1) > 0;
    lines += ink && blank;
    blank = !ink;
  }
  EXPECT_GE(lines, 41) << "series and walls";
  EXPECT_EQ(Ink(dut, dut.width - 10, 0, dut.width, dut.height), 0);
  EXPECT_EQ(Ink(dut, 0, dut.height - 3, dut.width, dut.height), 0);
}

}  // namespace
}  // namespace floorproof

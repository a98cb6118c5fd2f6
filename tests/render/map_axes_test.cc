// SPDX-License-Identifier: Apache-2.0
#include "render/map_axes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "render/strokes.h"
#include "tests/render/hall.h"

namespace floorproof {
namespace {

constexpr double kLetter_px = 8;

// 1, 2 or 5 times a power of ten.
bool IsRound(double step) {
  const double mantissa = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
  return std::abs(mantissa - 1) < 1e-6 || std::abs(mantissa - 2) < 1e-6 ||
         std::abs(mantissa - 5) < 1e-6;
}

TEST(MapAxesTest, TicksAreMultiplesOfARoundStepWithinTheSpan) {
  for (const double low : {-1e6 + 0.3, -100.0, -0.37, 0.0, 250.0, 33000.7})
    for (double span = 0.05; span < 1e4; span *= 1.7) {
      const AxisTicks dut = RoundTicks(low, low + span, 1000, 50, kLetter_px);
      EXPECT_TRUE(IsRound(dut.step)) << dut.step;
      ASSERT_GE(dut.at.size(), 2u) << low << " + " << span;
      ASSERT_EQ(dut.labels.size(), dut.at.size());
      for (std::size_t i = 0; i < dut.at.size(); ++i) {
        EXPECT_GE(dut.at[i], low - 1e-6 * span);
        EXPECT_LE(dut.at[i], low + span * (1 + 1e-6));
        EXPECT_NEAR(dut.at[i] / dut.step, std::round(dut.at[i] / dut.step), 1e-4);
        EXPECT_NEAR(std::stod(dut.labels[i]), dut.at[i], 1e-6 * dut.step);
        if (i > 0) {
          EXPECT_NEAR(dut.at[i] - dut.at[i - 1], dut.step, 1e-6 * dut.step);
          EXPECT_GE((dut.at[i] - dut.at[i - 1]) / span * 1000,
                    50 + kLetter_px * static_cast<double>(dut.labels[i].size()) - 1e-6)
              << dut.labels[i];
        }
      }
    }
}

TEST(MapAxesTest, TheStepGrowsWithTheSpan) {
  double last = 0;
  for (double span = 0.1; span < 1e4; span *= 1.1) {
    const double step = RoundTicks(0, span, 1000, 60, kLetter_px).step;
    EXPECT_GE(step, last);
    EXPECT_LE(step, span / 2);
    last = step;
  }
  EXPECT_GE(last, 500);
}

TEST(MapAxesTest, NoughtHasNoSignAndLabelsHaveTheStepsDecimals) {
  const AxisTicks dut = RoundTicks(-0.5, 0.5, 500, 50, kLetter_px);
  EXPECT_DOUBLE_EQ(dut.step, 0.1 * 2);
  EXPECT_EQ(dut.labels, (std::vector<std::string>{"-0.4", "-0.2", "0.0", "0.2", "0.4"}));
  EXPECT_EQ(RoundTicks(-300, 300, 800, 50, kLetter_px).labels.front(), "-300");
}

TEST(MapAxesTest, AShortBorderStillSaysWhereItIs) {
  for (const double low : {0.31, -7.77, 102.43})
    EXPECT_GE(RoundTicks(low, low + 0.6, 12, 50, kLetter_px).at.size(), 1u) << low;
}

// Whether there is a tick below the panel at that x, on the world's axis.
bool TickBelow(const HazardMap& map, const Image& image, const Vec2& p_W) {
  const Vec2 at = PixelOf(map, {}, p_W);
  int ink = 0;
  for (int dy = 2; dy < 6; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const Rgb c = ColourAt(image, at + Vec2(dx, dy));
      ink += c[0] < 190;  // smoothed over two pixels
    }
  return ink >= 4;
}
bool TickLeft(const HazardMap& map, const Image& image, const Vec2& p_W) {
  const Vec2 at = PixelOf(map, {}, p_W);
  int ink = 0;
  for (int dx = 3; dx < 7; ++dx)
    for (int dy = -1; dy <= 1; ++dy) {
      const Rgb c = ColourAt(image, at + Vec2(-dx, dy));
      ink += c[0] < 190;  // smoothed over two pixels
    }
  return ink >= 4;
}

TEST(MapAxesTest, TicksStandAtTheWorldsMetres) {
  HazardMap map = Hall(100, 80, 0.1);
  for (const Vec2& origin : {Vec2(0, 0), Vec2(-100, 250), Vec2(-4.35, -3.05)}) {
    map.frame.X_WG = {origin.x(), origin.y(), 0};
    const Image dut = DrawHeatMap(map, nullptr, {});
    for (double x = std::ceil(origin.x()); x < origin.x() + 9.5; ++x) {
      EXPECT_TRUE(TickBelow(map, dut, {x, origin.y()})) << x;
      EXPECT_FALSE(TickBelow(map, dut, {x + 0.4, origin.y()})) << x;
    }
    for (double y = std::ceil(origin.y()); y < origin.y() + 7.5; ++y) {
      EXPECT_TRUE(TickLeft(map, dut, {origin.x(), y})) << y;
      EXPECT_FALSE(TickLeft(map, dut, {origin.x(), y + 0.4})) << y;
    }
  }
}

// By a quarter the axes change places: y runs along the lower border, x down the left one.
TEST(MapAxesTest, AQuarterTurnsAxesStandAtTheWorldsMetresToo) {
  HazardMap map = Hall(100, 80, 0.1);
  map.frame.X_WG = {3.2, -2.3, kPi / 2};
  const Image dut = DrawHeatMap(map, nullptr, {});
  for (const double y : {-2.0, 0.0, 5.0}) {
    EXPECT_TRUE(TickBelow(map, dut, {3.2, y})) << y;
    EXPECT_FALSE(TickBelow(map, dut, {3.2, y + 0.4})) << y;
  }
  for (const double x : {3.0, 0.0, -4.0}) {
    EXPECT_TRUE(TickLeft(map, dut, {x, -2.3})) << x;
    EXPECT_FALSE(TickLeft(map, dut, {x - 0.4, -2.3})) << x;
  }
}

// Askew, lines lead from the labels to every place of whole metres.
TEST(MapAxesTest, LinesOfAMapAskewCrossWhereBothAreWhole) {
  HazardMap map = Hall(100, 80, 0.1);
  map.frame.X_WG = {-100.3, 250.2, 0.5};
  const Image dut = DrawHeatMap(map, nullptr, {});
  const auto lined = [&](const Vec2& p_W) {
    const Vec2 at = PixelOf(map, {}, p_W);
    int n = 0;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) n += ColourAt(dut, at + Vec2(dx, dy))[0] < 230;
    return n > 0;
  };
  int within = 0;
  for (double x = -106; x < -90; ++x)
    for (double y = 250; y < 266; ++y) {
      const Cell cell = map.frame.ToCell({x, y});
      if (cell.ix < 8 || cell.iy < 8 || cell.ix > 91 || cell.iy > 71) continue;
      ++within;
      EXPECT_TRUE(lined({x, y})) << x << ", " << y;
      EXPECT_TRUE(lined({x, y + 0.3})) << x << ", " << y;
      EXPECT_FALSE(lined({x + 0.4, y + 0.4})) << x << ", " << y;
    }
  EXPECT_GT(within, 40);
}

// Runs of ink in the row of labels below the panel, parted by gaps of at least 6 px.
std::vector<int> LabelWidths(const HazardMap& map, const Image& image) {
  const Vec2 corner = map.frame.X_WG * Vec2(0, 0);
  const int top = static_cast<int>(PixelOf(map, {}, corner).y()) + 8;
  std::vector<int> widths;
  int gap = 6, width = 0;
  for (int x = 0; x < image.width; ++x) {
    if (Ink(image, x, top, x + 1, top + 15) > 0) {
      if (gap >= 6) widths.push_back(width = 0);
      width += gap < 6 ? gap + 1 : 1;
      widths.back() = width;
      gap = 0;
    } else {
      ++gap;
    }
  }
  return widths;
}

TEST(MapAxesTest, LabelsKeepApartOnSmallHugeAndNarrowFloors) {
  struct Floor {
    int w, h;
    double cell_m, x_m;
  };
  for (const Floor& f : {Floor{20, 20, 0.05, 0},
                         {800, 600, 0.5, -200},
                         {4, 600, 0.1, 0.31},
                         {100, 30, 0.1, 500000},
                         {300, 20, 0.05, -1000}}) {
    HazardMap map = Hall(f.w, f.h, f.cell_m);
    map.frame.X_WG = {f.x_m, 0, 0};
    const Image dut = DrawHeatMap(map, nullptr, {});
    const std::vector<int> widths = LabelWidths(map, dut);
    ASSERT_GE(widths.size(), 1u) << f.w;
    const double end_m = f.x_m + f.w * f.cell_m;
    const std::string longest =
        std::to_string(static_cast<long>(std::max(std::abs(f.x_m), std::abs(end_m)))) + "-.00";
    for (const int width : widths)
      EXPECT_LE(width, TextWidth(longest, {.cap_px = 10}) + 4) << f.w << " x " << f.h;
    if (f.w > 10) {
      EXPECT_GE(widths.size(), 4u) << f.w << " x " << f.h;
    }
  }
}

}  // namespace
}  // namespace floorproof

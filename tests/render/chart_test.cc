// SPDX-License-Identifier: Apache-2.0
#include "render/chart.h"

#include <gtest/gtest.h>

namespace floorproof {
namespace {

constexpr Rgb kRed = {200, 20, 20}, kBlue = {20, 20, 200};

// Where a colour is: how many pixels, and the mean of their columns and rows.
struct Spot {
  int n = 0;
  double x = 0, y = 0;
};
Spot Find(const Image& image, const Rgb& colour) {
  Spot spot;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto* p = image.data.data() + 3 * (static_cast<std::size_t>(y) * image.width + x);
      if (p[0] != colour[0] || p[1] != colour[1] || p[2] != colour[2]) continue;
      ++spot.n;
      spot.x += x;
      spot.y += y;
    }
  spot.x /= std::max(1, spot.n);
  spot.y /= std::max(1, spot.n);
  return spot;
}

ChartSeries Dot(const Rgb& colour, double x, double y) {
  return {{colour, ChartStyle::Stroke::kNone, false}, 0, {{x, y, false}}};
}

Chart OnePanel(std::vector<ChartSeries> series) {
  Chart chart;
  chart.title = "title";
  chart.panels = {
      {"panel", "what is shown [mm]", "speed [m/s]", {0.1, 0.2, 0.3}, std::move(series)}};
  return chart;
}

TEST(Chart, MoreIsHigherAndFartherRight) {
  const Image dut = DrawChart(OnePanel({Dot(kRed, 0.1, 5), Dot(kBlue, 0.3, 10)}));
  const Spot red = Find(dut, kRed), blue = Find(dut, kBlue);
  EXPECT_GT(red.n, 10);
  EXPECT_GT(blue.n, 10);
  EXPECT_LT(red.x, blue.x);
  EXPECT_GT(red.y, blue.y);
}

TEST(Chart, AnAxisEndsWhereItIsTold) {
  const auto row = [](std::optional<double> y_end) {
    Chart chart = OnePanel({Dot(kRed, 0.1, 100)});
    chart.panels[0].y_end = y_end;
    return Find(DrawChart(chart), kRed).y;
  };
  EXPECT_GT(row({}), row(100) + 10) << "beyond the highest value";
  EXPECT_NEAR(row(200) - row(100), 125, 2) << "half of the plot lower";
}

TEST(Chart, StrokesAreToldApart) {
  const auto pixels = [](ChartStyle::Stroke stroke) {
    return Find(DrawChart(
                    OnePanel({{{kRed, stroke, false}, 0, {{0.1, 5, false}, {0.3, 5, false}}}})),
                kRed)
        .n;
  };
  using Stroke = ChartStyle::Stroke;
  EXPECT_GT(pixels(Stroke::kSolid), pixels(Stroke::kDashed));
  EXPECT_GT(pixels(Stroke::kDashed), pixels(Stroke::kDotted));
  EXPECT_GT(pixels(Stroke::kDotted), pixels(Stroke::kNone));
}

TEST(Chart, EqualValuesShowSideBySide) {
  ChartSeries aside = Dot(kBlue, 0.2, 5);
  const int alone = Find(DrawChart(OnePanel({aside})), kBlue).n;
  aside.aside_px = 12;
  const Image dut = DrawChart(OnePanel({aside, Dot(kRed, 0.2, 5)}));
  EXPECT_EQ(Find(dut, kBlue).n, alone);
  EXPECT_NEAR(Find(dut, kBlue).x - Find(dut, kRed).x, 12, 0.5);
}

TEST(Chart, AnArrowSaysAtLeast) {
  ChartSeries open = Dot(kRed, 0.2, 5);
  const int plain = Find(DrawChart(OnePanel({open})), kRed).n;
  open.points[0].at_least = true;
  EXPECT_GT(Find(DrawChart(OnePanel({open})), kRed).n, plain);
}

TEST(Chart, PanelsStandInRowsAndColumns) {
  Chart chart = OnePanel({Dot(kRed, 0.2, 0)});
  const Image one = DrawChart(chart);
  chart.panels.resize(4, chart.panels[0]);
  chart.columns = 2;
  const Image four = DrawChart(chart);
  EXPECT_GT(four.width, 1.8 * one.width - 100);
  EXPECT_GT(four.height, 1.5 * one.height);
  EXPECT_EQ(Find(four, kRed).n, 4 * Find(one, kRed).n);
}

TEST(Chart, NothingToShowIsAnEmptyFrame) {
  EXPECT_GT(DrawChart(OnePanel({})).height, 100);
  EXPECT_GT(DrawChart(OnePanel({Dot(kRed, 0.2, 0)})).height, 100) << "a limit of nought";
  Chart one_tick = OnePanel({Dot(kRed, 0.2, 3)});
  one_tick.panels[0].x_ticks = {0.2};
  EXPECT_GT(Find(DrawChart(one_tick), kRed).n, 10);
}

ChartSeries Bars(const Rgb& colour, double aside, double width, std::vector<double> heights) {
  ChartSeries series;
  series.style.colour = colour;
  series.style.bar = width;
  for (std::size_t i = 0; i < heights.size(); ++i)
    series.points.push_back({0.1 * static_cast<double>(i + 1) + aside, heights[i], false});
  return series;
}

int Changed(const Image& a, const Image& b) {
  int n = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i) n += a.data[i] != b.data[i];
  return n;
}

int Ink(const Image& image, int x0, int y0, int x1, int y1) {
  int n = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      n += image.data[3 * (static_cast<std::size_t>(y) * image.width + x)] < 200;
  return n;
}

TEST(Chart, BarsAreAsHighAsTheirValuesFromNought) {
  const Image dut =
      DrawChart(OnePanel({Bars(kRed, 0, 0.05, {5, 0, 0}), Bars(kBlue, 0, 0.05, {0, 0, 10})}));
  EXPECT_GT(Find(dut, kRed).n, 1000);
  EXPECT_NEAR(Find(dut, kBlue).n, 2 * Find(dut, kRed).n, 0.03 * Find(dut, kBlue).n);
}

TEST(Chart, TheOutermostBarsStandWithinTheAxis) {
  const Image dut =
      DrawChart(OnePanel({Bars(kRed, 0, 0.1, {5, 0, 0}), Bars(kBlue, 0, 0.1, {0, 0, 5})}));
  const Spot red = Find(dut, kRed), blue = Find(dut, kBlue);
  const double half_px = (blue.x - red.x) / 4;  // of a bar, half as wide as they lie apart
  EXPECT_GT(red.x - half_px, 76) << "the y axis";
  EXPECT_LT(blue.x + half_px, 76 + 350);
}

TEST(Chart, BarsOfAGroupHideNothingOfEachOther) {
  const auto red = Bars(kRed, -0.02, 0.04, {5, 7, 9}), blue = Bars(kBlue, 0.02, 0.04, {9, 7, 5});
  const Image dut = DrawChart(OnePanel({red, blue})), back = DrawChart(OnePanel({blue, red}));
  EXPECT_EQ(Changed(dut, back), 0);
  EXPECT_GT(Find(dut, kRed).n, 1000);
}

TEST(Chart, ValuesAreWrittenOverBarsWithRoomForAllOfThem) {
  for (const auto& [width, written] : {std::pair(0.05, true), {0.005, false}}) {
    ChartSeries bars = Bars(kRed, 0, width, {5, 12345, 9});
    const Image plain = DrawChart(OnePanel({bars}));
    bars.values = true;
    EXPECT_EQ(Changed(plain, DrawChart(OnePanel({bars}))) > 0, written) << width;
  }
}

// Whatever is written stands whole within the picture, a margin free at its right.
TEST(Chart, LetteringIsNotCutOff) {
  const std::string words(120, 'w');
  Chart title = OnePanel({}), note = title, key = title, panel = title;
  title.title = words;
  note.notes = {words};
  key.legend = {{{"short", {}}, {words, {}}}};
  panel.panels[0].title = words;
  for (const Chart& chart : {title, note, key, panel}) {
    const Image dut = DrawChart(chart);
    EXPECT_GT(dut.width, DrawChart(OnePanel({})).width);
    EXPECT_EQ(Ink(dut, dut.width - 20, 0, dut.width, dut.height), 0);
    EXPECT_GT(Ink(dut, dut.width - 120, 0, dut.width, dut.height), 0);
  }
}

TEST(Chart, TicksThatStandCloseAreNotAllLabelled) {
  Chart chart = OnePanel({});
  chart.panels[0].x_decimals = 3;
  chart.panels[0].x_ticks.clear();
  for (int i = 0; i < 200; ++i) chart.panels[0].x_ticks.push_back(0.001 * i);
  const Image dut = DrawChart(chart);
  // Below the axis, at the foot of which the chart ends.
  const int top = dut.height - 28 - 58 + 9, bottom = top + 13;
  int gaps = 0, blank = 0, inked = 0;
  for (int x = 70; x < dut.width - 30; ++x) {
    if (Ink(dut, x, top, x + 1, bottom) > 0) {
      gaps += blank >= 5;
      blank = 0;
      ++inked;
    } else {
      ++blank;
    }
  }
  EXPECT_GT(inked, 100);
  EXPECT_GE(gaps, 4);
}

TEST(Chart, CountsHaveWholeTicks) {
  ChartPanel panel = OnePanel({Dot(kRed, 0.2, 2)}).panels[0];
  Chart chart = OnePanel({});
  chart.panels = {panel};
  const Image fractions = DrawChart(chart);
  chart.panels[0].whole_numbers = true;
  const Image whole = DrawChart(chart);
  EXPECT_LT(Ink(whole, 20, 60, 70, whole.height - 90),
            Ink(fractions, 20, 60, 70, whole.height - 90))
      << "0, 1, 2 instead of 0, 0.5, 1, 1.5, ...";
}

}  // namespace
}  // namespace floorproof

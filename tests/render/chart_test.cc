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

}  // namespace
}  // namespace floorproof

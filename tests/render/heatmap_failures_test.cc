// SPDX-License-Identifier: Apache-2.0
#include "render/heatmap_failures.h"

#include <algorithm>
#include <random>
#include <string>

#include "tests/render/hall.h"

namespace floorproof {
namespace {

constexpr Rgb kFill = {16, 18, 22}, kRim = {250, 215, 40};

int Near(const Image& image, const Vec2& p_px, const Rgb& colour, int reach_px) {
  int n = 0;
  for (int dy = -reach_px; dy <= reach_px; ++dy)
    for (int dx = -reach_px; dx <= reach_px; ++dx) {
      const Vec2 at = p_px + Vec2(dx, dy);
      if (at.x() >= 0 && at.y() >= 0 && at.x() < image.width && at.y() < image.height)
        n += ColourAt(image, at) == colour;
    }
  return n;
}

TEST(HeatMapFailures, MarksStandWhereFailuresHappened) {
  for (const Pose2& X_WG : {Pose2{0, 0, 0}, {-100, 250, 0}, {7, -3, 0.6}, {2, 2, kPi / 2}})
    for (const double cell_m : {0.02, 0.25, 8.0}) {
      HazardMap map = Hall(50, 40, cell_m);
      map.frame.X_WG = X_WG;
      const Vec2 at[] = {X_WG * Vec2(10 * cell_m, 12 * cell_m),
                         X_WG * Vec2(33.3 * cell_m, 30 * cell_m)};
      HeatMapOptions options;
      options.failures = {{at[0], "1", "stuck"}, {at[1], "2", "roll over"}};
      const Image dut = DrawHeatMap(map, nullptr, options);
      for (const Vec2& p_W : at) {
        EXPECT_GT(Near(dut, PixelOf(map, options, p_W), kFill, 8), 80);
        EXPECT_GT(Near(dut, PixelOf(map, options, p_W), kRim, 12), 30);
      }
      EXPECT_EQ(Near(dut, PixelOf(map, options, X_WG * Vec2(20 * cell_m, 20 * cell_m)), kFill, 12),
                0);
    }
}

TEST(HeatMapFailures, NumbersAreTold) {
  const HazardMap map = Hall(50, 40, 0.1);
  const auto drawn = [&](const std::string& number) {
    HeatMapOptions options;
    options.failures = {{{2, 2}, number, "stuck"}};
    return DrawHeatMap(map, nullptr, options);
  };
  const Image one = drawn("1"), seven = drawn("7");
  ASSERT_EQ(one.width, seven.width);
  const Vec2 at = PixelOf(map, {}, {2, 2});
  int mark = 0, legend = 0;
  for (int y = 0; y < one.height; ++y)
    for (int x = 0; x < one.width; ++x) {
      const bool differs = Difference(one, seven, x, y) > 60;
      mark += differs && (Vec2(x, y) - at).norm() < 12;
      legend += differs && x > static_cast<int>(PixelOf(map, {}, {5, 0}).x());
    }
  EXPECT_GT(mark, 8);
  EXPECT_EQ(legend, mark) << "the same mark in the legend";
}

std::vector<HeatFailure> Scattered(int n, const HazardMap& map) {
  std::mt19937 random(7);
  std::vector<HeatFailure> failures;
  const auto share = [&] { return 0.02 + 0.96 * static_cast<double>(random() % 10000) / 1e4; };
  for (int i = 0; i < n; ++i) {
    const Vec2 p_G(share() * map.frame.width * map.frame.cell_m,
                   share() * map.frame.height * map.frame.cell_m);
    failures.push_back({map.frame.X_WG * p_G, std::to_string(1000 + i), "stuck"});
  }
  return failures;
}

TEST(HeatMapFailures, OfManyAFewAreNumberedNoneOverAnotherAndNoneIsLost) {
  HazardMap map = Hall(60, 50, 0.2);
  map.frame.X_WG = {-30, 4, 0.3};
  const PanelFrame frame(map.frame, KnownWindow(map, {}));
  for (const int n : {1, 15, 60, 3000}) {
    const std::vector<HeatFailure> failures = Scattered(n, map);
    const std::vector<FailureMark> marks = PlaceFailures(failures, frame);
    EXPECT_LE(marks.size(), 20u);
    EXPECT_GE(static_cast<int>(marks.size()), std::min(n, 12));
    int told = 0;
    std::size_t last = 0;
    for (const FailureMark& mark : marks) {
      told += 1 + mark.more;
      EXPECT_GE(mark.failure, last) << "the first come first";
      last = mark.failure;
      for (const FailureMark& other : marks)
        if (&other != &mark) {
          EXPECT_EQ((mark.box & other.box).area(), 0);
        }
      EXPECT_GE(mark.box.x, 0);
      EXPECT_LE(mark.box.br().x, frame.width);
    }
    EXPECT_LE(told, n);
  }
  // All in one place: one mark, which tells of all.
  const std::vector<HeatFailure> alike(70, HeatFailure{map.frame.X_WG * Vec2(3, 3), "5", "stuck"});
  const std::vector<FailureMark> one = PlaceFailures(alike, frame);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].more, 69);
  EXPECT_TRUE(one[0].also.empty());
  // What else failed there is told once each.
  std::vector<HeatFailure> mixed = alike;
  mixed[5].label = mixed[9].label = "veer off";
  EXPECT_EQ(PlaceFailures(mixed, frame).at(0).also, std::vector<std::string>{"veer off"});
}

TEST(HeatMapFailures, ThousandsLeaveTheValuesVisible) {
  const HazardMap map = Hall(60, 50, 0.2);
  const HeatValues values = Values(map, 2);
  HeatMapOptions options;
  const auto dark = [&](int n) {
    options.failures = Scattered(n, map);
    const Image dut = DrawHeatMap(map, &values, options);
    EXPECT_LE(dut.height, 1600);
    return Count(dut, kFill);
  };
  const int few = dark(40), many = dark(5000);
  EXPECT_GT(few, 2000);
  EXPECT_LT(many, 2 * few);
}

TEST(HeatMapFailures, AtABorderTheMarkIsWholeAndFarOffThereIsNone) {
  const HazardMap map = Hall(50, 40, 0.1);
  const auto fill = [&](const Vec2& p_W) {
    HeatMapOptions options;
    options.failures = {{p_W, "8", "stuck"}};
    return Count(DrawHeatMap(map, nullptr, options), kFill);
  };
  const int whole = fill({2.5, 2});
  EXPECT_NEAR(fill({0.01, 0.01}), whole, 0.1 * whole);
  EXPECT_NEAR(fill({4.99, 3.99}), whole, 0.1 * whole);
  for (const double far_m : {-50.0, 1e15}) EXPECT_LT(fill({far_m, 2}), 0.6 * whole);
}

}  // namespace
}  // namespace floorproof

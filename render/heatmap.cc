// SPDX-License-Identifier: Apache-2.0
#include "render/heatmap.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/quantity.h"
#include "render/heatmap_legend.h"
#include "render/heatmap_panel.h"
#include "render/strokes.h"

namespace floorproof {
namespace {

constexpr int kLeastColumn_px = 250, kTop_px = 76, kTitle_y = 36, kMargin_px = 24,
              kLeastHeight_px = 420;
constexpr int kArrow_px = 36;  // the arrow's reach, its letter included

constexpr TextStyle kTitle = {.cap_px = 17, .colour = kInk, .bold = true},
                    kName = {.cap_px = 11, .colour = kInk, .bold = true},
                    kLabel = {.cap_px = 10, .colour = kInk};

void DrawColourBar(Image& image, int x, int y, int height, const HeatPanel& panel,
                   const HeatMapOptions& options) {
  const HeatRange& range = panel.range;
  DrawText(image, x, y, options.quantity, kName);
  const std::string unit = options.unit.empty() ? "" : "[" + options.unit + "]";
  DrawText(image, x, y + 20, unit, kLabel);
  y += 38;
  constexpr int kWidth = 22;
  for (int r = 0; r < height; ++r) {
    const auto i = static_cast<std::size_t>(std::lround(255.0 * (height - 1 - r) / (height - 1)));
    FillRectangle(image, x, y + r, x + kWidth, y + r + 1, panel.colours[i], 1);
  }
  cv::Mat canvas = Canvas(image);
  cv::rectangle(canvas, {x, y}, {x + kWidth - 1, y + height - 1}, Colour(kGrey), 1);
  double step = NiceStep((range.high - range.low) / 6);
  if (options.whole_numbers) step = std::max(1.0, step);
  for (double v = std::ceil(range.low / step - 1e-9) * step; v <= range.high + 1e-9 * step;
       v += step) {
    const int row =
        y +
        static_cast<int>(std::lround((height - 1) * (range.high - v) / (range.high - range.low)));
    cv::line(canvas, {x + kWidth, row}, {x + kWidth + 5, row}, Colour(kInk), 1);
    DrawText(image, x + kWidth + 10, row + 5, NumberText(std::abs(v) < 1e-9 * step ? 0.0 : v, 6),
             kLabel);
  }
}

// Over the legend where there is no colour bar.
std::string LegendName(const HeatMapOptions& options) {
  return options.quantity + (options.unit.empty() ? "" : " [" + options.unit + "]");
}

// The right column's, wide enough for its longest line.
int ColumnWidth(const HeatPanel& panel, const HeatMapOptions& options) {
  const int name = static_cast<int>(std::ceil(TextWidth(LegendName(options), kName)));
  return std::max(std::max(name, LegendWidth(panel.legend)) + kMargin_px, kLeastColumn_px);
}

// Towards the world's +y. Which way is north no map states.
void DrawUp(Image& image, int x, int y, double map_yaw_rad) {
  const double s = std::sin(map_yaw_rad), c = std::cos(map_yaw_rad);
  const Vec2 along(s, -c), across(c, s);  // in pixels, y down
  const Vec2 middle(x, y);
  const auto at = [&](double a, double b) {
    const Vec2 p = middle + a * along + b * across;
    return cv::Point(static_cast<int>(std::lround(16 * p.x())),
                     static_cast<int>(std::lround(16 * p.y())));
  };
  const std::array<cv::Point, 4> head = {at(15, 0), at(-11, 8), at(-6, 0), at(-11, -8)};
  cv::Mat canvas = Canvas(image);
  cv::fillConvexPoly(canvas, head.data(), 3, Colour(kInk), cv::LINE_AA, 4);
  const std::array<cv::Point, 3> cut = {head[1], head[2], head[3]};
  cv::fillConvexPoly(canvas, cut.data(), 3, cv::Scalar(255, 255, 255), cv::LINE_AA, 4);
  const std::array<cv::Point, 3> left = {head[0], head[3], head[2]};
  cv::fillConvexPoly(canvas, left.data(), 3, Colour(kInk), cv::LINE_AA, 4);
  const Vec2 letter = middle + 26 * along;
  DrawText(image, letter.x(), letter.y() + 5, "y",
           {.cap_px = 10, .colour = kInk, .anchor = Anchor::kCentre, .bold = true});
}

}  // namespace

Image DrawHeatMap(const HazardMap& map, const HeatValues* values, const HeatMapOptions& options) {
  const PanelFrame frame(map.frame, KnownWindow(map, options));
  const MapAxes axes(frame);
  HeatPanel panel = DrawPanel(map, values, options, frame, axes);
  const bool bar = values != nullptr && options.categories.empty();
  const int lines = kLegendLine_px * static_cast<int>(panel.legend.size());
  const int inner = std::max(panel.image.height, kLeastHeight_px);
  const int bar_px = std::clamp(inner - lines - 84, 120, 320);
  const int name_y = kTop_px + 12;
  int legend_y = name_y;
  if (bar)
    legend_y += bar_px + 80;
  else if (!options.quantity.empty())
    legend_y += 28;

  const cv::Rect place(kMargin_px + axes.left_px(), kTop_px, panel.image.width, panel.image.height);
  const int column = place.br().x + kMargin_px;
  const int title_px = static_cast<int>(std::ceil(TextWidth(options.title, kTitle)));
  const int width = std::max(column + ColumnWidth(panel, options),
                             kMargin_px + title_px + kMargin_px + 2 * kArrow_px);
  const int height =
      std::max(kTop_px + inner + MapAxes::kBelow_px + kMargin_px / 2, legend_y + lines);
  Image image = GreyImage(width, height, 255);
  cv::Mat canvas = Canvas(image);
  Canvas(panel.image).copyTo(canvas(place));
  cv::rectangle(canvas, cv::Rect(place.x - 1, place.y - 1, place.width + 2, place.height + 2),
                Colour(kGrey), 1);
  axes.Draw(image, place);

  DrawText(image, kMargin_px, kTitle_y, options.title, kTitle);
  const double yaw_rad = map.frame.X_WG.yaw_rad;
  if (std::abs(yaw_rad) > 1e-9) DrawUp(image, image.width - kArrow_px, kArrow_px, yaw_rad);
  if (bar)
    DrawColourBar(image, column, name_y, bar_px, panel, options);
  else
    DrawText(image, column, name_y, LegendName(options), kName);
  DrawLegend(image, column, legend_y, panel.legend);
  return image;
}

void WriteHeatMap(const HazardMap& map, const HeatValues* values, const HeatMapOptions& options,
                  const std::filesystem::path& png) {
  WritePng(png, DrawHeatMap(map, values, options));
}

}  // namespace floorproof

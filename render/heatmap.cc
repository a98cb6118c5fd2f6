// SPDX-License-Identifier: Apache-2.0
#include "render/heatmap.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/quantity.h"
#include "render/heatmap_marks.h"
#include "render/heatmap_panel.h"
#include "render/strokes.h"

namespace floorproof {
namespace {

constexpr int kLeastColumn_px = 250, kTop_px = 64, kFoot_px = 64, kMargin_px = 24,
              kLeastHeight_px = 420;

constexpr TextStyle kTitle = {.cap_px = 17, .colour = kInk, .bold = true},
                    kName = {.cap_px = 11, .colour = kInk, .bold = true},
                    kLabel = {.cap_px = 10, .colour = kInk};
constexpr int kSwatch_px = 32, kLine_px = 22;  // of the legend

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
  double widest = TextWidth(LegendName(options), kName);
  for (const LegendLine& line : panel.legend)
    widest = std::max(widest, kSwatch_px + TextWidth(line.label, kLabel));
  return std::max(static_cast<int>(widest) + kMargin_px, kLeastColumn_px);
}

void DrawLegend(Image& image, int x, int y, const std::vector<LegendLine>& lines) {
  cv::Mat canvas = Canvas(image);
  for (const LegendLine& line : lines) {
    DrawSwatch(canvas, {x, y - 12, 22, 14}, line);
    DrawText(image, x + kSwatch_px, y, line.label, kLabel);
    y += kLine_px;
  }
}

// A bar of 1, 2 or 5 times a power of ten metres, about a fifth of the panel, with its ends marked.
// Returns where its lettering ends.
int DrawScaleBar(Image& image, int x, int y, double px_per_m, int panel_px) {
  double metres = NiceStep(0.12 * panel_px / px_per_m);
  const int length = static_cast<int>(std::lround(metres * px_per_m));
  cv::Mat canvas = Canvas(image);
  FillRectangle(image, x, y, x + length + 1, y + 4, kInk, 1);
  FillRectangle(image, x, y - 5, x + 2, y + 4, kInk, 1);
  FillRectangle(image, x + length - 1, y - 5, x + length + 1, y + 4, kInk, 1);
  const std::string text =
      metres < 0.995 ? NumberText(100 * metres, 6) + " cm" : NumberText(metres, 6) + " m";
  const TextStyle style{.cap_px = 12, .colour = kInk};
  DrawText(image, x + length + 12, y + 5, text, style);
  return x + length + 12 + static_cast<int>(TextWidth(text, style));
}

// Towards the world's +y.
void DrawNorth(Image& image, int x, int y, double map_yaw_rad) {
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
  DrawText(image, letter.x(), letter.y() + 5, "N",
           {.cap_px = 10, .colour = kInk, .anchor = Anchor::kCentre, .bold = true});
}

}  // namespace

Image DrawHeatMap(const HazardMap& map, const HeatValues* values, const HeatMapOptions& options) {
  HeatPanel panel = DrawPanel(map, values, options);
  const bool bar = values != nullptr && options.categories.empty();
  const int lines = static_cast<int>(panel.legend.size());
  const int inner = std::max(panel.image.height, kLeastHeight_px);
  const int bar_px = std::clamp(inner - kLine_px * lines - 84, 120, 320);
  const int name_y = kTop_px + 12;
  int legend_y = name_y;
  if (bar)
    legend_y += bar_px + 80;
  else if (!options.quantity.empty())
    legend_y += 28;

  Image image;
  image.width = std::max(
      kMargin_px + panel.image.width + kMargin_px + ColumnWidth(panel, options),
      kMargin_px + static_cast<int>(std::ceil(TextWidth(options.title, kTitle))) + kMargin_px);
  image.height = std::max(kTop_px + inner + kFoot_px, legend_y + kLine_px * lines);
  image.channels = 3;
  image.data.assign(static_cast<std::size_t>(image.width) * image.height * 3, 255);
  cv::Mat canvas = Canvas(image);
  const cv::Rect place(kMargin_px, kTop_px, panel.image.width, panel.image.height);
  Canvas(panel.image).copyTo(canvas(place));
  cv::rectangle(canvas, cv::Rect(place.x - 1, place.y - 1, place.width + 2, place.height + 2),
                Colour(kGrey), 1);

  DrawText(image, kMargin_px, 40, options.title, kTitle);
  const int column = place.x + place.width + kMargin_px;
  if (bar)
    DrawColourBar(image, column, name_y, bar_px, panel, options);
  else
    DrawText(image, column, name_y, LegendName(options), kName);
  DrawLegend(image, column, legend_y, panel.legend);
  const int foot = place.br().y + 34;
  const int scale_end = DrawScaleBar(image, kMargin_px, foot, panel.px_per_m, place.width);
  DrawNorth(image, std::max(place.br().x - 22, scale_end + 40), foot + 2, map.frame.X_WG.yaw_rad);
  return image;
}

void WriteHeatMap(const HazardMap& map, const HeatValues* values, const HeatMapOptions& options,
                  const std::filesystem::path& png) {
  WritePng(png, DrawHeatMap(map, values, options));
}

}  // namespace floorproof

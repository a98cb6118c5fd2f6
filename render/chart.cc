// SPDX-License-Identifier: Apache-2.0
#include "render/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/quantity.h"
#include "render/strokes.h"

namespace floorproof {
namespace {

constexpr int kMargin_px = 28, kTitle_px = 58, kNote_px = 22, kKey_px = 26;
constexpr int kPlotHeight_px = 250;
constexpr int kLeft_px = 48, kTop_px = 56, kFoot_px = 58, kGap_px = 30;  // around a plot
constexpr int kPanelHeight_px = kTop_px + kPlotHeight_px + kFoot_px;
constexpr int kSwatch_px = 44, kBetween_px = 30;  // of the legend's keys
constexpr Rgb kGrid = {226, 229, 233};
constexpr TextStyle kTitle = {.cap_px = 17, .colour = kInk, .bold = true},
                    kPanelTitle = {.cap_px = 13, .colour = kInk, .bold = true},
                    kNote = {.cap_px = 10, .colour = kGrey}, kTick = {.cap_px = 10, .colour = kInk},
                    kKey = {.cap_px = 11, .colour = kInk},
                    kValue = {.cap_px = 9, .colour = kInk, .anchor = Anchor::kCentre};

void Stroke(cv::Mat& canvas, const cv::Point2d& a, const cv::Point2d& b, const ChartStyle& style) {
  using Kind = ChartStyle::Stroke;
  if (style.stroke == Kind::kNone) return;
  if (style.stroke == Kind::kSolid) {
    Line(canvas, a, b, style.colour, 2);
    return;
  }
  const bool dashed = style.stroke == Kind::kDashed;
  Dashes(canvas, a, b, style.colour, 2, dashed ? 8 : 2, dashed ? 14 : 7);
}

void Mark(cv::Mat& canvas, const cv::Point2d& p, const ChartStyle& style) {
  if (!style.marks) return;
  if (style.hollow) {
    Ring(canvas, p, 7, style.colour, 2);
  } else {
    Disc(canvas, p, 5.2, {255, 255, 255});
    Disc(canvas, p, 3.9, style.colour);
  }
}

void UpArrow(cv::Mat& canvas, const cv::Point2d& p, const Rgb& colour) {
  const cv::Point2d tip = p - cv::Point2d(0, 20);
  Line(canvas, p - cv::Point2d(0, 8), tip, colour, 2);
  Line(canvas, tip, tip + cv::Point2d(-4, 6), colour, 2);
  Line(canvas, tip, tip + cv::Point2d(4, 6), colour, 2);
}

// One panel's data and pixels.
class Axes {
 public:
  Axes(const ChartPanel& panel, const cv::Rect& plot) : plot_(plot) {
    auto [low, high] = std::ranges::minmax(panel.x_ticks);
    const bool one = low == high;
    bool bars = false;
    for (const ChartSeries& series : panel.series) {
      if (series.style.bar <= 0) continue;
      bars = true;
      for (const ChartPoint& point : series.points) {
        low = std::min(low, point.x - series.style.bar / 2);
        high = std::max(high, point.x + series.style.bar / 2);
      }
    }
    const double beyond = one ? 0.5 : (bars ? 0.02 : 0.12) * (high - low);
    x_low_ = low - beyond;
    x_high_ = high + beyond;
    double most = 0;
    for (const ChartSeries& series : panel.series)
      for (const ChartPoint& point : series.points) most = std::max(most, point.y);
    if (panel.y_end) most = *panel.y_end;
    y_step = NiceStep(most > 0 ? most / 5 : 0.2, !panel.whole_numbers);
    if (panel.whole_numbers) y_step = std::max(1.0, y_step);
    y_high = panel.y_end ? most : y_step * std::ceil(most / y_step + 0.3);
  }
  cv::Point2d Pixel(double x, double y) const {
    return {plot_.x + plot_.width * (x - x_low_) / (x_high_ - x_low_),
            plot_.y + plot_.height * (1 - y / y_high)};
  }
  double y_step, y_high;

 private:
  cv::Rect plot_;
  double x_low_, x_high_;
};

TextStyle At(TextStyle style, Anchor anchor) {
  style.anchor = anchor;
  return style;
}

std::string XText(const ChartPanel& panel, double x) {
  return panel.x_decimals ? fmt::format("{:.{}f}", x, *panel.x_decimals) : NumberText(x, 6);
}

void DrawAxes(Image& image, const ChartPanel& panel, const cv::Rect& plot, const Axes& axes) {
  cv::Mat canvas = Canvas(image);
  for (double y = 0; y <= axes.y_high * (1 + 1e-9); y += axes.y_step) {
    const int row = static_cast<int>(std::lround(axes.Pixel(0, y).y));
    cv::line(canvas, {plot.x, row}, {plot.br().x, row}, Colour(kGrid), 1);
    DrawText(image, plot.x - 8, row + 5, NumberText(y, 6), At(kTick, Anchor::kRight));
  }
  constexpr double kApart_px = 6;
  double free_from_px = 0;  // right of the last label
  for (const double x : panel.x_ticks) {
    const int column = static_cast<int>(std::lround(axes.Pixel(x, 0).x));
    cv::line(canvas, {column, plot.y}, {column, plot.br().y}, Colour(kGrid), 1);
    cv::line(canvas, {column, plot.br().y}, {column, plot.br().y + 4}, Colour(kGrey), 1);
    const std::string text = XText(panel, x);
    const double half_px = 0.5 * TextWidth(text, kTick);
    if (column - half_px < free_from_px) continue;
    DrawText(image, column, plot.br().y + 20, text, At(kTick, Anchor::kCentre));
    free_from_px = column + half_px + kApart_px;
  }
  cv::line(canvas, {plot.x, plot.y}, {plot.x, plot.br().y}, Colour(kGrey), 1);
  cv::line(canvas, {plot.x, plot.br().y}, {plot.br().x, plot.br().y}, Colour(kGrey), 1);
  DrawText(image, plot.x + plot.width / 2.0, plot.br().y + 42, panel.x_label,
           At(kTick, Anchor::kCentre));
}

void DrawBars(Image& image, const ChartSeries& series, const Axes& axes) {
  cv::Mat canvas = Canvas(image);
  const double half = series.style.bar / 2;
  bool room = series.values;
  for (const ChartPoint& point : series.points) {
    const cv::Point2d top = axes.Pixel(point.x - half, point.y),
                      foot = axes.Pixel(point.x + half, 0);
    const int left = static_cast<int>(std::lround(top.x)) + series.aside_px,
              right = static_cast<int>(std::lround(foot.x)) + series.aside_px;
    FillRectangle(image, left, static_cast<int>(std::lround(top.y)), right,
                  static_cast<int>(std::lround(foot.y)), series.style.colour, 1);
    room = room && TextWidth(NumberText(point.y, 6), kValue) + 4 <= right - left;
  }
  if (!room) return;
  for (const ChartPoint& point : series.points) {
    const cv::Point2d top = axes.Pixel(point.x, point.y);
    DrawText(image, top.x + series.aside_px, top.y - 4, NumberText(point.y, 6), kValue);
  }
}

void DrawPanel(Image& image, const ChartPanel& panel, int x, int y, int width_px) {
  const cv::Rect plot(x + kLeft_px, y + kTop_px, width_px, kPlotHeight_px);
  DrawText(image, x, y + 18, panel.title, kPanelTitle);
  DrawText(image, x, y + 40, panel.subtitle, kNote);
  const Axes axes(panel, plot);
  DrawAxes(image, panel, plot, axes);
  cv::Mat canvas = Canvas(image);
  for (const ChartSeries& series : panel.series) {
    if (series.style.bar > 0) {
      DrawBars(image, series, axes);
      continue;
    }
    for (std::size_t i = 1; i < series.points.size(); ++i) {
      const ChartPoint &a = series.points[i - 1], &b = series.points[i];
      const cv::Point2d aside(series.aside_px, 0);
      Stroke(canvas, axes.Pixel(a.x, a.y) + aside, axes.Pixel(b.x, b.y) + aside, series.style);
    }
  }
  // Marks last, so that no line crosses one.
  for (const ChartSeries& series : panel.series) {
    if (series.style.bar > 0) continue;
    for (const ChartPoint& point : series.points) {
      const cv::Point2d p = axes.Pixel(point.x, point.y) + cv::Point2d(series.aside_px, 0);
      Mark(canvas, p, series.style);
      if (point.at_least) UpArrow(canvas, p, series.style.colour);
    }
  }
}

void DrawLegendLine(Image& image, const std::vector<ChartKey>& keys, int x, int y) {
  cv::Mat canvas = Canvas(image);
  for (const ChartKey& key : keys) {
    const cv::Point2d left(x, y - 5), right(x + kSwatch_px - 10, y - 5);
    if (key.style.bar > 0) {
      FillRectangle(image, x + 10, y - 12, x + kSwatch_px - 10, y + 2, key.style.colour, 1);
    } else {
      Stroke(canvas, left, right, key.style);
      Mark(canvas, (left + right) / 2, key.style);
    }
    DrawText(image, x + kSwatch_px, y, key.label, kKey);
    x += kSwatch_px + static_cast<int>(TextWidth(key.label, kKey)) + kBetween_px;
  }
}

// Of panels side by side and of whatever is written.
int WidthOf(const Chart& chart, int columns, int panel_px) {
  double widest = columns * panel_px - kGap_px + 16;
  const auto hold = [&](double from_px, const std::string& text, const TextStyle& style) {
    widest = std::max(widest, from_px + TextWidth(text, style));
  };
  hold(0, chart.title, kTitle);
  for (const std::string& note : chart.notes) hold(0, note, kNote);
  for (std::size_t i = 0; i < chart.panels.size(); ++i) {
    const int from_px = static_cast<int>(i) % columns * panel_px;
    hold(from_px, chart.panels[i].title, kPanelTitle);
    hold(from_px, chart.panels[i].subtitle, kNote);
  }
  for (const auto& keys : chart.legend) {
    double width = -kBetween_px;
    for (const ChartKey& key : keys)
      width += kSwatch_px + std::floor(TextWidth(key.label, kKey)) + kBetween_px;
    widest = std::max(widest, width);
  }
  return 2 * kMargin_px + static_cast<int>(std::ceil(widest));
}

}  // namespace

Image DrawChart(const Chart& chart) {
  const int panels = static_cast<int>(chart.panels.size());
  const int columns = std::max(1, std::min(chart.columns, panels));
  const int rows = (panels + columns - 1) / columns;
  const int head_px = kTitle_px + kNote_px * static_cast<int>(chart.notes.size()) + 8;
  const int legend_px = kKey_px * static_cast<int>(chart.legend.size());
  const int panel_px = kLeft_px + chart.plot_width_px + kGap_px;
  Image image = GreyImage(WidthOf(chart, columns, panel_px),
                          head_px + rows * kPanelHeight_px + legend_px + kMargin_px, 255);
  DrawText(image, kMargin_px, 40, chart.title, kTitle);
  int y = kTitle_px + 8;
  for (const std::string& note : chart.notes) {
    DrawText(image, kMargin_px, y, note, kNote);
    y += kNote_px;
  }
  for (int i = 0; i < panels; ++i)
    DrawPanel(image, chart.panels[static_cast<std::size_t>(i)], kMargin_px + i % columns * panel_px,
              head_px + i / columns * kPanelHeight_px, chart.plot_width_px);
  y = head_px + rows * kPanelHeight_px + 18;
  for (const auto& keys : chart.legend) {
    DrawLegendLine(image, keys, kMargin_px, y);
    y += kKey_px;
  }
  return image;
}

void WriteChart(const Chart& chart, const std::filesystem::path& png) {
  WritePng(png, DrawChart(chart));
}

}  // namespace floorproof

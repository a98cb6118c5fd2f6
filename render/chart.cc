// SPDX-License-Identifier: Apache-2.0
#include "render/chart.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace floorproof {
namespace {

constexpr Rgb kInk = {32, 38, 46}, kGrey = {110, 118, 128}, kGrid = {226, 229, 233};
constexpr int kMargin_px = 28, kTitle_px = 58, kNote_px = 22, kKey_px = 26;
constexpr int kPlotHeight_px = 250;
constexpr int kLeft_px = 48, kTop_px = 56, kFoot_px = 58, kGap_px = 30;  // around a plot
constexpr int kPanelHeight_px = kTop_px + kPlotHeight_px + kFoot_px;
constexpr int kShift = 4;  // of OpenCV's fixed-point coordinates

cv::Mat Canvas(Image& image) { return {image.height, image.width, CV_8UC3, image.data.data()}; }
cv::Scalar Colour(const Rgb& c) { return {1.0 * c[0], 1.0 * c[1], 1.0 * c[2]}; }
cv::Point Fixed(const cv::Point2d& p) {
  return {static_cast<int>(std::lround(p.x * (1 << kShift))),
          static_cast<int>(std::lround(p.y * (1 << kShift)))};
}
void Line(cv::Mat& canvas, const cv::Point2d& a, const cv::Point2d& b, const Rgb& colour, int px) {
  cv::line(canvas, Fixed(a), Fixed(b), Colour(colour), px, cv::LINE_AA, kShift);
}
void Disc(cv::Mat& canvas, const cv::Point2d& p, double radius_px, const Rgb& colour) {
  cv::circle(canvas, Fixed(p), static_cast<int>(std::lround(radius_px * (1 << kShift))),
             Colour(colour), cv::FILLED, cv::LINE_AA, kShift);
}

void Stroke(cv::Mat& canvas, const cv::Point2d& a, const cv::Point2d& b, const ChartStyle& style) {
  using Kind = ChartStyle::Stroke;
  if (style.stroke == Kind::kNone) return;
  if (style.stroke == Kind::kSolid) {
    Line(canvas, a, b, style.colour, 2);
    return;
  }
  const bool dashed = style.stroke == Kind::kDashed;
  const double on_px = dashed ? 8 : 2, period_px = dashed ? 14 : 7;
  const cv::Point2d d = b - a;
  const double length = std::max(std::hypot(d.x, d.y), 1e-9);
  for (double s = 0; s < length; s += period_px)
    Line(canvas, a + d * (s / length), a + d * (std::min(s + on_px, length) / length), style.colour,
         2);
}

void Mark(cv::Mat& canvas, const cv::Point2d& p, const ChartStyle& style) {
  if (!style.marks) return;
  if (style.hollow) {
    cv::circle(canvas, Fixed(p), 7 << kShift, Colour(style.colour), 2, cv::LINE_AA, kShift);
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

// The least of 1, 2, 2.5, 5 times a power of ten that is not below `least`.
double NiceStep(double least) {
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double step : {1.0, 2.0, 2.5, 5.0})
    if (step * decade >= least * (1 - 1e-9)) return step * decade;
  return 10 * decade;
}

// One panel's data and pixels.
class Axes {
 public:
  Axes(const ChartPanel& panel, const cv::Rect& plot) : plot_(plot) {
    const auto [low, high] = std::minmax_element(panel.x_ticks.begin(), panel.x_ticks.end());
    const double beyond = *high > *low ? 0.12 * (*high - *low) : 0.5;
    x_low_ = *low - beyond;
    x_high_ = *high + beyond;
    double most = 0;
    for (const ChartSeries& series : panel.series)
      for (const ChartPoint& point : series.points) most = std::max(most, point.y);
    y_step = NiceStep(most > 0 ? most / 5 : 0.2);
    y_high = y_step * std::ceil(most / y_step + 0.3);
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

void DrawAxes(Image& image, const ChartPanel& panel, const cv::Rect& plot, const Axes& axes) {
  cv::Mat canvas = Canvas(image);
  const TextStyle tick{.cap_px = 10, .colour = kInk};
  for (double y = 0; y <= axes.y_high * (1 + 1e-9); y += axes.y_step) {
    const int row = static_cast<int>(std::lround(axes.Pixel(0, y).y));
    cv::line(canvas, {plot.x, row}, {plot.br().x, row}, Colour(kGrid), 1);
    TextStyle right = tick;
    right.anchor = Anchor::kRight;
    DrawText(image, plot.x - 8, row + 5, Printf("%.6g", y), right);
  }
  for (const double x : panel.x_ticks) {
    const int column = static_cast<int>(std::lround(axes.Pixel(x, 0).x));
    cv::line(canvas, {column, plot.y}, {column, plot.br().y}, Colour(kGrid), 1);
    cv::line(canvas, {column, plot.br().y}, {column, plot.br().y + 4}, Colour(kGrey), 1);
    TextStyle middle = tick;
    middle.anchor = Anchor::kCentre;
    DrawText(image, column, plot.br().y + 20, Printf("%.6g", x), middle);
  }
  cv::line(canvas, {plot.x, plot.y}, {plot.x, plot.br().y}, Colour(kGrey), 1);
  cv::line(canvas, {plot.x, plot.br().y}, {plot.br().x, plot.br().y}, Colour(kGrey), 1);
  DrawText(image, plot.x + plot.width / 2.0, plot.br().y + 42, panel.x_label,
           {.cap_px = 10, .colour = kInk, .anchor = Anchor::kCentre});
}

void DrawPanel(Image& image, const ChartPanel& panel, int x, int y, int width_px) {
  const cv::Rect plot(x + kLeft_px, y + kTop_px, width_px, kPlotHeight_px);
  DrawText(image, x, y + 18, panel.title, {.cap_px = 13, .colour = kInk, .bold = true});
  DrawText(image, x, y + 40, panel.subtitle, {.cap_px = 10, .colour = kGrey});
  const Axes axes(panel, plot);
  DrawAxes(image, panel, plot, axes);
  cv::Mat canvas = Canvas(image);
  for (const ChartSeries& series : panel.series)
    for (std::size_t i = 1; i < series.points.size(); ++i) {
      const ChartPoint &a = series.points[i - 1], &b = series.points[i];
      const cv::Point2d aside(series.aside_px, 0);
      Stroke(canvas, axes.Pixel(a.x, a.y) + aside, axes.Pixel(b.x, b.y) + aside, series.style);
    }
  // Marks last, so that no line crosses one.
  for (const ChartSeries& series : panel.series)
    for (const ChartPoint& point : series.points) {
      const cv::Point2d p = axes.Pixel(point.x, point.y) + cv::Point2d(series.aside_px, 0);
      Mark(canvas, p, series.style);
      if (point.at_least) UpArrow(canvas, p, series.style.colour);
    }
}

void DrawLegendLine(Image& image, const std::vector<ChartKey>& keys, int x, int y) {
  constexpr int kSwatch_px = 44, kBetween_px = 30;
  const TextStyle label{.cap_px = 11, .colour = kInk};
  cv::Mat canvas = Canvas(image);
  for (const ChartKey& key : keys) {
    const cv::Point2d left(x, y - 5), right(x + kSwatch_px - 10, y - 5);
    Stroke(canvas, left, right, key.style);
    Mark(canvas, (left + right) / 2, key.style);
    DrawText(image, x + kSwatch_px, y, key.label, label);
    x += kSwatch_px + static_cast<int>(TextWidth(key.label, label)) + kBetween_px;
  }
}

}  // namespace

Image DrawChart(const Chart& chart) {
  const int panels = static_cast<int>(chart.panels.size());
  const int columns = std::max(1, std::min(chart.columns, panels));
  const int rows = (panels + columns - 1) / columns;
  const int head_px = kTitle_px + kNote_px * static_cast<int>(chart.notes.size()) + 8;
  const int legend_px = kKey_px * static_cast<int>(chart.legend.size());
  const int panel_px = kLeft_px + chart.plot_width_px + kGap_px;
  Image image;
  image.width = 2 * kMargin_px + columns * panel_px - kGap_px + 16;
  image.height = head_px + rows * kPanelHeight_px + legend_px + kMargin_px;
  image.channels = 3;
  image.data.assign(static_cast<std::size_t>(image.width) * image.height * 3, 255);
  DrawText(image, kMargin_px, 40, chart.title, {.cap_px = 17, .colour = kInk, .bold = true});
  int y = kTitle_px + 8;
  for (const std::string& note : chart.notes) {
    DrawText(image, kMargin_px, y, note, {.cap_px = 10, .colour = kGrey});
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

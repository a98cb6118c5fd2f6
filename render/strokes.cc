// SPDX-License-Identifier: Apache-2.0
#include "render/strokes.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace floorproof {
namespace {

constexpr int kShift = 4;  // of OpenCV's fixed-point coordinates

int Fixed(double px) { return static_cast<int>(std::lround(px * (1 << kShift))); }
cv::Point Fixed(const cv::Point2d& p) { return {Fixed(p.x), Fixed(p.y)}; }

// The part of the segment from a to b, as shares of it, that may show on the canvas (Liang &
// Barsky, 1984); empty: first > second. What lies far outside costs time, and has no whole number.
std::pair<double, double> ShownPart(const cv::Mat& canvas, const cv::Point2d& a,
                                    const cv::Point2d& b) {
  constexpr double kMargin_px = 64;  // wider than any stroke or mark
  double first = 0, last = 1;
  const auto cut = [&](double from, double way, double low, double high) {
    if (way == 0) {
      if (!(from >= low && from <= high)) last = -1;
      return;
    }
    const double in = ((way > 0 ? low : high) - from) / way;
    const double out = ((way > 0 ? high : low) - from) / way;
    first = std::max(first, in);
    last = std::min(last, out);
  };
  cut(a.x, b.x - a.x, -kMargin_px, canvas.cols + kMargin_px);
  cut(a.y, b.y - a.y, -kMargin_px, canvas.rows + kMargin_px);
  return {first, last};
}

bool Shows(const cv::Mat& canvas, const cv::Point2d& middle, double radius_px) {
  return middle.x > -radius_px && middle.x < canvas.cols + radius_px && middle.y > -radius_px &&
         middle.y < canvas.rows + radius_px;
}

}  // namespace

cv::Mat Canvas(Image& image) { return {image.height, image.width, CV_8UC3, image.data.data()}; }

cv::Scalar Colour(const Rgb& c) { return {1.0 * c[0], 1.0 * c[1], 1.0 * c[2]}; }

void Line(cv::Mat& canvas, const cv::Point2d& a, const cv::Point2d& b, const Rgb& colour, int px) {
  const auto [first, last] = ShownPart(canvas, a, b);
  if (!(first <= last)) return;
  const cv::Point2d from = first > 0 ? a + (b - a) * first : a;
  const cv::Point2d to = last < 1 ? a + (b - a) * last : b;
  cv::line(canvas, Fixed(from), Fixed(to), Colour(colour), px, cv::LINE_AA, kShift);
}

void Dashes(cv::Mat& canvas, const cv::Point2d& a, const cv::Point2d& b, const Rgb& colour, int px,
            double on_px, double period_px) {
  const cv::Point2d d = b - a;
  const double length = std::hypot(d.x, d.y);
  const auto [first, last] = ShownPart(canvas, a, b);
  // The dashes that show are those that the whole line would have there.
  const double from = std::floor(std::max(0.0, first * length / period_px)) * period_px;
  // Counted: so far along the line that a period is lost in rounding, a sum would not grow.
  const double dashes = std::ceil((std::min(last, 1.0) * length - from) / period_px);
  for (int k = 0; k < dashes; ++k) {
    const double s = from + k * period_px;
    Line(canvas, a + d * (s / length), a + d * (std::min(s + on_px, length) / length), colour, px);
  }
}

void Disc(cv::Mat& canvas, const cv::Point2d& middle, double radius_px, const Rgb& colour) {
  if (!Shows(canvas, middle, 2 * radius_px)) return;
  cv::circle(canvas, Fixed(middle), Fixed(radius_px), Colour(colour), cv::FILLED, cv::LINE_AA,
             kShift);
}

void Ring(cv::Mat& canvas, const cv::Point2d& middle, double radius_px, const Rgb& colour, int px) {
  if (!Shows(canvas, middle, 2 * radius_px + px)) return;
  cv::circle(canvas, Fixed(middle), Fixed(radius_px), Colour(colour), px, cv::LINE_AA, kShift);
}

double NiceStep(double least, bool quarters) {
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double step : {1.0, 2.0, 2.5, 5.0})
    if ((quarters || step != 2.5) && step * decade >= least * (1 - 1e-9)) return step * decade;
  return 10 * decade;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "render/strokes.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace floorproof {
namespace {

constexpr int kShift = 4;  // of OpenCV's fixed-point coordinates

int Fixed(double px) { return static_cast<int>(std::lround(px * (1 << kShift))); }
cv::Point Fixed(const cv::Point2d& p) { return {Fixed(p.x), Fixed(p.y)}; }

}  // namespace

cv::Mat Canvas(Image& image) { return {image.height, image.width, CV_8UC3, image.data.data()}; }

cv::Scalar Colour(const Rgb& c) { return {1.0 * c[0], 1.0 * c[1], 1.0 * c[2]}; }

void Line(cv::Mat& canvas, const cv::Point2d& a, const cv::Point2d& b, const Rgb& colour, int px) {
  cv::line(canvas, Fixed(a), Fixed(b), Colour(colour), px, cv::LINE_AA, kShift);
}

void Dashes(cv::Mat& canvas, const cv::Point2d& a, const cv::Point2d& b, const Rgb& colour, int px,
            double on_px, double period_px) {
  const cv::Point2d d = b - a;
  const double length = std::hypot(d.x, d.y);
  for (double s = 0; s < length; s += period_px)
    Line(canvas, a + d * (s / length), a + d * (std::min(s + on_px, length) / length), colour, px);
}

void Disc(cv::Mat& canvas, const cv::Point2d& middle, double radius_px, const Rgb& colour) {
  cv::circle(canvas, Fixed(middle), Fixed(radius_px), Colour(colour), cv::FILLED, cv::LINE_AA,
             kShift);
}

void Ring(cv::Mat& canvas, const cv::Point2d& middle, double radius_px, const Rgb& colour, int px) {
  cv::circle(canvas, Fixed(middle), Fixed(radius_px), Colour(colour), px, cv::LINE_AA, kShift);
}

double NiceStep(double least, bool quarters) {
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double step : {1.0, 2.0, 2.5, 5.0})
    if ((quarters || step != 2.5) && step * decade >= least * (1 - 1e-9)) return step * decade;
  return 10 * decade;
}

}  // namespace floorproof

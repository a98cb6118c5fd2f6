// SPDX-License-Identifier: Apache-2.0
// Smooth lines and marks on RGB pictures, and the steps of their axes: what charts and heat maps
// are drawn with.
#pragma once

#include <opencv2/core.hpp>

#include "media/media.h"
#include "render/text.h"

namespace floorproof {

inline constexpr Rgb kInk = {32, 38, 46}, kGrey = {110, 118, 128}, kWhite = {255, 255, 255};

// The picture's own pixels, not a copy.
cv::Mat Canvas(Image& image);
cv::Scalar Colour(const Rgb& colour);
// Points are in pixels, fractions too.
void Line(cv::Mat& canvas, const cv::Point2d& a, const cv::Point2d& b, const Rgb& colour, int px);
// Pieces `on_px` long, one each `period_px`.
void Dashes(cv::Mat& canvas, const cv::Point2d& a, const cv::Point2d& b, const Rgb& colour, int px,
            double on_px, double period_px);
void Disc(cv::Mat& canvas, const cv::Point2d& middle, double radius_px, const Rgb& colour);
void Ring(cv::Mat& canvas, const cv::Point2d& middle, double radius_px, const Rgb& colour, int px);

// The least of 1, 2, 5 times a power of ten that is not below `least`; `quarters`: 2.5 too.
double NiceStep(double least, bool quarters = false);

}  // namespace floorproof

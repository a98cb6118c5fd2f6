// SPDX-License-Identifier: Apache-2.0
// The draughtsman's marks of a sheet of views, in pixels.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "render/view_sheet.h"

namespace floorproof {

// From one row of dimensions to the next: below one another, and side by side, texts between.
inline constexpr int kDimensionRow_px = 34, kDimensionColumn_px = 124;

// A convex shape with a darker border.
void FillShape(Image& image, const std::vector<cv::Point2d>& outline, const Rgb& fill,
               double alpha);
void HatchFloor(Image& image, double left, double right, double y);
// The line lies at `level`: its row where it is along x, else its column.
void DrawDimension(Image& image, const cv::Point2d& a, const cv::Point2d& b, bool along_x,
                   double level, const std::string& text);
void DrawViewMark(Image& image, const cv::Point2d& at, ViewMark::Kind kind, const Rgb& colour);
void DrawLabel(Image& image, const cv::Point2d& middle, const std::string& text, const Rgb& colour);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "planners/audit/features.h"

#include <algorithm>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "planners/audit/thinning.h"

namespace floorproof {
namespace {

constexpr int kPad = 2;                      // cells around the map: what lies beyond it is wall
constexpr std::uint8_t kMaxOccupancy = 128;  // T_max: darker pixels are occupied
constexpr int kMedian = 5;                   // pixels; see CornersOf
constexpr double kBlur = 1.5;                // pixels: a slanted wall is a staircase of corners
constexpr int kCornerContrast = 30;          // of 255, to the pixels of the ring

}  // namespace

std::vector<Cell> BoundaryOf(const Room& room) {
  const int width = room.pixels.width + 2 * kPad, height = room.pixels.height + 2 * kPad;
  const auto inside = [&](int x, int y) {
    return room.inside.Inside(x - kPad, y - kPad) && room.inside(x - kPad, y - kPad);
  };
  Grid<std::uint8_t> edge(width, height);
  for (int y = 1; y + 1 < height; ++y)
    for (int x = 1; x + 1 < width; ++x) {
      if (inside(x, y)) continue;
      const bool on_map = room.pixels.Inside(x - kPad, y - kPad);
      if (on_map && room.pixels(x - kPad, y - kPad) >= kMaxOccupancy) continue;
      for (int k = 0; k < 9 && !edge(x, y); ++k) edge(x, y) = inside(x + k % 3 - 1, y + k / 3 - 1);
    }
  Thin(edge);
  const cv::Mat image(height, width, CV_8U, edge.cells.data());
  std::vector<std::vector<cv::Point>> contours;
  std::vector<cv::Vec4i> kin;  // of each: next, before, child, parent
  cv::findContours(image, contours, kin, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  const std::vector<cv::Point>* largest = nullptr;
  double most = -1;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const bool hole = kin[i][3] >= 0;
    const double area = hole ? cv::contourArea(contours[i]) : -1;
    if (area > most) largest = &contours[i], most = area;
  }
  std::vector<Cell> boundary;
  if (largest != nullptr)
    for (const cv::Point& p : *largest) boundary.push_back({p.x - kPad, p.y - kPad});
  return boundary;
}

std::vector<Cell> CornersOf(const Room& room) {
  constexpr int kBorder = 4;  // FAST looks at pixels three away
  cv::Mat image(room.inside.height + 2 * kBorder, room.inside.width + 2 * kBorder, CV_8U,
                cv::Scalar(0));
  for (int iy = 0; iy < room.inside.height; ++iy)
    for (int ix = 0; ix < room.inside.width; ++ix)
      if (room.inside(ix, iy)) image.at<std::uint8_t>(iy + kBorder, ix + kBorder) = 255;
  cv::medianBlur(image, image, kMedian);
  cv::GaussianBlur(image, image, {}, kBlur);
  std::vector<cv::KeyPoint> points;
  // All of them: of two equal neighbours, which a corner often has, the choice of one keeps none.
  cv::FAST(image, points, kCornerContrast, false, cv::FastFeatureDetector::TYPE_9_16);
  std::vector<Cell> corners;
  for (const cv::KeyPoint& p : points)
    corners.push_back({static_cast<int>(p.pt.x) - kBorder, static_cast<int>(p.pt.y) - kBorder});
  return corners;
}

}  // namespace floorproof

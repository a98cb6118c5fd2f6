// SPDX-License-Identifier: Apache-2.0
#include "planners/audit/features.h"

#include <algorithm>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "planners/audit/thinning.h"

namespace floorproof {
namespace {

constexpr int kPad = 2;                      // cells around the map: what lies beyond it is wall
constexpr std::uint8_t kMaxOccupancy = 128;  // T_max: darker pixels are occupied
constexpr int kMedian = 5;                   // pixels; see CornersOf
constexpr double kBlur = 1.5;                // pixels: a slanted wall is a staircase of corners
constexpr int kCornerContrast = 30;          // of 255, to the pixels of the ring
constexpr int kBendRadius = 6;               // pixels; see Bend
constexpr int kClimb = 5;  // pixels: as far from FAST's pixel the edge is looked for

// How much the edge bends at each pixel: how far the share of the room in a disc around it is from
// a half, which it is along a straight wall (an integral invariant: Manay et al., "Integral
// Invariants for Shape Matching", 2006).
cv::Mat Bend(const cv::Mat& room) {
  cv::Mat disc = cv::Mat::zeros(2 * kBendRadius + 1, 2 * kBendRadius + 1, CV_32F);
  for (int y = -kBendRadius; y <= kBendRadius; ++y)
    for (int x = -kBendRadius; x <= kBendRadius; ++x)
      if (x * x + y * y <= kBendRadius * (kBendRadius + 1))
        disc.at<float>(y + kBendRadius, x + kBendRadius) = 1;
  cv::Mat share;
  cv::filter2D(room, share, CV_32F, disc / (255 * cv::sum(disc)[0]));
  return cv::abs(share - 0.5);
}

// From `from` to the pixel of the edge within kClimb at which it bends most, from there on to the
// next, until there is none that bends more. Nowhere where there is no edge.
std::optional<cv::Point> ClimbToCorner(const cv::Mat& edge, const cv::Mat& bend, cv::Point from) {
  constexpr float kMore = 1e-5F;  // rounding
  const cv::Rect image(0, 0, edge.cols, edge.rows);
  std::optional<cv::Point> best;
  for (bool higher = true; higher;) {
    higher = false;
    const cv::Point middle = best.value_or(from);
    for (int dy = -kClimb; dy <= kClimb; ++dy)
      for (int dx = -kClimb; dx <= kClimb; ++dx) {
        const cv::Point p = middle + cv::Point(dx, dy);
        if (dx * dx + dy * dy > kClimb * kClimb || !image.contains(p)) continue;
        if (edge.at<std::uint8_t>(p) == 0) continue;
        if (best && bend.at<float>(p) <= bend.at<float>(*best) + kMore) continue;
        best = p;
        higher = true;
      }
  }
  return best;
}

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
  constexpr int kBorder = kBendRadius + 1;  // what lies beyond the map is wall
  cv::Mat image(room.inside.height + 2 * kBorder, room.inside.width + 2 * kBorder, CV_8U,
                cv::Scalar(0));
  for (int iy = 0; iy < room.inside.height; ++iy)
    for (int ix = 0; ix < room.inside.width; ++ix)
      if (room.inside(ix, iy)) image.at<std::uint8_t>(iy + kBorder, ix + kBorder) = 255;
  cv::Mat smooth, edge;  // edge: the pixels around the room
  cv::medianBlur(image, smooth, kMedian);
  cv::GaussianBlur(smooth, smooth, {}, kBlur);
  std::vector<cv::KeyPoint> points;
  // All of them: of two equal neighbours, which a corner often has, the choice of one keeps none.
  cv::FAST(smooth, points, kCornerContrast, false, cv::FastFeatureDetector::TYPE_9_16);
  const cv::Mat bend = Bend(image);
  cv::dilate(image, edge, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  edge -= image;
  constexpr std::uint8_t kTaken = 1;  // of the edge, whose other pixels are 255
  std::vector<Cell> corners;
  for (const cv::KeyPoint& point : points) {
    const auto corner = ClimbToCorner(edge, bend, point.pt);
    if (!corner || edge.at<std::uint8_t>(*corner) == kTaken) continue;
    edge.at<std::uint8_t>(*corner) = kTaken;
    corners.push_back({corner->x - kBorder, corner->y - kBorder});
  }
  return corners;
}

}  // namespace floorproof

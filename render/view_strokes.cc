// SPDX-License-Identifier: Apache-2.0
#include "render/view_strokes.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "render/strokes.h"

namespace floorproof {
namespace {

constexpr TextStyle kDimension = {.cap_px = 10, .colour = kInk};

Rgb Mixed(const Rgb& a, const Rgb& b, double share) {
  Rgb out;
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = static_cast<std::uint8_t>(std::lround(a[k] + share * (b[k] - a[k])));
  return out;
}

void Arrow(cv::Mat& canvas, const cv::Point2d& tip, const cv::Point2d& way) {
  const cv::Point2d across(-way.y, way.x);
  for (const double side : {-1.0, 1.0})
    Line(canvas, tip, tip - 7 * way + side * 3 * across, kGrey, 1);
}

// Behind a text, so that lines do not cross it.
void LightGround(Image& image, double x, double base_y, double width, double cap_px) {
  FillRectangle(image, static_cast<int>(x - 3), static_cast<int>(base_y - cap_px - 4),
                static_cast<int>(x + width + 3), static_cast<int>(base_y + 5), kWhite, 0.85);
}

}  // namespace

void FillShape(Image& image, const std::vector<cv::Point2d>& outline, const Rgb& fill,
               double alpha) {
  if (outline.size() < 3) return;
  constexpr int kShift = 4;
  constexpr double kDarker = 0.45;
  std::vector<cv::Point> fixed;
  for (const cv::Point2d& p : outline)
    fixed.emplace_back(static_cast<int>(std::lround(p.x * (1 << kShift))),
                       static_cast<int>(std::lround(p.y * (1 << kShift))));
  cv::Mat canvas = Canvas(image);
  if (alpha < 1) {
    const cv::Mat before = canvas.clone();
    cv::fillConvexPoly(canvas, fixed, Colour(fill), cv::LINE_AA, kShift);
    cv::addWeighted(canvas, alpha, before, 1 - alpha, 0, canvas);
  } else {
    cv::fillConvexPoly(canvas, fixed, Colour(fill), cv::LINE_AA, kShift);
  }
  const Rgb border = Mixed(fill, kInk, kDarker);
  for (std::size_t i = 0; i < outline.size(); ++i)
    Line(canvas, outline[i], outline[(i + 1) % outline.size()], border, 1);
}

void HatchFloor(Image& image, double left, double right, double y) {
  constexpr double kApart_px = 11, kLong_px = 8;
  cv::Mat canvas = Canvas(image);
  for (double x = left + kLong_px; x <= right; x += kApart_px)
    Line(canvas, {x, y}, {x - kLong_px, y + kLong_px}, kGrey, 1);
  Line(canvas, {left, y}, {right, y}, kInk, 2);
}

void DrawDimension(Image& image, const cv::Point2d& a, const cv::Point2d& b, bool along_x,
                   double level, const std::string& text) {
  constexpr double kBeyond_px = 4, kOff_px = 5;
  cv::Mat canvas = Canvas(image);
  const auto at = [&](double along, double off) {
    return along_x ? cv::Point2d(along, off) : cv::Point2d(off, along);
  };
  const double from = std::min(along_x ? a.x : a.y, along_x ? b.x : b.y);
  const double to = std::max(along_x ? a.x : a.y, along_x ? b.x : b.y);
  for (const cv::Point2d& end : {a, b}) {
    const double along = along_x ? end.x : end.y, off = along_x ? end.y : end.x;
    const double way = level > off ? 1 : -1;
    Line(canvas, at(along, off + way * kOff_px), at(along, level + way * kBeyond_px), kGrey, 1);
  }
  Line(canvas, at(from, level), at(to, level), kGrey, 1);
  const double width = TextWidth(text, kDimension), middle = (from + to) / 2;
  constexpr double kRoom_px = 26;  // below this the arrows point from outside
  const bool inside = to - from > kRoom_px;
  const cv::Point2d way = along_x ? cv::Point2d(1, 0) : cv::Point2d(0, 1);
  Arrow(canvas, at(from, level), inside ? -way : way);
  Arrow(canvas, at(to, level), inside ? way : -way);
  const double x = along_x ? middle - width / 2 : level + 6;
  const double y = along_x ? level - 5 : middle + kDimension.cap_px / 2;
  LightGround(image, x, y, width, kDimension.cap_px);
  DrawText(image, x, y, text, kDimension);
}

void DrawViewMark(Image& image, const cv::Point2d& at, ViewMark::Kind kind, const Rgb& colour) {
  cv::Mat canvas = Canvas(image);
  switch (kind) {
    case ViewMark::Kind::kDisc:
      Disc(canvas, at, 6.5, kWhite);
      Disc(canvas, at, 5, colour);
      break;
    case ViewMark::Kind::kRing:
      Disc(canvas, at, 6.5, kWhite);
      Ring(canvas, at, 5, colour, 2);
      break;
    case ViewMark::Kind::kMassCentre: {
      constexpr int kRadius_px = 10;
      Disc(canvas, at, kRadius_px + 1.5, kWhite);
      const cv::Point middle(static_cast<int>(std::lround(at.x)),
                             static_cast<int>(std::lround(at.y)));
      for (const int from : {0, 180})
        cv::ellipse(canvas, middle, {kRadius_px, kRadius_px}, 0, from, from + 90, Colour(colour),
                    cv::FILLED, cv::LINE_AA);
      Ring(canvas, at, kRadius_px, colour, 2);
      break;
    }
  }
}

void DrawLabel(Image& image, const cv::Point2d& middle, const std::string& text,
               const Rgb& colour) {
  const TextStyle style = {.cap_px = 10, .colour = colour, .bold = true};
  const double width = TextWidth(text, style);
  LightGround(image, middle.x - width / 2, middle.y + 5, width, style.cap_px);
  DrawText(image, middle.x - width / 2, middle.y + 5, text, style);
}

}  // namespace floorproof

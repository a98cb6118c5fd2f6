// SPDX-License-Identifier: Apache-2.0
#include "render/heatmap_legend.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "render/heatmap_failures.h"
#include "render/heatmap_marks.h"
#include "render/strokes.h"

namespace floorproof {
namespace {

using Kind = LegendLine::Kind;

constexpr TextStyle kLabel = {.cap_px = 10, .colour = kInk},
                    kHeading = {.cap_px = 11, .colour = kInk, .bold = true};
constexpr int kSwatch_px = 22, kSwatchHeight_px = 14, kGap_px = 10;

// Where the labels begin, right of the widest picture.
int Indent(const std::vector<LegendLine>& legend) {
  int widest = kSwatch_px;
  for (const LegendLine& line : legend)
    if (line.kind == Kind::kNumber) widest = std::max(widest, NumberSwatchWidth(line.number));
  return widest + kGap_px;
}

}  // namespace

void DrawSwatch(Image& image, const cv::Rect& place, const LegendLine& line) {
  cv::Mat canvas = Canvas(image);
  const cv::Point2d left(place.x, place.y + 0.5 * place.height),
      right(place.x + place.width, place.y + 0.5 * place.height), middle = 0.5 * (left + right);
  switch (line.kind) {
    case Kind::kArea:
      cv::rectangle(canvas, place, Colour(line.colour), cv::FILLED);
      if (line.colour == kWhite) cv::rectangle(canvas, place, Colour(kGrey), 1);
      break;
    case Kind::kHatched:
      for (int y = place.y; y < place.br().y; ++y)
        for (int x = place.x; x < place.br().x; ++x) {
          const Rgb colour = HatchedAt(x, y);
          canvas.at<cv::Vec3b>(y, x) = {colour[0], colour[1], colour[2]};
        }
      break;
    case Kind::kOutline:
      cv::rectangle(canvas, place, Colour(line.colour), 2, cv::LINE_AA);
      break;
    case Kind::kDashed:
      HazardDashes(canvas, left, right, line.colour);
      break;
    case Kind::kLine:
      Line(canvas, left, right, line.colour, line.px);
      break;
    case Kind::kStart:
      StartMark(canvas, middle);
      break;
    case Kind::kEnd:
      EndMark(canvas, middle);
      break;
    case Kind::kMark:
      Mark(canvas, (place.tl() + place.br()) / 2, line.colour, line.mark);
      break;
    case Kind::kRing:
      RingMark(canvas, middle, 7.5, 2, line.colour);
      break;
    case Kind::kNumber:
      NumberSwatch(image, place.x, place.y + place.height / 2, line.number);
      break;
    case Kind::kDot:
      FailureDot(canvas, middle);
      break;
    case Kind::kHeading:
      break;
  }
}

int LegendWidth(const std::vector<LegendLine>& legend) {
  double widest = 0;
  const int indent = Indent(legend);
  for (const LegendLine& line : legend)
    widest = std::max(widest, line.kind == Kind::kHeading ? TextWidth(line.label, kHeading)
                                                          : indent + TextWidth(line.label, kLabel));
  return static_cast<int>(std::ceil(widest));
}

void DrawLegend(Image& image, int x_px, int y_px, const std::vector<LegendLine>& legend) {
  const int indent = Indent(legend);
  for (const LegendLine& line : legend) {
    const bool heading = line.kind == Kind::kHeading;
    DrawSwatch(image, {x_px, y_px - 12, kSwatch_px, kSwatchHeight_px}, line);
    DrawText(image, heading ? x_px : x_px + indent, y_px, line.label, heading ? kHeading : kLabel);
    y_px += kLegendLine_px;
  }
}

}  // namespace floorproof

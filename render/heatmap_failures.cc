// SPDX-License-Identifier: Apache-2.0
#include "render/heatmap_failures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "render/strokes.h"

namespace floorproof {
namespace {

// Light on dark: a difference that every eye sees, on each colour map.
constexpr Rgb kFill = {16, 18, 22}, kRim = {250, 215, 40};
constexpr TextStyle kNumber = {
    .cap_px = 10, .colour = kWhite, .anchor = Anchor::kCentre, .bold = true};
constexpr int kHeight_px = 22, kRim_px = 2;
constexpr std::size_t kMostMarks = 20;  // and lines of the legend
constexpr std::size_t kMostLabels = 2;  // beside the first's, of those that share a mark
constexpr std::size_t kMostDots = 200;  // more would hide the values
constexpr double kDot_px = 3.5;

int WidthOf(const std::string& number) {
  return std::max(kHeight_px, static_cast<int>(std::ceil(TextWidth(number, kNumber))) + 12);
}

std::string Shown(const HeatFailure& failure, int more) {
  return failure.number + (more > 0 ? "+" : "");
}

// A disc, drawn out to the box's width.
void Pill(cv::Mat& canvas, const cv::Rect& box, double radius_px, const Rgb& colour) {
  const double y = box.y + 0.5 * box.height, inset = 0.5 * box.height;
  const cv::Point2d left(box.x + inset, y), right(box.br().x - inset, y);
  Disc(canvas, left, radius_px, colour);
  Disc(canvas, right, radius_px, colour);
  const auto whole = [](double px) { return static_cast<int>(std::lround(px)); };
  if (right.x > left.x)
    cv::rectangle(canvas, {whole(left.x), whole(y - radius_px)},
                  {whole(right.x), whole(y + radius_px)}, Colour(colour), cv::FILLED, cv::LINE_8);
}

void NumberMark(Image& image, const cv::Rect& box, const std::string& number) {
  cv::Mat canvas = Canvas(image);
  Pill(canvas, box, 0.5 * kHeight_px, kRim);
  Pill(canvas, box, 0.5 * kHeight_px - kRim_px, kFill);
  DrawText(image, box.x + 0.5 * box.width, box.y + 0.5 * (kHeight_px + kNumber.cap_px), number,
           kNumber);
}

bool Within(const cv::Point2d& p, const PanelFrame& frame) {
  return p.x >= 0 && p.y >= 0 && p.x <= frame.width && p.y <= frame.height;
}

// With the room that the sign of shared marks needs, moved inside the panel where it would be cut.
cv::Rect BoxOf(const HeatFailure& failure, const PanelFrame& frame) {
  const cv::Point2d middle = frame.Pixel(failure.p_W);
  const int width = WidthOf(Shown(failure, 1));
  const auto inside = [](double from, int size, int all) {
    return std::max(0, std::min(static_cast<int>(std::lround(from)), all - size));
  };
  return {inside(middle.x - 0.5 * width, width, frame.width),
          inside(middle.y - 0.5 * kHeight_px, kHeight_px, frame.height), width, kHeight_px};
}

}  // namespace

std::vector<FailureMark> PlaceFailures(const std::vector<HeatFailure>& failures,
                                       const PanelFrame& frame) {
  std::vector<FailureMark> marks;
  for (std::size_t i = 0; i < failures.size(); ++i) {
    if (!Within(frame.Pixel(failures[i].p_W), frame)) continue;
    const cv::Rect box = BoxOf(failures[i], frame);
    const auto shared = std::ranges::find_if(
        marks, [&](const FailureMark& mark) { return (mark.box & box).area() > 0; });
    if (shared != marks.end()) {
      ++shared->more;
      const std::string& label = failures[i].label;
      if (shared->also.size() < kMostLabels && label != failures[shared->failure].label &&
          std::ranges::find(shared->also, label) == shared->also.end())
        shared->also.push_back(label);
    } else if (marks.size() < kMostMarks) {
      marks.push_back({i, box});
    }
  }
  return marks;
}

void DrawFailures(const HeatMapOptions& options, const PanelFrame& frame, HeatPanel& panel) {
  const std::vector<HeatFailure>& failures = options.failures;
  if (failures.empty()) return;
  using Kind = LegendLine::Kind;
  panel.legend.push_back({.kind = Kind::kHeading, .label = options.failures_by});
  const std::vector<FailureMark> marks = PlaceFailures(failures, frame);
  std::size_t told = 0;
  cv::Mat canvas = Canvas(panel.image);
  if (failures.size() <= kMostDots)
    for (const HeatFailure& failure : failures)
      if (const cv::Point2d p = frame.Pixel(failure.p_W); Within(p, frame)) FailureDot(canvas, p);
  for (const FailureMark& mark : marks) {
    const HeatFailure& failure = failures[mark.failure];
    const std::string number = Shown(failure, mark.more);
    const int width = WidthOf(number);  // of one alone it is less than its room
    const int left = mark.box.x + (mark.box.width - width) / 2;
    NumberMark(panel.image, {left, mark.box.y, width, mark.box.height}, number);
    std::string label = failure.label;
    for (const std::string& also : mark.also) label += "; " + also;
    if (mark.more > 0) label += fmt::format("; {} here", mark.more + 1);
    panel.legend.push_back({.kind = Kind::kNumber, .label = label, .number = number});
    told += 1 + static_cast<std::size_t>(mark.more);
  }
  if (told < failures.size())
    panel.legend.push_back(
        {.kind = Kind::kDot, .label = fmt::format("{} more elsewhere", failures.size() - told)});
}

void NumberSwatch(Image& image, int left_px, int middle_y_px, const std::string& number) {
  NumberMark(image, {left_px, middle_y_px - kHeight_px / 2, WidthOf(number), kHeight_px}, number);
}
int NumberSwatchWidth(const std::string& number) { return WidthOf(number); }

void FailureDot(cv::Mat& canvas, const cv::Point2d& middle) {
  Disc(canvas, middle, kDot_px + 1.5, kRim);
  Disc(canvas, middle, kDot_px, kFill);
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "render/timeline.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/quantity.h"
#include "render/overlay.h"
#include "render/strokes.h"

namespace floorproof {
namespace {

constexpr Rgb kPale = {232, 235, 239};
constexpr int kWidth = 1100, kMargin = 24, kRow = 24, kGap = 10, kCurve = 150, kAxis = 44;
constexpr int kLeast_px = 4;  // of what is short
constexpr TextStyle kLabel{.cap_px = 9, .colour = kInk};

// Black or white, whichever is read more easily on it (relative luminance, roughly).
Rgb ReadableOn(const Rgb& colour) {
  const double light = 0.21 * colour[0] + 0.72 * colour[1] + 0.07 * colour[2];
  return light > 140 ? kInk : kWhite;
}

double LongestName(const Timeline& timeline) {
  double longest = 0;
  for (const TimelineRow& row : timeline.rows)
    longest = std::max(longest, TextWidth(row.name, kLabel));
  if (timeline.curve) longest = std::max(longest, TextWidth(timeline.curve->name, kLabel));
  return longest;
}

// Lines broken between words where they are too long.
std::vector<std::string> Wrapped(const std::vector<std::string>& lines, double width_px,
                                 const TextStyle& style) {
  std::vector<std::string> wrapped;
  for (const std::string& line : lines) {
    wrapped.emplace_back();
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      std::string& last = wrapped.back();
      const std::string longer = last.empty() ? word : last + " " + word;
      if (last.empty() || TextWidth(longer, style) <= width_px)
        last = longer;
      else
        wrapped.push_back(word);
    }
  }
  return wrapped;
}

// Where a time lies.
struct Axis {
  double left = 0, width = 1, end_s = 1;
  double X(double t_s) const { return left + width * std::clamp(t_s / end_s, 0.0, 1.0); }
};

void DrawSpans(const TimelineRow& row, const Axis& axis, int top, int height, bool texts,
               Image& image) {
  for (const TimelineSpan& span : row.spans) {
    const int x0 = static_cast<int>(axis.X(span.from_s));
    const int x1 = std::max(x0 + kLeast_px, static_cast<int>(axis.X(span.to_s)));
    FillRectangle(image, x0, top, x1, top + height, span.colour, 1);
    TextStyle style = kLabel;
    style.colour = ReadableOn(span.colour);
    if (texts && !span.text.empty() && TextWidth(span.text, style) + 8 < x1 - x0)
      DrawText(image, x0 + 4, top + 0.5 * height + 0.5 * style.cap_px, span.text, style);
  }
}

void DrawCurve(const TimelineCurve& curve, const Axis& axis, int top, Image& image) {
  const auto y = [&](double value) {
    return top + kCurve * (1 - std::clamp(value / curve.most, 0.0, 1.0));
  };
  cv::Mat canvas = Canvas(image);
  FillRectangle(image, static_cast<int>(axis.left), top, static_cast<int>(axis.left + axis.width),
                top + kCurve, kPale, 0.5);
  TextStyle grey = kLabel;
  grey.colour = kGrey;
  TextStyle right = grey;
  right.anchor = Anchor::kRight;
  for (const double value : {0.0, curve.most})
    DrawText(image, axis.left - 6, y(value) + (value == 0 ? 0 : 10), NumberText(value), right);
  for (const auto& [value, name] : curve.levels) {
    Dashes(canvas, {axis.left, y(value)}, {axis.left + axis.width, y(value)}, kGrey, 1, 4, 8);
    DrawText(image, axis.left + 6, y(value) - 3, name, grey);
  }
  const auto draw = [&](const std::vector<std::pair<double, double>>& steps, Rgb colour) {
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const double from = axis.X(steps[i].first);
      const bool last = i + 1 == steps.size();
      const double to = last ? axis.left + axis.width : axis.X(steps[i + 1].first);
      const double value = steps[i].second;
      Line(canvas, {from, y(value)}, {to, y(value)}, colour, 2);
      if (!last) Line(canvas, {to, y(value)}, {to, y(steps[i + 1].second)}, colour, 2);
    }
  };
  draw(curve.behind, curve.behind_colour);
  draw(curve.steps, curve.colour);
}

void DrawAxis(const Axis& axis, int top, int bottom, Image& image) {
  cv::Mat canvas = Canvas(image);
  constexpr double kTick_px = 80;
  const double step = NiceStep(axis.end_s * kTick_px / axis.width);
  TextStyle centre = kLabel;
  centre.anchor = Anchor::kCentre;
  for (int k = 0; k * step <= axis.end_s * (1 + 1e-9); ++k) {
    const double x = axis.X(k * step);
    Line(canvas, {x, static_cast<double>(top)}, {x, static_cast<double>(bottom)}, kPale, 1);
    DrawText(image, x, bottom + 16, NumberText(k * step), centre);
  }
  DrawText(image, axis.left + axis.width / 2, bottom + 36, "simulated time [s]", centre);
}

}  // namespace

Image DrawTimeline(const Timeline& timeline) {
  const TextStyle title{.cap_px = 14, .colour = kInk, .bold = true};
  const TextStyle note{.cap_px = 10, .colour = kGrey};
  const std::vector<std::string> notes = Wrapped(timeline.notes, kWidth - 2 * kMargin, note);
  const int head = kMargin + 24 + 20 * static_cast<int>(notes.size());
  const int rows = static_cast<int>(timeline.rows.size()) * (kRow + kGap);
  const int body = rows + (timeline.curve ? kCurve + kGap : 0);
  constexpr std::size_t kKeys = 5;  // a line of the legend
  const int legend = 22 * static_cast<int>((timeline.legend.size() + kKeys - 1) / kKeys);
  Image image = GreyImage(kWidth, head + body + kAxis + legend + kMargin, 255);
  DrawText(image, kMargin, kMargin + 12, timeline.title, title);
  for (std::size_t i = 0; i < notes.size(); ++i)
    DrawText(image, kMargin, kMargin + 34 + 20 * static_cast<double>(i), notes[i], note);
  const double left = kMargin + LongestName(timeline) + 12;
  const Axis axis{left, kWidth - kMargin - left, std::max(timeline.end_s, 1e-9)};
  DrawAxis(axis, head, head + body, image);
  TextStyle name = kLabel;
  name.anchor = Anchor::kRight;
  int top = head;
  for (const TimelineRow& row : timeline.rows) {
    DrawText(image, left - 8, top + 0.5 * kRow + 5, row.name, name);
    DrawSpans(row, axis, top, kRow, true, image);
    top += kRow + kGap;
  }
  if (timeline.curve) {
    DrawText(image, left - 8, top + 0.5 * kCurve + 5, timeline.curve->name, name);
    DrawCurve(*timeline.curve, axis, top, image);
    top += kCurve + kGap;
  }
  for (std::size_t k = 0; k < timeline.legend.size(); ++k) {
    const auto& [text, colour] = timeline.legend[k];
    const int x = static_cast<int>(left + static_cast<double>(k % kKeys) * axis.width / kKeys);
    const int y = top + kAxis + 22 * static_cast<int>(k / kKeys);
    FillRectangle(image, x, y, x + 14, y + 14, colour, 1);
    DrawText(image, x + 20, y + 11.5, text, kLabel);
  }
  return image;
}

void DrawTimelineStrip(const Timeline& timeline, double t_s, Image& frame) {
  const auto rows = std::ranges::count_if(timeline.rows, &TimelineRow::in_film);
  if (rows == 0) return;
  const double unit = std::max(9.0, frame.height / 44.0);
  const int bottom = RowsOf(frame).bottom, height = static_cast<int>(0.8 * unit);
  const int strip = static_cast<int>(rows) * (height + 2) + 4;
  const TextStyle style{.cap_px = 0.5 * unit, .colour = kWhite};
  double name_px = 0;
  for (const TimelineRow& row : timeline.rows)
    if (row.in_film) name_px = std::max(name_px, TextWidth(row.name, style));
  const double left = 2 * unit + name_px;
  const Axis axis{left, frame.width - unit - left, std::max(timeline.end_s, 1e-9)};
  FillRectangle(frame, 0, bottom - strip, frame.width, bottom, {18, 24, 32}, 0.72);
  int top = bottom - strip + 3;
  for (const TimelineRow& row : timeline.rows) {
    if (!row.in_film) continue;
    DrawText(frame, unit, top + 0.5 * height + 0.5 * style.cap_px, row.name, style);
    DrawSpans(row, axis, top, height, false, frame);
    top += height + 2;
  }
  const int x = static_cast<int>(axis.X(t_s));
  FillRectangle(frame, x - 1, bottom - strip, x + 2, bottom, kWhite, 1);
}

}  // namespace floorproof

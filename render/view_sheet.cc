// SPDX-License-Identifier: Apache-2.0
#include "render/view_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/quantity.h"
#include "render/strokes.h"
#include "render/view_strokes.h"

namespace floorproof {
namespace {

constexpr int kMargin_px = 36, kHead_px = 104, kGap_px = 48, kTitle_px = 34, kFoot_px = 74;
constexpr int kTarget_px = 1060;  // of the two longer sides that stand side by side
constexpr int kFigures_px = 500;  // the least width of the free corner
constexpr int kRow_px = 25;       // of figures and remarks
constexpr TextStyle kSheetTitle = {.cap_px = 20, .colour = kInk, .bold = true},
                    kSubtitle = {.cap_px = 11, .colour = kGrey},
                    kViewTitle = {.cap_px = 12, .colour = kGrey, .bold = true},
                    kFigure = {.cap_px = 11, .colour = kInk},
                    kFigureName = {.cap_px = 11, .colour = kGrey};

struct Extent {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = Vec2::Constant(-std::numeric_limits<double>::infinity());
  void Hold(const Vec2& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Vec2 size() const { return high - low; }
};

Extent ExtentOf(const View& view) {
  Extent extent;
  for (const ViewShape& shape : view.shapes)
    for (const Vec2& p : shape.outline) extent.Hold(p);
  for (const ViewLine& line : view.lines)
    for (const Vec2& p : line.points) extent.Hold(p);
  if (view.floor) extent.Hold({extent.low.x(), 0});
  return extent;
}

// What dimensions need on each side, px.
struct Rows {
  int below = 0, above = 0, right = 0, left = 0;
};

constexpr int kHatch_px = 12;  // the floor's

int RowsBelow(const View& view, int row) {
  return row * kDimensionRow_px + (view.floor ? kHatch_px : 0);
}

Rows RowsOf(const View& view) {
  Rows rows;
  const auto hold = [](int& side, int px) { side = std::max(side, px); };
  for (const ViewDimension& d : view.dimensions) {
    const int row = std::abs(d.row);
    if (d.along_x)
      hold(d.row > 0 ? rows.below : rows.above,
           d.row > 0 ? RowsBelow(view, row) : row * kDimensionRow_px);
    else
      hold(d.row > 0 ? rows.right : rows.left, row * kDimensionColumn_px);
  }
  return rows;
}

// A view's frame on the sheet, its dimensions included.
struct Placed {
  Extent extent;
  Rows rows;
  double px_per_m = 1;
  int x = 0, y = 0;  // of the extent's upper left corner

  int width() const { return static_cast<int>(std::ceil(extent.size().x() * px_per_m)); }
  int height() const { return static_cast<int>(std::ceil(extent.size().y() * px_per_m)); }
  cv::Point2d Pixel(const Vec2& p) const {
    return {x + (p.x() - extent.low.x()) * px_per_m, y + (extent.high.y() - p.y()) * px_per_m};
  }
};

void DrawLines(Image& image, const View& view, const Placed& at) {
  cv::Mat canvas = Canvas(image);
  for (const ViewLine& line : view.lines) {
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const cv::Point2d a = at.Pixel(line.points[i - 1]), b = at.Pixel(line.points[i]);
      if (line.dashed)
        Dashes(canvas, a, b, line.colour, 2, 9, 15);
      else
        Line(canvas, a, b, line.colour, 2);
    }
    if (line.label.empty()) continue;
    const cv::Point2d end = at.Pixel(line.points.back());
    DrawText(image, end.x - 4, end.y - 6, line.label,
             {.cap_px = 10, .colour = line.colour, .anchor = Anchor::kRight});
  }
}

void DrawDimensions(Image& image, const View& view, const Placed& at) {
  constexpr int kFirst_px = 24;  // from the view to the first column
  for (const ViewDimension& d : view.dimensions) {
    const int row = std::abs(d.row);
    const double column_px = kFirst_px + (row - 1) * kDimensionColumn_px;
    double level = at.y - row * kDimensionRow_px;
    if (d.along_x && d.row > 0) level = at.y + at.height() + RowsBelow(view, row) - kHatch_px / 2;
    if (!d.along_x) level = d.row > 0 ? at.x + at.width() + column_px : at.x - column_px;
    DrawDimension(image, at.Pixel(d.a), at.Pixel(d.b), d.along_x, level, d.text);
  }
}

void DrawView(Image& image, const View& view, const Placed& at) {
  DrawText(image, at.x - at.rows.left, at.y - at.rows.above - 18, view.title, kViewTitle);
  if (view.floor) HatchFloor(image, at.x - 16, at.x + at.width() + 16, at.Pixel({0, 0}).y);
  for (const ViewShape& shape : view.shapes) {
    std::vector<cv::Point2d> points;
    for (const Vec2& p : shape.outline) points.push_back(at.Pixel(p));
    FillShape(image, points, shape.fill, shape.alpha);
  }
  DrawLines(image, view, at);
  DrawDimensions(image, view, at);
  for (const ViewMark& mark : view.marks)
    DrawViewMark(image, at.Pixel(mark.at), mark.kind, mark.colour);
  for (const ViewNote& note : view.notes)
    DrawLabel(image, at.Pixel(note.at), note.text, note.colour);
}

// Returns where it ends.
int DrawScaleBar(Image& image, double px_per_m, int x, int y) {
  constexpr double kAimed_px = 120;
  const double length_m = NiceStep(kAimed_px / px_per_m);
  const double end = x + length_m * px_per_m;
  cv::Mat canvas = Canvas(image);
  Line(canvas, cv::Point2d(x, y), {end, static_cast<double>(y)}, kInk, 3);
  for (const double at : {static_cast<double>(x), end})
    Line(canvas, {at, y - 6.0}, {at, y + 6.0}, kInk, 2);
  DrawText(image, end + 12, y + 5, LengthText(length_m), kFigure);
  return static_cast<int>(end + 12 + TextWidth(LengthText(length_m), kFigure));
}

void DrawKeys(Image& image, const std::vector<SheetKey>& keys, int x, int y, int right) {
  constexpr int kSwatch_px = 40, kBetween_px = 28;
  const int left = x;
  for (const SheetKey& key : keys) {
    const int width = kSwatch_px + static_cast<int>(TextWidth(key.label, kFigure)) + kBetween_px;
    if (x + width > right && x > left) {
      x = left;
      y += kRow_px;
    }
    cv::Mat canvas = Canvas(image);
    if (key.line && key.dashed)
      Dashes(canvas, cv::Point2d(x, y), cv::Point2d(x + 28, y), key.colour, 2, 9, 15);
    else if (key.line)
      Line(canvas, cv::Point2d(x, y), cv::Point2d(x + 28, y), key.colour, 2);
    else
      DrawViewMark(image, cv::Point2d(x + 14, y), key.mark, key.colour);
    DrawText(image, x + kSwatch_px, y + 5, key.label, kFigure);
    x += width;
  }
}

// As many words a line as fit.
std::vector<std::string> Wrapped(const std::string& text, double width_px) {
  std::vector<std::string> lines(1);
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    std::string& line = lines.back();
    const std::string longer = line.empty() ? word : line + " " + word;
    if (!line.empty() && TextWidth(longer, kFigure) > width_px)
      lines.push_back("  " + word);
    else
      line = longer;
    at = end + 1;
  }
  return lines;
}

struct Corner {
  std::vector<std::string> remarks;  // wrapped
  double name_px = 0;
  int width = 0, height = 0;
};

Corner CornerOf(const ViewSheet& sheet, int room_px) {
  Corner corner;
  double value_px = 0;
  for (const auto& [name, value] : sheet.figures) {
    corner.name_px = std::max(corner.name_px, TextWidth(name, kFigureName));
    value_px = std::max(value_px, TextWidth(value, kFigure));
  }
  corner.width = std::max({room_px, kFigures_px, static_cast<int>(corner.name_px + value_px) + 40});
  for (const std::string& remark : sheet.remarks)
    for (std::string& line : Wrapped(remark, corner.width)) corner.remarks.push_back(line);
  corner.height = kRow_px * static_cast<int>(sheet.figures.size() + corner.remarks.size() + 1);
  return corner;
}

void DrawCorner(Image& image, const ViewSheet& sheet, const Corner& corner, int x, int y) {
  for (const auto& [name, value] : sheet.figures) {
    DrawText(image, x, y, name, kFigureName);
    DrawText(image, x + corner.name_px + 24, y, value, kFigure);
    y += kRow_px;
  }
  y += kRow_px / 2;
  for (const std::string& line : corner.remarks) {
    DrawText(image, x, y, line, kFigure);
    y += kRow_px;
  }
}

}  // namespace

Image DrawViewSheet(const ViewSheet& sheet) {
  Placed top{ExtentOf(sheet.top), RowsOf(sheet.top)},
      side{ExtentOf(sheet.side), RowsOf(sheet.side)},
      front{ExtentOf(sheet.front), RowsOf(sheet.front)};
  // Top and side share their left and right.
  for (Placed* one : {&top, &side}) {
    const double low = std::min(top.extent.low.x(), side.extent.low.x());
    const double high = std::max(top.extent.high.x(), side.extent.high.x());
    one->extent.low.x() = low;
    one->extent.high.x() = high;
  }
  const double scale = kTarget_px / (top.extent.size().x() + front.extent.size().x());
  for (Placed* one : {&top, &side, &front}) one->px_per_m = scale;
  const int left = std::max(top.rows.left, side.rows.left);
  const int right = std::max(top.rows.right, side.rows.right);
  const int second_x = kMargin_px + left + top.width() + right + kGap_px;
  top.x = side.x = kMargin_px + left;
  front.x = second_x + front.rows.left;
  const int front_px = (front.rows.left + front.rows.right) + front.width();
  const Corner corner = CornerOf(sheet, front_px);
  top.y = kHead_px + kTitle_px + top.rows.above;
  const int top_end =
      std::max(top.y + top.height() + top.rows.below, kHead_px + kTitle_px + corner.height);
  const int above = std::max(side.rows.above, front.rows.above);
  const double high = std::max(side.extent.high.y(), front.extent.high.y());
  side.extent.high.y() = front.extent.high.y() = high;
  side.y = front.y = top_end + kGap_px + kTitle_px + above;
  const int below = std::max(side.rows.below, front.rows.below);
  const int end = side.y + std::max(side.height(), front.height()) + below + kGap_px / 2;
  const int width = second_x + std::max(corner.width, front_px) + kMargin_px;
  Image image = GreyImage(width, end + kFoot_px, 255);
  DrawText(image, kMargin_px, 50, sheet.title, kSheetTitle);
  DrawText(image, kMargin_px, 76, sheet.subtitle, kSubtitle);
  DrawView(image, sheet.top, top);
  DrawView(image, sheet.side, side);
  DrawView(image, sheet.front, front);
  DrawCorner(image, sheet, corner, second_x, kHead_px + kTitle_px);
  const int keys_x = DrawScaleBar(image, scale, kMargin_px, end + 22) + kGap_px;
  DrawKeys(image, sheet.keys, keys_x, end + 22, width - kMargin_px);
  return image;
}

}  // namespace floorproof

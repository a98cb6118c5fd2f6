// SPDX-License-Identifier: Apache-2.0
#include "render/heatmap_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/quantity.h"
#include "render/hazard_looks.h"
#include "render/strokes.h"

namespace floorproof {
namespace {

constexpr Rgb kUnknown = {214, 217, 221}, kHatch = {190, 194, 200};
// Paths in blue and orange, which every eye tells apart from each other and from walls.
constexpr Rgb kPath = {0, 114, 178}, kDriven = {240, 136, 0}, kStart = {20, 150, 90},
              kEnd = {190, 20, 120};
constexpr double kThick_px = 12, kCased_px = 20;  // apart: there is room for such lines
constexpr std::array<Rgb, 7> kSeries = {{{200, 20, 40},
                                         {120, 40, 180},
                                         {230, 110, 0},
                                         {0, 110, 190},
                                         {60, 60, 60},
                                         {214, 39, 140},
                                         {120, 80, 20}}};
constexpr std::array<int, kSeries.size()> kMarks = {
    cv::MARKER_TILTED_CROSS, cv::MARKER_TRIANGLE_UP,   cv::MARKER_DIAMOND, cv::MARKER_SQUARE,
    cv::MARKER_STAR,         cv::MARKER_TRIANGLE_DOWN, cv::MARKER_CROSS};

// A name's number by order of appearance.
std::size_t NumberOf(std::vector<std::string>& seen, const std::string& name) {
  const auto at = std::find(seen.begin(), seen.end(), name);
  if (at != seen.end()) return static_cast<std::size_t>(at - seen.begin());
  seen.push_back(name);
  return seen.size() - 1;
}

void AddOnce(std::vector<LegendLine>& legend, const LegendLine& line) {
  for (const LegendLine& l : legend)
    if (l.label == line.label && l.kind == line.kind) return;
  legend.push_back(line);
}

// How far the lines of a plan lie apart that covers all free floor, m.
double ApartOf(const HazardMap& map, const Path& plan) {
  const auto free = std::ranges::count(map.occupancy.cells, CellState::kFree);
  return static_cast<double>(free) * map.frame.cell_m * map.frame.cell_m / Length(plan);
}

// Of strokes, px; 0: none. A plan shows on both sides of what was driven along it.
struct Widths {
  int casing, plan, driven;
};
Widths WidthsOf(const HazardMap& map, const HeatMapOptions& options, const PanelFrame& frame) {
  const double apart_px = options.plan != nullptr && options.plan->size() > 1
                              ? ApartOf(map, *options.plan) * frame.px_per_m()
                              : kCased_px;
  const bool driven = !options.driven.empty();
  if (apart_px >= kCased_px) return driven ? Widths{9, 7, 3} : Widths{5, 3, 3};
  if (apart_px >= kThick_px) return driven ? Widths{0, 5, 2} : Widths{0, 2, 2};
  return driven && apart_px >= kThick_px / 2 ? Widths{0, 3, 1} : Widths{0, 1 + driven, 1};
}

void Polylines(cv::Mat& canvas, const std::vector<std::vector<Vec2>>& lines,
               const PanelFrame& frame, const Rgb& colour, int px) {
  for (const std::vector<Vec2>& line : lines)
    for (std::size_t i = 1; i < line.size(); ++i)
      Line(canvas, frame.Pixel(line[i - 1]), frame.Pixel(line[i]), colour, px);
}

std::string CellText(float value) { return NumberText(static_cast<double>(value), 6); }
double Luma(const Rgb& c) { return 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2]; }

// The upper or the lower left corner of a cell, `reach_px` from its middle: the one where less is
// drawn over the cell's colour. The right corners are not used, because the numbers of neighbours
// would read as one.
cv::Rect FreerCorner(const Image& image, const cv::Point2d& middle, double reach_px,
                     const cv::Size& size, const Rgb& cell) {
  const auto drawn = [&](const cv::Rect& box) {
    int n = 0;
    for (int y = std::max(0, box.y); y < std::min(image.height, box.br().y); ++y)
      for (int x = std::max(0, box.x); x < std::min(image.width, box.br().x); ++x)
        n += !std::equal(cell.begin(), cell.end(),
                         image.data.data() + 3 * (static_cast<std::size_t>(y) * image.width + x));
    return n;
  };
  const auto left = static_cast<int>(std::lround(middle.x - reach_px)),
             top = static_cast<int>(std::lround(middle.y - reach_px)),
             bottom = static_cast<int>(std::lround(middle.y + reach_px)) - size.height;
  const cv::Rect upper({left, top}, size), lower({left, bottom}, size);
  return drawn(lower) < drawn(upper) ? lower : upper;
}

}  // namespace

void HazardDashes(cv::Mat& image, const cv::Point2d& a, const cv::Point2d& b, const Rgb& colour) {
  Dashes(image, a, b, colour, 2, 7, 12);
}

void StartMark(cv::Mat& image, const cv::Point2d& p) {
  Disc(image, p, 7, kWhite);
  Disc(image, p, 5, kStart);
}
void EndMark(cv::Mat& image, const cv::Point2d& p) {
  Disc(image, p, 11, kWhite);
  Ring(image, p, 8.5, kEnd, 3);
}

void Mark(cv::Mat& image, const cv::Point2d& at, const Rgb& colour, int mark) {
  constexpr double kReach_px = 24;
  if (!(std::abs(at.x - 0.5 * image.cols) < 0.5 * image.cols + kReach_px &&
        std::abs(at.y - 0.5 * image.rows) < 0.5 * image.rows + kReach_px))
    return;  // off the picture, and perhaps beyond whole numbers
  const cv::Point p = at;
  cv::drawMarker(image, p, Colour(kWhite), mark, 17, 6, cv::LINE_AA);
  cv::drawMarker(image, p, Colour(colour), mark, 15, 2, cv::LINE_AA);
}

void RingMark(cv::Mat& image, const cv::Point2d& middle, double radius_px, double dot_px,
              const Rgb& colour) {
  Ring(image, middle, radius_px, kWhite, 5);
  Ring(image, middle, radius_px, colour, 2);
  Disc(image, middle, dot_px + 2, kWhite);
  Disc(image, middle, dot_px, colour);
}

HeatCategory CellsOf(HazardClass hazard_class) {
  constexpr std::array<const char*, 4> kNames = {"C1 blind object", "C2 glass", "C3 level change",
                                                 "C4 terrain"};
  return {kNames[static_cast<std::size_t>(hazard_class)],
          MixColours(HazardClassColour(hazard_class), kWhite, 0.6)};
}

void DrawPaths(const HazardMap& map, const HeatMapOptions& options, const PanelFrame& frame,
               HeatPanel& panel) {
  cv::Mat canvas = Canvas(panel.image);
  const Path* plan = options.plan;
  const Widths widths = WidthsOf(map, options, frame);
  std::vector<std::vector<Vec2>> planned;
  if (plan != nullptr && plan->size() > 1) {
    planned.emplace_back();
    for (const Waypoint& waypoint : *plan) planned.back().push_back(waypoint.p_W);
  }
  if (widths.casing > 0) Polylines(canvas, planned, frame, kWhite, widths.casing);
  Polylines(canvas, planned, frame, kPath, widths.plan);
  Polylines(canvas, options.driven, frame, kDriven, widths.driven);
  if (!planned.empty())
    panel.legend.push_back({LegendLine::Kind::kLine, "plan", kPath, widths.plan});
  if (!options.driven.empty())
    panel.legend.push_back({LegendLine::Kind::kLine, "driven", kDriven, widths.driven});
  if (plan != nullptr && !plan->empty()) {
    EndMark(canvas, frame.Pixel(plan->back().p_W));
    panel.legend.push_back({LegendLine::Kind::kEnd, "end of the plan"});
  }
  if (map.start) {
    StartMark(canvas, frame.Pixel(map.start->p()));
    panel.legend.push_back({LegendLine::Kind::kStart, "start"});
  }
}

void DrawHazards(const HazardMap& map, const PanelFrame& frame, HeatPanel& panel) {
  cv::Mat canvas = Canvas(panel.image);
  const std::vector<HazardLook> looks = HazardLooks(map);
  std::vector<LegendLine> legend;
  for (std::size_t h = 0; h < looks.size(); ++h) {
    const Hazard& hazard = map.hazards[h];
    const auto& [colour, label] = looks[h];
    for (const Polygon& polygon : hazard.footprint) {
      for (const bool casing : {true, false}) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
          const auto a = frame.Pixel(polygon[i]),
                     b = frame.Pixel(polygon[(i + 1) % polygon.size()]);
          if (casing) {
            Line(canvas, a, b, kWhite, 5);
          } else if (hazard.known) {
            Line(canvas, a, b, colour, 2);
          } else {
            HazardDashes(canvas, a, b, colour);
          }
        }
      }
    }
    AddOnce(legend,
            {hazard.known ? LegendLine::Kind::kOutline : LegendLine::Kind::kDashed, label, colour});
  }
  std::ranges::stable_sort(legend, {}, &LegendLine::label);
  panel.legend.insert(panel.legend.end(), legend.begin(), legend.end());
}

void DrawOutlines(const HeatMapOptions& options, const PanelFrame& frame, HeatPanel& panel) {
  cv::Mat canvas = Canvas(panel.image);
  for (const HeatOutline& outline : options.outlines) {
    for (std::size_t i = 0; i < outline.p_W.size(); ++i)
      Line(canvas, frame.Pixel(outline.p_W[i]),
           frame.Pixel(outline.p_W[(i + 1) % outline.p_W.size()]), outline.colour, 2);
    AddOnce(panel.legend, {LegendLine::Kind::kOutline, outline.label, outline.colour});
  }
}

void DrawRings(const HeatMapOptions& options, const PanelFrame& frame, HeatPanel& panel) {
  cv::Mat canvas = Canvas(panel.image);
  for (const HeatRing& ring : options.rings) {
    RingMark(canvas, frame.Pixel(ring.p_W), ring.radius_m * frame.px_per_m(), 6, ring.colour);
    AddOnce(panel.legend, {LegendLine::Kind::kRing, ring.label, ring.colour});
  }
}

void DrawPoints(const HeatMapOptions& options, const PanelFrame& frame, HeatPanel& panel) {
  cv::Mat canvas = Canvas(panel.image);
  std::vector<std::string> series = options.series;
  for (const HeatPoint& point : options.points) {
    const std::size_t i = NumberOf(series, point.series);
    const Rgb& colour = kSeries[i % kSeries.size()];
    const int mark = kMarks[i % kMarks.size()];
    Mark(canvas, frame.Pixel(point.p_W), colour, mark);
    std::string label = point.series;
    std::replace(label.begin(), label.end(), '_', ' ');
    AddOnce(panel.legend, {LegendLine::Kind::kMark, label, colour, 1, mark});
  }
}

void DrawNumbers(const HeatValues& values, const PanelFrame& frame, HeatPanel& panel) {
  constexpr double kLeastCell_px = 24;
  const double cell_px = values.frame.cell_m * frame.px_per_m();
  if (cell_px < kLeastCell_px) return;
  const double pad = std::max(2.0, 0.06 * cell_px);
  TextStyle style{.cap_px = std::clamp(0.24 * cell_px, 8.0, 14.0)};
  for (const float value : values.values.cells)
    if (std::isfinite(value) && TextWidth(CellText(value), style) + 2 * pad > cell_px) return;
  for (int iy = 0; iy < values.values.height; ++iy)
    for (int ix = 0; ix < values.values.width; ++ix) {
      const float value = values.values(ix, iy);
      if (!std::isfinite(value)) continue;
      const std::string text = CellText(value);
      const Rgb under = panel.ColourOf(value);
      const cv::Rect box = FreerCorner(
          panel.image, frame.Pixel(values.frame.Center(ix, iy)), 0.5 * cell_px - pad,
          {static_cast<int>(std::ceil(TextWidth(text, style))), static_cast<int>(style.cap_px) + 1},
          under);
      FillRectangle(panel.image, box.x - 1, box.y - 1, box.br().x + 1, box.br().y + 1, under, 1);
      style.colour = Luma(under) < 115 ? kWhite : kInk;
      DrawText(panel.image, box.x, box.br().y, text, style);
    }
}

Rgb HatchedAt(int x, int y) { return (x + y) % 9 < 2 ? kHatch : kUnknown; }

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "render/heatmap_panel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace floorproof {
namespace {

constexpr Rgb kWall = {52, 60, 72}, kFree = {238, 240, 243}, kUnknown = {214, 217, 221};
constexpr Rgb kHatch = {190, 194, 200}, kPath = {70, 78, 90}, kStart = {20, 150, 90};
// Chosen to stand out from viridis, inferno and cividis, inside a white casing.
constexpr std::array<Rgb, 6> kHazards = {
    {{214, 39, 40}, {230, 70, 190}, {255, 127, 14}, {20, 110, 220}, {120, 70, 30}, {0, 150, 150}}};
constexpr std::array<Rgb, 5> kSeries = {
    {{200, 20, 40}, {120, 40, 180}, {230, 110, 0}, {0, 110, 190}, {60, 60, 60}}};
constexpr std::array<int, 5> kMarks = {cv::MARKER_TILTED_CROSS, cv::MARKER_TRIANGLE_UP,
                                       cv::MARKER_DIAMOND, cv::MARKER_SQUARE, cv::MARKER_STAR};
constexpr int kLong_px = 1160;  // the longer side aimed at

cv::Scalar Colour(const Rgb& c) { return {1.0 * c[0], 1.0 * c[1], 1.0 * c[2]}; }

// Part of the map's grid, in cells.
struct Window {
  int x0, y0, x1, y1;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
};

// What is worth showing: known cells, hazards and points, and some cells around.
Window KnownWindow(const HazardMap& map, const HeatMapOptions& options) {
  Window w = {map.frame.width, map.frame.height, 0, 0};
  const auto include = [&](int ix, int iy) {
    w = {std::min(w.x0, ix), std::min(w.y0, iy), std::max(w.x1, ix + 1), std::max(w.y1, iy + 1)};
  };
  for (int iy = 0; iy < map.cells.height; ++iy)
    for (int ix = 0; ix < map.cells.width; ++ix)
      if (map.cells(ix, iy) != CellState::kUnknown) include(ix, iy);
  const auto include_point = [&](const Vec2& p_W) {
    const Cell c = map.frame.ToCell(p_W);
    include(std::clamp(c.ix, 0, map.frame.width - 1), std::clamp(c.iy, 0, map.frame.height - 1));
  };
  for (const Hazard& hazard : map.hazards)
    for (const Polygon& polygon : hazard.footprint)
      for (const Vec2& p_W : polygon) include_point(p_W);
  for (const HeatPoint& point : options.points) include_point(point.p_W);
  if (w.x1 <= w.x0) return {0, 0, map.frame.width, map.frame.height};
  const int margin = std::max(w.width(), w.height()) / 50;
  return {std::max(0, w.x0 - margin), std::max(0, w.y0 - margin),
          std::min(map.frame.width, w.x1 + margin), std::min(map.frame.height, w.y1 + margin)};
}

// Pixels of the panel and metres in the map's frame G and the world.
class PanelFrame {
 public:
  PanelFrame(const GridFrame& frame, const Window& window) : frame_(frame), window_(window) {
    const int cells = std::max(window.width(), window.height());
    // Whole pixels a cell while there are enough, so that cells keep their edges.
    scale_ =
        cells <= kLong_px ? std::max(1, kLong_px / cells) : static_cast<double>(kLong_px) / cells;
    if (cells <= kLong_px && scale_ * cells < 700) scale_ = static_cast<double>(kLong_px) / cells;
    width = std::max(1, static_cast<int>(std::lround(scale_ * window.width())));
    height = std::max(1, static_cast<int>(std::lround(scale_ * window.height())));
  }
  double px_per_m() const { return scale_ / frame_.cell_m; }
  // Cells under a pixel's row or column, [first, last], counted from the map's lower left.
  std::array<int, 2> Columns(int column) const {
    return Span(window_.x0 + column / scale_, window_.x1);
  }
  std::array<int, 2> Rows(int row) const {
    return Span(window_.y0 + (height - 1 - row) / scale_, window_.y1);
  }
  cv::Point2d Pixel(const Vec2& p_W) const {
    const Vec2 p_G = frame_.X_WG.Inverse() * p_W / frame_.cell_m;
    return {(p_G.x() - window_.x0) * scale_, height - (p_G.y() - window_.y0) * scale_};
  }
  Vec2 World(double x_px, double y_px) const {
    return frame_.X_WG * Vec2(frame_.cell_m * Vec2(window_.x0 + x_px / scale_,
                                                   window_.y0 + (height - y_px) / scale_));
  }
  int width, height;

 private:
  std::array<int, 2> Span(double first, int end) const {
    const int a = std::min(end - 1, static_cast<int>(std::floor(first + 1e-9)));
    const int b = static_cast<int>(std::ceil(first + 1 / scale_ - 1e-9)) - 1;
    return {a, std::clamp(b, a, end - 1)};
  }
  const GridFrame& frame_;
  Window window_;
  double scale_;
};

CellState Under(const HazardMap& map, const std::array<int, 2>& xs, const std::array<int, 2>& ys) {
  CellState found = CellState::kUnknown;
  for (int iy = ys[0]; iy <= ys[1]; ++iy) {
    for (int ix = xs[0]; ix <= xs[1]; ++ix) {
      const CellState s = map.cells(ix, iy);
      if (s == CellState::kOccupied) return s;
      if (s == CellState::kFree) found = s;
    }
  }
  return found;
}

// The mean of the finite values on the ground of one pixel, or the value at its middle.
class ValueSampler {
 public:
  ValueSampler(const HeatValues& values, const PanelFrame& panel, bool mean)
      : values_(values), panel_(panel) {
    const double cells_a_pixel = 1 / (panel.px_per_m() * values.frame.cell_m);
    reach_ = mean ? std::max(1, static_cast<int>(std::lround(cells_a_pixel))) : 1;
  }
  float At(int column, int row) const {
    const Cell c = values_.frame.ToCell(panel_.World(column + 0.5, row + 0.5));
    double sum = 0;
    int n = 0;
    for (int iy = c.iy - (reach_ - 1) / 2; iy <= c.iy + reach_ / 2; ++iy) {
      for (int ix = c.ix - (reach_ - 1) / 2; ix <= c.ix + reach_ / 2; ++ix) {
        if (!values_.values.Inside(ix, iy) || !std::isfinite(values_.values(ix, iy))) continue;
        sum += values_.values(ix, iy);
        ++n;
      }
    }
    return n == 0 ? HeatValues::kNone : static_cast<float>(sum / n);
  }

 private:
  const HeatValues& values_;
  const PanelFrame& panel_;
  int reach_;
};

HeatRange RangeOf(const HeatValues* values, const HeatMapOptions& options) {
  HeatRange range = {std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity()};
  if (values != nullptr) {
    for (const float v : values->values.cells) {
      if (!std::isfinite(v)) continue;
      range.low = std::min<double>(range.low, v);
      range.high = std::max<double>(range.high, v);
    }
  }
  if (range.low > range.high) range = {0, 1};
  range = {options.low.value_or(range.low), options.high.value_or(range.high)};
  if (!(range.high > range.low)) range.high = range.low + 1;
  return range;
}

// Map and values, pixel by pixel. Walls lie over values: a planner's grid may reach into them.
void DrawCells(const HazardMap& map, const HeatValues* values, const HeatMapOptions& options,
               const PanelFrame& frame, HeatPanel& panel) {
  const auto colours = Colours(options.colour_map);
  const bool named = !options.categories.empty();
  std::optional<ValueSampler> sampler;
  if (values != nullptr) sampler.emplace(*values, frame, !named);
  std::vector<bool> used(options.categories.size());
  bool walls = false, unknown = false;
  for (int row = 0; row < frame.height; ++row) {
    auto* pixel = panel.image.ptr<cv::Vec3b>(row);
    const auto ys = frame.Rows(row);
    for (int column = 0; column < frame.width; ++column) {
      const CellState state = Under(map, frame.Columns(column), ys);
      Rgb colour = kFree;
      if (state == CellState::kOccupied) {
        colour = kWall;
        walls = true;
      } else if (state == CellState::kUnknown) {
        colour = (column + row) % 9 < 2 ? kHatch : kUnknown;
        unknown = true;
      }
      const float v =
          sampler && state != CellState::kOccupied ? sampler->At(column, row) : HeatValues::kNone;
      if (std::isfinite(v) && named) {
        const auto last = static_cast<long>(options.categories.size()) - 1;
        const auto i = static_cast<std::size_t>(std::clamp(std::lround(v), 0L, last));
        colour = options.categories[i].colour;
        used[i] = true;
      } else if (std::isfinite(v)) {
        const double share = (v - panel.range.low) / (panel.range.high - panel.range.low);
        colour = colours[static_cast<std::size_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)))];
      }
      pixel[column] = {colour[0], colour[1], colour[2]};
    }
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) {
      panel.legend.push_back(
          {LegendLine::Kind::kArea, options.categories[i].label, options.categories[i].colour});
    }
  }
  if (walls) panel.legend.push_back({LegendLine::Kind::kArea, "wall, furniture", kWall});
  if (unknown) panel.legend.push_back({LegendLine::Kind::kHatched, "unknown", kUnknown});
}

constexpr int kShift = 4;  // of OpenCV's fixed-point coordinates
cv::Point Fixed(const cv::Point2d& p) {
  return {static_cast<int>(std::lround(p.x * (1 << kShift))),
          static_cast<int>(std::lround(p.y * (1 << kShift)))};
}
void Line(cv::Mat& image, const cv::Point2d& a, const cv::Point2d& b, const Rgb& colour, int px) {
  cv::line(image, Fixed(a), Fixed(b), Colour(colour), px, cv::LINE_AA, kShift);
}
void Dashes(cv::Mat& image, const cv::Point2d& a, const cv::Point2d& b, const Rgb& colour, int px) {
  constexpr double kDash_px = 7, kPeriod_px = 12;
  const cv::Point2d d = b - a;
  const double length = std::hypot(d.x, d.y);
  for (double s = 0; s < length; s += kPeriod_px) {
    Line(image, a + d * (s / length), a + d * (std::min(s + kDash_px, length) / length), colour,
         px);
  }
}

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

void DrawHazards(const HazardMap& map, const PanelFrame& frame, HeatPanel& panel) {
  std::vector<std::string> types;
  for (const Hazard& hazard : map.hazards) {
    const Rgb& colour = kHazards[NumberOf(types, hazard.type) % kHazards.size()];
    for (const Polygon& polygon : hazard.footprint) {
      for (const bool casing : {true, false}) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
          const auto a = frame.Pixel(polygon[i]),
                     b = frame.Pixel(polygon[(i + 1) % polygon.size()]);
          if (casing) {
            Line(panel.image, a, b, {255, 255, 255}, 4);
          } else if (hazard.known) {
            Line(panel.image, a, b, colour, 2);
          } else {
            Dashes(panel.image, a, b, colour, 2);
          }
        }
      }
    }
    std::string label = hazard.type + (hazard.known ? "" : " (not on the map)");
    std::replace(label.begin(), label.end(), '_', ' ');
    AddOnce(panel.legend,
            {hazard.known ? LegendLine::Kind::kOutline : LegendLine::Kind::kDashed, label, colour});
  }
}

void DrawPlan(const HazardMap& map, const Path* plan, const PanelFrame& frame, HeatPanel& panel) {
  if (plan != nullptr && plan->size() > 1) {
    for (std::size_t i = 1; i < plan->size(); ++i) {
      Line(panel.image, frame.Pixel((*plan)[i - 1].p_W), frame.Pixel((*plan)[i].p_W), kPath, 1);
    }
    panel.legend.push_back({LegendLine::Kind::kLine, "plan", kPath});
  }
  if (!map.start) return;
  cv::circle(panel.image, Fixed(frame.Pixel(map.start->p())), 7 << kShift, {255, 255, 255},
             cv::FILLED, cv::LINE_AA, kShift);
  cv::circle(panel.image, Fixed(frame.Pixel(map.start->p())), 5 << kShift, Colour(kStart),
             cv::FILLED, cv::LINE_AA, kShift);
  panel.legend.push_back({LegendLine::Kind::kMark, "start", kStart, -1});
}

void Mark(cv::Mat& image, const cv::Point& p, const Rgb& colour, int mark) {
  if (mark < 0) {
    cv::circle(image, p, 5, Colour(colour), cv::FILLED, cv::LINE_AA);
    return;
  }
  cv::drawMarker(image, p, {255, 255, 255}, mark, 17, 6, cv::LINE_AA);
  cv::drawMarker(image, p, Colour(colour), mark, 15, 2, cv::LINE_AA);
}

void DrawPoints(const HeatMapOptions& options, const PanelFrame& frame, HeatPanel& panel) {
  std::vector<std::string> series;
  for (const HeatPoint& point : options.points) {
    const std::size_t i = NumberOf(series, point.series);
    const Rgb& colour = kSeries[i % kSeries.size()];
    const int mark = kMarks[i % kMarks.size()];
    Mark(panel.image, frame.Pixel(point.p_W), colour, mark);
    std::string label = point.series;
    std::replace(label.begin(), label.end(), '_', ' ');
    AddOnce(panel.legend, {LegendLine::Kind::kMark, label, colour, mark});
  }
}

}  // namespace

std::array<Rgb, 256> Colours(ColourMap map) {
  const int id = map == ColourMap::kViridis   ? cv::COLORMAP_VIRIDIS
                 : map == ColourMap::kInferno ? cv::COLORMAP_INFERNO
                                              : cv::COLORMAP_CIVIDIS;
  cv::Mat ramp(1, 256, CV_8U), bgr;
  for (int i = 0; i < 256; ++i) ramp.at<std::uint8_t>(i) = static_cast<std::uint8_t>(i);
  cv::applyColorMap(ramp, bgr, id);
  std::array<Rgb, 256> colours;
  for (int i = 0; i < 256; ++i) {
    const auto& c = bgr.at<cv::Vec3b>(i);
    colours[static_cast<std::size_t>(i)] = {c[2], c[1], c[0]};
  }
  return colours;
}

HeatPanel DrawPanel(const HazardMap& map, const HeatValues* values, const HeatMapOptions& options) {
  const PanelFrame frame(map.frame, KnownWindow(map, options));
  HeatPanel panel;
  panel.image.create(frame.height, frame.width, CV_8UC3);
  panel.px_per_m = frame.px_per_m();
  panel.range = RangeOf(values, options);
  DrawCells(map, values, options, frame, panel);
  DrawPlan(map, options.plan, frame, panel);
  DrawHazards(map, frame, panel);
  DrawPoints(options, frame, panel);
  return panel;
}

void DrawSwatch(cv::Mat& canvas, const cv::Rect& place, const LegendLine& line) {
  const cv::Point2d left(place.x, place.y + 0.5 * place.height),
      right(place.x + place.width, place.y + 0.5 * place.height);
  switch (line.kind) {
    case LegendLine::Kind::kArea:
      cv::rectangle(canvas, place, Colour(line.colour), cv::FILLED);
      break;
    case LegendLine::Kind::kHatched:
      for (int y = place.y; y < place.br().y; ++y)
        for (int x = place.x; x < place.br().x; ++x)
          canvas.at<cv::Vec3b>(y, x) = (x + y) % 9 < 2
                                           ? cv::Vec3b(kHatch[0], kHatch[1], kHatch[2])
                                           : cv::Vec3b(kUnknown[0], kUnknown[1], kUnknown[2]);
      break;
    case LegendLine::Kind::kOutline:
      cv::rectangle(canvas, place, Colour(line.colour), 2, cv::LINE_AA);
      break;
    case LegendLine::Kind::kDashed:
      Dashes(canvas, left, right, line.colour, 2);
      break;
    case LegendLine::Kind::kLine:
      Line(canvas, left, right, line.colour, 1);
      break;
    case LegendLine::Kind::kMark:
      Mark(canvas, (place.tl() + place.br()) / 2, line.colour, line.mark);
      break;
  }
}

}  // namespace floorproof

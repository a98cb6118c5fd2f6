// SPDX-License-Identifier: Apache-2.0
#include "render/panel_frame.h"

#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

constexpr int kLong_px = 1160;  // the longer side aimed at

}  // namespace

Window KnownWindow(const HazardMap& map, const HeatMapOptions& options) {
  Window w = {map.frame.width, map.frame.height, 0, 0};
  const auto include = [&](int ix, int iy) {
    w = {std::min(w.x0, ix), std::min(w.y0, iy), std::max(w.x1, ix + 1), std::max(w.y1, iy + 1)};
  };
  for (int iy = 0; iy < map.occupancy.height; ++iy)
    for (int ix = 0; ix < map.occupancy.width; ++ix)
      if (map.occupancy(ix, iy) != CellState::kUnknown) include(ix, iy);
  const auto include_point = [&](const Vec2& p_W) {
    const Cell c = map.frame.ToCell(p_W);
    include(std::clamp(c.ix, 0, map.frame.width - 1), std::clamp(c.iy, 0, map.frame.height - 1));
  };
  for (const Hazard& hazard : map.hazards)
    for (const Polygon& polygon : hazard.footprint)
      for (const Vec2& p_W : polygon) include_point(p_W);
  for (const HeatPoint& point : options.points) include_point(point.p_W);
  for (const HeatRing& ring : options.rings) include_point(ring.p_W);
  for (const HeatFailure& failure : options.failures) include_point(failure.p_W);
  if (w.x1 <= w.x0) return {0, 0, map.frame.width, map.frame.height};
  const int margin = std::max(w.width(), w.height()) / 50;
  return {std::max(0, w.x0 - margin), std::max(0, w.y0 - margin),
          std::min(map.frame.width, w.x1 + margin), std::min(map.frame.height, w.y1 + margin)};
}

PanelFrame::PanelFrame(const GridFrame& frame, const Window& window)
    : frame_(frame), window_(window) {
  const int cells = std::max(window.width(), window.height());
  // Whole pixels a cell while there are enough, so that cells keep their edges.
  scale_ =
      cells <= kLong_px ? std::max(1, kLong_px / cells) : static_cast<double>(kLong_px) / cells;
  if (cells <= kLong_px && scale_ * cells < 700) scale_ = static_cast<double>(kLong_px) / cells;
  TakeSize();
}

PanelFrame::PanelFrame(const GridFrame& frame, const Window& window, int most_width,
                       int most_height)
    : frame_(frame), window_(window) {
  constexpr double kRounded = 4;  // from here on whole pixels a cell cost little of the room
  scale_ = std::min(static_cast<double>(most_width) / window.width(),
                    static_cast<double>(most_height) / window.height());
  if (scale_ >= kRounded) scale_ = std::floor(scale_);
  TakeSize();
}

void PanelFrame::TakeSize() {
  width = std::max(1, static_cast<int>(std::lround(scale_ * window_.width())));
  height = std::max(1, static_cast<int>(std::lround(scale_ * window_.height())));
}

std::array<int, 2> PanelFrame::Columns(int column) const {
  return Span(window_.x0 + column / scale_, window_.x1);
}
std::array<int, 2> PanelFrame::Rows(int row) const {
  return Span(window_.y0 + (height - 1 - row) / scale_, window_.y1);
}

cv::Point2d PanelFrame::Pixel(const Vec2& p_W) const {
  const Vec2 p_G = frame_.ToGrid(p_W) / frame_.cell_m;
  return {(p_G.x() - window_.x0) * scale_, height - (p_G.y() - window_.y0) * scale_};
}
Vec2 PanelFrame::World(double x_px, double y_px) const {
  return frame_.X_WG * Vec2(frame_.cell_m * Vec2(window_.x0 + x_px / scale_,
                                                 window_.y0 + (height - y_px) / scale_));
}

std::array<int, 2> PanelFrame::Span(double first, int end) const {
  const int a = std::min(end - 1, static_cast<int>(std::floor(first + 1e-9)));
  const int b = static_cast<int>(std::ceil(first + 1 / scale_ - 1e-9)) - 1;
  return {a, std::clamp(b, a, end - 1)};
}

}  // namespace floorproof

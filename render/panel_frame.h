// SPDX-License-Identifier: Apache-2.0
// Which part of a map a heat map shows, and at which pixel each place of it lies.
#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "env/core/hazard_map.h"
#include "render/heatmap.h"

namespace floorproof {

// Part of the map's grid, in cells.
struct Window {
  int x0, y0, x1, y1;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
};

// What is worth showing: known cells, hazards, points, rings' middles and failures, and some cells
// around.
Window KnownWindow(const HazardMap& map, const HeatMapOptions& options);

// Pixels of the panel and metres in the map's frame G and the world.
class PanelFrame {
 public:
  // As large as heat maps are.
  PanelFrame(const GridFrame& frame, const Window& window);
  // As large as fits.
  PanelFrame(const GridFrame& frame, const Window& window, int most_width, int most_height);

  double px_per_m() const { return scale_ / frame_.cell_m; }
  // Cells under a pixel's row or column, [first, last], counted from the map's lower left.
  std::array<int, 2> Columns(int column) const;
  std::array<int, 2> Rows(int row) const;
  cv::Point2d Pixel(const Vec2& p_W) const;
  Vec2 World(double x_px, double y_px) const;

  int width, height;

 private:
  void TakeSize();
  std::array<int, 2> Span(double first, int end) const;

  const GridFrame& frame_;
  Window window_;
  double scale_;
};

}  // namespace floorproof

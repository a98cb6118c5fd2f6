// SPDX-License-Identifier: Apache-2.0
// A walled hall with values on its cells, and what tests of heat maps look for in its picture.
#pragma once

#include <algorithm>

#include "render/heatmap.h"
#include "render/map_axes.h"
#include "render/panel_frame.h"
#include "tests/render/room.h"

namespace floorproof {

// w x h free cells inside a wall one cell thick.
inline HazardMap Hall(int w, int h, double cell_m) {
  HazardMap map;
  map.name = "hall";
  map.frame = {w, h, cell_m, {}};
  map.occupancy = Grid<CellState>(w, h, CellState::kFree);
  for (int x = 0; x < w; ++x) map.occupancy(x, 0) = map.occupancy(x, h - 1) = CellState::kOccupied;
  for (int y = 0; y < h; ++y) map.occupancy(0, y) = map.occupancy(w - 1, y) = CellState::kOccupied;
  return map;
}

// Where a place lies in the picture that DrawHeatMap() gives.
inline Vec2 PixelOf(const HazardMap& map, const HeatMapOptions& options, const Vec2& p_W) {
  constexpr int kLeft_px = 24, kTop_px = 76;
  const PanelFrame frame(map.frame, KnownWindow(map, options));
  const cv::Point2d p = frame.Pixel(p_W);
  return {kLeft_px + MapAxes(frame).left_px() + p.x, kTop_px + p.y};
}
inline Rgb ColourAt(const Image& image, const Vec2& p_px) {
  const std::uint8_t* p =
      image.data.data() +
      3 * (static_cast<std::size_t>(p_px.y()) * image.width + static_cast<std::size_t>(p_px.x()));
  return {p[0], p[1], p[2]};
}

inline HeatValues Values(const HazardMap& map, float value) {
  return {map.frame, Grid<float>(map.frame.width, map.frame.height, value)};
}

inline bool Is(const Image& image, int x, int y, const Rgb& colour) {
  return std::equal(colour.begin(), colour.end(), Pixel(image, x, y));
}
inline int Count(const Image& image, const Rgb& colour) {
  int n = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) n += Is(image, x, y, colour);
  return n;
}
inline int Ink(const Image& image, int x0, int y0, int x1, int y1) {
  int n = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) n += Luma(image, x, y) < 120;
  return n;
}

}  // namespace floorproof

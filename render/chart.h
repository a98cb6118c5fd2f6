// SPDX-License-Identifier: Apache-2.0
// Line charts: panels in rows and columns, each with axes of its own, under one title and above
// one legend.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "env/core/geometry.h"
#include "env/media/media.h"
#include "render/text.h"

namespace floorproof {

// How points are shown and joined.
struct ChartStyle {
  enum class Stroke { kNone, kSolid, kDashed, kDotted };
  Rgb colour = {0, 0, 0};
  Stroke stroke = Stroke::kSolid;
  bool hollow = false;  // a larger ring in place of a dot
  bool marks = true;    // else the line alone, for curves of many points
};

struct ChartPoint {
  double x = 0, y = 0;
  bool at_least = false;  // the value is that or more: an arrow points up
};

struct ChartSeries {
  ChartStyle style;
  int aside_px = 0;  // drawn so far to the right, so that series of equal values show side by side
  std::vector<ChartPoint> points;  // joined in this order
};

struct ChartPanel {
  std::string title, subtitle;  // the subtitle says what the y axis shows, with its unit
  std::string x_label;          // with its unit
  std::vector<double> x_ticks;  // at least one; the axis reaches a little beyond the outermost
  std::vector<ChartSeries> series;
};

struct ChartKey {
  std::string label;
  ChartStyle style;
};

struct Chart {
  std::string title;
  std::vector<std::string> notes;  // lines below the title
  std::vector<ChartPanel> panels;
  int columns = 3;
  int plot_width_px = 350;                    // of each panel
  std::vector<std::vector<ChartKey>> legend;  // a line each
};

// The y axes begin at 0 and reach beyond the highest value; negative values are not for it.
Image DrawChart(const Chart& chart);
// The same into a PNG; throws InputError when the file cannot be written.
void WriteChart(const Chart& chart, const std::filesystem::path& png);

}  // namespace floorproof

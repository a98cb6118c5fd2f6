// SPDX-License-Identifier: Apache-2.0
// Charts of lines and bars: panels in rows and columns, each with axes of its own, under one title
// and above one legend.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "env/geometry/geometry.h"
#include "media/media.h"
#include "render/text.h"

namespace floorproof {

// How points are shown and joined.
struct ChartStyle {
  enum class Stroke { kNone, kSolid, kDashed, kDotted };
  Rgb colour = {0, 0, 0};
  Stroke stroke = Stroke::kSolid;
  bool hollow = false;  // a larger ring in place of a dot
  bool marks = true;    // else the line alone, for curves of many points
  double bar = 0;       // above 0: a bar from nought to each point, so wide in units of x, instead
};

struct ChartPoint {
  double x = 0, y = 0;
  bool at_least = false;  // the value is that or more: an arrow points up
};

struct ChartSeries {
  ChartStyle style;
  int aside_px = 0;  // drawn so far to the right, so that series of equal values show side by side
  std::vector<ChartPoint> points;  // joined in this order
  bool values = false;             // bars: each point's value above its bar
};

struct ChartPanel {
  std::string title, subtitle;  // the subtitle says what the y axis shows, with its unit
  std::string x_label;          // with its unit
  std::vector<double> x_ticks;  // at least one; the axis reaches a little beyond them and all bars
  std::vector<ChartSeries> series;
  std::optional<int> x_decimals = {};  // of the ticks; none: as many as they need
  bool whole_numbers = false;          // ticks of y at whole numbers only
  std::optional<double> y_end = {};    // none: beyond the highest value
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

// The y axes begin at 0 and reach beyond the highest value; negative values are not supported. The
// chart is as wide as its panels and lettering need. Tick labels and bar values that do not fit are
// left out.
Image DrawChart(const Chart& chart);
// The same into a PNG; throws as WriteFileWhole does.
void WriteChart(const Chart& chart, const std::filesystem::path& png);

}  // namespace floorproof

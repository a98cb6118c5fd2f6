// SPDX-License-Identifier: Apache-2.0
// A quantity over a floor, as a picture: map, values in colour, hazards, paths, failures, axes in
// metres, legend.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "env/core/hazard_map.h"
#include "env/core/path.h"
#include "media/media.h"
#include "render/text.h"

namespace floorproof {

enum class ColourMap { kViridis, kInferno, kCividis };  // perceptually uniform

// Values on a grid of their own (any cell size; any frame).
struct HeatValues {
  static constexpr float kNone = std::numeric_limits<float>::quiet_NaN();  // the floor shows
  GridFrame frame;
  Grid<float> values;
};

struct HeatCategory {
  std::string label;
  Rgb colour;
};

struct HeatPoint {
  Vec2 p_W = Vec2::Zero();
  std::string series;  // points of one series share a mark and a line of the legend
};

// Drawn as a numbered mark; the legend says what each number stands for. Of many, those that would
// hide another share its mark.
struct HeatFailure {
  Vec2 p_W = Vec2::Zero();
  std::string number;  // where it is listed
  std::string label;   // what failed
};

// A circle around a place that is marked, cut off at the map's border.
struct HeatRing {
  Vec2 p_W = Vec2::Zero();
  double radius_m = 0;
  std::string label;
  Rgb colour = {0, 0, 0};
};

// A closed line over the floor, for what has no area.
struct HeatOutline {
  std::vector<Vec2> p_W;
  std::string label;
  Rgb colour = {0, 0, 0};
};

struct HeatMapOptions {
  std::string title;
  std::string quantity, unit;  // over the colour bar: "quantity [unit]"
  ColourMap colour_map = ColourMap::kViridis;
  bool reversed = false;            // the colours run from the high end to the low one
  std::optional<double> low, high;  // of the colour bar; none: of the values
  bool whole_numbers = false;       // ticks at whole numbers only
  // Not empty: a value v is category round(v), and the legend replaces the colour bar.
  std::vector<HeatCategory> categories;
  bool numbers = false;  // each value in its cell, where cells are large enough for all of them
  std::vector<HeatPoint> points;
  // Series that have their marks by this order, so that pictures without some of them show the
  // others alike. Any others come after, as they are met.
  std::vector<std::string> series;
  std::vector<HeatOutline> outlines;
  std::vector<HeatRing> rings;
  std::vector<HeatFailure> failures;
  std::string failures_by;  // over their lines of the legend: what the numbers are
  const Path* plan = nullptr;
  std::vector<std::vector<Vec2>> driven;  // in stretches between which the robot was carried
};

// Marks the cells that hold hazards of that class, named as in the hTetro FMEA paper, in a pale
// shade of the colour in which its hazards are outlined.
HeatCategory CellsOf(HazardClass hazard_class);

// Drawn in the map's own frame (of one that lies askew an arrow shows the world's +y) and cropped
// to what is known; the axes are the world's, in metres. What was driven lies over the plan,
// narrower. The longer side has 800 to 1600 pixels, or more where the lettering needs it. A pixel
// over many cells is wall if one of them is, and shows the mean of their values. `values` may be
// null.
Image DrawHeatMap(const HazardMap& map, const HeatValues* values, const HeatMapOptions& options);
// The same into a PNG; throws as WriteFileWhole does.
void WriteHeatMap(const HazardMap& map, const HeatValues* values, const HeatMapOptions& options,
                  const std::filesystem::path& png);

}  // namespace floorproof

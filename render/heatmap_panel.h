// SPDX-License-Identifier: Apache-2.0
// The map itself within a heat map, and what its legend must explain. For heatmap*.cc and
// cell_*.cc only.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "render/heatmap.h"
#include "render/map_axes.h"
#include "render/panel_frame.h"

namespace floorproof {

inline constexpr Rgb kWallColour = {52, 60, 72};

struct HeatRange {
  double low = 0, high = 1;  // low < high
};

struct LegendLine {
  // In the legend's order.
  enum class Kind {
    kArea,
    kHatched,
    kOutline,
    kDashed,
    kLine,
    kStart,
    kEnd,
    kMark,
    kRing,
    kHeading,
    kNumber,
    kDot
  };
  Kind kind = Kind::kArea;
  std::string label;
  Rgb colour = {0, 0, 0};
  int px = 1;    // of a line
  int mark = 0;  // of cv::MarkerTypes
  std::string number = {};
};

struct HeatPanel {
  Image image;
  HeatRange range;
  std::array<Rgb, 256> colours = {};  // from the range's low end to its high one
  std::vector<LegendLine> legend;

  Rgb ColourOf(double value) const;
};

HeatPanel DrawPanel(const HazardMap& map, const HeatValues* values, const HeatMapOptions& options,
                    const PanelFrame& frame, const MapAxes& axes);

}  // namespace floorproof

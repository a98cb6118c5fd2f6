// SPDX-License-Identifier: Apache-2.0
// The map itself within a heat map, and what its legend must explain. Used by heatmap.cc only.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "render/heatmap.h"

namespace floorproof {

struct HeatRange {
  double low = 0, high = 1;  // low < high
};

struct LegendLine {
  enum class Kind { kArea, kHatched, kOutline, kDashed, kLine, kMark };
  Kind kind = Kind::kArea;
  std::string label;
  Rgb colour = {0, 0, 0};
  int mark = 0;  // of cv::MarkerTypes
};

struct HeatPanel {
  cv::Mat image;  // CV_8UC3, RGB
  double px_per_m = 1;
  HeatRange range;
  std::vector<LegendLine> legend;
};

HeatPanel DrawPanel(const HazardMap& map, const HeatValues* values, const HeatMapOptions& options);
// The legend's picture of a line, within `place`.
void DrawSwatch(cv::Mat& canvas, const cv::Rect& place, const LegendLine& line);
std::array<Rgb, 256> Colours(ColourMap map);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What the marks and colours of a heat map mean, line by line. For heatmap*.cc and
// cell_stage.cc only.
#pragma once

#include "render/heatmap_panel.h"

namespace floorproof {

inline constexpr int kLegendLine_px = 24;

// What a line is about, within `place`.
void DrawSwatch(Image& image, const cv::Rect& place, const LegendLine& line);
int LegendWidth(const std::vector<LegendLine>& legend);  // px
// The first line's base at y_px.
void DrawLegend(Image& image, int x_px, int y_px, const std::vector<LegendLine>& legend);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What the marks and colours of a heat map mean, line by line. For heatmap*.cc only.
#pragma once

#include "render/heatmap_panel.h"

namespace floorproof {

inline constexpr int kLegendLine_px = 24;

int LegendWidth(const std::vector<LegendLine>& legend);  // px
// The first line's base at y_px.
void DrawLegend(Image& image, int x_px, int y_px, const std::vector<LegendLine>& legend);

}  // namespace floorproof

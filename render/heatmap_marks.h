// SPDX-License-Identifier: Apache-2.0
// What lies over a heat map's cells: the plan, hazards, points, numbers. Each adds its lines to the
// legend. For heatmap*.cc only.
#pragma once

#include "render/heatmap_panel.h"
#include "render/panel_frame.h"

namespace floorproof {

// Start and end too. Thick and cased where there is room between its lines.
void DrawPlan(const HazardMap& map, const Path* plan, const PanelFrame& frame, HeatPanel& panel);
// Outlines: a class's colour, a shade of it for each of its types, broken where it is on no map.
void DrawHazards(const HazardMap& map, const PanelFrame& frame, HeatPanel& panel);
void DrawPoints(const HeatMapOptions& options, const PanelFrame& frame, HeatPanel& panel);
// Each value in a corner of its cell where little else is drawn, if there is room for all of them.
// To be drawn last: it looks at what is there.
void DrawNumbers(const HeatValues& values, const PanelFrame& frame, HeatPanel& panel);

// The legend's picture of a line, within `place`.
void DrawSwatch(cv::Mat& canvas, const cv::Rect& place, const LegendLine& line);
// Ground that nobody knows, at that pixel.
Rgb HatchedAt(int x, int y);

}  // namespace floorproof

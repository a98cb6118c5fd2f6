// SPDX-License-Identifier: Apache-2.0
// What lies over a heat map's cells: paths, hazards, points, numbers. Each adds its lines to the
// legend. For heatmap*.cc only.
#pragma once

#include "render/heatmap_panel.h"
#include "render/panel_frame.h"

namespace floorproof {

// The plan with start and end, thick and cased where there is room between its lines; over it, and
// narrower, what was driven.
void DrawPaths(const HazardMap& map, const HeatMapOptions& options, const PanelFrame& frame,
               HeatPanel& panel);
// Outlines: a class's colour, a shade of it for each of its types, broken where it is on no map.
void DrawHazards(const HazardMap& map, const PanelFrame& frame, HeatPanel& panel);
void DrawOutlines(const HeatMapOptions& options, const PanelFrame& frame, HeatPanel& panel);
void DrawRings(const HeatMapOptions& options, const PanelFrame& frame, HeatPanel& panel);
void DrawPoints(const HeatMapOptions& options, const PanelFrame& frame, HeatPanel& panel);
// Each value in a corner of its cell where little else is drawn, if there is room for all of them.
// To be drawn last: it looks at what is there.
void DrawNumbers(const HeatValues& values, const PanelFrame& frame, HeatPanel& panel);

// What they are drawn with; the legend is too.
void RingMark(cv::Mat& image, const cv::Point2d& middle, double radius_px, double dot_px,
              const Rgb& colour);
void StartMark(cv::Mat& image, const cv::Point2d& p);
void EndMark(cv::Mat& image, const cv::Point2d& p);  // shows around the start's
void Mark(cv::Mat& image, const cv::Point2d& at, const Rgb& colour, int mark);
void HazardDashes(cv::Mat& image, const cv::Point2d& a, const cv::Point2d& b, const Rgb& colour);
// Ground that nobody knows, at that pixel.
Rgb HatchedAt(int x, int y);

}  // namespace floorproof

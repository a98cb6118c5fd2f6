// SPDX-License-Identifier: Apache-2.0
// Failures as numbered marks on a heat map, with their lines of the legend. For heatmap*.cc only.
#pragma once

#include <string>
#include <vector>

#include "render/heatmap_panel.h"

namespace floorproof {

// A failure's mark, with those that share it: they would hide it.
struct FailureMark {
  std::size_t failure = 0;             // of the options' list
  cv::Rect box;                        // on the panel
  int more = 0;                        // that share it
  std::vector<std::string> also = {};  // what else failed there; the first two
};

// In the list's order; a failure whose mark would touch an earlier one shares that one. At most 20:
// the rest are dots. None for what lies off the panel.
std::vector<FailureMark> PlaceFailures(const std::vector<HeatFailure>& failures,
                                       const PanelFrame& frame);

// To be drawn last. Each failure that is not in the middle of a mark is a dot, unless there are too
// many to see what is below them.
void DrawFailures(const HeatMapOptions& options, const PanelFrame& frame, HeatPanel& panel);

// The legend's pictures, round or from `left_px` on and about `middle_y_px`.
void NumberSwatch(Image& image, int left_px, int middle_y_px, const std::string& number);
int NumberSwatchWidth(const std::string& number);
void FailureDot(cv::Mat& canvas, const cv::Point2d& middle);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A map's axes: round metres of the world frame along the left and the lower border of its panel.
// For heatmap*.cc only.
#pragma once

#include <string>
#include <vector>

#include "render/panel_frame.h"

namespace floorproof {

struct AxisTicks {
  double step = 1;                  // 1, 2 or 5 times a power of ten
  std::vector<double> at;           // multiples of it, ascending
  std::vector<std::string> labels;  // each of as many decimals as the step needs
};

// Those within [low, high], which is drawn length_px long; a label of c letters takes least_px +
// c * letter_px of it. At least one, unless the span is too short for any number of its size.
AxisTicks RoundTicks(double low, double high, double length_px, double least_px, double letter_px);
// Multiples of `step` within [low, high]; at most 1000.
AxisTicks TicksAt(double step, double low, double high);

class MapAxes {
 public:
  explicit MapAxes(const PanelFrame& frame);

  // What the lettering needs beside and below the panel.
  int left_px() const { return left_px_; }
  static constexpr int kBelow_px = 52;

  // Of a map that lies askew in the world: where x and where y is round, to be drawn before what
  // lies over the cells. Nothing on others: their borders say it.
  void DrawGrid(cv::Mat panel) const;
  // `panel`: within `image`.
  void Draw(Image& image, const cv::Rect& panel) const;

 private:
  // A coordinate of the world along a border: from its first pixel on, growing by per_px.
  struct Border {
    char name;  // of the coordinate: x or y
    double first, per_px, length_px;
    double per_px_inward;  // the same coordinate's growth square to the border, into the panel
    AxisTicks ticks;
    double Pixel(double value) const { return (value - first) / per_px; }
    double last() const { return first + per_px * length_px; }
    // At multiples of `step`, if there are some to read lengths by.
    void TakeStep(double step);
  };
  static Border MakeBorder(const PanelFrame& frame, const cv::Point2d& from,
                           const cv::Point2d& along, const cv::Point2d& inward, double least_px,
                           double letter_px);

  Border below_, left_;
  int left_px_ = 0;
  double height_px_ = 0;
};

}  // namespace floorproof

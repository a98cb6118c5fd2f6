// SPDX-License-Identifier: Apache-2.0
#include "render/heatmap_panel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "render/heatmap_failures.h"
#include "render/heatmap_marks.h"
#include "render/strokes.h"

namespace floorproof {
namespace {

constexpr Rgb kFree = {238, 240, 243};

std::array<Rgb, 256> Colours(ColourMap map) {
  const int id = map == ColourMap::kViridis   ? cv::COLORMAP_VIRIDIS
                 : map == ColourMap::kInferno ? cv::COLORMAP_INFERNO
                                              : cv::COLORMAP_CIVIDIS;
  cv::Mat ramp(1, 256, CV_8U), bgr;
  for (int i = 0; i < 256; ++i) ramp.at<std::uint8_t>(i) = static_cast<std::uint8_t>(i);
  cv::applyColorMap(ramp, bgr, id);
  std::array<Rgb, 256> colours;
  for (int i = 0; i < 256; ++i) {
    const auto& c = bgr.at<cv::Vec3b>(i);
    colours[static_cast<std::size_t>(i)] = {c[2], c[1], c[0]};
  }
  return colours;
}

CellState Under(const HazardMap& map, const std::array<int, 2>& xs, const std::array<int, 2>& ys) {
  CellState found = CellState::kUnknown;
  for (int iy = ys[0]; iy <= ys[1]; ++iy) {
    for (int ix = xs[0]; ix <= xs[1]; ++ix) {
      const CellState s = map.occupancy(ix, iy);
      if (s == CellState::kOccupied) return s;
      if (s == CellState::kFree) found = s;
    }
  }
  return found;
}

// The mean of the finite values on the ground of one pixel, or the value at its middle.
class ValueSampler {
 public:
  ValueSampler(const HeatValues& values, const PanelFrame& panel, bool mean) : values_(values) {
    const double cells_a_pixel = 1 / (panel.px_per_m() * values.frame.cell_m);
    reach_ = mean ? std::max(1, static_cast<int>(std::lround(cells_a_pixel))) : 1;
    const auto at = [&](double column, double row) -> Vec2 {
      const Vec2 p_W = panel.World(column + 0.5, row + 0.5);
      return values.frame.ToGrid(p_W) / values.frame.cell_m;
    };
    first_ = at(0, 0);
    right_ = at(1, 0) - first_;
    down_ = at(0, 1) - first_;
  }
  float At(int column, int row) const {
    const Vec2 p = first_ + column * right_ + row * down_;
    const int cx = static_cast<int>(std::floor(p.x())), cy = static_cast<int>(std::floor(p.y()));
    double sum = 0;
    int n = 0;
    for (int iy = cy - (reach_ - 1) / 2; iy <= cy + reach_ / 2; ++iy) {
      for (int ix = cx - (reach_ - 1) / 2; ix <= cx + reach_ / 2; ++ix) {
        if (!values_.values.Inside(ix, iy) || !std::isfinite(values_.values(ix, iy))) continue;
        sum += values_.values(ix, iy);
        ++n;
      }
    }
    return n == 0 ? HeatValues::kNone : static_cast<float>(sum / n);
  }

 private:
  const HeatValues& values_;
  Vec2 first_, right_, down_;  // of the panel's pixels, in cells of the values
  int reach_;
};

HeatRange RangeOf(const HeatValues* values, const HeatMapOptions& options) {
  HeatRange range = {std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity()};
  if (values != nullptr) {
    for (const float v : values->values.cells) {
      if (!std::isfinite(v)) continue;
      range.low = std::min<double>(range.low, v);
      range.high = std::max<double>(range.high, v);
    }
  }
  if (range.low > range.high) range = {0, 1};
  range = {options.low.value_or(range.low), options.high.value_or(range.high)};
  if (!(range.high > range.low)) range.high = range.low + 1;
  return range;
}

// Map and values, pixel by pixel. Walls lie over values: a planner's grid may reach into them.
void DrawCells(const HazardMap& map, const HeatValues* values, const HeatMapOptions& options,
               const PanelFrame& frame, HeatPanel& panel) {
  const bool named = !options.categories.empty();
  std::optional<ValueSampler> sampler;
  if (values != nullptr) sampler.emplace(*values, frame, !named);
  std::vector<bool> used(options.categories.size());
  bool walls = false, unknown = false;
  for (int row = 0; row < frame.height; ++row) {
    std::uint8_t* pixel = panel.image.data.data() + 3 * static_cast<std::size_t>(row) * frame.width;
    const auto ys = frame.Rows(row);
    for (int column = 0; column < frame.width; ++column, pixel += 3) {
      const CellState state = Under(map, frame.Columns(column), ys);
      Rgb colour = kFree;
      if (state == CellState::kOccupied) {
        colour = kWallColour;
        walls = true;
      } else if (state == CellState::kUnknown) {
        colour = HatchedAt(column, row);
        unknown = true;
      }
      const float v =
          sampler && state != CellState::kOccupied ? sampler->At(column, row) : HeatValues::kNone;
      if (std::isfinite(v) && named) {
        const auto last = static_cast<long>(options.categories.size()) - 1;
        const auto i = static_cast<std::size_t>(std::clamp(std::lround(v), 0L, last));
        colour = options.categories[i].colour;
        used[i] = true;
      } else if (std::isfinite(v)) {
        colour = panel.ColourOf(v);
      }
      std::ranges::copy(colour, pixel);
    }
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) {
      panel.legend.push_back(
          {LegendLine::Kind::kArea, options.categories[i].label, options.categories[i].colour});
    }
  }
  if (walls) panel.legend.push_back({LegendLine::Kind::kArea, "wall, furniture", kWallColour});
  if (unknown) panel.legend.push_back({LegendLine::Kind::kHatched, "unknown"});
}

}  // namespace

Rgb HeatPanel::ColourOf(double value) const {
  const double share = (value - range.low) / (range.high - range.low);
  return colours[static_cast<std::size_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)))];
}

HeatPanel DrawPanel(const HazardMap& map, const HeatValues* values, const HeatMapOptions& options,
                    const PanelFrame& frame, const MapAxes& axes) {
  HeatPanel panel;
  panel.image = GreyImage(frame.width, frame.height, 0);
  panel.range = RangeOf(values, options);
  panel.colours = Colours(options.colour_map);
  if (options.reversed) std::ranges::reverse(panel.colours);
  DrawCells(map, values, options, frame, panel);
  axes.DrawGrid(Canvas(panel.image));
  DrawPaths(map, options, frame, panel);
  DrawHazards(map, frame, panel);
  DrawOutlines(options, frame, panel);
  DrawRings(options, frame, panel);
  DrawPoints(options, frame, panel);
  if (values != nullptr && options.numbers) DrawNumbers(*values, frame, panel);
  DrawFailures(options, frame, panel);
  std::ranges::stable_sort(panel.legend, {}, &LegendLine::kind);
  return panel;
}

}  // namespace floorproof

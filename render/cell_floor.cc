// SPDX-License-Identifier: Apache-2.0
#include "render/cell_floor.h"

#include <algorithm>
#include <cmath>

#include "render/heatmap_marks.h"
#include "render/map_axes.h"

namespace floorproof {
namespace {

// The map with all its free cells in one colour.
HeatPanel Over(const Rgb& colour, const HazardMap& map, const PanelFrame& frame) {
  HeatMapOptions options;
  options.categories = {{"", colour}};
  HeatValues values{map.frame, Grid<float>(map.frame.width, map.frame.height, HeatValues::kNone)};
  for (std::size_t i = 0; i < values.values.cells.size(); ++i)
    if (map.occupancy.cells[i] == CellState::kFree) values.values.cells[i] = 0;
  return DrawPanel(map, &values, options, frame, MapAxes(frame));
}

std::uint8_t ShadeBetween(std::uint8_t black, std::uint8_t white, std::uint8_t share) {
  return static_cast<std::uint8_t>(black + (white - black) * share / 255);
}

}  // namespace

Rgb Veiled(const Rgb& colour, int x, int y) {
  const Rgb hatch = HatchedAt(x, y);
  Rgb veiled;
  for (std::size_t k = 0; k < 3; ++k)
    veiled[k] = static_cast<std::uint8_t>((colour[k] + 2 * hatch[k]) / 3);
  return veiled;
}

CellFloor::CellFloor(const HazardMap& map, const Grid<std::uint8_t>& in_reach, int most_width,
                     int most_height)
    : map_(map),
      in_reach_(in_reach),
      window_(KnownWindow(map, {})),
      frame_(map.frame, window_, most_width, most_height),
      visits_(map.frame.width, map.frame.height),
      seen_(map.frame.width, map.frame.height) {
  HeatPanel panel = Over({0, 0, 0}, map, frame_);
  for (const LegendLine& line : panel.legend)
    if (line.kind != LegendLine::Kind::kArea && line.kind != LegendLine::Kind::kHatched)
      marks_.push_back(line);
  black_ = std::move(panel.image);
  white_ = Over({255, 255, 255}, map, frame_).image;
  image_ = black_;
  for (std::size_t i = 0; i < in_reach.cells.size(); ++i) {
    counts_[0] += in_reach.cells[i] != 0;
    any_out_of_reach_ |= !in_reach.cells[i] && map.occupancy.cells[i] == CellState::kFree;
  }
  for (int iy = window_.y0; iy < window_.y1; ++iy)
    for (int ix = window_.x0; ix < window_.x1; ++ix) Paint({ix, iy});
}

void CellFloor::SetVisits(Cell cell, int visits) {
  const auto number = [](int n) { return static_cast<std::size_t>(PropertyOf(n)); };
  if (!in_reach_(cell)) return;
  const std::size_t before = number(visits_(cell)), after = number(visits);
  visits_(cell) = visits;
  if (before == after) return;
  --counts_[before];
  ++counts_[after];
  Paint(cell);
}

void CellFloor::See(Cell cell) {
  if (seen_(cell)) return;
  seen_(cell) = 1;
  Paint(cell);
}

Rgb CellFloor::ColourIn(Cell cell) const {
  return ColourOf(in_reach_(cell) ? PropertyOf(visits_(cell)) : CellProperty::kOutOfReach);
}

// The pixels whose middles lie in it.
void CellFloor::Paint(Cell cell) {
  const double px = frame_.px_per_m() * map_.frame.cell_m;
  const auto first = [](double edge_px) { return static_cast<int>(std::ceil(edge_px - 0.5)); };
  const double left = (cell.ix - window_.x0) * px,
               bottom = frame_.height - (cell.iy - window_.y0) * px;
  const int x0 = std::max(0, first(left)), x1 = std::min(frame_.width, first(left + px));
  const int y0 = std::max(0, first(bottom - px)), y1 = std::min(frame_.height, first(bottom));
  const Rgb colour = ColourIn(cell);
  const bool seen = seen_(cell) != 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      const std::size_t at = 3 * (static_cast<std::size_t>(y) * frame_.width + x);
      Rgb mixed;
      for (std::size_t k = 0; k < 3; ++k)
        mixed[k] = ShadeBetween(black_.data[at + k], white_.data[at + k], colour[k]);
      if (!seen) mixed = Veiled(mixed, x, y);
      std::ranges::copy(mixed, image_.data.begin() + static_cast<std::ptrdiff_t>(at));
    }
}

}  // namespace floorproof

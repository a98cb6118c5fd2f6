// SPDX-License-Identifier: Apache-2.0
#include "report/swept_again.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "report/carried.h"
#include "run/episode/tool_meter.h"

namespace floorproof {
namespace {

constexpr double kStretch_m = 0.25;  // less than a robot's length: it hides that they come late

// Cells [x0, x1) x [y0, y1).
struct Block {
  int x0, x1, y0, y1;
};

// Rows of neighbours, joined where the row below is as wide.
std::vector<Block> BlocksOf(std::vector<Cell>& cells) {
  std::ranges::sort(cells, {}, [](const Cell& c) { return std::tuple(c.iy, c.ix); });
  std::vector<Block> blocks;
  for (std::size_t begin = 0, end = 0; begin < cells.size(); begin = end) {
    const Cell first = cells[begin];
    for (end = begin + 1;
         end < cells.size() && cells[end].iy == first.iy && cells[end].ix == cells[end - 1].ix + 1;)
      ++end;
    const int x1 = cells[end - 1].ix + 1;
    const auto below = std::ranges::find_if(
        blocks, [&](const Block& b) { return b.x0 == first.ix && b.x1 == x1 && b.y1 == first.iy; });
    if (below != blocks.end())
      ++below->y1;
    else
      blocks.push_back({first.ix, x1, first.iy, first.iy + 1});
  }
  return blocks;
}

class Patches {
 public:
  explicit Patches(const SweepArea& area)
      : area_(area), twice_(area.frame.width, area.frame.height) {}

  // Finds what changed within reach_m of the robot.
  void Look(const CoverageMeter& swept, const TraceRow& row, double reach_m) {
    const GridFrame& frame = area_.frame;
    const Cell at = frame.ToCell({row.x_m, row.y_m});
    const int reach = static_cast<int>(std::ceil(reach_m / frame.cell_m));
    const int x0 = std::max(0, at.ix - reach), x1 = std::min(frame.width - 1, at.ix + reach),
              y0 = std::max(0, at.iy - reach), y1 = std::min(frame.height - 1, at.iy + reach);
    for (int iy = y0; iy <= y1; ++iy)
      for (int ix = x0; ix <= x1; ++ix) {
        if (swept.passes()(ix, iy) < 2 || twice_(ix, iy) || !area_.sweepable(ix, iy)) continue;
        twice_(ix, iy) = 1;
        cells_.push_back({ix, iy});
      }
  }
  void Paint(const TraceRow& row) {
    const GridFrame& frame = area_.frame;
    for (const Block& b : BlocksOf(cells_)) {
      const auto at = [&](int x) -> Vec2 {
        return frame.X_WG * Vec2(x * frame.cell_m, 0.5 * (b.y0 + b.y1) * frame.cell_m);
      };
      patches_.push_back({row.t_s, at(b.x0), at(b.x1), (b.y1 - b.y0) * frame.cell_m,
                          static_cast<double>(row.z_m)});
    }
    cells_.clear();
  }
  std::vector<FloorPatch> Take() { return std::move(patches_); }

 private:
  const SweepArea& area_;
  Grid<std::uint8_t> twice_;
  std::vector<Cell> cells_;  // not painted yet
  std::vector<FloorPatch> patches_;
};

}  // namespace

std::vector<FloorPatch> SweptAgainPatches(const EpisodeRecord& record, const RobotSpec& robot) {
  SweepArea area;
  area.frame = record.passes_frame;
  area.sweepable = record.sweepable;
  area.sweepable_cells = std::ranges::count(record.sweepable.cells, std::uint8_t{1});
  ToolMeter meter(area, robot);
  Patches patches(area);
  Carried carried(record.interventions);
  double since_m = 0;  // driven since the last stretch ended
  const TraceRow* last = nullptr;
  for (const TraceRow& row : record.trace) {
    if (carried.Before(row)) meter.Lift();
    meter.Take(row.shape);
    meter.Add({row.x_m, row.y_m, static_cast<double>(row.yaw_rad)});
    const double gone_m =
        last != nullptr ? std::hypot(row.x_m - last->x_m, row.y_m - last->y_m) : 0;
    patches.Look(meter.swept(), row, robot.circumscribed_radius_m + gone_m);
    since_m += gone_m;
    if (since_m >= kStretch_m || &row == &record.trace.back()) {
      patches.Paint(row);
      since_m = 0;
    }
    last = &row;
  }
  return patches.Take();
}

}  // namespace floorproof

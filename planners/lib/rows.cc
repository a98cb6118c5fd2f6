// SPDX-License-Identifier: Apache-2.0
// A row's strip lies on sweepable ground altogether, and rows at full spacing do not overlap. So
// what a set of rows leaves is known from their lengths alone: the ground less width * length less
// the round ends. With ground left over costing kLeftover times what a row would, directions near
// the region's own, spacings and offsets are compared without sweeping anything.
#include "planners/lib/rows.h"

#include <algorithm>
#include <array>
#include <limits>

namespace floorproof {
namespace {

constexpr double kLeftover = 2.0;  // cost of ground swept afterwards, in rows of the same ground

struct Box {
  double u0 = std::numeric_limits<double>::infinity(), u1 = -u0, v0 = u0, v1 = -u0;
};

// One region's cells and what of it a row needs to visit.
class RegionRows {
 public:
  RegionRows(const Floor& floor, const Regions& regions, int region, const Swept* swept,
             const std::vector<Cell>& cells)
      : floor_(floor), regions_(regions), region_(region), swept_(swept), cells_(cells) {}

  // Calls use(a, b, line) for each row.
  template <class Use>
  void ForEach(double direction_rad, double spacing, double offset, const Use& use) const {
    const Vec2 along(std::cos(direction_rad), std::sin(direction_rad)),
        across(-along.y(), along.x());
    const Box box = Bounds(along, across);
    const int first = static_cast<int>(std::ceil((box.v0 - offset) / spacing));
    const int last = static_cast<int>(std::floor((box.v1 - offset) / spacing));
    for (int line = first; line <= last; ++line) {
      const Vec2 base = (offset + line * spacing) * across;
      bool in = false;
      double from = 0, to = 0;
      for (double u = box.u0; u <= box.u1 + kStep; u += kStep) {
        const Vec2 p = base + u * along;
        if (Wanted(p, across)) {
          if (!in) from = u;
          in = true;
          to = u;
        } else if (in) {
          use(Vec2(base + from * along), Vec2(base + to * along), line);
          in = false;
        }
      }
      if (in) use(Vec2(base + from * along), Vec2(base + to * along), line);
    }
  }

  Box Bounds(const Vec2& along, const Vec2& across) const {
    Box box;
    for (const Cell c : cells_) {
      const Vec2 p = Floor::CentreOf(c);
      box.u0 = std::min(box.u0, p.dot(along)), box.u1 = std::max(box.u1, p.dot(along));
      box.v0 = std::min(box.v0, p.dot(across)), box.v1 = std::max(box.v1, p.dot(across));
    }
    return box;
  }

 private:
  static constexpr double kStep = 0.5;

  bool Wanted(const Vec2& p, const Vec2& across) const {
    const Cell c = Floor::CellAt(p);
    if (!floor_.pose.Inside(c) || regions_.label(c) != region_) {
      // A line along a wall may run just outside the cells whose centres are clear.
      return false;
    }
    if (!floor_.Free(p, floor_.tolerance)) return false;
    if (!swept_) return true;
    // Something open across the tool's width here?
    const double half = floor_.tool_width / 2;
    for (double v = -half + 0.5; v <= half - 0.25; v += 1) {
      const Cell q = Floor::CellAt(p + v * across);
      if (floor_.ground.Inside(q) && swept_->IsOpen(q.ix, q.iy)) return true;
    }
    return false;
  }

  const Floor& floor_;
  const Regions& regions_;
  int region_;
  const Swept* swept_;
  const std::vector<Cell>& cells_;
};

}  // namespace

std::vector<Row> MakeRows(const Floor& floor, Regions& regions, const RowOptions& options,
                          const Swept* swept) {
  std::vector<std::vector<Cell>> cells(regions.direction_rad.size());
  for (int iy = 0; iy < floor.frame.height; ++iy)
    for (int ix = 0; ix < floor.frame.width; ++ix)
      if (const auto label = regions.label(ix, iy); label >= 0)
        cells[static_cast<std::size_t>(label)].push_back({ix, iy});

  std::vector<Row> rows;
  const double w = floor.tool_width;
  for (std::size_t region = 0; region < cells.size(); ++region) {
    const RegionRows maker(floor, regions, static_cast<int>(region), swept, cells[region]);
    double best = -std::numeric_limits<double>::infinity(), best_spacing = 0, best_offset = 0;
    for (const double narrow : {1.0, 0.97, 0.94, 0.91, 0.88}) {
      const double spacing = options.spacing * narrow;
      constexpr int kOffsets = 10;
      for (int i = 0; i < kOffsets; ++i) {
        const double offset = spacing * i / kOffsets;
        double value = 0;
        maker.ForEach(regions.direction_rad[region], spacing, offset,
                      [&](const Vec2& a, const Vec2& b, int) {
                        const double length = (b - a).norm();
                        const double ground = length * std::min(spacing, w) + kPi / 4 * w * w;
                        value += kLeftover * ground / w - length - options.link;
                      });
        if (value > best) best = value, best_spacing = spacing, best_offset = offset;
      }
    }
    maker.ForEach(regions.direction_rad[region], best_spacing, best_offset,
                  [&](const Vec2& a, const Vec2& b, int line) {
                    rows.push_back({a, b, static_cast<int>(region), line});
                  });
  }
  return rows;
}

}  // namespace floorproof

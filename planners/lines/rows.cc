// SPDX-License-Identifier: Apache-2.0
// The strip of a row lies on sweepable ground, and rows at full spacing do not overlap. So the
// ground that a set of rows leaves is known from their lengths alone: all ground, less width *
// length, less the round ends. Ground that is left costs kUncovered times what a row over it would.
// With that, spacings and offsets are compared without sweeping anything.
#include "planners/lines/rows.h"

#include <algorithm>
#include <array>
#include <limits>

#include "planners/search/index.h"

namespace floorproof {
namespace {

constexpr double kRoughStep = 1.0, kFineStep = 0.5;  // cells along a row, to compare and to make
constexpr double kUncovered = 2;  // cost of ground swept later, in rows over the same ground

// A region's extent along its direction and across.
struct Extent {
  Vec2 along, across;
  double u0 = std::numeric_limits<double>::infinity(), u1 = -u0, v0 = u0, v1 = -u0;
};

std::vector<Extent> Extents(const Regions& regions) {
  std::vector<Extent> extents;
  for (const double yaw : regions.direction_rad) {
    Extent& extent = extents.emplace_back();
    extent.along = {std::cos(yaw), std::sin(yaw)};
    extent.across = {-extent.along.y(), extent.along.x()};
  }
  for (int iy = 0; iy < regions.label.height; ++iy)
    for (int ix = 0; ix < regions.label.width; ++ix) {
      const std::int32_t label = regions.label(ix, iy);
      if (label < 0) continue;
      Extent& extent = extents[Z(label)];
      const Vec2 p = Floor::CentreOf({ix, iy});
      const double u = p.dot(extent.along), v = p.dot(extent.across);
      extent.u0 = std::min(extent.u0, u), extent.u1 = std::max(extent.u1, u);
      extent.v0 = std::min(extent.v0, v), extent.v1 = std::max(extent.v1, v);
    }
  return extents;
}

// What of a region a row needs to visit.
class RegionRows {
 public:
  RegionRows(const Floor& floor, const Regions& regions, int region, const Swept* swept,
             const Extent& extent)
      : floor_(floor), regions_(regions), region_(region), swept_(swept), extent_(extent) {}

  // Calls use(a, b, line) for each row.
  template <class Use>
  void ForEach(double spacing, double offset, double step, const Use& use) const {
    const int first = static_cast<int>(std::ceil((extent_.v0 - offset) / spacing));
    const int last = static_cast<int>(std::floor((extent_.v1 - offset) / spacing));
    for (int line = first; line <= last; ++line) {
      const Vec2 base = (offset + line * spacing) * extent_.across;
      const auto at = [&](double u) { return Vec2(base + u * extent_.along); };
      bool in = false;
      double from = 0, to = 0;
      for (double u = extent_.u0; u <= extent_.u1 + step; u += step) {
        if (NeedsRow(at(u), step < 1)) {
          if (!in) from = u;
          in = true;
          to = u;
        } else if (in) {
          use(at(from), at(to), line);
          in = false;
        }
      }
      if (in) use(at(from), at(to), line);
    }
  }

 private:
  bool NeedsRow(const Vec2& p, bool exact) const {
    const Cell c = Floor::CellAt(p);
    if (!floor_.pose.Inside(c) || regions_.label(c) != region_) return false;
    if (exact && !floor_.Free(p, floor_.tolerance)) return false;
    if (!swept_) return true;
    return swept_->OpenShareAcross(p, extent_.across) > 0;
  }

  const Floor& floor_;
  const Regions& regions_;
  int region_;
  const Swept* swept_;
  const Extent& extent_;
};

}  // namespace

std::vector<Row> MakeRows(const Floor& floor, const Regions& regions, const RowOptions& options,
                          const Swept* swept) {
  const std::vector<Extent> extents = Extents(regions);
  std::vector<Row> rows;
  const double w = floor.tool_width;
  for (std::size_t region = 0; region < extents.size(); ++region) {
    const RegionRows maker(floor, regions, static_cast<int>(region), swept, extents[region]);
    double best = -std::numeric_limits<double>::infinity(), best_spacing = 0, best_offset = 0;
    for (const double narrow : {1.0, 0.96, 0.92, 0.88}) {
      const double spacing = options.spacing * narrow;
      constexpr int kOffsets = 8;
      for (int i = 0; i < kOffsets; ++i) {
        const double offset = spacing * i / kOffsets;
        double value = 0;
        maker.ForEach(spacing, offset, kRoughStep, [&](const Vec2& a, const Vec2& b, int) {
          const double length = (b - a).norm();
          const double ground = length * std::min(spacing, w) + kPi / 4 * w * w;
          value += kUncovered * ground / w - length - options.link;
        });
        if (value > best) best = value, best_spacing = spacing, best_offset = offset;
      }
    }
    maker.ForEach(best_spacing, best_offset, kFineStep,
                  [&](const Vec2& a, const Vec2& b, int line) {
                    rows.push_back({a, b, static_cast<int>(region), line});
                  });
  }
  return rows;
}

int CountCells(const std::vector<Row>& rows, const Regions& regions) {
  // Rows of a region come line by line. below[i]: neighbours of row i on the line before;
  // above[i]: on the line after.
  std::vector<int> below(rows.size()), above(rows.size()), parent(rows.size(), -1);
  std::size_t line_begin = 0, before_begin = 0, before_end = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    if (i == 0 || rows[i - 1].region != row.region || rows[i - 1].line != row.line) {
      const bool next =
          i > 0 && rows[i - 1].region == row.region && rows[i - 1].line + 1 == row.line;
      before_begin = next ? line_begin : i, before_end = i;
      line_begin = i;
    }
    const double yaw = regions.direction_rad[Z(row.region)];
    const Vec2 along(std::cos(yaw), std::sin(yaw));
    for (std::size_t k = before_begin; k < before_end; ++k) {
      if (rows[k].b.dot(along) < row.a.dot(along) || rows[k].a.dot(along) > row.b.dot(along))
        continue;
      ++below[i];
      ++above[k];
      parent[i] = static_cast<int>(k);
    }
  }
  int cells = 0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (below[i] != 1 || above[static_cast<std::size_t>(parent[i])] != 1) ++cells;
  return cells;
}

}  // namespace floorproof

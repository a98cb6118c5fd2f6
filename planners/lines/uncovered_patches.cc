// SPDX-License-Identifier: Apache-2.0
// A patch of open cells gets rows along its longer principal axis, as many as its width needs. The
// points of a row lie in the middle of the open cells there, moved to the nearest pose. A patch
// that is longer than a few tool widths is cut, so that each part's axis fits where the patch
// bends.
#include "planners/lines/uncovered_patches.h"

#include <algorithm>
#include <limits>

#include "planners/lines/wall_contours.h"

namespace floorproof {
namespace {

std::vector<Cell> TakePatch(const Floor& floor, const Swept& swept, Cell seed, int reach,
                            Grid<std::uint8_t>& taken) {
  std::vector<Cell> cluster = {seed};
  taken(seed) = 1;
  for (std::size_t i = 0; i < cluster.size(); ++i)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const Cell n{cluster[i].ix + dx, cluster[i].iy + dy};
        if (!floor.ground.Inside(n) || taken(n) || !swept.IsOpen(n.ix, n.iy)) continue;
        if (std::abs(n.ix - seed.ix) > reach || std::abs(n.iy - seed.iy) > reach) continue;
        taken(n) = 1;
        cluster.push_back(n);
      }
  return cluster;
}

}  // namespace

std::vector<Polyline> LinesOverUncoveredPatches(const Floor& floor, const ShortestPaths& paths,
                                                double min_cells, Swept& swept) {
  const double w = floor.tool_width, reach = floor.tool_reach;
  Grid<std::uint8_t> taken(floor.frame.width, floor.frame.height);
  std::vector<Polyline> lines;
  for (int iy = 0; iy < taken.height; ++iy)
    for (int ix = 0; ix < taken.width; ++ix) {
      if (taken(ix, iy) || !swept.IsOpen(ix, iy)) continue;
      const auto cluster =
          TakePatch(floor, swept, {ix, iy}, static_cast<int>(std::lround(6 * w)), taken);
      if (static_cast<double>(cluster.size()) < min_cells) continue;
      Vec2 mean = Vec2::Zero();
      for (const Cell c : cluster) mean += Floor::CentreOf(c);
      mean /= static_cast<double>(cluster.size());
      double xx = 0, xy = 0, yy = 0;
      for (const Cell c : cluster) {
        const Vec2 d = Floor::CentreOf(c) - mean;
        xx += d.x() * d.x(), xy += d.x() * d.y(), yy += d.y() * d.y();
      }
      const double yaw = 0.5 * std::atan2(2 * xy, xx - yy);
      const Vec2 along(std::cos(yaw), std::sin(yaw)), across(-along.y(), along.x());
      double v0 = std::numeric_limits<double>::infinity(), v1 = -v0;
      for (const Cell c : cluster) {
        const double v = (Floor::CentreOf(c) - mean).dot(across);
        v0 = std::min(v0, v - 0.5), v1 = std::max(v1, v + 0.5);
      }
      const int rows = std::max(1, static_cast<int>(std::ceil((v1 - v0) / w - 0.15)));
      for (int row = 0; row < rows; ++row) {
        // Open cells of this row's strip, by the slice of length kSlice that they lie in.
        constexpr double kSlice = 2;
        const double low = v0 + (v1 - v0) * row / rows, high = v0 + (v1 - v0) * (row + 1) / rows;
        std::vector<std::pair<int, Vec2>> slices;
        std::vector<std::pair<int, Cell>> by_slice;
        for (const Cell c : cluster) {
          const Vec2 d = Floor::CentreOf(c) - mean;
          const double v = d.dot(across);
          if (v < low || v > high) continue;
          by_slice.push_back({static_cast<int>(std::floor(d.dot(along) / kSlice)), c});
        }
        std::stable_sort(by_slice.begin(), by_slice.end(),
                         [](const auto& p, const auto& q) { return p.first < q.first; });
        for (std::size_t i = 0, k; i < by_slice.size(); i = k) {
          Vec2 sum = Vec2::Zero();
          for (k = i; k < by_slice.size() && by_slice[k].first == by_slice[i].first; ++k)
            sum += Floor::CentreOf(by_slice[k].second);
          slices.push_back({by_slice[i].first, sum / static_cast<double>(k - i)});
        }
        Polyline line;
        const auto finish = [&] {
          if (!line.empty()) {
            Polyline smooth = Simplify(floor, line, 1.0);
            if (swept.Add(smooth) >= 0.5 * min_cells) {
              lines.push_back(std::move(smooth));
            } else {
              swept.Remove(smooth);
            }
          }
          line.clear();
        };
        // The round tool reaches ahead: the outermost slices need no visit.
        const int spare = static_cast<int>(0.5 * reach / kSlice);
        const int first = slices.empty() ? 0 : slices.front().first;
        const int last = slices.empty() ? 0 : slices.back().first;
        for (const auto& [slice, p] : slices) {
          const bool tip = slice < first + spare || slice > last - spare;
          if (tip && last - first > 2 * spare) continue;
          const Cell pose = paths.NearestPose(p, reach + 1);
          if (pose.ix < 0) continue;
          const bool own = pose == Floor::CellAt(p) && floor.Free(p);
          const Vec2 q = own ? p : Floor::CentreOf(pose);
          if (!line.empty() && ((q - line.back()).norm() > w || !floor.Sees(line.back(), q)))
            finish();
          if (line.empty() || q != line.back()) line.push_back(q);
        }
        finish();
      }
    }
  return lines;
}

}  // namespace floorproof

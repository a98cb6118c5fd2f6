// SPDX-License-Identifier: Apache-2.0
// Breadth-first search over the graph of regions, from `to` on. It goes no farther than to `from`:
// on a floor in very many pieces most ways are short. Rows are kept for later calls as long as
// there is memory for them; then the row of another region is overwritten.
#include "planners/walk/region_borders.h"

#include <algorithm>

#include "planners/search/index.h"

namespace floorproof {
namespace {

constexpr std::size_t kMaxEntries = std::size_t{1} << 25;  // of all rows
constexpr int kMaxBorders = 0xfffe;

}  // namespace

RegionBorders::RegionBorders(const WalkGraph& graph)
    : graph_(graph), regions_(graph.adjacent.size()) {
  const std::size_t rows = std::clamp<std::size_t>(kMaxEntries / regions_, 1, regions_);
  borders_.resize(rows * regions_);
  row_region_.assign(rows, -1);
  depth_.assign(rows, -1);
}

const std::uint16_t* RegionBorders::To(int to, int from) {
  const std::size_t slot = Z(to) < row_region_.size() ? Z(to) : Z(to) % row_region_.size();
  std::uint16_t* row = &borders_[slot * regions_];
  const bool kept = row_region_[slot] == to;
  if (kept && row[from] <= depth_[slot]) return row;
  // A row that was not deep enough gets twice as deep, so that it is not begun anew for each layer.
  const int least = kept ? 2 * depth_[slot] : 1;
  row_region_[slot] = to;
  const auto unknown = static_cast<std::uint16_t>(kMaxBorders + 1);
  std::fill(row, row + regions_, unknown);
  row[to] = 0;
  int depth = kMaxBorders;  // of the last layer that is needed
  reached_.assign(1, to);
  for (std::size_t k = 0; k < reached_.size() && row[reached_[k]] <= depth; ++k) {
    const int region = reached_[k], borders = row[region];
    if (region == from) depth = std::max(borders, least);
    for (const int next : graph_.adjacent[Z(region)])
      if (row[next] == unknown) {
        row[next] = static_cast<std::uint16_t>(std::min(borders + 1, kMaxBorders));
        reached_.push_back(next);
      }
  }
  std::replace(row, row + regions_, unknown,
               static_cast<std::uint16_t>(std::min(depth + 1, kMaxBorders)));
  depth_[slot] = depth;
  work += static_cast<std::int64_t>(reached_.size() + regions_ / 16);
  return row;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// How many borders between regions a way has to cross at least.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/walk/walk_graph.h"

namespace floorproof {

class RegionBorders {
 public:
  explicit RegionBorders(const WalkGraph& graph);

  // A row that holds, by region, the number of borders on the way from there to region `to`. It is
  // exact for `from` and for every region that is no farther from `to`. For regions beyond it is a
  // lower bound. The row is valid until the next call.
  const std::uint16_t* To(int to, int from);

  std::int64_t work = 0;  // regions looked at

 private:
  const WalkGraph& graph_;
  std::size_t regions_;
  std::vector<std::uint16_t> borders_;  // rows, by region
  std::vector<int> row_region_;         // by row: its `to`; -1: none yet
  std::vector<int> depth_;              // by row: the number of borders up to which it is exact
  std::vector<int> reached_;
};

}  // namespace floorproof

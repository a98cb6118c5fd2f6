// SPDX-License-Identifier: Apache-2.0
// Between which rows of a trace a person carried the robot.
#pragma once

#include <vector>

#include "run/episode/episode.h"

namespace floorproof {

// Asked with each row in turn. `helped` outlives it.
class Carried {
 public:
  explicit Carried(const std::vector<Intervention>& helped)
      : next_(helped.begin()), end_(helped.end()) {}
  // Whether it was, since the row before. A row at the time of setting down is of before.
  bool Before(const TraceRow& row) {
    const auto first = next_;
    while (next_ != end_ && next_->t_s < row.t_s) ++next_;
    return next_ != first;
  }

 private:
  std::vector<Intervention>::const_iterator next_, end_;
};

}  // namespace floorproof

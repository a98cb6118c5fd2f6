// SPDX-License-Identifier: Apache-2.0
// The floor that a plan leaves uncovered, and why.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "env/core/coverage.h"
#include "planners/planner.h"

namespace floorproof {

struct World;

struct UncoveredPocket {
  enum class Why {
    kNotVisited,  // the tool could reach it, the plan does not go there
    kNarrow,      // the robot does not fit in, or through the gap before it
    kBehind,      // hazards that it must keep off cut it off, or walls with them
    kClosed,      // walls all around
    kKeptOff,     // a floor of another level, which it must keep off
  };
  Why why = Why::kNotVisited;
  double area_m2 = 0;
  Vec2 p_W = Vec2::Zero();  // within it, where it is widest
  double width_m = 0;       // there, between what bounds it; to a cell
  // kNarrow: the narrowest place on the widest way in, to a cell; none: it has no wider place.
  std::optional<double> gap_m = {};
  Vec2 gap_W = Vec2::Zero();
  std::string hazard;  // kBehind: the id of the first that closes the way; kKeptOff: its own
};

struct UncoveredFloor {
  // Known and free, in reach or not; floors of other levels, too.
  double floor_m2 = 0;
  double covered_m2 = 0;                 // of it, by the plan
  std::vector<UncoveredPocket> pockets;  // the largest first
  double edges_m2 = 0;  // along walls, in corners and between rows: too thin to be a pocket
};

// In cells of the sweep area (at most 5 cm). A pocket is wider than a quarter of the tool and not
// smaller than a square of half of its width.
UncoveredFloor FindUncovered(const World& world, const PlanResult& plan, const SweepArea& area);

// What the robot must have free to get through, m: its clear circle's diameter, or the lesser side
// of its footprint.
double LeastPassage(const Shape2& clear);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The floor as an audit drives over it: which places the robot can get to, how far they are from
// one another, and the ways between them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planners/lines/floor.h"
#include "planners/lines/held_yaw.h"
#include "planners/lines/kept_margin.h"
#include "planners/orders/visit_order.h"
#include "planners/planner.h"

namespace floorproof {

// Distances along the shortest collision-free ways of the robot's clear shape ("audit-sampling",
// section 5, which takes A* for each pair; here one search from a place reaches all others). Ways
// turn at any angle: straight on where the floor between is free.
class AuditFloor {
 public:
  // Where the robot's middle stands for a sample, and which way it faces there; none: any.
  struct Stop {
    Vec2 p_W = Vec2::Zero();
    std::optional<double> yaw_rad;
  };

  // `area` and `shapes`: with the robot's own clear shape. A robot that may face anywhere, with its
  // sensor ahead of its middle, turns it to the place: it reaches places closer to a wall than its
  // own radius. `margin_m` is kept beyond it on the way,
  // for the tracker's error, but for the surroundings of places that lie closer to an obstacle.
  // If the margin would cut a place off, the path goes through the middle of the narrow passages.
  AuditFloor(const PlanRequest& request, const FloorRoom& room, const SweepArea& area,
             const HeldShapes& shapes, const std::vector<Vec2>& places, double margin_m);

  double margin_m() const { return margin_m_; }  // what is kept; 0: no path keeps it
  // The start, and a stop for each of the places that can be reached, in the order given: what the
  // table's places are.
  const std::vector<Stop>& stops() const { return stops_; }
  // Of each place given, which stop it is; 0: it cannot be reached.
  const std::vector<int>& stop_of() const { return stop_of_; }
  const PlaceDistances& distances() const { return distances_; }
  // The way from one stop to another, both included, world frame.
  std::vector<Vec2> Way(int from, int to) const;

 private:
  // Where to stand so that the sensor, ahead of the middle, is over the place: with the margin
  // where there is a choice, and then nearest to the start. None: nowhere.
  std::optional<Stop> StopFor(const Vec2& place_W, double sensor_x_m, double margin_m) const;
  // Whether the robot gets to all stops within this mask; then distances and ways are known.
  bool Measure(const Grid<std::uint8_t>& free);
  Cell CellOf(const Vec2& p_W) const { return Floor::CellAt(floor_.ToCells(p_W)); }

  Floor floor_;
  double margin_m_ = 0;
  std::optional<KeptMargin> kept_;  // where the margin would cut a place off
  std::vector<Stop> stops_;
  std::vector<int> stop_of_;
  PlaceDistances distances_{0};
  // From a stop to each later one, in turn: the numbers of the cells where the way begins, bends
  // and ends, and where it ends in that list. There are as many ways as pairs of stops.
  struct Ways {
    std::vector<int> cells;
    std::vector<std::size_t> ends;
  };
  std::vector<Ways> ways_;
};

}  // namespace floorproof

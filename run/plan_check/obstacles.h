// SPDX-License-Identifier: Apache-2.0
// What a robot must keep off, as convex polygons that are found by place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "env/core/hazard_map.h"
#include "env/core/robot_spec.h"
#include "env/map/wall_grid.h"

namespace floorproof {

class Obstacles {
 public:
  static constexpr int kWall = -1;
  struct Part {
    Polygon polygon_G;   // convex, in the map's grid frame, m
    int hazard = kWall;  // index into the known map's hazards
  };

  // Of what is known of the map: the walls that a robot which starts there can meet, and the
  // hazards that it must keep off. A level change does not count where a later floor covers it.
  Obstacles(const HazardMap& known, const RobotSpec& robot, const Vec2& start_W);

  // The parts whose bounding boxes meet the rectangle [low, high].
  template <class Visit>
  void Near(const Vec2& low_G, const Vec2& high_G, const Visit& visit) {
    boxes_.Near(low_G, high_G, found_);
    for (const int i : found_) visit(parts_[static_cast<std::size_t>(i)]);
  }
  // Along the ray, which has length 1, to the first of them; none within `most_m`.
  std::optional<double> Cast(const Vec2& from_G, const Vec2& direction_G, double most_m);
  std::string Id(int hazard) const;

 private:
  void AddHazard(const HazardMap& known, std::size_t index);

  std::vector<Part> parts_;
  std::vector<std::string> ids_;
  WallGrid boxes_;  // around each part
  std::vector<int> found_;
};

}  // namespace floorproof

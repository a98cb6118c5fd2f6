// SPDX-License-Identifier: Apache-2.0
// What a robot must keep off, and what it may come over, as convex polygons that are found by
// place.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "env/core/hazard_map.h"
#include "env/core/robot_spec.h"
#include "env/geometry/box_grid.h"

namespace floorproof {

class Obstacles {
 public:
  static constexpr int kWall = -1;
  static constexpr double kTouch_m = 0.001;      // as a start beside a wall (env/core/standing.h)
  static constexpr double kSameStretch_m = 0.3;  // what is met again within that is still met
  struct Part {
    Polygon polygon_G;   // convex, in the map's grid frame, m
    int hazard = kWall;  // index into the known map's hazards
  };

  // Of what is known of the map: the walls that a robot which starts there can meet, and the
  // hazards that it must keep off, where they are still there (BareFloors).
  Obstacles(const HazardMap& known, const RobotSpec& robot, const Vec2& start_W);

  // Of all other hazards of the map, where they are still there: those that can be driven over, and
  // those that are not known.
  static Obstacles OthersOf(const HazardMap& map, const RobotSpec& robot);

  // The parts whose bounding boxes meet the rectangle [low, high].
  template <class Visit>
  void Near(const Vec2& low_G, const Vec2& high_G, const Visit& visit) {
    boxes_.Near(low_G, high_G, found_);
    for (const int i : found_) visit(parts_[static_cast<std::size_t>(i)]);
  }
  // Along the ray, which has length 1, the first of them; none within `most_m`.
  struct Hit {
    double along_m = 0;
    int hazard = kWall;
  };
  std::optional<Hit> Cast(const Vec2& from_G, const Vec2& direction_G, double most_m);
  std::string Id(int hazard) const;

 private:
  Obstacles() = default;
  void AddHazards(const HazardMap& map, const std::function<bool(const Hazard&)>& counts);
  void FindByPlace();

  std::vector<Part> parts_;
  std::vector<std::string> ids_;
  BoxGrid boxes_;  // around each part
  std::vector<int> found_;
};

}  // namespace floorproof

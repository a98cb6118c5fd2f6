// SPDX-License-Identifier: Apache-2.0
// The yaw at which a plan holds a robot with a footprint, and how its shapes lie there.
//
// A footprint is held at one of the map's quarter turns, the one nearest to the start's yaw. If the
// walls are askew to the map, coverage planners give the map along the walls (MapAlongWalls). A
// square covers the same floor at all four. A lopsided footprint, such as a bar, does not: where it
// fits crosswise it may hit a wall lengthwise. ComputeSweepArea tries all four yaws unless it is
// told not to, so whoever holds one yaw must ask for that yaw alone:
//
//   const HeldShapes held = HoldYaw(map, start, robot.clear, robot.tool);
//   const SweepArea area =
//       ComputeSweepArea(map, held.clear, held.tool, robot.step_m, start.p(), held.yaws);
//   const Floor floor = CropFloor(area, held.clear, held.tool, robot.tool_width_m);
//   ...
//   waypoint.yaw_rad = held.yaw_rad;  // of every waypoint
//
// PlanResult::clear and tool are the shapes as given, not these.
#pragma once

#include <optional>

#include "env/core/coverage.h"

namespace floorproof {

struct HeldShapes {
  std::optional<double>
      yaw_rad;         // in the world, in (-pi, pi]; none: a circle, which may face anywhere
  Shape2 clear, tool;  // in the map's axes, as `yaws` takes them
  Yaws yaws = Yaws::kQuarters;  // kFirst where `clear` fits at this yaw and not at the next
};
HeldShapes HoldYaw(const HazardMap& map, const Pose2& start, const Shape2& clear,
                   const Shape2& tool);

// A footprint turned about the shape's centre; a circle stays.
Shape2 Turned(Shape2 shape, double yaw_rad);

}  // namespace floorproof

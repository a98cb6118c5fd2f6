// SPDX-License-Identifier: Apache-2.0
// What a planner or tracker that is not ours is told of robots, hazards and grids: the same keys in
// a program's request.json and in Python (docs/external-planner.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "env/core/hazard_map.h"
#include "env/core/robot_spec.h"
#include "env/geometry/grid.h"

namespace floorproof {

nlohmann::ordered_json DescribePose(const Pose2& pose);  // x_m, y_m, yaw_rad

// width, height, cell_m, origin: the pose of the outer lower left corner of cell (0, 0).
nlohmann::ordered_json DescribeFrame(const GridFrame& frame);

nlohmann::ordered_json DescribeRobot(const RobotSpec& robot);

// An array of all hazards of `map`. With a robot's step, `keep_off` says whether it must.
nlohmann::ordered_json DescribeHazards(const HazardMap& map, std::optional<double> step_m);

}  // namespace floorproof

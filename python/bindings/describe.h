// SPDX-License-Identifier: Apache-2.0
// What the structs that everything speaks look like from Python.
#pragma once

#include <vector>

#include "env/core/hazard_map.h"
#include "env/core/robot_spec.h"
#include "env/geometry/grid.h"
#include "python/bindings/host.h"
#include "run/scenario/scenario.h"

namespace floorproof {

nb::tuple PoseTuple(const Pose2& pose);  // x_m, y_m, yaw_rad
nb::list PointList(const std::vector<Vec2>& points);
// width, height, cell_m, origin (a pose: the outer lower-left corner of cell (0, 0)).
nb::dict FrameDict(const GridFrame& frame);
nb::dict ShapeDict(const Shape2& shape);  // radius_m, or polygon
nb::dict RobotDict(const RobotSpec& robot);
nb::list HazardList(const HazardMap& map);

// Says, as a Python warning of the caller's line, which program is about to be asked for the plan,
// if one is: before it runs. With or without the GIL. A warning that is an error ends the work.
void WarnOfProgram(const Scenario& scenario);

}  // namespace floorproof

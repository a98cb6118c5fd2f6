// SPDX-License-Identifier: Apache-2.0
// What the structs that everything speaks look like from Python.
#pragma once

#include <optional>

#include "env/core/hazard_map.h"
#include "env/core/robot_spec.h"
#include "env/geometry/grid.h"
#include "python/bindings/host.h"

namespace floorproof {

struct Scenario;

nb::tuple PoseTuple(const Pose2& pose);  // x_m, y_m, yaw_rad
// width, height, cell_m, origin (a pose: the outer lower-left corner of cell (0, 0)).
nb::dict FrameDict(const GridFrame& frame);
// As run/episode/descriptions.h has them.
nb::object RobotDict(const RobotSpec& robot);
nb::object HazardList(const HazardMap& map, std::optional<double> step_m);

// Says, as a Python warning of the caller's line, which program is about to be asked for the plan,
// if one is: before it runs. With or without the GIL. A warning that is an error ends the work.
void WarnOfProgram(const Scenario& scenario);

}  // namespace floorproof

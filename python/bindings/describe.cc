// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/describe.h"

#include <nlohmann/json.hpp>

#include "run/episode/descriptions.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

nb::object FromJson(const nlohmann::ordered_json& json) {
  return Ask(nb::module_::import_("json").attr("loads"), json.dump());
}

}  // namespace

nb::tuple PoseTuple(const Pose2& pose) { return nb::make_tuple(pose.x_m, pose.y_m, pose.yaw_rad); }

nb::dict FrameDict(const GridFrame& frame) {
  nb::dict out;
  out["width"] = frame.width;
  out["height"] = frame.height;
  out["cell_m"] = frame.cell_m;
  out["origin"] = PoseTuple(frame.X_WG);
  return out;
}

nb::object RobotDict(const RobotSpec& robot) { return FromJson(DescribeRobot(robot)); }

nb::object HazardList(const HazardMap& map, std::optional<double> step_m) {
  return FromJson(DescribeHazards(map, step_m));
}

void WarnOfProgram(const Scenario& scenario) {
  const std::string line = ProgramAnnounced(scenario);
  if (line.empty()) return;
  InPython("warnings.warn",
           [&line] { Ask(nb::module_::import_("floorproof._warn").attr("warn"), line); });
}

}  // namespace floorproof

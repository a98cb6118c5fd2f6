// SPDX-License-Identifier: Apache-2.0
// Planners of known floors, written in Python: plan(request) -> (rows or None, message).
#include "planners/planner.h"
#include "planners/risk/risk_map.h"
#include "python/bindings/arrays.h"
#include "python/bindings/describe.h"
#include "python/bindings/modules.h"
#include "python/bindings/plugin.h"

namespace floorproof {
namespace {

nb::dict RequestDict(const PlanRequest& request) {
  const RobotSpec& robot = request.robot;
  nb::dict out;
  out["frame"] = FrameDict(request.map.frame);
  Grid<std::uint8_t> walls(request.map.frame.width, request.map.frame.height);
  for (int iy = 0; iy < walls.height; ++iy)
    for (int ix = 0; ix < walls.width; ++ix) walls(ix, iy) = request.map.IsWall(ix, iy);
  out["walls"] = MaskArray(walls);
  const GridFrame fine = FineFrame(request.map.frame);
  out["obstacle_frame"] = FrameDict(fine);
  out["obstacles"] = MaskArray(ObstacleMask(request.map, robot.step_m, fine));
  if (request.risk != nullptr) {
    out["risk"] = GridArray<double>(request.risk->rf);
    out["risk_frame"] = FrameDict(request.risk->grid.frame);
  }
  out["hazards"] = HazardList(request.map, robot.step_m);
  out["robot"] = RobotDict(robot);
  out["start"] = PoseTuple(request.start);
  out["goal"] = request.goal ? nb::object(nb::make_tuple(request.goal->x(), request.goal->y()))
                             : nb::object(nb::none());
  out["seed"] = request.seed;
  return out;
}

class PythonPlanner final : public Planner {
 public:
  PythonPlanner(const std::string& name, nb::object plugin)
      : params_("planner " + name, std::move(plugin)) {}

  void Visit(ParamVisitor& v) override { params_.Visit(v); }

  PlannerPromises promises() const override {
    return InPython(params_.who(), [&] {
      const auto said = nb::cast<nb::dict>(Ask(params_.attr("promises")));
      PlannerPromises promises;
      promises.needs_risk = nb::cast<bool>(said["needs_risk"]);
      promises.needs_goal = nb::cast<bool>(said["needs_goal"]);
      promises.uses_seed = nb::cast<bool>(said["uses_seed"]);
      return promises;
    });
  }

  PlanResult Plan(const PlanRequest& request) const override {
    return InPython(params_.who(), [&] {
      PlanResult result;
      result.clear = request.robot.clear;
      result.tool = request.robot.tool;
      result.tool_width_m = request.robot.tool_width_m;
      const auto answer = nb::cast<nb::tuple>(Ask(params_.attr("plan"), RequestDict(request)));
      result.message = nb::cast<std::string>(answer[1]);
      const nb::object rows = answer[0];
      if (rows.is_none()) return result;  // failed, and says why
      result.path = FromStart(PathFrom(nb::cast<Rows>(rows), request.map.frame, params_.who()),
                              request.start.p());
      result.status = PlanStatus::kSuccess;
      return result;
    });
  }

 private:
  PythonParams params_;
};

}  // namespace

void BindPlannerPlugins(nb::module_& m) {
  m.def("register_planner", [](const std::string& name, nb::object make) {
    Register<Planner, PythonPlanner>(Planners(), name, std::move(make));
  });
  m.def("planners", [] { return Listed(Planners()); });
}

}  // namespace floorproof

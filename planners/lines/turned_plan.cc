// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/turned_plan.h"

#include <algorithm>

#include "base/quantity.h"
#include "planners/lines/turn_curves.h"

namespace floorproof {
namespace {

TurnedPath TurnedPathOf(const Path& path, const HazardMap& map, const RobotSpec& robot,
                        const Shape2& clear, double lane_m, const Pose2& X_WB) {
  constexpr double kMargin_m = 0.03;  // as plans keep for round robots' trackers
  const bool circle = clear.kind == Shape2::Kind::kCircle;
  const ClearanceField clearance = ComputeClearance(map, robot.step_m);
  return WithTurns(path, {.clearance = clearance,
                          .clear_radius_m = circle ? clear.radius_m : robot.circumscribed_radius_m,
                          .margin_m = kMargin_m,
                          .turn_radius_m = kTurnReserve * robot.turn_radius_m,
                          .lane_m = lane_m,
                          .start = X_WB});
}

}  // namespace

Path FitTurns(const Path& path, const HazardMap& map, const RobotSpec& robot, const Shape2& clear,
              const Pose2& X_WB) {
  return TurnedPathOf(path, map, robot, clear, 0, X_WB).path;
}

void FitTurns(const PlanRequest& request, PlanResult& plan) {
  constexpr double kWorthSaying = 0.0005;
  const RobotSpec& robot = request.robot;
  if (robot.turn_radius_m == 0 || plan.status != PlanStatus::kSuccess || plan.path.size() < 2)
    return;
  const double radius_m = kTurnReserve * robot.turn_radius_m;
  TurnedPath turned =
      TurnedPathOf(plan.path, request.map, robot, plan.clear, plan.tool_width_m, request.start);
  if (turned.path.empty()) {
    plan.status = PlanStatus::kFailed;
    plan.message =
        "from its start and heading the robot cannot turn into any leg of the plan: it needs arcs "
        "of " +
        LengthText(radius_m) + " radius";
    plan.path.clear();
    return;
  }
  const SweepArea area =
      ComputeSweepArea(request.map, plan.clear, plan.tool, robot.step_m, request.start.p());
  const double before = MeasureCoverage(area, plan.tool, plan.path).coverage;
  const double after = MeasureCoverage(area, plan.tool, turned.path).coverage;
  const double cost = std::max(0.0, before - after);
  const bool ends = turned.path.back().p_W == plan.path.back().p_W;
  plan.path = std::move(turned.path);
  plan.figures.emplace_back("turn_radius_m", radius_m);
  plan.figures.emplace_back("lanes_left_out", turned.left_out);
  plan.figures.emplace_back("turns_cost_coverage", cost);
  if (turned.left_out == 0 && turned.stops_left_out == 0 && ends && cost < kWorthSaying) return;
  plan.message += (plan.message.empty() ? "" : "; ");
  plan.message += "turns of " + LengthText(radius_m) + " radius leave out " +
                  CountText(turned.left_out, "lane") + " of " + std::to_string(turned.lanes);
  if (turned.left_out > 0) plan.message += ", " + NumberText(turned.left_out_m) + " m";
  if (turned.stops_left_out > 0)
    plan.message += ", and " + CountText(turned.stops_left_out, "stop");
  if (!ends) plan.message += ", the plan's end among them";
  plan.message += ", and cost " + PercentText(cost) + " of coverage";
}

}  // namespace floorproof

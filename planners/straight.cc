// SPDX-License-Identifier: Apache-2.0
// Straight: from the start to the goal in a straight line.
//
// The body holds the start's yaw (holonomic robots; others face along the way). It covers nothing:
// it is how one crossing is driven (measure), or a leg of which nothing but the ends is asked.
// Refused where the clear shape, at the start's yaw, meets a wall or an obstacle on the way, to
// within a cell of at most 5 cm. With `cross_obstacles` no hazard counts as one: the way leads over
// whatever lies there, as an experiment would.
// Not done: going around anything.
#include <cmath>

#include "planners/lines/held_yaw.h"
#include "planners/lines/why_nothing.h"
#include "planners/planner.h"

namespace floorproof {
namespace {

// Whether the robot's centre may be here: at one of the four cells' centres around.
bool Fits(const SweepArea& area, const Vec2& p_W) {
  const Vec2 p = area.frame.X_WG.Inverse() * p_W / area.frame.cell_m;
  const auto ix = static_cast<int>(std::floor(p.x() - 0.5));
  const auto iy = static_cast<int>(std::floor(p.y() - 0.5));
  for (const Cell cell : {Cell{ix, iy}, {ix + 1, iy}, {ix, iy + 1}, {ix + 1, iy + 1}})
    if (area.reachable.Inside(cell.ix, cell.iy) && area.reachable(cell.ix, cell.iy) != 0)
      return true;
  return false;
}

// The first place on the way where the robot does not fit; none: it does all along.
std::optional<Vec2> FirstMet(const SweepArea& area, const Vec2& from_W, const Vec2& to_W) {
  const double step_m = area.frame.cell_m / 4;
  const int steps = 1 + static_cast<int>((to_W - from_W).norm() / step_m);
  for (int i = 0; i <= steps; ++i) {
    const Vec2 p_W = from_W + (to_W - from_W) * i / steps;
    if (!Fits(area, p_W)) return p_W;
  }
  return {};
}

std::string Place(const Vec2& p_W) {
  const auto millimetres = [](double m) { return FormatDouble(std::round(1000 * m) / 1000 + 0.0); };
  return "(" + millimetres(p_W.x()) + ", " + millimetres(p_W.y()) + ") m";
}

class Straight final : public Planner {
 public:
  void Visit(ParamVisitor& v) override {
    v("speed_mps", speed_mps_, Between(0, 10), "along the way; 0: the robot's cruise speed");
    v("cross_obstacles", cross_obstacles_,
      "the way leads over known hazards that the robot is not trusted to cross, and into "
      "obstacles");
  }

  PlannerPromises promises() const override { return {.needs_goal = true, .ends_at_goal = true}; }

  PlanResult Plan(const PlanRequest& request) const override {
    PlanResult result;
    const RobotSpec& robot = request.robot;
    result.clear = robot.clear;
    result.tool = robot.tool;
    result.tool_width_m = robot.tool_width_m;
    if (robot.clear.kind == Shape2::Kind::kFootprint && !IsConvex(robot.clear.footprint_B)) {
      result.message = kNotConvex;
      return result;
    }
    HazardMap map = request.map;
    if (cross_obstacles_) map.hazards.clear();
    const double turned_rad = request.start.yaw_rad - map.frame.X_WG.yaw_rad;
    const SweepArea area =
        ComputeSweepArea(map, Turned(robot.clear, turned_rad), Turned(robot.tool, turned_rad),
                         robot.step_m, request.start.p(), Yaws::kFirst);
    if (!StartFits(area)) {
      result.status = PlanStatus::kStartBlocked;
      result.message = WhyNothing(request, area, robot.clear);
      return result;
    }
    if (!request.goal) {
      result.message = "a straight way needs a goal: the key goal";
      return result;
    }
    const Vec2 start_W = request.start.p(), goal_W = *request.goal;
    if ((goal_W - start_W).norm() < 1e-6) {
      result.message = "the goal " + Place(goal_W) + " is where the robot starts";
      return result;
    }
    if (const auto met = FirstMet(area, start_W, goal_W)) {
      result.status = PlanStatus::kGoalUnreachable;
      result.message =
          "the straight way to the goal " + Place(goal_W) + " is not free at " + Place(*met);
      return result;
    }
    for (const Vec2& p_W : {start_W, goal_W}) {
      Waypoint& waypoint = result.path.emplace_back();
      waypoint.p_W = p_W;
      waypoint.yaw_rad = request.start.yaw_rad;
      waypoint.speed_mps = speed_mps_;
    }
    result.status = PlanStatus::kSuccess;
    return result;
  }

 private:
  double speed_mps_ = 0;
  bool cross_obstacles_ = false;
};

}  // namespace

FP_DEFINE_PLUGIN(Planner, Straight)

}  // namespace floorproof

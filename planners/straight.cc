// SPDX-License-Identifier: Apache-2.0
// Straight: from the start to the goal in a straight line.
//
// With `lanes` it turns after `turn_at` of the way: `back` beside it and to the start; `thrice`,
// half the way back and there again; or it steps `aside` and goes on. A change of lane is two
// corners with `aside_m` between them, to the left where there is room, else to the right. The body
// holds the start's yaw (holonomic robots; others face along the way). It covers nothing: it is how
// one crossing is driven (measure), or a leg of which nothing but the ends is asked. Refused where
// the clear shape, at the start's yaw, meets a wall or an obstacle on the way, to within a cell of
// at most 5 cm. With `cross_obstacles` no hazard counts as one: the way leads over whatever lies
// there, as an experiment would. Not done: going around anything.
#include <cmath>

#include "planners/lines/held_yaw.h"
#include "planners/lines/why_nothing.h"
#include "planners/planner.h"

namespace floorproof {
namespace {

// Whether the robot's centre may be here: at one of the four cells' centres around.
bool Fits(const SweepArea& area, const Vec2& p_W) {
  const Vec2 p = area.frame.ToGrid(p_W) / area.frame.cell_m;
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

// But for the first leg.
bool IsFree(const SweepArea& area, const std::vector<Vec2>& corners) {
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    if (FirstMet(area, corners[i], corners[i + 1])) return false;
  return true;
}

bool Stands(const Hazard& hazard) {
  return hazard.hazard_class == HazardClass::kBlindObject ||
         hazard.hazard_class == HazardClass::kGlass;
}

SweepArea AreaOf(const PlanRequest& request, const HazardMap& map) {
  const RobotSpec& robot = request.robot;
  const double turned_rad = request.start.yaw_rad - map.frame.X_WG.yaw_rad;
  return ComputeSweepArea(map, Turned(robot.clear, turned_rad), Turned(robot.tool, turned_rad),
                          robot.step_m, request.start.p(), Yaws::kFirst);
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
    v("lanes", lanes_, {"one", "back", "thrice", "aside"},
      "one; there and back to the start; there, half the way back and there again; or one that "
      "steps aside and goes on");
    v("turn_at", turn_at_, Between(0.05, 1),
      "share of the way after which it leaves the first lane");
    v("turn_deg", turn_deg_, Between(0, 180),
      "the first of the two corners between lanes, to the left where there is room, else to the "
      "right");
    v("aside_m", aside_m_, Between(0, 10), "from the first of the two corners to the second");
  }

  PlannerPromises promises() const override {
    return {.needs_goal = true, .ends_at_goal = lanes_ != "back"};
  }

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
    const SweepArea area = AreaOf(request, map);
    map.hazards = request.map.hazards;
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
    std::vector<Vec2> corners = {start_W, goal_W};
    if (lanes_ != "one") {
      std::erase_if(map.hazards, [](const Hazard& hazard) { return !Stands(hazard); });
      const SweepArea room = AreaOf(request, map);
      for (const double left : {-1.0, 1.0})
        if (std::vector<Vec2> there = Corners(start_W, goal_W, left); IsFree(room, there))
          corners = std::move(there);
      if (corners.size() == 2) result.message = "there is no room beside the way: it is one lane";
    }
    for (const Vec2& p_W : corners) {
      Waypoint& waypoint = result.path.emplace_back();
      waypoint.p_W = p_W;
      waypoint.yaw_rad = request.start.yaw_rad;
      waypoint.speed_mps = speed_mps_;
    }
    result.status = PlanStatus::kSuccess;
    return result;
  }

 private:
  // Of the whole way, its ends included; none twice in a row. `left`: 1; -1 where it changes lanes
  // to the right.
  std::vector<Vec2> Corners(const Vec2& start_W, const Vec2& goal_W, double left) const {
    const Vec2 way = goal_W - start_W, ahead = way.normalized();
    const Vec2 across = left * Vec2(-ahead.y(), ahead.x());
    const double turn_rad = turn_deg_ * kPi / 180;
    const double on_m = aside_m_ * std::cos(turn_rad), aside_m = aside_m_ * std::sin(turn_rad);
    std::vector<Vec2> corners = {start_W};
    const auto go_to = [&](const Vec2& p_W) {
      if ((p_W - corners.back()).norm() > kSame_m) corners.push_back(p_W);
    };
    // In the lane that it is in, so far along the way.
    const auto go_on_to = [&](double share) {
      const Vec2 from_W = corners.back();
      go_to(from_W + (start_W + share * way - from_W).dot(ahead) * ahead);
    };
    if (lanes_ != "one") {
      go_to(start_W + turn_at_ * way);
      go_to(corners.back() + on_m * ahead + aside_m * across);
      if (lanes_ == "aside") go_on_to(1);
      if (lanes_ == "back") go_on_to(0);
      if (lanes_ == "thrice") {
        go_on_to(turn_at_ / 2);
        go_to(corners.back() - on_m * ahead + aside_m * across);
        go_on_to(1);
      }
    }
    go_to(lanes_ == "back" ? start_W : goal_W);
    return corners;
  }

  static constexpr double kSame_m = 1e-6;
  double speed_mps_ = 0;
  bool cross_obstacles_ = false;
  std::string lanes_ = "one";
  double turn_at_ = 0.5, turn_deg_ = 90, aside_m_ = 0.3;
};

}  // namespace

FP_DEFINE_PLUGIN(Planner, Straight)

}  // namespace floorproof

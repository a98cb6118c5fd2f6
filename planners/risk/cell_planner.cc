// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/cell_planner.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "planners/risk/cell_anchors.h"
#include "planners/risk/cell_path.h"

namespace floorproof {
namespace {

Cell FarthestFree(const Grid<std::int32_t>& steps, const RiskGrid& grid, Cell start) {
  Cell farthest = start;
  for (int iy = 0; iy < steps.height; ++iy)
    for (int ix = 0; ix < steps.width; ++ix)
      if (grid.contents(ix, iy).free() && steps(ix, iy) > steps(farthest)) farthest = {ix, iy};
  return farthest;
}

CellMotion MotionOf(const PlanRequest& request, const std::vector<Cell>& tour, bool with_care,
                    TerrainLead lead) {
  const RiskGrid& grid = request.risk->grid;
  CellMotion motion;
  if (with_care) motion.speed_mps = SpeedsOverTerrain(grid, tour, request.robot);
  if (!HoldsYaw(request.robot)) return motion;
  // The start's yaw, to the next of the map's quarters.
  const double map_yaw = request.map.frame.X_WG.yaw_rad, quarter = kPi / 2;
  const int first =
      static_cast<int>(std::lround(WrapAngle(request.start.yaw_rad - map_yaw) / quarter)) & 3;
  for (const int q : QuartersOverTerrain(grid, tour, first, lead))
    motion.yaw_rad.push_back(WrapAngle(map_yaw + q * quarter));
  return motion;
}

}  // namespace

TerrainLead CellPlanner::terrain_lead(const RobotSpec& robot) const {
  return crosses_with_care() && robot.cover_forward_rad > robot.cover_sideways_rad
             ? TerrainLead::kForward
             : TerrainLead::kAny;
}

void CellPlanner::Visit(ParamVisitor& visit) {
  visit("unreachable_share", unreachable_share_, Between(0, 1),
        "of the free cells that may be out of reach; with more of them the floor has fallen apart");
}

PlanResult CellPlanner::Plan(const PlanRequest& request) const {
  PlanResult result;
  result.clear = request.robot.clear;
  result.tool = request.robot.tool;
  result.tool_width_m = request.robot.tool_width_m;
  if (request.risk == nullptr) {
    result.message = "the floor's risk is not known";
    return result;
  }
  const RiskGrid& grid = request.risk->grid;
  const auto refuse = [&](PlanStatus status, const std::string& message) {
    result.status = status;
    result.message = message;
    return result;
  };
  const double width_m = LeastCellWidth(request.robot);
  constexpr double kSameWidth_m = 1e-3;
  if (grid.frame.cell_m < width_m - kSameWidth_m) {
    std::ostringstream why_not;
    why_not << "the risk's cells of " << grid.frame.cell_m << " m are narrower than the robot, "
            << width_m << " m";
    return refuse(PlanStatus::kFailed, why_not.str());
  }
  CellAnchors anchors(request);
  std::string why;
  const std::optional<Cell> start = anchors.At(request.start.p(), why);
  if (!start)
    return refuse(PlanStatus::kStartBlocked,
                  "start " + DescribePlace(request.map.frame, request.start.p()) + ": " + why);

  Grid<std::uint8_t> drivable = CellsThat(grid, &RiskCell::drivable);
  const Grid<std::int32_t> steps = StepsFrom(drivable, *start);
  CellTask task{*request.risk, *start, *start, {drivable.width, drivable.height}, {}};
  std::size_t free = 0, lost = 0;
  std::optional<Cell> first_lost;
  for (std::size_t i = 0; i < drivable.cells.size(); ++i) {
    const bool reached = steps.cells[i] >= 0;
    drivable.cells[i] &= reached;
    if (!grid.contents.cells[i].free()) continue;
    ++free;
    task.free.cells[i] = reached;
    lost += !reached;
    if (!reached && !first_lost) first_lost = CellAt(drivable, i);
  }
  task.drivable = std::move(drivable);
  if (lost > 0) {
    std::ostringstream lost_cells;
    lost_cells << "neither floor nor terrain leads in such cells from the start to "
               << DescribePlace(grid.frame, grid.frame.Center(*first_lost));
    if (lost > 1) lost_cells << ", and to " << lost - 1 << " more";
    lost_cells << ", of " << free << " free ones";
    if (static_cast<double>(lost) > unreachable_share_ * static_cast<double>(free))
      return refuse(PlanStatus::kFloorDivided, "the floor falls apart: " + lost_cells.str());
    result.message = "left out: " + lost_cells.str();
  }

  task.end = FarthestFree(steps, grid, task.start);
  if (request.goal) {
    const std::optional<Cell> goal = anchors.At(*request.goal, why);
    if (!goal || !task.free(*goal))
      return refuse(PlanStatus::kGoalUnreachable,
                    "goal " + DescribePlace(request.map.frame, *request.goal) + ": " +
                        (goal ? "neither floor nor terrain leads there from the start" : why));
    task.end = *goal;
  }

  const CellTour tour = Tour(task, result.figures);
  Grid<std::uint8_t> left_out = task.free;
  for (const Cell cell : tour.cells) left_out(cell) = 0;
  result.left_out_cells = static_cast<int>(std::ranges::count(left_out.cells, 1));
  if (result.left_out_cells > 0)
    result.message += (result.message.empty() ? "" : "; ") +
                      ("left out for their risk: " + std::to_string(result.left_out_cells)) +
                      " of " + std::to_string(free) + " free cells";
  result.figures.push_back({"cell_m", grid.frame.cell_m});
  result.figures.push_back({"dead_ends", tour.dead_ends});
  result.figures.push_back({"unreachable_cells", static_cast<double>(lost)});
  const CellMotion motion =
      MotionOf(request, tour.cells, crosses_with_care(), terrain_lead(request.robot));
  result.path = ToPath(tour, motion, grid.frame, request.start,
                       request.goal.value_or(grid.frame.Center(task.end)));
  result.status = PlanStatus::kSuccess;
  return result;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/cell_planner.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "env/core/coverage.h"
#include "planners/risk/terrain_yaw.h"

namespace floorproof {
namespace {

constexpr double kSame_m = 1e-6;

std::string_view Name(HazardClass c) {
  constexpr std::string_view kNames[] = {"a blind object (C1)", "glass (C2)", "a level change (C3)",
                                         "terrain (C4)"};
  return kNames[static_cast<std::size_t>(c)];
}

// "(1.25, 0.75) m, cell (2, 1)", of the map's own cells.
std::string Place(const HazardMap& map, const Vec2& p) {
  const Cell cell = map.frame.ToCell(p);
  std::ostringstream out;
  out << "(" << FormatDouble(p.x()) << ", " << FormatDouble(p.y()) << ") m, cell (" << cell.ix
      << ", " << cell.iy << ")";
  return out.str();
}

// Finds the cell that a place of the robot belongs to.
class Anchors {
 public:
  explicit Anchors(const PlanRequest& request) : request_(request), grid_(request.risk->grid) {}

  // The free cell that holds p and the robot there; where it stands beside a wall or solid, the
  // nearest free one that it can drive straight to. `why` says else.
  std::optional<Cell> At(const Vec2& p, std::string& why) {
    const Cell cell = grid_.frame.ToCell(p);
    // (On the map's very edge the two frames may round apart.)
    if (!request_.map.frame.Inside(request_.map.frame.ToCell(p)) || !grid_.frame.Inside(cell)) {
      why = "lies off the map";
      return std::nullopt;
    }
    for (const Hazard& hazard : request_.map.hazards)
      for (const Polygon& polygon : hazard.footprint)
        if (Contains(polygon, p)) {
          why = "lies on a hazard, " + std::string(Name(hazard.hazard_class));
          return std::nullopt;
        }
    if (grid_.cells(cell).terrain()) {
      why = "its cell holds a hazard, terrain (C4)";
      return std::nullopt;
    }
    if (grid_.cells(cell).free() && LiesWithin(cell, p)) return cell;
    if (!Fits(p)) {
      const auto& hazard = grid_.cells(cell).hazard;
      why = "the robot does not fit";
      if (hazard) why += ": its cell holds a hazard, " + std::string(Name(*hazard));
      return std::nullopt;
    }
    std::optional<Cell> best;
    double least = std::numeric_limits<double>::infinity();
    constexpr int kReach = 2;
    for (int dy = -kReach; dy <= kReach; ++dy)
      for (int dx = -kReach; dx <= kReach; ++dx) {
        const Cell near = cell + Cell{dx, dy};
        if (!grid_.cells.Inside(near) || !grid_.cells(near).free()) continue;
        const double d = (grid_.frame.Center(near) - p).norm();
        if (d < least && Sees(p, grid_.frame.Center(near))) best = near, least = d;
      }
    if (!best) why = "the robot fits, but it can drive straight to no free cell of its width";
    return best;
  }

 private:
  // Whether the clear shape at p keeps to the cell, which is free as a whole.
  bool LiesWithin(Cell cell, const Vec2& p) const {
    const double room_m = (grid_.frame.cell_m - LeastCellWidth(request_.robot)) / 2;
    const Vec2 off_G = grid_.frame.X_WG.Inverse().Rotate(p - grid_.frame.Center(cell));
    constexpr double kTouch_m = 1e-3;
    return off_G.cwiseAbs().maxCoeff() <= room_m + kTouch_m;
  }

  // Of places that do not keep to a free cell; its own, finer ruler.
  const SweepArea& area() {
    if (!area_)
      area_ = ComputeSweepArea(request_.map, request_.robot.clear, request_.robot.tool,
                               request_.robot.step_m, request_.start.p());
    return *area_;
  }
  bool Reaches(Cell fine) { return area().reachable.Inside(fine) && area().reachable(fine); }
  bool Fits(const Vec2& p) {
    const Cell fine = area().frame.ToCell(p);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (Reaches(fine + Cell{dx, dy})) return true;
    return false;
  }
  // Whether it drives straight from a to b, the centre of a free cell.
  bool Sees(const Vec2& a, const Vec2& b) {
    const int samples = 1 + static_cast<int>((b - a).norm() / area().frame.cell_m);
    for (int i = 1; i < samples; ++i)
      if (!IsClear(a + (b - a) * i / samples)) return false;
    return true;
  }
  // A place on a border of fine cells is in each of them.
  bool IsClear(const Vec2& p) {
    constexpr double kBorder_m = 1e-6;
    for (const double dy : {-kBorder_m, kBorder_m})
      for (const double dx : {-kBorder_m, kBorder_m})
        if (Reaches(area().frame.ToCell(p + area().frame.X_WG.Rotate({dx, dy})))) return true;
    return false;
  }

  const PlanRequest& request_;
  const RiskGrid& grid_;
  std::optional<SweepArea> area_;
};

Cell FarthestFree(const Grid<std::int32_t>& steps, const RiskGrid& grid, Cell start) {
  Cell farthest = start;
  for (int iy = 0; iy < steps.height; ++iy)
    for (int ix = 0; ix < steps.width; ++ix)
      if (grid.cells(ix, iy).free() && steps(ix, iy) > steps(farthest)) farthest = {ix, iy};
  return farthest;
}

// How a robot goes to each cell of a tour; both may be empty.
struct Gait {
  std::vector<double> yaw_rad;    // held on the way
  std::vector<double> speed_mps;  // 0: the robot's own
};

// The tour as waypoints, without points on straight lines.
Path ToPath(const CellTour& tour, const Gait& gait, const GridFrame& frame, const Pose2& start,
            const Vec2& end) {
  Path path;
  const auto add = [&](const Vec2& p, std::size_t i) {
    const std::optional<double> yaw =
        gait.yaw_rad.empty() ? std::nullopt : std::optional<double>(gait.yaw_rad[i]);
    const double speed_mps = gait.speed_mps.empty() ? 0 : gait.speed_mps[i];
    if (!path.empty() && (path.back().p_W - p).norm() < kSame_m) return;
    const std::size_t n = path.size();
    if (n >= 2 && path[n - 1].yaw_rad == yaw && path[n - 1].speed_mps == speed_mps) {
      const Vec2 before = path[n - 1].p_W - path[n - 2].p_W, now = p - path[n - 1].p_W;
      if (std::abs(Cross(before, now)) < kSame_m * before.norm() && before.dot(now) > 0)
        path.pop_back();
    }
    Waypoint waypoint;
    waypoint.p_W = p;
    waypoint.yaw_rad = yaw;
    waypoint.speed_mps = speed_mps;
    path.push_back(waypoint);
  };
  add(start.p(), 0);
  for (std::size_t i = 0; i < tour.cells.size(); ++i) add(frame.Center(tour.cells[i]), i);
  add(end, tour.cells.size() - 1);
  return path;
}

// Limits of covers grow with speed, up to the fastest that the ladder has charted
// (docs/validation.md).
std::vector<double> FastOverTerrain(const RiskGrid& grid, const std::vector<Cell>& tour,
                                    const RobotSpec& robot) {
  constexpr double kCharted_mps = 0.3;
  std::vector<double> speed_mps(tour.size(), 0);
  for (std::size_t i = 1; i < tour.size(); ++i)
    if (grid.cells(tour[i]).terrain() || grid.cells(tour[i - 1]).terrain())
      speed_mps[i] = std::min(kCharted_mps, robot.max_speed_mps);
  return speed_mps;
}

}  // namespace

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
  Anchors anchors(request);
  std::string why;
  const std::optional<Cell> start = anchors.At(request.start.p(), why);
  if (!start)
    return refuse(PlanStatus::kStartBlocked,
                  "start " + Place(request.map, request.start.p()) + ": " + why);

  Grid<std::uint8_t> drivable(grid.cells.width, grid.cells.height);
  for (std::size_t i = 0; i < drivable.cells.size(); ++i)
    drivable.cells[i] = !grid.cells.cells[i].solid;
  const Grid<std::int32_t> steps = StepsFrom(drivable, *start);
  CellTask task{*request.risk, *start, *start, {drivable.width, drivable.height}, {}};
  std::size_t free = 0, lost = 0;
  std::optional<Cell> first_lost;
  for (std::size_t i = 0; i < drivable.cells.size(); ++i) {
    const bool reached = steps.cells[i] >= 0;
    drivable.cells[i] &= reached;
    if (!grid.cells.cells[i].free()) continue;
    ++free;
    task.free.cells[i] = reached;
    lost += !reached;
    if (!reached && !first_lost)
      first_lost = Cell{static_cast<int>(i) % drivable.width, static_cast<int>(i) / drivable.width};
  }
  task.drivable = std::move(drivable);
  if (static_cast<double>(lost) > unreachable_share_ * static_cast<double>(free))
    return refuse(PlanStatus::kFloorDivided,
                  "the floor falls apart: neither floor nor terrain leads from the start to " +
                      Place(request.map, grid.frame.Center(*first_lost)) + " and " +
                      std::to_string(lost - 1) + " more of " + std::to_string(free) +
                      " free cells");

  task.end = FarthestFree(steps, grid, task.start);
  if (request.goal) {
    const std::optional<Cell> goal = anchors.At(*request.goal, why);
    if (!goal || !task.free(*goal))
      return refuse(PlanStatus::kGoalUnreachable,
                    "goal " + Place(request.map, *request.goal) + ": " +
                        (goal ? "neither floor nor terrain leads there from the start" : why));
    task.end = *goal;
  }

  const CellTour tour = Tour(task, result.figures);
  result.figures.push_back({"cell_m", grid.frame.cell_m});
  result.figures.push_back({"dead_ends", tour.dead_ends});
  result.figures.push_back({"unreachable_cells", static_cast<double>(lost)});
  Gait gait;
  const bool charted = crosses_with_care() && request.robot.cover_forward_rad > 0;
  if (charted) gait.speed_mps = FastOverTerrain(grid, tour.cells, request.robot);
  if (result.clear.kind == Shape2::Kind::kFootprint) {
    // The start's yaw, to the next of the map's quarters.
    const double map_yaw = request.map.frame.X_WG.yaw_rad, quarter = kPi / 2;
    const int first =
        static_cast<int>(std::lround(WrapAngle(request.start.yaw_rad - map_yaw) / quarter)) & 3;
    std::vector<int> quarters(tour.cells.size(), first);
    if (charted && request.robot.cover_forward_rad > request.robot.cover_sideways_rad)
      quarters = QuartersForwardOverTerrain(grid, tour.cells, first);
    for (const int q : quarters) gait.yaw_rad.push_back(WrapAngle(map_yaw + q * quarter));
  }
  result.path = ToPath(tour, gait, grid.frame, request.start,
                       request.goal.value_or(grid.frame.Center(task.end)));
  result.status = PlanStatus::kSuccess;
  return result;
}

}  // namespace floorproof

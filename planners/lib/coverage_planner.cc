// SPDX-License-Identifier: Apache-2.0
#include "planners/lib/coverage_planner.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "planners/lib/laps.h"
#include "planners/lib/leftovers.h"
#include "planners/lib/pieces.h"
#include "planners/lib/prune.h"
#include "planners/lib/tour.h"

namespace floorproof {
namespace {

std::string WhyNothing(const PlanRequest& request, const SweepArea& area, const Shape2& clear,
                       bool fits) {
  const Vec2 p = request.start.p();
  const Cell cell = request.map.frame.ToCell(p), fine = area.frame.ToCell(p);
  std::ostringstream out;
  out << "start (" << FormatDouble(p.x()) << ", " << FormatDouble(p.y()) << ") m, cell (" << cell.ix
      << ", " << cell.iy << "): ";
  if (fits) {
    out << "the tool sweeps no floor from there";
  } else if (!request.map.frame.Inside(cell)) {
    out << "lies off the map";
  } else {
    out << "the robot does not fit: an obstacle is "
        << std::lround(1000 * static_cast<double>(area.clearance_m(fine))) << " mm away";
    if (clear.kind == Shape2::Kind::kCircle)
      out << " and " << std::lround(1000 * clear.radius_m) << " mm are kept clear";
  }
  return out.str();
}

Polyline Drive(Ways& ways, const Vec2& start, const std::vector<Polyline>& lines) {
  std::vector<Polyline> ordered = {{start}};
  for (const Stop& stop : OrderLines(ways, start, lines)) {
    ordered.push_back(lines[stop.line]);
    if (stop.reversed) std::reverse(ordered.back().begin(), ordered.back().end());
  }
  return MergeStraight(JoinByRoutes(ways, ordered));
}

}  // namespace

void CoveragePlanner::Visit(ParamVisitor& visit) {
  visit("tool_width_m", tool_width_m_, Positive(),
        "width of a disc that sweeps; none: the robot's tool");
  visit("radius_m", radius_m_, Positive(), "of a circle kept clear; none: the robot's clear shape");
  visit("overlap", overlap_, Between(0, 0.9), "of neighbouring rows, share of the tool's width");
  visit("edges", edges_, "laps along walls and furniture first");
}

Polyline CoveragePlanner::Sweep(const Floor& floor, const Vec2& start, Figures& figures) const {
  const double w = floor.tool_width;
  Ways ways(floor);
  const Grid<float> depth = PoseDepth(floor);
  const std::vector<Polyline> walls = Contours(floor, depth, 0);

  std::vector<Polyline> lines;
  Swept covered(floor);
  if (edges_) lines = OpenParts(floor, walls, 0.25, w, covered);
  for (Polyline& line : Lines(floor, covered, figures)) lines.push_back(std::move(line));

  Polyline path = Drive(ways, start, lines);
  const double goal = edges_ ? 0.992 : 0.97;
  for (int round = 0; round < 2; ++round) {
    Swept swept(floor);
    swept.Add(path);
    figures.push_back({"coverage" + std::to_string(round), swept.share()});
    figures.push_back({"length" + std::to_string(round), PolylineLength(path) * w / floor.ground_cells});
    Prune(floor, {goal * floor.ground_cells, 0.15}, path, swept);
    figures.push_back({"prlength" + std::to_string(round), PolylineLength(path) * w / floor.ground_cells});
    std::vector<Polyline> pieces = WorkingPieces(floor, path, 0.1, swept);
    const double min_gain = (edges_ ? 0.3 : 0.5) * w * w / (1 + round);
    std::vector<Polyline> rest = OpenParts(floor, walls, (edges_ ? 0.2 : 0.4) / (1 + round), min_gain, swept);
    for (auto& line : LinesOverLeftovers(floor, ways, min_gain, swept)) rest.push_back(std::move(line));
    CutBeside(floor, rest, 6 * w, pieces);
    for (auto& line : rest) pieces.push_back(std::move(line));
    path = Drive(ways, start, pieces);
  }
  Swept swept(floor);
  swept.Add(path);
  figures.push_back({"coverage2", swept.share()});
  figures.push_back({"length2", PolylineLength(path) * w / floor.ground_cells});
  Prune(floor, {goal * floor.ground_cells, edges_ ? 0.25 : 0.4}, path, swept);
  // A cluttered floor is dear: there the last per cent may go for less.
  if (PolylineLength(path) * w > 1.25 * floor.ground_cells)
    Prune(floor, {(edges_ ? 0.988 : 0.96) * floor.ground_cells, edges_ ? 0.4 : 0.6}, path, swept);
  return MergeStraight(path);
}

PlanResult CoveragePlanner::Plan(const PlanRequest& request) const {
  PlanResult result;
  result.clear = request.robot.clear;
  result.tool = request.robot.tool;
  result.tool_width_m = request.robot.tool_width_m;
  if (radius_m_) result.clear = {Shape2::Kind::kCircle, *radius_m_, {}};
  if (tool_width_m_) {
    result.tool = {Shape2::Kind::kCircle, *tool_width_m_ / 2, {}};
    result.tool_width_m = *tool_width_m_;
  }
  const SweepArea area = ComputeSweepArea(request.map, result.clear, result.tool,
                                          request.robot.step_m, request.start.p());
  if (area.sweepable_cells == 0) {
    const bool fits = std::find(area.reachable.cells.begin(), area.reachable.cells.end(), 1) !=
                      area.reachable.cells.end();
    result.status = fits ? PlanStatus::kNoFloor : PlanStatus::kStartBlocked;
    result.message = WhyNothing(request, area, result.clear, fits);
    return result;
  }
  const Floor floor = CropFloor(area, result.clear, result.tool, result.tool_width_m);
  const Polyline path = Sweep(floor, floor.ToCells(request.start.p()), result.figures);
  for (const Vec2& p : path) {
    Waypoint w;
    w.p_W = floor.ToWorld(p);
    result.path.push_back(w);
  }
  result.status = PlanStatus::kSuccess;
  return result;
}

}  // namespace floorproof

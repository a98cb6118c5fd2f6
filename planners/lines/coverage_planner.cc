// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/coverage_planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/quantity.h"
#include "env/core/standing.h"
#include "planners/lines/held_yaw.h"
#include "planners/lines/kept_margin.h"
#include "planners/lines/map_along_walls.h"
#include "planners/lines/pieces.h"
#include "planners/lines/prune.h"
#include "planners/lines/relax.h"
#include "planners/lines/tour.h"
#include "planners/lines/uncovered_patches.h"
#include "planners/lines/wall_contours.h"
#include "planners/lines/why_nothing.h"

namespace floorproof {
namespace {

// How far to go for the last of the ground. A detour is worth its length when it sweeps more than
// this share of width * length. The values were chosen on eight real maps, for the coverage that is
// asked of these planners and about one per cent more, as no robot tracks a path perfectly.
struct Effort {
  double goal;  // coverage below which nothing is given up
  double worth;
  double least_goal;  // the same where the floor is dear
  double dear_worth;
  double least_gain;     // a visit to an uncovered patch sweeps at least this, in width^2
  double open_share;     // of the tool's width, along walls
  double relaxed_worth;  // as `worth`, where points and lines are shifted
};
constexpr Effort kRowsOnly = {0.965, 0.4, 0.948, 0.7, 0.5, 0.4, 1.05};
constexpr Effort kWithEdges = {0.989, 0.25, 0.981, 0.6, 0.3, 0.2, 0.4};
constexpr double kSmall = 0.02;  // of the ground: worth a visit however small
constexpr int kRounds = 2;       // before a path is good enough to be finished
constexpr int kMaxRounds = 4;    // of a path that leaves too much; later ones visit smaller patches
// A path of few points is cheap to shift more finely, and to make anew from what the last one left:
// the best is kept.
constexpr std::size_t kFewPoints = 1000;
constexpr double kTriedEffort = 2600, kMostTries = 9;
constexpr double kPointCost = 0.15;    // tool widths
constexpr double kPocket = 1;          // width^2: what is left of this size and more, people see
constexpr double kVisitCost = 4;       // tool widths
constexpr double kLacking = 3;         // what ground below the goal costs, in rows over it
constexpr double kDear = 1.25;         // length above this many times ground / width
constexpr double kLapShare = 0.4;      // of the tool's width open: a lap along a wall pays
constexpr double kFirstWorth = 0.15;   // before a path is taken apart: only what is plainly lost
constexpr double kWorkingShare = 0.1;  // a segment that sweeps less of its own is a transit
constexpr double kCutReach = 6;        // tool widths: from so far aside a line is left for a visit
constexpr double kMaxGoal = 0.995;
// The tracker's error on such plans, and a little more: of round robots, which turn on the spot,
// and of holonomic robots with a footprint.
constexpr double kMargin_m = 0.03, kFootprintMargin_m = 0.015;
constexpr double kLeastMargin_m = 0.01;  // the smallest default margin
constexpr double kMaxLost = 0.04;        // of the ground, to a larger one
constexpr double kDriveLoss = 0.012;    // of the ground, measured: corners driven less than exactly
constexpr double kWallTolerance = 0.7;  // cells: a traced contour's staircase

struct Outcome {
  double cost;  // its length and bends, and what it would take to sweep the ground that lacks
  bool enough;  // is swept
};

// Shortens a path to what is worth its length.
Outcome Finish(const Floor& floor, const ShortestPaths& paths, const Effort& effort,
               Polyline& path) {
  double goal_cells = effort.goal * floor.ground_cells;
  Swept swept(floor);
  swept.Add(path);
  Relax(floor, {goal_cells, effort.relaxed_worth, 1, 0.5}, path, swept);
  Prune(floor, {goal_cells, effort.worth, 1}, path, swept);
  if (path.size() < kFewPoints) {
    Relax(floor, {goal_cells, effort.relaxed_worth, 0.5, 0.5}, path, swept);
    Prune(floor, {goal_cells, effort.worth, 1}, path, swept);
  }
  if (PolylineLength(path) * floor.tool_width > kDear * floor.ground_cells) {
    goal_cells = effort.least_goal * floor.ground_cells;
    Prune(floor, {goal_cells, effort.dear_worth}, path, swept);
  }
  path = MergeStraight(path);
  const double lacking = std::max(0.0, goal_cells - swept.swept_cells());
  const bool enough = swept.swept_cells() >= effort.least_goal * floor.ground_cells;
  const double w = floor.tool_width;
  double cost = PolylineLength(path) + kLacking * lacking / w +
                kPointCost * w * static_cast<double>(path.size());
  for (const Polyline& line : LinesOverUncoveredPatches(floor, paths, kPocket * w * w, swept))
    cost += PolylineLength(line) + kVisitCost * w;
  return {cost, enough};
}

// What making a path anew takes, about: in points, with those that its length is worth.
double EffortOfTry(const Floor& floor, const Polyline& path) {
  constexpr double kWidthsOfPoint = 6;
  return static_cast<double>(path.size()) +
         PolylineLength(path) / (kWidthsOfPoint * floor.tool_width);
}

Polyline Drive(ShortestPaths& paths, const Vec2& start, const std::vector<Polyline>& lines,
               bool thorough) {
  std::vector<Polyline> ordered = {{start}};
  for (const Stop& stop : OrderLines(paths, start, lines, thorough)) {
    ordered.push_back(lines[stop.line]);
    if (stop.reversed) std::reverse(ordered.back().begin(), ordered.back().end());
  }
  return MergeStraight(JoinByRoutes(paths, ordered));
}

// Of two plans for one floor, whether the one along the walls is to be taken: it covers enough, and
// takes less length and turns for the share of the floor that it covers.
bool IsBetter(const SweepArea& area, const PlanResult& along, const PlanResult& plain) {
  constexpr double kTurn_m = 0.25;   // a turn takes a holonomic robot about a second
  constexpr double kMinGain = 0.03;  // of the cost
  constexpr double kEnough = 0.94, kMaxLess = 0.02;  // covered; or so much less than the other
  if (plain.status != PlanStatus::kSuccess) return true;
  const auto cost_m = [](const PlanResult& plan, double share) {
    double length_m = 0;
    for (std::size_t i = 1; i < plan.path.size(); ++i)
      length_m += (plan.path[i].p_W - plan.path[i - 1].p_W).norm() + kTurn_m;
    return length_m / std::max(share, 1e-9);
  };
  const double along_share = MeasureCoverage(area, along.tool, along.path).coverage;
  const double plain_share = MeasureCoverage(area, plain.tool, plain.path).coverage;
  return along_share >= std::min(kEnough, plain_share - kMaxLess) &&
         cost_m(along, along_share) < (1 - kMinGain) * cost_m(plain, plain_share);
}

// The floor that is swept with a margin.
struct RoomyFloor {
  double margin_m = 0;
  double lost = 0;  // of the ground, to the margin
  SweepArea area;
  std::optional<KeptMargin> kept;  // with narrow places
};

// Keeps room for the tracker's error. `bare`: without a margin, and the margin to begin with. A
// given margin is kept everywhere. Else it is halved while it takes much of the floor, but never
// dropped: narrower places are passed in their middle.
RoomyFloor KeepMargin(const FloorRoom& room, const HeldShapes& held, const Vec2& start_W,
                      RoomyFloor bare, bool is_given) {
  RoomyFloor out;
  const auto keep = [&](SweepArea area) {
    out.lost = 1 - static_cast<double>(area.sweepable_cells) /
                       static_cast<double>(bare.area.sweepable_cells);
    out.area = std::move(area);
  };
  for (out.margin_m = bare.margin_m;; out.margin_m = std::max(kLeastMargin_m, out.margin_m / 2)) {
    keep(room.Sweepable(Grown(held.clear, out.margin_m), held.tool, start_W, held.yaws));
    if (is_given || out.lost <= kMaxLost) return out;
    out.kept.emplace(room, held, out.margin_m, bare.area, start_W);
    keep(out.kept->area());
    if (out.lost <= kMaxLost || out.margin_m <= kLeastMargin_m) return out;
    out.kept.reset();
  }
}

// What its margin means for a plan; empty: nothing to say.
std::string MarginText(const RoomyFloor& roomy, const std::vector<Vec2>& path_W) {
  std::string text;
  if (roomy.margin_m > 0 && roomy.lost > kMaxLost)
    text = fmt::format("with margin_m = {}, the plan leaves out {} of the floor",
                       LengthText(roomy.margin_m), PercentText(roomy.lost));
  const int places = roomy.kept ? roomy.kept->PlacesOn(path_W) : 0;
  if (places == 0) return text;
  return text + (text.empty() ? "" : "; ") +
         fmt::format(
             "the plan passes {} through the middle of a narrow place, with less room than its "
             "margin of {} on either side",
             CountText(places, "time"), LengthText(roomy.margin_m));
}

}  // namespace

void CoveragePlanner::Visit(ParamVisitor& visit) {
  visit("tool_width_m", tool_width_m_, Positive(),
        "width of a disc that sweeps; none: the robot's tool");
  visit("radius_m", radius_m_, Positive(), "of a circle kept clear; none: the robot's clear shape");
  visit("margin_m", margin_m_, NonNegative(),
        "kept beyond the clear shape for the tracker's error; none: 0.03 around a robot's circle, "
        "0.015 around its footprint, 0 around radius_m; reduced to 0.01 if it takes much of the "
        "floor, and narrower doors are passed in their middle. A given margin is kept everywhere, "
        "to within half a cell of the map");
  visit("overlap", overlap_, Between(0, 0.9), "of neighbouring rows, share of the tool's width");
  visit("edges", edges_, "laps along walls and furniture first");
}

Polyline CoveragePlanner::Sweep(const Floor& floor, const Vec2& start, double shortfall,
                                Figures& figures) const {
  Effort effort = edges_ ? kWithEdges : kRowsOnly;
  effort.goal = std::min(kMaxGoal, effort.goal + shortfall);
  effort.least_goal = std::min(kMaxGoal, effort.least_goal + shortfall);
  const double goal_cells = effort.goal * floor.ground_cells;
  const double w = floor.tool_width;
  ShortestPaths paths(floor);
  const std::vector<Polyline> walls = Contours(floor, PoseDepth(floor), 0);

  Swept covered(floor);
  std::vector<Polyline> lines;
  if (edges_) lines = OpenParts(floor, walls, kLapShare, w, kWallTolerance, covered);
  double laps = 0;
  for (const Polyline& lap : lines) laps += PolylineLength(lap);
  for (Polyline& line : Lines(floor, covered, figures)) lines.push_back(std::move(line));
  Polyline path = Drive(paths, start, lines, false);

  Polyline best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (int round = 1, tries = 1; tries > 0; ++round) {
    Swept swept(floor);
    swept.Add(path);
    Prune(floor, {goal_cells, kFirstWorth, 1}, path, swept);
    if (round >= kRounds) Relax(floor, {goal_cells, effort.relaxed_worth, 2, 1}, path, swept);
    std::vector<Polyline> pieces = WorkingPieces(floor, path, kWorkingShare, swept);
    const int care = std::min(round, kMaxRounds);
    const double min_gain = std::min(effort.least_gain * w * w, kSmall * floor.ground_cells) / care;
    std::vector<Polyline> rest =
        OpenParts(floor, walls, effort.open_share / care, min_gain, kWallTolerance, swept);
    for (Polyline& line : LinesOverUncoveredPatches(floor, paths, min_gain, swept))
      rest.push_back(std::move(line));
    CutBeside(floor, rest, kCutReach * w, pieces);
    for (Polyline& line : rest) pieces.push_back(std::move(line));
    path = Drive(paths, start, pieces, round >= kRounds);
    if (round < kRounds) continue;

    if (round == kRounds)
      tries =
          static_cast<int>(std::clamp(kTriedEffort / EffortOfTry(floor, path), 1.0, kMostTries));
    const Outcome outcome = Finish(floor, paths, effort, path);
    if (outcome.cost < best_cost) best_cost = outcome.cost, best = path;
    --tries;
    if (tries == 0 && !outcome.enough && round < kMaxRounds) tries = 1;
  }
  path = best;
  Swept swept(floor);
  swept.Add(path);

  const double cell_m = floor.frame.cell_m;
  double working = 0;
  for (const Polyline& piece : WorkingPieces(floor, path, kWorkingShare, swept))
    working += PolylineLength(piece);
  figures.push_back({"laps_m", laps * cell_m});
  figures.push_back({"transit_m", (PolylineLength(path) - working) * cell_m});
  return path;
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
  const bool circle = result.clear.kind == Shape2::Kind::kCircle;
  if (!circle && !IsConvex(result.clear.footprint_B)) {
    result.message = kNotConvex;
    return result;
  }
  const HeldGround ground = GroundOf(request.map, request, result);
  if (ground.area.sweepable_cells == 0) {
    result.status = StartFits(ground.area) ? PlanStatus::kNoFloor : PlanStatus::kStartBlocked;
    result.message = WhyNothing(request, ground.area, result.clear);
    return result;
  }
  auto along = PlanAlongWalls(request, ground, result);
  result = PlanOn(ground, request, std::move(result));
  if (!along) return result;
  // As the report counts it.
  const SweepArea area =
      ground.room.Sweepable(along->clear, along->tool, request.start.p(), Yaws::kQuarters);
  return IsBetter(area, *along, result) ? *std::move(along) : result;
}

CoveragePlanner::HeldGround CoveragePlanner::GroundOf(const HazardMap& map,
                                                      const PlanRequest& request,
                                                      const PlanResult& plan) {
  HeldGround ground{
      HoldYaw(map, request.start, plan.clear, plan.tool), FloorRoom(map, request.robot.step_m), {}};
  ground.area = ground.room.Sweepable(ground.held.clear, ground.held.tool, request.start.p(),
                                      ground.held.yaws);
  return ground;
}

std::optional<PlanResult> CoveragePlanner::PlanAlongWalls(const PlanRequest& request,
                                                          const HeldGround& ground,
                                                          const PlanResult& shapes) const {
  if (shapes.clear.kind == Shape2::Kind::kCircle) return {};
  const auto map = MapAlongWalls(request.map, shapes.clear);
  if (!map) return {};
  HeldGround along = GroundOf(*map, request, shapes);
  along.turned_rad = WrapAngle(map->frame.X_WG.yaw_rad - request.map.frame.X_WG.yaw_rad);
  const Pose2 start{request.start.x_m, request.start.y_m, *along.held.yaw_rad};
  if (!StandAt(request.map, request.robot, start).obstruction.empty()) return {};
  along.lost = std::max(0.0, 1 - along.area.area_m2() / ground.area.area_m2());
  if (along.lost > kMaxLost) return {};
  PlanResult plan = PlanOn(along, request, shapes);
  if (plan.status != PlanStatus::kSuccess) return {};
  return plan;
}

PlanResult CoveragePlanner::PlanOn(const HeldGround& ground, const PlanRequest& request,
                                   PlanResult result) const {
  const bool circle = result.clear.kind == Shape2::Kind::kCircle;
  const HeldShapes& held = ground.held;
  RoomyFloor roomy;
  roomy.area = ground.area;
  roomy.margin_m = margin_m_.value_or(radius_m_ ? 0.0 : (circle ? kMargin_m : kFootprintMargin_m));
  if (roomy.margin_m > 0)
    roomy =
        KeepMargin(ground.room, held, request.start.p(), std::move(roomy), margin_m_.has_value());
  if (roomy.area.sweepable_cells == 0) {
    result.status = PlanStatus::kStartBlocked;
    result.message = fmt::format("the clearance at the start is less than margin_m = {}",
                                 LengthText(roomy.margin_m));
    return result;
  }
  result.figures.push_back({"margin_m", roomy.margin_m});
  Floor floor = CropFloor(roomy.area, Grown(held.clear, roomy.margin_m), held.tool,
                          result.tool_width_m, overlap_);
  floor.turned_rad = ground.turned_rad;
  // A large loss to the margin cannot be made up by the rest of the floor.
  const double shortfall =
      ground.lost + (roomy.margin_m > 0 ? std::min(roomy.lost, kMaxLost) + kDriveLoss : 0);
  std::vector<Vec2> path_W;
  for (const Vec2& p : Sweep(floor, floor.ToCells(request.start.p()), shortfall, result.figures))
    path_W.push_back(floor.ToWorld(p));
  if (roomy.kept) path_W = roomy.kept->Centred(path_W);
  result.message = MarginText(roomy, path_W);
  for (const Vec2& p_W : path_W) {
    Waypoint w;
    w.p_W = p_W;
    w.yaw_rad = held.yaw_rad;
    result.path.push_back(w);
  }
  result.status = PlanStatus::kSuccess;
  return result;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// (1) What is left of the path is cut into the pieces that are free beside the marks. (2) The floor
// that the robot can reach is computed from where it is, or from a place nearby where its clear
// shape fits. (3) Piece by piece, the way there is the shortest path over that floor, or a straight
// line. Not done: a better order of the pieces, or sweeping what was missed.
#include "planners/lines/rejoin.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "planners/lines/held_yaw.h"
#include "planners/lines/shortest_paths.h"

namespace floorproof {
namespace {

constexpr double kLook_m = 0.05;     // along the path, between looks at whether it is free
constexpr double kNear_cells = 1.5;  // a path along walls may lie so far off the cells
constexpr double kAway_m = 0.12;     // kept from marks: they are as wrong as the robot's pose was
constexpr double kShortest_m = 0.1;  // what is left of a piece and shorter than this is left out

// What is left of the path, in the pieces that are free.
std::vector<Path> FreePieces(const RejoinRequest& request, const Floor& floor,
                             const ShortestPaths& paths) {
  std::vector<Path> pieces;
  Path piece;
  const auto close = [&] {
    if (Length(piece) >= kShortest_m ||
        std::ranges::any_of(piece, [](const Waypoint& w) { return w.dwell_s > 0 || w.task; }))
      pieces.push_back(piece);
    piece.clear();
  };
  for (std::size_t i = request.segment; i + 1 < request.path.size(); ++i) {
    const Waypoint& to = request.path[i + 1];
    const Vec2 a = request.path[i].p_W, b = to.p_W;
    const double begin = i == request.segment ? NearestFraction(a, b, request.X_WB.p()) : 0;
    const int looks =
        std::max(1, static_cast<int>(std::ceil((1 - begin) * (b - a).norm() / kLook_m)));
    const auto point = [&](int k) -> Vec2 {
      return a + (begin + (1 - begin) * k / looks) * (b - a);
    };
    const auto add = [&](int k) {
      piece.push_back(to);
      piece.back().p_W = point(k);
      if (k == looks) return;  // what is to be done at the waypoint is done there
      piece.back().dwell_s = 0;
      piece.back().task.reset();
    };
    for (int k = 0; k <= looks;) {
      int end = k;  // of the run of looks from k on that are free
      while (end <= looks && paths.NearestPose(floor.ToCells(point(end)), kNear_cells).ix >= 0)
        ++end;
      if (k > 0 || end == k) close();
      if (end > k) {
        if (piece.empty()) add(k);
        if (end > k + 1) add(end - 1);
      }
      k = end + 1;
    }
  }
  close();
  return pieces;
}

// Whether no wall of the map lies on the way from a to b; a may lie within one, where the robot
// thinks it is.
bool InSight(const ClearanceField& map, const Vec2& a, const Vec2& b) {
  const int looks = std::max(1, static_cast<int>(2 * (b - a).norm() / map.frame.cell_m));
  bool out = false;
  for (int k = 0; k <= looks; ++k) {
    const bool free = map.At(a + (b - a) * k / looks) > 0;
    if (out && !free) return false;
    out = out || free;
  }
  return out;
}

// Places near the robot where its clear shape may fit, the nearest first. The robot has backed off,
// but what it met may be larger than that.
std::vector<Vec2> PlacesNearby(const HazardMap& marked, const RejoinRequest& request) {
  constexpr double kFarthest_m = 0.5, kStep_m = 0.1;
  constexpr int kWays = 8;
  constexpr std::size_t kMax = 5;  // each costs a look at the whole map
  const Shape2& clear = request.clear;
  const double needs_m = 0.9 * (clear.kind == Shape2::Kind::kCircle
                                    ? clear.radius_m
                                    : -SignedDistance(clear.footprint_B, Vec2::Zero()));
  const ClearanceField room = ComputeClearance(marked, request.robot.step_m);
  const ClearanceField bare = ComputeClearance(request.known, request.robot.step_m);
  const Vec2 here = request.X_WB.p();
  std::vector<Vec2> places;
  for (double r_m = kStep_m; r_m <= kFarthest_m + 1e-9; r_m += kStep_m)
    for (int k = 0; k < kWays && places.size() < kMax; ++k) {
      const double a = 2 * kPi * k / kWays;
      const Vec2 p = here + r_m * Vec2(std::cos(a), std::sin(a));
      if (room.At(p) >= needs_m && InSight(bare, here, p)) places.push_back(p);
    }
  return places;
}

// The shapes as the rest of the path holds them. A footprint is tried at the one yaw that the path
// keeps, or at the map's quarters where it keeps none.
HeldShapes HeldOnTheRest(const RejoinRequest& request) {
  HeldShapes held{{}, request.clear, request.robot.tool};
  const auto first = std::min(request.segment + 1, request.path.size());
  const std::span<const Waypoint> rest = std::span(request.path).subspan(first);
  if (held.clear.kind == Shape2::Kind::kCircle || rest.empty() || !rest.front().yaw_rad ||
      std::ranges::any_of(rest, [&](const Waypoint& w) { return w.yaw_rad != rest[0].yaw_rad; }))
    return held;
  held.yaw_rad = rest.front().yaw_rad;
  const double turned = *held.yaw_rad - request.known.frame.X_WG.yaw_rad;
  held.clear = Turned(held.clear, turned);
  held.tool = Turned(held.tool, turned);
  held.yaws = Yaws::kFirst;
  return held;
}

}  // namespace

Path Rejoin(const RejoinRequest& request) {
  const RobotSpec& robot = request.robot;
  std::vector<FloorMark> marks = request.marks;
  for (FloorMark& mark : marks) mark.radius_m += kAway_m;
  const HazardMap marked = WithMarks(request.known, marks);

  Waypoint here;
  here.p_W = request.X_WB.p();
  Path path = {here};
  const HeldShapes held = HeldOnTheRest(request);
  const auto from = [&](const Vec2& p_W) {
    return ComputeSweepArea(marked, held.clear, held.tool, robot.step_m, p_W, held.yaws);
  };
  SweepArea area = from(here.p_W);
  if (area.sweepable_cells == 0)
    for (const Vec2& p : PlacesNearby(marked, request)) {
      area = from(p);
      if (area.sweepable_cells == 0) continue;
      path.emplace_back().p_W = p;
      break;
    }
  if (area.sweepable_cells == 0) {
    const auto next = std::min(request.segment + 1, request.path.size());
    path.insert(path.end(), request.path.begin() + static_cast<std::ptrdiff_t>(next),
                request.path.end());
    return path;
  }
  const Floor floor = CropFloor(area, held.clear, held.tool, robot.tool_width_m);
  ShortestPaths paths(floor);
  for (const Path& piece : FreePieces(request, floor, paths)) {
    const Vec2 last = floor.ToCells(path.back().p_W);
    if (!request.around) {
      const auto seen = std::ranges::find_if(
          piece, [&](const Waypoint& w) { return floor.Sees(last, floor.ToCells(w.p_W)); });
      path.insert(path.end(), seen, piece.end());
      if (seen != piece.end()) continue;
    }
    const Polyline route = paths.Route(last, floor.ToCells(piece.front().p_W));
    if (route.empty()) continue;  // cut off by what was met
    for (std::size_t i = 1; i + 1 < route.size(); ++i) {
      Waypoint on_the_way;
      on_the_way.p_W = floor.ToWorld(route[i]);
      on_the_way.yaw_rad = piece.front().yaw_rad;
      on_the_way.speed_mps = piece.front().speed_mps;
      path.push_back(on_the_way);
    }
    path.insert(path.end(), piece.begin(), piece.end());
  }
  return path;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The searches run side by side, each with a field of its own; what they find does not hang on how
// many there are.
#include "planners/audit/audit_floor.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "base/usable_cores.h"
#include "env/geometry/distance.h"
#include "planners/search/any_angle_field.h"

namespace floorproof {
namespace {

constexpr double kAround_m = 0.3;  // of a place closer to an obstacle: no margin is kept there
constexpr double kApart_m = 0.02;
constexpr int kHeadings = 64;  // that are tried at a place
constexpr int kFewStops = 16;  // for which a second thread is not worth it

// `all` within reach of the middles, besides `roomy`.
Grid<std::uint8_t> WithSurroundings(const Grid<std::uint8_t>& all, Grid<std::uint8_t> roomy,
                                    const std::vector<Cell>& middles, double reach) {
  const int r = static_cast<int>(std::ceil(reach));
  for (const Cell c : middles)
    for (int iy = std::max(0, c.iy - r); iy <= std::min(all.height - 1, c.iy + r); ++iy)
      for (int ix = std::max(0, c.ix - r); ix <= std::min(all.width - 1, c.ix + r); ++ix)
        if (all(ix, iy) && std::hypot(ix - c.ix, iy - c.iy) <= reach) roomy(ix, iy) = 1;
  return roomy;
}

}  // namespace

AuditFloor::AuditFloor(const PlanRequest& request, const FloorRoom& room, const SweepArea& area,
                       const HeldShapes& shapes, const std::vector<Vec2>& places, double margin_m)
    : floor_(CropFloor(area, shapes.clear, shapes.tool, request.robot.tool_width_m)),
      margin_m_(margin_m) {
  const Cell shift = CellOf(area.frame.Center(0, 0));
  const auto crop = [&](const Grid<std::uint8_t>& mask) {
    Grid<std::uint8_t> cropped(floor_.frame.width, floor_.frame.height);
    for (int iy = 0; iy < cropped.height; ++iy)
      for (int ix = 0; ix < cropped.width; ++ix)
        if (mask.Inside(ix - shift.ix, iy - shift.iy))
          cropped(ix, iy) = mask(ix - shift.ix, iy - shift.iy);
    return cropped;
  };
  stops_.push_back({request.start.p(), {}});
  const double sensor_x_m = shapes.yaw_rad ? 0 : request.robot.audit_sensor_x_m;
  for (const Vec2& p : places) {
    const std::optional<Stop> stop = StopFor(p, sensor_x_m, margin_m);
    stop_of_.push_back(stop ? static_cast<int>(stops_.size()) : 0);
    if (stop) stops_.push_back(*stop);
  }
  const auto gets_to_all = [&](const SweepArea& roomy) {
    const Grid<std::uint8_t> clear = crop(roomy.reachable);
    std::vector<Cell> close;
    for (const Stop& stop : stops_)
      if (const Cell c = CellOf(stop.p_W); floor_.pose.Inside(c) && !clear(c)) close.push_back(c);
    return Measure(WithSurroundings(floor_.pose, clear, close, floor_.ToCells(kAround_m)));
  };
  const Vec2 start = request.start.p();
  if (gets_to_all(room.Sweepable(Grown(shapes.clear, margin_m), shapes.tool, start, shapes.yaws)))
    return;
  std::vector<Vec2> stops_W;
  for (const Stop& stop : stops_) stops_W.push_back(stop.p_W);
  kept_.emplace(room, shapes, margin_m, area, start, stops_W);
  if (gets_to_all(kept_->area())) return;
  kept_.reset();
  margin_m_ = 0;
  Measure(floor_.pose);
}

std::optional<AuditFloor::Stop> AuditFloor::StopFor(const Vec2& place_W, double sensor_x_m,
                                                    double margin_m) const {
  const auto is_pose = [this](const Vec2& p_W) {
    const Cell c = CellOf(p_W);
    return floor_.pose.Inside(c) && floor_.pose(c);
  };
  if (sensor_x_m <= 0) {
    constexpr double kRounding = 1e-6;  // cells: at a cell's own centre none of the others count
    const bool clear = is_pose(place_W) && floor_.Free(floor_.ToCells(place_W), kRounding);
    return clear ? std::optional<Stop>({place_W, {}}) : std::nullopt;
  }
  std::optional<Stop> best;
  double best_room = 0, best_way = 0;
  for (int k = 0; k < kHeadings; ++k) {
    const double yaw_rad = WrapAngle(2 * kPi * k / kHeadings);
    const Vec2 p_W = place_W - sensor_x_m * Vec2(std::cos(yaw_rad), std::sin(yaw_rad));
    if (!is_pose(p_W)) continue;
    const double room = std::min(floor_.MarginAt(floor_.ToCells(p_W)), floor_.ToCells(margin_m));
    const double way = (p_W - stops_.front().p_W).norm();
    if (room < 0 || (best && (room < best_room || (room == best_room && way >= best_way))))
      continue;
    // A stop of its own: at one place a robot faces one way.
    if (std::ranges::any_of(stops_, [&](const Stop& s) { return (s.p_W - p_W).norm() < kApart_m; }))
      continue;
    best = Stop{p_W, yaw_rad};
    best_room = room;
    best_way = way;
  }
  return best;
}

bool AuditFloor::Measure(const Grid<std::uint8_t>& free) {
  const auto n = static_cast<int>(stops_.size());
  const AnyAngleFloor floor(free);
  std::vector<Cell> cells;
  for (const Stop& stop : stops_) cells.push_back(CellOf(stop.p_W));
  // A start may be clear in a cell whose centre is just not (env/core/coverage.h).
  for (Cell& c : cells)
    for (int k = 0; k < 9 && !(free.Inside(c) && free(c)); ++k)
      if (const Cell d{c.ix + k % 3 - 1, c.iy + k / 3 - 1}; free.Inside(d) && free(d)) c = d;
  distances_ = PlaceDistances(n);
  ways_.assign(Z(n), {});
  std::atomic<int> next = 0;
  std::atomic<bool> all = true;
  const auto search = [&] {
    AnyAngleField field(floor);
    for (int a = next++; a < n && all; a = next++) {
      field.From(cells[Z(a)]);
      for (int b = a + 1; b < n; ++b) {
        if (!std::isfinite(field.DistanceTo(cells[Z(b)]))) {
          all = false;
          break;
        }
        Ways& ways = ways_[Z(a)];
        for (const Cell c : field.PathTo(cells[Z(b)])) ways.cells.push_back(NumberOf(free, c));
        ways.ends.push_back(ways.cells.size());
        distances_.Set(a, b, PolylineLength(Way(a, b)));  // as it is driven
      }
    }
  };
  std::vector<std::thread> others;
  const int threads = std::min(UsableCores(), n / kFewStops);
  for (int t = 1; t < threads; ++t) others.emplace_back(search);
  search();
  for (std::thread& thread : others) thread.join();
  return all;
}

std::vector<Vec2> AuditFloor::Way(int from, int to) const {
  const int a = std::min(from, to), b = std::max(from, to);
  std::vector<Vec2> way;
  const Ways& ways = ways_[Z(a)];
  const auto k = Z(b - a - 1);
  for (std::size_t i = k > 0 ? ways.ends[k - 1] : 0; i < ways.ends[k]; ++i)
    way.push_back(Floor::CentreOf(floorproof::CellAt(floor_.pose, Z(ways.cells[i]))));
  if (from > to) std::reverse(way.begin(), way.end());
  // Stops lie anywhere in their cells: the way ends there, by the cell's middle where it must.
  const auto end_at = [&](const Vec2& p_W, bool front) {
    const Vec2 p = floor_.ToCells(p_W);
    const auto at = front ? way.begin() : way.end() - 1;
    if ((*at - p).norm() < 1e-6) return;
    if (way.size() >= 2 && floor_.Sees(p, front ? way[1] : way[way.size() - 2]))
      *at = p;
    else
      way.insert(front ? way.begin() : way.end(), p);
  };
  end_at(stops_[Z(from)].p_W, true);
  end_at(stops_[Z(to)].p_W, false);
  way = MergeStraight(way);
  for (Vec2& p : way) p = floor_.ToWorld(p);
  return kept_ ? kept_->Centred(way, true) : way;
}

}  // namespace floorproof

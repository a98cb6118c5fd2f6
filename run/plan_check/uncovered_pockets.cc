// SPDX-License-Identifier: Apache-2.0
// Every uncovered cell has a reason; cells of one reason that hang together are one pocket, cut
// where they are thinner than a quarter of the tool: the seams along walls would join everything.
// The widest way into what the robot does not fit into is found for all such cells at once, by a
// search that always goes on from the cell with the widest way to it.
#include "run/plan_check/uncovered_pockets.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <queue>
#include <utility>

#include "env/core/plan_passes.h"
#include "env/geometry/box.h"
#include "env/geometry/distance.h"
#include "env/geometry/rasterise.h"
#include "run/scenario/floors.h"
#include "run/scenario/world.h"

namespace floorproof {
namespace {

using Why = UncoveredPocket::Why;
using Mask = Grid<std::uint8_t>;

constexpr Cell kSides[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};

// Cells of `free` that hang together with a set cell of `from` by their sides.
Mask Connected(const Mask& free, const Mask& from) {
  Mask out(free.width, free.height);
  std::vector<Cell> stack;
  for (int iy = 0; iy < free.height; ++iy)
    for (int ix = 0; ix < free.width; ++ix)
      if (from(ix, iy) && free(ix, iy)) {
        out(ix, iy) = 1;
        stack.push_back({ix, iy});
      }
  while (!stack.empty()) {
    const Cell c = stack.back();
    stack.pop_back();
    for (const Cell& d : kSides) {
      const Cell n{c.ix + d.ix, c.iy + d.iy};
      if (!free.Inside(n) || !free(n) || out(n)) continue;
      out(n) = 1;
      stack.push_back(n);
    }
  }
  return out;
}

// The cells that an obstacle of the map touches, in a grid of its own: a floor may have thousands
// of obstacles, and each is small beside it.
struct Touched {
  Cell low;  // of the map's grid, where this one begins
  Mask cells;
};
Touched CellsOf(const Hazard& hazard, const GridFrame& frame) {
  std::vector<Polygon> polygons;
  const Vec2 size(frame.width, frame.height);
  Vec2 low = size, high = Vec2::Zero();  // in cells
  for (const Polygon& footprint : hazard.footprint) {
    Polygon& p_G = polygons.emplace_back();
    for (const Vec2& p_W : footprint) {
      p_G.push_back(frame.ToGrid(p_W) / frame.cell_m);
      low = low.cwiseMin(p_G.back());
      high = high.cwiseMax(p_G.back());
    }
  }
  const Eigen::Vector2i first = low.cwiseMax(0.0).cast<int>();
  const Eigen::Vector2i end = high.cwiseMin(size - Vec2::Ones()).cast<int>().array() + 1;
  if ((first.array() >= end.array()).any()) return {};
  Touched touched{{first.x(), first.y()}, Mask(end.x() - first.x(), end.y() - first.y())};
  for (const Polygon& p_G : polygons)
    Rasterise(p_G, frame.width, frame.height,
              [&](int ix, int iy) { touched.cells(ix - touched.low.ix, iy - touched.low.iy) = 1; });
  return touched;
}

// Per cell, the narrowest place of the widest way to it from where the robot can be, as a clearance
// to either side; and where that is.
struct WaysIn {
  Grid<float> narrowest_m;
  Grid<std::uint32_t> where;
};
WaysIn FindWaysIn(const SweepArea& area, const Mask& free) {
  WaysIn ways{Grid<float>(free.width, free.height, -1.0f),
              Grid<std::uint32_t>(free.width, free.height)};
  using Entry = std::pair<float, std::uint32_t>;
  std::priority_queue<Entry> open;
  const auto reach = [&](Cell c, float narrowest_m, std::uint32_t where) {
    const auto at = static_cast<std::uint32_t>(free.Index(c.ix, c.iy));
    const float own_m = area.clearance_m(c);
    if (own_m < narrowest_m) narrowest_m = own_m, where = at;
    if (ways.narrowest_m.cells[at] >= narrowest_m) return;
    ways.narrowest_m.cells[at] = narrowest_m;
    ways.where.cells[at] = where;
    open.push({narrowest_m, at});
  };
  const auto width = static_cast<std::uint32_t>(free.width);
  const auto spread = [&](Cell c, float narrowest_m, std::uint32_t where) {
    for (const Cell& d : kSides) {
      const Cell n{c.ix + d.ix, c.iy + d.iy};
      if (free.Inside(n) && free(n) && !area.reachable(n)) reach(n, narrowest_m, where);
    }
  };
  for (int iy = 0; iy < free.height; ++iy)
    for (int ix = 0; ix < free.width; ++ix)
      if (area.reachable(ix, iy))
        spread({ix, iy}, std::numeric_limits<float>::infinity(),
               static_cast<std::uint32_t>(free.Index(ix, iy)));
  while (!open.empty()) {
    const auto [narrowest_m, at] = open.top();
    open.pop();
    if (narrowest_m < ways.narrowest_m.cells[at]) continue;
    spread({static_cast<int>(at % width), static_cast<int>(at / width)}, narrowest_m,
           ways.where.cells[at]);
  }
  return ways;
}

// Per cell within the walls, the first cell on the way to it that a hazard closes: on the way from
// where the robot can be that leads through the fewest of these. Unreached cells keep `kNowhere`.
constexpr std::uint32_t kNowhere = std::numeric_limits<std::uint32_t>::max();
Grid<std::uint32_t> FirstClosed(const SweepArea& area, const Mask& free, const Mask& within) {
  Grid<std::uint32_t> first(free.width, free.height, kNowhere), closed(first);
  std::deque<Cell> open;  // by how many it leads through, ascending
  for (int iy = 0; iy < free.height; ++iy)
    for (int ix = 0; ix < free.width; ++ix)
      if (area.reachable(ix, iy)) closed(ix, iy) = 0, open.push_back({ix, iy});
  while (!open.empty()) {
    const Cell c = open.front();
    open.pop_front();
    for (const Cell& d : kSides) {
      const Cell n{c.ix + d.ix, c.iy + d.iy};
      if (!free.Inside(n) || !within(n)) continue;
      const std::uint32_t through = closed(c) + (free(n) ? 0 : 1);
      if (closed(n) <= through) continue;
      closed(n) = through;
      first(n) = first(c) == kNowhere && !free(n)
                     ? static_cast<std::uint32_t>(free.Index(n.ix, n.iy))
                     : first(c);
      free(n) ? open.push_front(n) : open.push_back(n);
    }
  }
  return first;
}

struct Patch {
  std::int64_t cells = 0;
  Cell widest;
  float half_width = 0;  // cells, there
};

// The patches of `cells` that are thicker than 2 * least_half cells somewhere; `rest` counts the
// cells that belong to none.
std::vector<Patch> Patches(const Mask& cells, double least_half, std::int64_t& rest) {
  Mask others(cells.width, cells.height);
  for (std::size_t i = 0; i < cells.cells.size(); ++i) others.cells[i] = !cells.cells[i];
  const Grid<float> half = DistanceToSet(others, true);
  Mask taken(cells.width, cells.height);
  const auto grow =
      static_cast<int>(std::ceil(least_half)) + 1;  // back to what the core was cut of
  std::vector<Patch> patches;
  std::vector<std::pair<Cell, int>> queue;
  std::int64_t all = 0, in_patches = 0;
  for (int iy = 0; iy < cells.height; ++iy)
    for (int ix = 0; ix < cells.width; ++ix) {
      all += cells(ix, iy);
      if (taken(ix, iy) || !cells(ix, iy) || static_cast<double>(half(ix, iy)) < least_half)
        continue;
      Patch patch;
      taken(ix, iy) = 1;
      queue.assign(1, {{ix, iy}, 0});
      for (std::size_t k = 0; k < queue.size(); ++k) {
        const auto [c, from_core] = queue[k];
        ++patch.cells;
        if (half(c) > patch.half_width) patch.half_width = half(c), patch.widest = c;
        for (const Cell& d : kSides) {
          const Cell n{c.ix + d.ix, c.iy + d.iy};
          if (!cells.Inside(n) || !cells(n) || taken(n)) continue;
          const int steps = static_cast<double>(half(n)) >= least_half ? 0 : from_core + 1;
          if (steps > grow) continue;
          taken(n) = 1;
          queue.push_back({n, steps});
        }
      }
      in_patches += patch.cells;
      patches.push_back(patch);
    }
  rest += all - in_patches;
  return patches;
}

class Finder {
 public:
  Finder(const World& world, const PlanResult& plan, const SweepArea& area)
      : known_(KnownFloor(world)), step_m_(world.robot.spec.step_m), area_(area), plan_(plan) {
    free_ = FreeOn(known_);
    HazardMap bare = known_;
    bare.hazards.clear();
    within_walls_ = FreeOn(bare);
    const double cell_m = area.frame.cell_m;
    least_half_ = std::max(1.0, plan.tool_width_m / 8 / cell_m);
    least_cells_ = std::pow(plan.tool_width_m / 2 / cell_m, 2);
  }

  UncoveredFloor Find() {
    const CoverageMeter meter = PassesOf(area_, plan_.tool, plan_.path);
    const Mask from_floor = Connected(free_, area_.reachable);
    const Mask from_start = Connected(within_walls_, area_.reachable);
    Mask of[4];
    for (Mask& mask : of) mask = Mask(free_.width, free_.height);
    const double cell_m2 = area_.frame.cell_m * area_.frame.cell_m;
    std::int64_t floor = 0, covered = 0;
    for (std::size_t i = 0; i < free_.cells.size(); ++i) {
      if (!free_.cells[i]) continue;
      ++floor;
      if (area_.sweepable.cells[i] && meter.passes().cells[i] > 0) {
        ++covered;
        continue;
      }
      const Why why = area_.sweepable.cells[i] ? Why::kNotVisited
                      : from_floor.cells[i]    ? Why::kNarrow
                      : from_start.cells[i]    ? Why::kBehind
                                               : Why::kClosed;
      of[static_cast<std::size_t>(why)].cells[i] = 1;
    }
    out_.covered_m2 = static_cast<double>(covered) * cell_m2;
    for (const Why why : {Why::kNotVisited, Why::kNarrow, Why::kBehind, Why::kClosed})
      AddPockets(why, of[static_cast<std::size_t>(why)]);
    floor += AddLevels();
    out_.floor_m2 = static_cast<double>(floor) * cell_m2;
    out_.edges_m2 = static_cast<double>(rest_) * cell_m2;
    std::ranges::stable_sort(out_.pockets, std::ranges::greater(), &UncoveredPocket::area_m2);
    return std::move(out_);
  }

 private:
  // Cells that no obstacle of this floor takes.
  Mask FreeOn(const HazardMap& floor) const {
    Mask free = ObstacleMask(floor, step_m_, area_.frame);
    for (std::uint8_t& cell : free.cells) cell = !cell;
    return free;
  }

  Vec2 CentreOf(std::uint32_t index) const {
    const auto width = static_cast<std::uint32_t>(free_.width);
    return area_.frame.Center(static_cast<int>(index % width), static_cast<int>(index / width));
  }

  void AddPockets(Why why, const Mask& cells) {
    const std::vector<Patch> patches = Patches(cells, least_half_, rest_);
    for (const Patch& patch : patches) {
      if (static_cast<double>(patch.cells) < least_cells_) {
        rest_ += patch.cells;
        continue;
      }
      UncoveredPocket pocket;
      pocket.why = why;
      pocket.area_m2 = static_cast<double>(patch.cells) * area_.frame.cell_m * area_.frame.cell_m;
      pocket.p_W = area_.frame.Center(patch.widest);
      pocket.width_m = 2 * static_cast<double>(patch.half_width) * area_.frame.cell_m;
      if (why == Why::kNarrow) FindGap(patch, pocket);
      if (why == Why::kBehind) pocket.hazard = NearestHazard(ClosedAt(patch.widest));
      out_.pockets.push_back(std::move(pocket));
    }
  }

  void FindGap(const Patch& patch, UncoveredPocket& pocket) {
    if (ways_in_.narrowest_m.cells.empty()) ways_in_ = FindWaysIn(area_, free_);
    // The widest place of the pocket; the patch was measured between uncovered cells.
    const double narrowest_m = static_cast<double>(ways_in_.narrowest_m(patch.widest));
    const double own_m = static_cast<double>(area_.clearance_m(patch.widest));
    pocket.width_m = 2 * own_m;
    if (narrowest_m < 0 || own_m - narrowest_m < area_.frame.cell_m) return;
    const std::uint32_t at = ways_in_.where(patch.widest);
    pocket.gap_m = 2 * narrowest_m;
    pocket.gap_W = CentreOf(at);
  }

  // Where a hazard closes the way to the cell.
  Vec2 ClosedAt(const Cell& cell) {
    if (first_closed_.cells.empty()) first_closed_ = FirstClosed(area_, free_, within_walls_);
    const std::uint32_t at = first_closed_(cell);
    return at == kNowhere ? area_.frame.Center(cell) : CentreOf(at);
  }

  std::string NearestHazard(const Vec2& p_W) const {
    double nearest_m = std::numeric_limits<double>::infinity();
    std::string id;
    for (const Hazard& hazard : known_.hazards) {
      if (!IsObstacle(hazard, step_m_)) continue;
      for (const Polygon& footprint : hazard.footprint) {
        const double away_m = SignedDistance(footprint, p_W);
        if (away_m < nearest_m) nearest_m = away_m, id = hazard.id;
      }
    }
    return id;
  }

  // Floors that the robot does not get onto: of another level, or terrain beyond its measured
  // limits, as far as they lie within the walls. Returns of how many cells they are.
  std::int64_t AddLevels() {
    std::int64_t floor = 0;
    for (const Hazard& hazard : known_.hazards) {
      const bool is_floor =
          hazard.hazard_class == HazardClass::kLevelChange || hazard.crossable == false;
      if (!is_floor || !IsObstacle(hazard, step_m_)) continue;
      auto [low, cells] = CellsOf(hazard, area_.frame);
      for (int iy = 0; iy < cells.height; ++iy)
        for (int ix = 0; ix < cells.width; ++ix)
          if (free_(low.ix + ix, low.iy + iy)) cells(ix, iy) = 0;
      floor += std::ranges::count(cells.cells, 1);
      for (const Patch& patch : Patches(cells, least_half_, rest_)) {
        const double cell_m = area_.frame.cell_m;
        if (static_cast<double>(patch.cells) < least_cells_) {
          rest_ += patch.cells;
          continue;
        }
        out_.pockets.push_back(
            {Why::kKeptOff,
             static_cast<double>(patch.cells) * cell_m * cell_m,
             area_.frame.Center(low.ix + patch.widest.ix, low.iy + patch.widest.iy),
             2 * static_cast<double>(patch.half_width) * cell_m,
             {},
             Vec2::Zero(),
             hazard.id});
      }
    }
    return floor;
  }

  HazardMap known_;
  double step_m_;
  const SweepArea& area_;
  const PlanResult& plan_;
  Mask free_, within_walls_;
  double least_half_ = 1, least_cells_ = 1;
  std::int64_t rest_ = 0;
  WaysIn ways_in_;
  Grid<std::uint32_t> first_closed_;
  UncoveredFloor out_;
};

}  // namespace

double LeastPassage(const Shape2& clear) {
  if (clear.kind == Shape2::Kind::kCircle) return 2 * clear.radius_m;
  return BoxAround(clear.footprint_B).Size().minCoeff();
}

UncoveredFloor FindUncovered(const World& world, const PlanResult& plan, const SweepArea& area) {
  return Finder(world, plan, area).Find();
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What a planner of unknown floors costs: moves a second of one core, the world that it moves in
// included, and how many times as long as the world alone takes for the same moves; then a step on
// a floor of 1,000 x 1,000 cells that is known but for a strip: median, 99th percentile and
// longest. Last, of those that cover all, the step when all of such a floor is covered and a cell
// turns out to be free at the corner that is farthest away.
//   bench_online [CELLS]
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <vector>

#include "base/streams.h"
#include "planners/online/online_planner.h"
#include "run/episode/cell_world.h"

namespace floorproof {
namespace {

using Clock = std::chrono::steady_clock;

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// A room of square cells with rectangles in it, a tenth of it in all.
Grid<std::uint8_t> Room(int cells) {
  Grid<std::uint8_t> blocked(cells, cells);
  Stream draw(1, 0, "room");
  const auto below = [&](int n) {
    return static_cast<int>(draw.Below(static_cast<std::uint64_t>(n)));
  };
  for (int i = 0; i < cells * cells / 90; ++i) {
    const int w = 1 + below(5), h = 1 + below(5), x = 1 + below(cells - w - 1),
              y = 1 + below(cells - h - 1);
    for (int iy = y; iy < y + h; ++iy)
      for (int ix = x; ix < x + w; ++ix) blocked(ix, iy) = 1;
  }
  for (int iy = 0; iy < 3; ++iy)
    for (int ix = 0; ix < 3; ++ix) blocked(ix, iy) = 0;
  return blocked;
}

constexpr double kCell_m = 0.5;

struct Found {
  double moves_per_s = 0, over_world = 0;
  std::vector<double> step_s;
};

// `all_seen`: all but a strip at one side is known from the start.
Found Drive(const PluginEntry<OnlinePlanner>& entry, int cells, std::int64_t moves, bool all_seen) {
  const GridFrame frame = {cells, cells, kCell_m, {}};
  const Grid<std::uint8_t> blocked = Room(cells);
  const auto planner = entry.make();
  CellWorld world(frame, blocked, {1, 1}, planner->params().radius_m);
  KnownMap known(frame);
  known.changed.emplace();
  if (all_seen)
    for (int iy = 0; iy < cells; ++iy)
      for (int ix = 0; ix < cells - 20; ++ix) known.Add(ix, iy, blocked(ix, iy) ? 4 : -4, 4);
  Estimate estimate;
  const auto look = [&] {
    const Vec2 p_W = frame.Center(world.here());
    estimate.X_WB = {p_W.x(), p_W.y(), 0};
  };
  look();
  planner->Start({frame, estimate.X_WB, {}, {}, kCell_m, 1});
  std::vector<Cell> way;
  Found found;
  const auto begin = Clock::now();
  for (std::int64_t i = 0; i < moves; ++i) {
    world.Sense(known);
    const auto asked = Clock::now();
    const OnlineStep step = planner->Next({known, *known.changed, estimate});
    if (all_seen && i > 0) found.step_s.push_back(Since(asked));
    known.changed->clear();
    if (step.kind != OnlineStep::Kind::kTarget || !world.Step(frame.ToCell(step.target_W))) break;
    way.push_back(world.here());
    look();
  }
  const double with_s = Since(begin);
  found.moves_per_s = static_cast<double>(way.size()) / with_s;
  CellWorld bare(frame, blocked, {1, 1}, planner->params().radius_m);
  KnownMap seen(frame);
  const auto again = Clock::now();
  for (const Cell to : way) {
    bare.Sense(seen);
    bare.Step(to);
  }
  found.over_world = with_s / Since(again);
  return found;
}

// The way there is one way out over all of the floor, whatever the planner looks at near itself.
void FindFarCell(const PluginEntry<OnlinePlanner>& entry, int cells) {
  const GridFrame frame = {cells, cells, kCell_m, {}};
  const auto planner = entry.make();
  if (!planner->covers_all()) return;
  if (entry.name == "frontier_coverage")  // a million steps would take minutes
    ReadParams(ParseYaml("{look_around: 0}", "params"), "", *planner);
  CellWorld world(frame, Grid<std::uint8_t>(cells, cells), {1, 1}, planner->params().radius_m);
  KnownMap known(frame);
  known.changed.emplace();
  const std::array<Cell, 4> corners = {Cell{0, 0}, Cell{cells - 1, 0}, Cell{0, cells - 1},
                                       Cell{cells - 1, cells - 1}};
  for (const Cell c : corners) known.Add(c.ix, c.iy, 4, 4);
  Estimate estimate;
  const auto ask = [&] {
    const Vec2 p_W = frame.Center(world.here());
    estimate.X_WB = {p_W.x(), p_W.y(), 0};
    world.Sense(known);
    const OnlineStep step = planner->Next({known, *known.changed, estimate});
    known.changed->clear();
    return step;
  };
  planner->Start(
      {frame, {frame.Center({1, 1}).x(), frame.Center({1, 1}).y(), 0}, {}, {}, kCell_m, 1});
  while (true) {
    const OnlineStep step = ask();
    if (step.kind != OnlineStep::Kind::kTarget || !world.Step(frame.ToCell(step.target_W))) break;
  }
  const auto way = [&](Cell c) {
    return std::max(std::abs(c.ix - world.here().ix), std::abs(c.iy - world.here().iy));
  };
  const Cell far = *std::ranges::max_element(corners, {}, way);
  known.Add(far.ix, far.iy, -8, 4);
  const auto asked = Clock::now();
  const OnlineStep step = ask();
  fmt::print("{:20} to a free cell {} cells away, all between covered: {:.1f} ms{}\n", entry.name,
             way(far), 1e3 * Since(asked),
             step.kind == OnlineStep::Kind::kTarget ? "" : " (not found)");
}

void Run(int cells) {
  fmt::print("{:20} {:>12} {:>12}   step on {} x {} known cells, us\n", "planner", "moves/s",
             "x the world", cells, cells);
  for (const auto& entry : OnlinePlanners()) {
    const Found small = Drive(entry, 40, 1'000'000, false);
    Found large = Drive(entry, cells, 20'000, true);
    std::ranges::sort(large.step_s);
    const auto us = [&](double share) {
      const auto last = static_cast<double>(large.step_s.size() - 1);
      return 1e6 * large.step_s[static_cast<std::size_t>(share * last)];
    };
    fmt::print("{:20} {:12.0f} {:12.1f}   median {:.1f}, 99 % {:.1f}, longest {:.1f}\n", entry.name,
               small.moves_per_s, small.over_world, us(0.5), us(0.99), us(1));
  }
  for (const auto& entry : OnlinePlanners()) FindFarCell(entry, cells);
}

}  // namespace
}  // namespace floorproof

int main(int argc, char** argv) { floorproof::Run(argc > 1 ? std::atoi(argv[1]) : 1000); }

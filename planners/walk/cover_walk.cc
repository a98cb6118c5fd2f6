// SPDX-License-Identifier: Apache-2.0
// A travelling salesman's path over the wanted cells, in which neighbours link for nothing and any
// other link costs what must be passed once more: an order of the regions with few crossings, in
// them an order of the cells with few such links, which path_search then shortens. Deterministic;
// not optimal. Turns are not counted.
#include "planners/walk/cover_walk.h"

#include <algorithm>
#include <cmath>

#include "planners/lines/index.h"
#include "planners/walk/first_order.h"
#include "planners/walk/path_search.h"
#include "planners/walk/region_order.h"
#include "planners/walk/walk_costs.h"

namespace floorproof {
namespace {

constexpr std::size_t kNear = 5;
// Small floors are settled soon; large ones begin near the best.
constexpr double kWorkPerPlace = 10'000, kAmple = 1e6, kWorkPerMore = 200, kMaxWork = 1e8;

int CountCrossings(const Grid<std::uint8_t>& terrain, const std::vector<Cell>& walk) {
  int crossings = 0;
  bool on_terrain = false;
  for (const Cell c : walk) {
    crossings += terrain(c) && !on_terrain;
    on_terrain = terrain(c) != 0;
  }
  return crossings;
}

std::optional<Cell> FindUnreachable(const CoverWalkProblem& problem, const WalkGraph& graph) {
  const auto region = [&graph](Cell c) { return graph.region[Z(graph.At(c))]; };
  if (!problem.open.Inside(problem.start) || region(problem.start) < 0) return problem.start;
  std::vector<int> reached = {region(problem.start)};
  std::vector<std::uint8_t> is_reached(graph.touching.size(), 0);
  is_reached[Z(reached[0])] = 1;
  for (std::size_t k = 0; k < reached.size(); ++k)
    for (const int next : graph.touching[Z(reached[k])])
      if (!is_reached[Z(next)]) is_reached[Z(next)] = 1, reached.push_back(next);
  const auto missed = [&](Cell c) { return region(c) < 0 || !is_reached[Z(region(c))]; };
  if (problem.end && (!problem.open.Inside(*problem.end) || missed(*problem.end)))
    return problem.end;
  for (int iy = 0; iy < problem.wanted.height; ++iy)
    for (int ix = 0; ix < problem.wanted.width; ++ix)
      if (problem.wanted(ix, iy) && missed({ix, iy})) return Cell{ix, iy};
  return std::nullopt;
}

// The cells to be visited as places of a path: the start first; a fixed end last, if need be the
// start's cell once more.
struct Places {
  std::vector<int> cells;
  std::vector<int> at;  // by cell; -1: none
  std::vector<std::uint8_t> wanted;
  int start = -1, end = -1;  // cells; end -1: none, or the start
  bool fixed_end = false;

  Places(const CoverWalkProblem& problem, const WalkGraph& graph)
      : at(graph.size(), -1), wanted(graph.size(), 0), fixed_end(problem.end.has_value()) {
    start = graph.At(problem.start);
    if (problem.end && *problem.end != problem.start) end = graph.At(*problem.end);
    for (int iy = 0; iy < problem.wanted.height; ++iy)
      for (int ix = 0; ix < problem.wanted.width; ++ix)
        wanted[Z(graph.At({ix, iy}))] = problem.open(ix, iy) && problem.wanted(ix, iy);
    wanted[Z(start)] = 1;
    if (end >= 0) wanted[Z(end)] = 1;
    Add(start);
    for (int cell = 0; cell < static_cast<int>(graph.size()); ++cell)
      if (wanted[Z(cell)] && cell != start && cell != end) Add(cell);
    if (end >= 0) Add(end);
    if (fixed_end && end < 0) cells.push_back(start);
  }
  void Add(int cell) {
    at[Z(cell)] = static_cast<int>(cells.size());
    cells.push_back(cell);
  }
  int last() const { return static_cast<int>(cells.size()) - 1; }
};

// Places in an order to begin with.
std::vector<int> FirstPath(const WalkGraph& graph, const Places& places) {
  const int end = places.fixed_end ? places.cells.back() : -1;
  const std::vector<int> regions = OrderRegions(graph, places.wanted, places.start, end);
  std::vector<int> path = FirstOrder(graph, places.wanted, places.start, places.end, regions);
  for (int& cell : path) cell = places.at[Z(cell)];
  if (places.fixed_end && places.end < 0) path.push_back(places.last());
  return path;
}

std::vector<Cell> Shorten(const WalkGraph& graph, const Places& places, WalkCosts& costs,
                          const CoverWalkOptions& options, std::vector<int> path) {
  const double n = static_cast<double>(path.size());
  const double work = std::min(std::min(kWorkPerPlace * n, kAmple) + kWorkPerMore * n, kMaxWork);
  PathSearchOptions search;
  search.fixed_end = places.fixed_end;
  search.most_work = std::llround(options.effort * work);
  ShortenPath(costs, costs.Near(kNear), search, path);
  std::vector<int> cells = {places.start};
  for (std::size_t k = 1; k < path.size(); ++k) costs.AppendWay(path[k - 1], path[k], cells);
  std::vector<Cell> walk;
  for (const int at : cells) walk.push_back(graph.CellAt(at));
  return walk;
}

}  // namespace

CoverWalk ShortCoverWalk(const CoverWalkProblem& problem, const CoverWalkOptions& options) {
  CoverWalk result;
  const WalkGraph graph(problem, options);
  result.unreachable = FindUnreachable(problem, graph);
  if (result.unreachable) return result;

  const Places places(problem, graph);
  WalkCosts costs(graph, places.cells);
  result.cells = Shorten(graph, places, costs, options, FirstPath(graph, places));
  result.crossings = CountCrossings(problem.terrain, result.cells);
  return result;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A travelling salesman's tour over the required cells. An edge between neighbours costs nothing;
// any other edge costs the cells that must be passed once more. The floor is cut into regions of
// one kind (floor or terrain). First the regions are put in an order with few crossings
// (region_order.h). Then a tour is constructed region by region (tour_construction.h) and improved
// by 3-opt (planners/search/three_opt.h). Last, each edge becomes the cells of its cheapest way.
// Deterministic; not optimal. Turns are not counted.
#include "planners/walk/cover_walk.h"

#include <algorithm>
#include <cmath>

#include "planners/search/three_opt.h"
#include "planners/walk/region_order.h"
#include "planners/walk/tour_construction.h"
#include "planners/walk/walk_costs.h"

namespace floorproof {
namespace {

constexpr std::size_t kCandidates = 5;
// Small floors are settled soon. On large ones the tour is near the best from the start.
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
  std::vector<std::uint8_t> is_reached(graph.adjacent.size(), 0);
  is_reached[Z(reached[0])] = 1;
  for (std::size_t k = 0; k < reached.size(); ++k)
    for (const int next : graph.adjacent[Z(reached[k])])
      if (!is_reached[Z(next)]) is_reached[Z(next)] = 1, reached.push_back(next);
  const auto missed = [&](Cell c) { return region(c) < 0 || !is_reached[Z(region(c))]; };
  if (problem.end && (!problem.open.Inside(*problem.end) || missed(*problem.end)))
    return problem.end;
  for (int iy = 0; iy < problem.required.height; ++iy)
    for (int ix = 0; ix < problem.required.width; ++ix)
      if (problem.required(ix, iy) && missed({ix, iy})) return Cell{ix, iy};
  return std::nullopt;
}

// The cells to be visited as places of a tour. The start is the first place. A fixed end is the
// last one, if need be the start's cell once more.
struct Places {
  std::vector<int> cells;
  std::vector<int> at;  // by cell; -1: none
  std::vector<std::uint8_t> required;
  int start = -1, end = -1;  // cells; end -1: none, or the start
  bool fixed_end = false;

  Places(const CoverWalkProblem& problem, const WalkGraph& graph)
      : at(graph.size(), -1), required(graph.size(), 0), fixed_end(problem.end.has_value()) {
    start = graph.At(problem.start);
    if (problem.end && *problem.end != problem.start) end = graph.At(*problem.end);
    for (int iy = 0; iy < problem.required.height; ++iy)
      for (int ix = 0; ix < problem.required.width; ++ix)
        required[Z(graph.At({ix, iy}))] = problem.open(ix, iy) && problem.required(ix, iy);
    required[Z(start)] = 1;
    if (end >= 0) required[Z(end)] = 1;
    Add(start);
    for (int cell = 0; cell < static_cast<int>(graph.size()); ++cell)
      if (required[Z(cell)] && cell != start && cell != end) Add(cell);
    if (end >= 0) Add(end);
    if (fixed_end && end < 0) cells.push_back(start);
  }
  void Add(int cell) {
    at[Z(cell)] = static_cast<int>(cells.size());
    cells.push_back(cell);
  }
  int last() const { return static_cast<int>(cells.size()) - 1; }
};

// The tour that 3-opt begins with.
std::vector<int> InitialTour(const WalkGraph& graph, const Places& places) {
  const int end = places.fixed_end ? places.cells.back() : -1;
  const std::vector<int> regions = OrderRegions(graph, places.required, places.start, end);
  std::vector<int> tour = ConstructTour(graph, places.required, places.start, places.end, regions);
  for (int& cell : tour) cell = places.at[Z(cell)];
  if (places.fixed_end && places.end < 0) tour.push_back(places.last());
  return tour;
}

std::vector<Cell> Improve(const WalkGraph& graph, const Places& places, WalkCosts& costs,
                          const CoverWalkOptions& options, std::vector<int> tour) {
  const double n = static_cast<double>(tour.size());
  const double work = std::min(std::min(kWorkPerPlace * n, kAmple) + kWorkPerMore * n, kMaxWork);
  ThreeOptOptions search;
  search.fixed_end = places.fixed_end;
  search.max_work = std::llround(options.effort * work);
  ImproveTour(costs, costs.Candidates(kCandidates), search, tour);
  std::vector<int> cells = {places.start};
  for (std::size_t k = 1; k < tour.size(); ++k) costs.AppendWay(tour[k - 1], tour[k], cells);
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
  result.cells = Improve(graph, places, costs, options, InitialTour(graph, places));
  result.crossings = CountCrossings(problem.terrain, result.cells);
  return result;
}

}  // namespace floorproof

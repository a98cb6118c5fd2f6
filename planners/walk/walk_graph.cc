// SPDX-License-Identifier: Apache-2.0
#include "planners/walk/walk_graph.h"

#include <algorithm>
#include <cmath>

#include "planners/search/index.h"

namespace floorproof {
namespace {

double MeanCost(const CoverWalkProblem& problem) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < problem.open.cells.size(); ++i)
    if (problem.open.cells[i] && problem.required.cells[i]) sum += problem.cost.cells[i], ++count;
  return count > 0 ? sum / count : 1;
}

void FindRegions(const std::vector<std::uint8_t>& open, WalkGraph& graph) {
  std::vector<int> stack;
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (!open[i] || graph.region[i] >= 0) continue;
    const auto name = static_cast<std::int32_t>(graph.adjacent.size());
    graph.adjacent.emplace_back();
    graph.region[i] = name;
    stack.assign(1, static_cast<int>(i));
    while (!stack.empty()) {
      const int at = stack.back();
      stack.pop_back();
      for (const int next : graph.Neighbours(at)) {
        if (!open[Z(next)]) continue;
        std::int32_t& other = graph.region[Z(next)];
        if (graph.terrain[Z(next)] == graph.terrain[Z(at)]) {
          if (other < 0) other = name, stack.push_back(next);
        } else if (other >= 0) {
          graph.adjacent[Z(name)].push_back(other);
          graph.adjacent[Z(other)].push_back(name);
        }
      }
    }
  }
  for (auto& list : graph.adjacent) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
}

}  // namespace

WalkGraph::WalkGraph(const CoverWalkProblem& problem, const CoverWalkOptions& options)
    : stride(problem.open.width + 2) {
  const std::size_t count = Z(stride) * Z(problem.open.height + 2);
  region.assign(count, -1);
  terrain.assign(count, 0);
  weight.assign(count, 0);
  std::vector<std::uint8_t> open(count, 0);
  const double mean = MeanCost(problem);
  std::int64_t total = 0;
  for (int iy = 0; iy < problem.open.height; ++iy)
    for (int ix = 0; ix < problem.open.width; ++ix) {
      if (!problem.open(ix, iy)) continue;
      const std::size_t at = Z(At({ix, iy}));
      open[at] = 1;
      terrain[at] = problem.terrain(ix, iy) != 0;
      const double steps =
          1 + options.cost_share * (problem.cost(ix, iy) / mean - 1) + problem.more_steps(ix, iy);
      weight[at] = std::max<std::int64_t>(1, std::llround(static_cast<double>(kStep) * steps));
      if (total == 0 || weight[at] < least_weight) least_weight = weight[at];
      total += weight[at];
    }
  FindRegions(open, *this);
  // A crossing costs more than any way through all regions, so no saving makes up for one. (On a
  // floor in very many pieces the sums would be too large; there this is not proven.)
  const std::size_t most = 64, regions = adjacent.size();
  half_crossing = (total + 1) * static_cast<std::int64_t>(regions <= most ? regions + 1 : 1);
}

}  // namespace floorproof

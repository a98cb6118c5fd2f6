// SPDX-License-Identifier: Apache-2.0
// A tour through the regions, found in the same way as the walk itself, by 3-opt. A step from one
// region to another costs the borders that it crosses; of steps with equally many, the shorter one
// from middle to middle is cheaper. The first tour is that of a depth-first walk through the graph
// of regions. Where there are very many regions, that tour is the result.
#include "planners/walk/region_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "planners/search/three_opt.h"
#include "planners/walk/region_borders.h"

namespace floorproof {
namespace {

constexpr std::size_t kMaxOrdered = 2'000, kCandidates = 10;  // regions
constexpr std::int64_t kWorkPerRegion = 10'000;
constexpr std::int64_t kBorder = std::int64_t{1} << 32;  // more than any way, cells

class RegionCosts : public EdgeCosts {
 public:
  RegionCosts(const WalkGraph& graph, const std::vector<int>& regions)
      : count_(regions.size()), costs_(count_ * count_) {
    const std::vector<Vec2> middles = Middles(graph);
    RegionBorders borders(graph);
    for (std::size_t a = 0; a < count_; ++a)
      for (std::size_t b = 0; b < count_; ++b) {
        const double apart = (middles[Z(regions[a])] - middles[Z(regions[b])]).lpNorm<1>();
        costs_[a * count_ + b] =
            borders.To(regions[a], regions[b])[regions[b]] * kBorder + std::llround(apart);
      }
  }
  std::int64_t Cost(int a, int b, std::int64_t) override { return costs_[Z(a) * count_ + Z(b)]; }
  std::int64_t AtLeast(int a, int b) override { return Cost(a, b, 0); }
  std::int64_t EndCost(int) const override { return 0; }

  CandidateEdges Candidates() {
    CandidateEdges candidates;
    for (std::size_t a = 0; a < count_; ++a) {
      std::vector<CandidateEdge> edges;
      for (std::size_t b = 0; b < count_; ++b)
        if (b != a) edges.push_back({costs_[a * count_ + b], static_cast<int>(b)});
      std::ranges::stable_sort(edges, {}, &CandidateEdge::cost);
      if (edges.size() > kCandidates) edges.resize(kCandidates);
      for (const CandidateEdge& edge : edges) candidates.Add(edge);
      candidates.Close();
    }
    return candidates;
  }

 private:
  static std::vector<Vec2> Middles(const WalkGraph& graph) {
    std::vector<Vec2> sums(graph.adjacent.size(), Vec2::Zero());
    std::vector<double> cells(graph.adjacent.size(), 0);
    for (int at = 0; at < static_cast<int>(graph.size()); ++at) {
      if (graph.region[Z(at)] < 0) continue;
      const Cell c = graph.CellAt(at);
      sums[Z(graph.region[Z(at)])] += Vec2(c.ix, c.iy);
      ++cells[Z(graph.region[Z(at)])];
    }
    for (std::size_t r = 0; r < sums.size(); ++r) sums[r] /= cells[r];
    return sums;
  }

  std::size_t count_;
  std::vector<std::int64_t> costs_;
};

// The regions in the order of a depth-first walk from `first`.
std::vector<int> Walk(const WalkGraph& graph, int first) {
  std::vector<int> order, stack = {first};
  std::vector<std::uint8_t> done(graph.adjacent.size(), 0);
  while (!stack.empty()) {
    const int region = stack.back();
    stack.pop_back();
    if (done[Z(region)]) continue;
    done[Z(region)] = 1;
    order.push_back(region);
    const auto& beside = graph.adjacent[Z(region)];
    stack.insert(stack.end(), beside.rbegin(), beside.rend());
  }
  return order;
}

}  // namespace

std::vector<int> OrderRegions(const WalkGraph& graph, const std::vector<std::uint8_t>& required,
                              int start, int end) {
  const int first = graph.region[Z(start)], last = end < 0 ? -1 : graph.region[Z(end)];
  std::vector<std::uint8_t> holds(graph.adjacent.size(), 0);
  for (std::size_t i = 0; i < required.size(); ++i)
    if (required[i]) holds[Z(graph.region[i])] = 1;
  std::vector<int> regions;
  for (const int region : Walk(graph, first))
    if (holds[Z(region)] && (region == first || region != last)) regions.push_back(region);
  if (last >= 0) regions.push_back(last);  // once more where it is the first
  if (regions.size() > 3 && regions.size() <= kMaxOrdered) {
    RegionCosts costs(graph, regions);
    ThreeOptOptions options;
    options.fixed_end = end >= 0;
    options.max_work = kWorkPerRegion * static_cast<std::int64_t>(regions.size());
    std::vector<int> tour(regions.size());
    std::iota(tour.begin(), tour.end(), 0);
    ImproveTour(costs, costs.Candidates(), options, tour);
    std::vector<int> order;
    for (const int k : tour) order.push_back(regions[Z(k)]);
    regions = order;
  }
  if (last == first) regions.pop_back();
  return regions;
}

}  // namespace floorproof

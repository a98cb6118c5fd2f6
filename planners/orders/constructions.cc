// SPDX-License-Identifier: Apache-2.0
#include "planners/orders/constructions.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace floorproof {

std::vector<int> NearestNeighbourOrder(const PlaceDistances& distances) {
  std::vector<int> order = AsNumbered(distances.size());
  for (auto next = order.begin(); next != order.end(); ++next) {
    if (next == order.begin()) continue;
    const int at = *(next - 1);
    const auto nearest = std::min_element(next, order.end(), [&](int a, int b) {
      return std::tuple(distances(at, a), a) < std::tuple(distances(at, b), b);
    });
    std::iter_swap(next, nearest);
  }
  return order;
}

std::vector<int> GreedyOrder(const PlaceDistances& distances) {
  const int n = distances.size();
  std::vector<std::tuple<double, int, int>> edges;
  edges.reserve(Z(n) * Z(n) / 2);
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b) edges.push_back({distances(a, b), a, b});
  std::ranges::sort(edges);
  std::vector<std::array<int, 2>> neighbours(Z(n), {-1, -1});
  std::vector<int> other_end = AsNumbered(n);  // of the way that a place is an end of
  const auto takes_one = [&](int a) { return neighbours[Z(a)][a == 0 ? 0 : 1] < 0; };
  // The start is an end for good: it may be joined to another way only by that one's end.
  int left = n - 1;
  for (const auto& [m, a, b] : edges) {
    if (!takes_one(a) || !takes_one(b) || other_end[Z(a)] == b) continue;
    neighbours[Z(a)][neighbours[Z(a)][0] < 0 ? 0 : 1] = b;
    neighbours[Z(b)][neighbours[Z(b)][0] < 0 ? 0 : 1] = a;
    const int p = other_end[Z(a)], q = other_end[Z(b)];
    other_end[Z(p)] = q, other_end[Z(q)] = p;
    if (--left == 0) break;
  }
  std::vector<int> order;
  for (int at = 0, from = -1; at >= 0 && static_cast<int>(order.size()) < n;) {
    order.push_back(at);
    const int next = neighbours[Z(at)][neighbours[Z(at)][0] == from ? 1 : 0];
    from = at, at = next;
  }
  return order;
}

}  // namespace floorproof

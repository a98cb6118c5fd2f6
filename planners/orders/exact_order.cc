// SPDX-License-Identifier: Apache-2.0
// Dynamic programming over sets of places: the shortest way from the start through a set that ends
// at one of its places is the shortest one through the set without that place, and one edge (Held &
// Karp, "A Dynamic Programming Approach to Sequencing Problems", SIAM Journal 10, 1962).
//
// Sets are bits, the start is in none. Ties go to the lesser place.
#include "planners/orders/exact_order.h"

#include <algorithm>
#include <limits>

namespace floorproof {

std::vector<int> ExactOrder(const PlaceDistances& distances, bool closed) {
  const int others = distances.size() - 1;
  if (others < 1) return AsNumbered(distances.size());
  const unsigned all = (1u << others) - 1;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  // Bit and index i stand for place i + 1.
  std::vector<std::vector<double>> best_m(all + 1, std::vector<double>(Z(others), kNever));
  std::vector<std::vector<int>> before(all + 1, std::vector<int>(Z(others), -1));
  for (int i = 0; i < others; ++i) best_m[1u << i][Z(i)] = distances(0, i + 1);
  for (unsigned set = 1; set <= all; ++set)
    for (int last = 0; last < others; ++last) {
      if (!(set >> last & 1u)) continue;
      for (int next = 0; next < others; ++next) {
        if (set >> next & 1u) continue;
        const double length_m = best_m[set][Z(last)] + distances(last + 1, next + 1);
        const unsigned with = set | 1u << next;
        if (length_m < best_m[with][Z(next)])
          best_m[with][Z(next)] = length_m, before[with][Z(next)] = last;
      }
    }
  int last = 0;
  const auto whole_m = [&](int i) {
    return best_m[all][Z(i)] + (closed ? distances(i + 1, 0) : 0);
  };
  for (int i = 1; i < others; ++i)
    if (whole_m(i) < whole_m(last)) last = i;
  std::vector<int> order;
  for (unsigned set = all; last >= 0;) {
    order.push_back(last + 1);
    const int previous = before[set][Z(last)];
    set &= ~(1u << last);
    last = previous;
  }
  order.push_back(0);
  std::ranges::reverse(order);
  return order;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "planners/orders/rows.h"

#include <algorithm>
#include <tuple>

namespace floorproof {

std::vector<int> OrderByY(const OrderRequest& request) {
  std::vector<int> order = AsNumbered(request.distances.size());
  if (order.empty()) return order;
  std::ranges::sort(order.begin() + 1, order.end(), {}, [&](int a) {
    const Vec2& p = request.places[Z(a)];
    return std::tuple(p.y(), p.x(), a);
  });
  return order;
}

std::vector<int> OrderByRows(const OrderRequest& request, double row_m) {
  const auto& p = request.places;
  std::vector<int> order = OrderByY(request);
  if (order.size() < 2) return order;
  bool ascending = true;
  for (auto row = order.begin() + 1; row != order.end();) {
    const double end_m = p[Z(*row)].y() + row_m;
    const auto next = std::find_if(row, order.end(), [&](int a) { return p[Z(a)].y() > end_m; });
    std::sort(row, next, [&](int a, int b) {
      return std::tuple(p[Z(a)].x(), a) < std::tuple(p[Z(b)].x(), b);
    });
    if (row == order.begin() + 1)
      ascending = request.distances(0, *row) <= request.distances(0, *(next - 1));
    if (!ascending) std::reverse(row, next);
    ascending = !ascending;
    row = next;
  }
  return order;
}

}  // namespace floorproof
